//! The sphere test with the residual form of the discriminant.
//!
//! **Decides** whether rays meet one sphere, and where they first do.
//!
//! **Parameters.** World space. The `t` interval is closed at both ends; of the two roots the first
//! that is at least `tmin` counts, so that rays from inside hit the far side.
//!
//! **Precision.** The discriminant is r² − |l|², where l is the vector from the centre to the point
//! of the ray that is nearest to it: no difference of large squares, however far the sphere. The
//! roots are q / a and c / q, with the sign of q such that nothing cancels. Worst cases measured in
//! `tests/it/sphere.rs`. The hit's `t` is at least the entry into the sphere's own box.
//!
//! **Degenerate inputs.** A ray that touches the sphere may hit or miss it.
//!
//! **Operations**: 8 subtractions and additions, 10 multiplications, a division and a comparison to
//! the first rejection.
//!
//! Source: Haines, Günther, Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection",
//! Ray Tracing Gems, chapter 7. Deviation: `t` is clamped to the own box.

use simd4::math::Vec3;
use simd4::{Lanes, SimdF32, SimdMask};

use crate::packet::{Frame, Packet, Query};
use crate::primitives::SphereRecord;
use crate::slab::robust;

/// Tests a packet against one sphere and records the hits.
#[inline(always)]
pub fn intersect<V: SimdF32, F: Frame<V>, Q: Query<V>>(
    s: V::Simd,
    record: &SphereRecord,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Q,
) {
    let sphere = &record.sphere;
    let radius2 = V::splat(s, sphere.radius * sphere.radius);
    // From the ray's origin to the centre.
    let center = Vec3::splat(s, sphere.center.to_array()) - packet.origin;
    let a = packet.dir.dot(packet.dir);
    let b = center.dot(packet.dir);
    let nearest = center - packet.dir * (b / a);
    let discriminant = radius2 - nearest.dot(nearest);
    let zero = V::splat(s, 0.0);
    let meets = discriminant.ge(zero);
    if meets.none() {
        return;
    }

    let root = (a * discriminant).sqrt();
    let q = b + b.ge(zero).select(root, -root);
    let c = center.dot(center) - radius2;
    let (t0, t1) = (c / q, q / a);
    let (enter, exit) = robust::enter_exit(s, &sphere.own_box(), packet, frame);
    let (first, second) = (t0.min(t1), t0.max(t1));
    let t = first.ge(packet.tmin).select(first, second);
    let ahead = meets & packet.tmin.le(t) & packet.tmin.le(exit);
    let t = t.max(enter);
    let hits = ahead & enter.le(exit) & t.le(query.limit());
    if hits.any() {
        query.record(s, hits, V::U32::splat(s, record.prim), t, zero, zero);
    }
}
