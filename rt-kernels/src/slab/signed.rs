//! The slab test that knows the nearer plane by the sign of the direction.

use std::marker::PhantomData;

use simd4::math::Vec3;
use simd4::{SimdF32, SimdMask};

use super::knobs::{Distance, Widening, words};
use super::{BoxKernel, Crossing};
use crate::packet::{Boxes, Frame, Packet};
use crate::tri::knobs::Reciprocal;

/// The slab test by signs.
///
/// **Decides** when a ray enters a box and when it leaves it. Near and far planes are chosen by the
/// sign bit of the direction's reciprocal ([`Frame::near_far`]), −0 included, so that no minimum of
/// the two distances of an axis is needed.
///
/// **Parameters.** World space. The `t` interval is closed at both ends, and so are the boxes.
///
/// **Precision.** Three roundings a distance with [`Relative`](super::knobs::Relative) and an exact
/// reciprocal: enough to lose rays that graze an edge, unless the exit is widened.
///
/// **Degenerate inputs.** A ray within a plane of the box (0 · ∞) has a NaN for that distance. It
/// is dropped, as if the slab had no end there: the ray counts as inside. A flat box is hit like any
/// other. (Not so with [`Scaled`](super::knobs::Scaled), where every distance of that axis is NaN.)
///
/// **Operations**, per box: 6 subtractions, 6 multiplications, 3 minima, 3 maxima, 1 comparison, and
/// 1 multiplication to widen.
///
/// Source: Williams, Barrus, Morley, Shirley, "An Efficient and Robust Ray–Box Intersection
/// Algorithm", JGT 10(1), 2005. Deviation: minima and maxima for branches.
#[derive(Clone, Copy, Debug)]
pub struct Signed<C, D, W>(PhantomData<(C, D, W)>);

impl<C: Reciprocal, D: Distance, W: Widening> BoxKernel for Signed<C, D, W> {
    const NAME: &'static str = "signed";
    const EXACT: bool = C::EXACT;
    const FUSED: bool = D::FUSED;
    const FRAMED: bool = true;

    type Reciprocal = C;

    fn variant() -> String {
        words(&[C::NAME, D::NAME, W::NAME])
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
        s: V::Simd,
        boxes: &B,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Crossing<V>> {
        let [enter, exit] =
            interval::<D, W, V, F, B>(s, boxes, packet, frame, [packet.tmin, limit]);
        let mask = enter.le(exit);
        mask.any().then_some(Crossing { mask, enter })
    }
}

/// The part of `after..=before` within the box, its end widened.
///
/// `min` and `max` give their second operand where the first is NaN: the order of operands drops
/// NaNs.
#[inline(always)]
pub(super) fn interval<D: Distance, W: Widening, V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    boxes: &B,
    packet: &Packet<V>,
    frame: &F,
    [after, before]: [V; 2],
) -> [V; 2] {
    let (near, far) = frame.near_far(s, boxes);
    let near = distances::<D, V>(near, packet);
    let far = distances::<D, V>(far, packet);
    let enter = near.z.max(near.y.max(near.x.max(after)));
    let exit = far.z.min(far.y.min(far.x.min(before)));
    [enter, W::widen(s, exit)]
}

/// The distances along the rays to one plane of each axis.
#[inline(always)]
fn distances<D: Distance, V: SimdF32>(planes: Vec3<V>, packet: &Packet<V>) -> Vec3<V> {
    let Packet { origin, inv, .. } = packet;
    Vec3::new(
        D::to(planes.x, origin.x, inv.x),
        D::to(planes.y, origin.y, inv.y),
        D::to(planes.z, origin.z, inv.z),
    )
}
