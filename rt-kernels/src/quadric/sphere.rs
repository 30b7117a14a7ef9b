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

use super::form::{Ball, Form, depth_in_ball, see_ball};
use super::residual::nearest;
use super::stable::q_roots;
use super::{Found, QuadricKernel, Record, Records, Roots};
use crate::geom::Curved;
use crate::packet::{Boxes, Frame, Packet, Query};
use crate::primitives::SphereRecord;
use crate::slab::robust;
use crate::tri::knobs::Plain;

/// The sphere test that renders: [`Residual`](super::Residual) with the clamp to the sphere's own
/// box. The [module](self) has the rest.
#[derive(Clone, Copy, Debug)]
pub struct OwnBoxSphere;

impl QuadricKernel for OwnBoxSphere {
    const NAME: &'static str = "residual";
    const FRAMED: bool = true;

    fn variant() -> String {
        "sphere, own box".to_string()
    }

    fn record(surface: &Curved, prim: u32) -> Option<Record> {
        Ball::record(surface, prim)
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Found<V>> {
        let (center, radius) = (records.center(s), records.size(s));
        test(
            s,
            center,
            radius,
            #[inline(always)]
            || records.own_boxes(s),
            packet,
            frame,
            limit,
        )
    }
}

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
    let center = Vec3::splat(s, sphere.center.to_array());
    let found = test(
        s,
        center,
        V::splat(s, sphere.radius),
        #[inline(always)]
        || sphere.own_box(),
        packet,
        frame,
        query.limit(),
    );
    if let Some(Found { mask, t }) = found {
        let zero = V::splat(s, 0.0);
        query.record(s, mask, V::U32::splat(s, record.prim), t, zero, zero);
    }
}

/// One sphere in all lanes, or each lane its own. `own_box` is asked for only if some ray meets the
/// sphere.
#[inline(always)]
fn test<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    center: Vec3<V>,
    radius: V,
    own_box: impl FnOnce() -> B,
    packet: &Packet<V>,
    frame: &F,
    limit: V,
) -> Option<Found<V>> {
    let seen = see_ball::<Plain, V>(center, radius, packet);
    let depth = depth_in_ball::<Plain, V>(radius, nearest::<Plain, V>(&seen, packet));
    let meets = depth.ge(V::splat(s, 0.0));
    if meets.none() {
        return None;
    }
    let roots = Roots { meets, t: q_roots(s, seen.equation(), (seen.a * depth).sqrt()) };
    let (enter, exit) = robust::enter_exit(s, &own_box(), packet, frame);
    let [first, second] = roots.in_order();
    let t = first.ge(packet.tmin).select(first, second);
    let ahead = meets & packet.tmin.le(t) & packet.tmin.le(exit);
    let t = t.max(enter);
    let mask = ahead & enter.le(exit) & t.le(limit);
    mask.any().then_some(Found { mask, t })
}
