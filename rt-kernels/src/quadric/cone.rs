//! The test for cones and cylinders.
//!
//! **Decides** whether rays meet the mantle of one truncated cone, and where they first do.
//!
//! **Parameters.** World space. The `t` interval is closed at both ends, and so is the mantle. Of the
//! two roots the lesser counts that is at least `tmin` and on the mantle, so that rays from inside
//! hit the far side, and rays through an open end the inside.
//!
//! With z along the axis from the base, p across it, and θ half the angle at the tip, the cone is
//! where |p|² cos²θ = (r cosθ + z sinθ)²: both sides stay small, however flat it is. A cylinder has
//! θ = 0. With e and m for what p and the root of the right side change along the ray, and ρ for that
//! root, the ray meets the cone where a t² − 2 b t + c = 0, counted from the point of the ray that is
//! nearest to the base: so no coefficient is the difference of large numbers, however far the origin.
//!
//! **Precision.** The discriminant is cos²θ (|ρ e − m p|² − cos²θ |p × e|²), by Lagrange's identity:
//! for a cylinder what r² − d² is for a sphere, where d is the distance of the line from the axis. The
//! roots are q / a and c / q, with the sign of q such that nothing cancels, even where a is 0, for a
//! ray at the slope of the mantle. The answer is that for a ray which is moved by less than a roundoff
//! of the way to the cone and of its size, and in rare cases by dozens; measured in `tests/it/cone.rs`.
//! The hit's `t` is at least the entry into the cone's own box.
//!
//! **Degenerate inputs.** A ray that touches the mantle, runs in it, or through a tip, may hit or miss.
//!
//! **Operations**: 32 additions and subtractions, 43 multiplications, a division and a comparison to
//! the first rejection.
//!
//! Source: Eberly, "Intersection of a Line and a Cone", Geometric Tools, 2000, for the equation.
//! Deviations: both sides are scaled by cos²θ, the discriminant is not computed as b² − a c, and `t` is
//! clamped to the own box.

use simd4::math::Vec3;
use simd4::{Lanes, SimdF32, SimdMask};

use super::stable::q_roots;
use super::{Found, QuadricKernel, Record, Records};
use crate::geom::{Aabb, Cone, Curved};
use crate::packet::{Boxes, Frame, Packet, Query};
use crate::slab::robust;

/// A cone as leaves hold it: 68 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct ConeRecord {
    pub(super) base: [f32; 3],
    /// Of unit length.
    pub(super) axis: [f32; 3],
    /// From base to apex.
    pub(super) height: f32,
    /// The cosine of half the angle at the tip.
    pub(super) cos: f32,
    /// Its sine: negative if the apex is the narrower end.
    pub(super) sin: f32,
    /// The radius at the base, times the cosine.
    pub(super) radius: f32,
    pub(super) own_box: Aabb,
    /// The primitive's number.
    pub(crate) prim: u32,
}

impl ConeRecord {
    /// The cone's numbers, each rounded once.
    pub(crate) fn new(cone: &Cone, prim: u32) -> ConeRecord {
        let height = (cone.apex.as_dvec3() - cone.base.as_dvec3()).length();
        let [base_radius, apex_radius] = [cone.base_radius, cone.apex_radius].map(f64::from);
        let widening = apex_radius - base_radius;
        let side = (height * height + widening * widening).sqrt();
        let (cos, sin) = (height / side, widening / side);
        ConeRecord {
            base: cone.base.to_array(),
            axis: cone.axis().as_vec3().to_array(),
            height: height as f32,
            cos: cos as f32,
            sin: sin as f32,
            radius: (base_radius * cos) as f32,
            own_box: cone.own_box(),
            prim,
        }
    }
}

/// The test that renders, as a kernel among others. The [module](self) has the rest.
#[derive(Clone, Copy, Debug)]
pub struct OwnBoxCone;

impl QuadricKernel for OwnBoxCone {
    const NAME: &'static str = "residual";
    const FRAMED: bool = true;

    fn variant() -> String {
        "cone, own box".to_string()
    }

    fn record(surface: &Curved, prim: u32) -> Option<Record> {
        let Curved::Cone(cone) = surface else { return None };
        Some(Record::cone(&ConeRecord::new(cone, prim)))
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Found<V>> {
        let [cos, sin, radius] = records.opening(s);
        let (base, axis, height) = (records.center(s), records.axis(s), records.size(s));
        let mantle = Mantle { base, axis, height, cos, sin, radius };
        test(
            s,
            &mantle,
            #[inline(always)]
            || records.cone_boxes(s),
            packet,
            frame,
            limit,
        )
    }
}

/// One cone in all lanes, or each lane its own: the numbers of a [`ConeRecord`].
struct Mantle<V> {
    base: Vec3<V>,
    axis: Vec3<V>,
    height: V,
    cos: V,
    sin: V,
    radius: V,
}

/// Tests a packet against one cone and records the hits.
#[inline(always)]
pub fn intersect<V: SimdF32, F: Frame<V>, Q: Query<V>>(
    s: V::Simd,
    record: &ConeRecord,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Q,
) {
    let mantle = Mantle {
        base: Vec3::splat(s, record.base),
        axis: Vec3::splat(s, record.axis),
        height: V::splat(s, record.height),
        cos: V::splat(s, record.cos),
        sin: V::splat(s, record.sin),
        radius: V::splat(s, record.radius),
    };
    let found = test(
        s,
        &mantle,
        #[inline(always)]
        || record.own_box,
        packet,
        frame,
        query.limit(),
    );
    if let Some(Found { mask, t }) = found {
        let zero = V::splat(s, 0.0);
        query.record(s, mask, V::U32::splat(s, record.prim), t, zero, zero);
    }
}

/// `own_box` is asked for only if some ray meets the cone that has no ends.
#[inline(always)]
fn test<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    mantle: &Mantle<V>,
    own_box: impl FnOnce() -> B,
    packet: &Packet<V>,
    frame: &F,
    limit: V,
) -> Option<Found<V>> {
    let &Mantle { base, axis, height, cos, sin, radius } = mantle;
    // From the base to the point of the ray that is nearest to it.
    let from_base = packet.origin - base;
    let start = -from_base.dot(packet.dir) / packet.dir.dot(packet.dir);
    let from_base = from_base + packet.dir * start;
    // Place and direction: along the axis, across it, and how wide the cone is there.
    let (z, dz) = (from_base.dot(axis), packet.dir.dot(axis));
    let (p, e) = (from_base - axis * z, packet.dir - axis * dz);
    let (width, widening) = (radius + sin * z, sin * dz);

    let (apart, moment) = (e * width - p * widening, p.cross(e));
    let cos2 = cos * cos;
    let depth = apart.dot(apart) - cos2 * moment.dot(moment);
    let meets = depth.ge(V::splat(s, 0.0));
    if meets.none() {
        return None;
    }
    let a = cos2 * e.dot(e) - widening * widening;
    let b = width * widening - cos2 * p.dot(e);
    let c = cos2 * p.dot(p) - width * width;
    let [t0, t1] = q_roots(s, [a, b, c], cos * depth.sqrt());
    let t0 = counting(s, packet, start, [z, dz], height, t0);
    let t1 = counting(s, packet, start, [z, dz], height, t1);
    let t = t0.min(t1);

    let (enter, exit) = robust::enter_exit(s, &own_box(), packet, frame);
    let t = t.max(enter);
    let mask = meets & packet.tmin.le(exit) & enter.le(exit) & t.le(limit);
    mask.any().then_some(Found { mask, t })
}

/// The `t` of a root, which is counted from `start`, if it counts, else +∞: `z` is place and direction
/// along the axis.
#[inline(always)]
fn counting<V: SimdF32>(
    s: V::Simd,
    packet: &Packet<V>,
    start: V,
    [z, dz]: [V; 2],
    height: V,
    root: V,
) -> V {
    let (z, t) = (z + dz * root, start + root);
    let counts = packet.tmin.le(t) & V::splat(s, 0.0).le(z) & z.le(height);
    counts.select(t, V::splat(s, f32::INFINITY))
}
