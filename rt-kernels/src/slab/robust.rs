//! The slab test that loses no ray.
//!
//! **Decides** when a ray enters a box and when it leaves it, from the plane distances
//! `(plane − origin) · inv`. Near and far planes are chosen by the sign bit of the direction
//! ([`Frame::near_far`]), so that no minimum of the two distances of an axis is needed.
//!
//! **Precision.** Conservative: the exit is multiplied by 1 + 2^-19, more than the rounding of
//! both distances (Ize's 1 + 2γ₃ is 6 roundoffs; here are 32) and than what the primitives' kernels
//! add to it (`geom::aabb`). No ray that passes the box is lost. Monotone: a box inside another has
//! no earlier entry and no later exit, bit for bit, since subtraction, multiplication by a factor
//! of fixed sign, minimum and maximum all are.
//!
//! **Degenerate inputs.** A ray within a plane of the box (0 · ∞) has a NaN for that distance. It
//! is dropped, as if the slab had no end there: the ray counts as inside. A flat box is hit like any
//! other. `t` before 0 is not widened: rays start at `tmin >= 0`.
//!
//! **Operations**, per node: 6 subtractions, 7 multiplications, 3 minima, 3 maxima, 1 comparison.
//!
//! Source: Williams et al. 2005 (signs); Ize 2013 (padding); order of operands for NaN: this file.

use simd4::SimdF32;
use simd4::math::Vec3;

use crate::packet::{Boxes, Frame, Packet};

/// What the exit is multiplied by.
const WIDER: f32 = 1.0 + crate::geom::PADDING;

/// The lanes whose ray may meet something in the box with `tmin <= t <= limit`.
#[inline(always)]
pub fn may_hit<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    boxes: &B,
    packet: &Packet<V>,
    frame: &F,
    limit: V,
) -> V::Mask {
    let (enter, exit) = interval(s, boxes, packet, frame, packet.tmin, limit);
    enter.le(exit)
}

/// The entry into the box and the padded exit from it: ∓∞ where there is no end.
#[inline(always)]
pub fn enter_exit<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    boxes: &B,
    packet: &Packet<V>,
    frame: &F,
) -> (V, V) {
    let infinity = V::splat(s, f32::INFINITY);
    interval(s, boxes, packet, frame, -infinity, infinity)
}

/// The part of `after..=before` within the box, its end padded.
///
/// `min` and `max` give their second operand where the first is NaN: the order of operands drops
/// NaNs.
#[inline(always)]
fn interval<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    boxes: &B,
    packet: &Packet<V>,
    frame: &F,
    after: V,
    before: V,
) -> (V, V) {
    let (near, far) = frame.near_far(s, boxes);
    let near = distances(near, packet);
    let far = distances(far, packet);
    let enter = near.z.max(near.y.max(near.x.max(after)));
    let exit = far.z.min(far.y.min(far.x.min(before)));
    (enter, exit * V::splat(s, WIDER))
}

/// The distances along the rays to one plane of each axis.
#[inline(always)]
fn distances<V: SimdF32>(planes: Vec3<V>, packet: &Packet<V>) -> Vec3<V> {
    let relative = planes - packet.origin;
    Vec3::new(relative.x * packet.inv.x, relative.y * packet.inv.y, relative.z * packet.inv.z)
}
