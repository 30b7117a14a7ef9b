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
//! Source: Williams et al. 2005 (signs); Ize 2013 (padding); order of operands for NaN:
//! [`Signed`](super::Signed), which is the same test with less padding.

use std::marker::PhantomData;

use simd4::{SimdF32, SimdMask};

use super::knobs::{Padded, Relative, words};
use super::signed::interval;
use super::{BoxKernel, Crossing};
use crate::packet::{Boxes, Frame, Packet};
use crate::tri::knobs::{Division, Reciprocal};

/// The slab test that loses no ray: what renders, with its default. The [module](self) has the rest.
#[derive(Clone, Copy, Debug)]
pub struct Robust<C = Division>(PhantomData<C>);

impl<C: Reciprocal> BoxKernel for Robust<C> {
    const NAME: &'static str = "robust";
    const EXACT: bool = C::EXACT;
    const FRAMED: bool = true;

    type Reciprocal = C;

    fn variant() -> String {
        words(&[C::NAME])
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
        s: V::Simd,
        boxes: &B,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Crossing<V>> {
        let crossing = crossing(s, boxes, packet, frame, limit);
        crossing.mask.any().then_some(crossing)
    }
}

/// The lanes whose ray may meet something in the box with `tmin <= t <= limit`, as the kernel's test, and
/// where they enter it: without a branch for that it is none.
#[inline(always)]
pub fn crossing<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    boxes: &B,
    packet: &Packet<V>,
    frame: &F,
    limit: V,
) -> Crossing<V> {
    let [enter, exit] = may_pass(s, boxes, packet, frame, [packet.tmin, limit]);
    Crossing { mask: enter.le(exit), enter }
}

/// The lanes whose ray may meet something in the box with `tmin <= t <= limit`.
#[inline(always)]
pub fn may_hit<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    boxes: &B,
    packet: &Packet<V>,
    frame: &F,
    limit: V,
) -> V::Mask {
    let [enter, exit] = may_pass(s, boxes, packet, frame, [packet.tmin, limit]);
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
    let [enter, exit] = may_pass(s, boxes, packet, frame, [-infinity, infinity]);
    (enter, exit)
}

#[inline(always)]
fn may_pass<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    boxes: &B,
    packet: &Packet<V>,
    frame: &F,
    within: [V; 2],
) -> [V; 2] {
    interval::<Relative, Padded, V, F, B>(s, boxes, packet, frame, within)
}
