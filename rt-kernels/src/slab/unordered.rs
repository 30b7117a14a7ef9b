//! The slab test of Kay and Kajiya: both distances of each axis, ordered by minimum and maximum.

use std::marker::PhantomData;

use simd4::{SimdF32, SimdMask};

use super::knobs::{Distance, Order, Relative, Widening, words};
use super::{BoxKernel, Crossing};
use crate::packet::{Boxes, Frame, Packet};
use crate::tri::knobs::Reciprocal;

/// Kay and Kajiya's test.
///
/// **Decides** when a ray enters a box and when it leaves it, without a look at the signs of the
/// direction: rays of any kind share a packet at no cost.
///
/// **Parameters.** World space. The `t` interval is closed at both ends, and so are the boxes.
///
/// **Precision.** Three roundings a distance: enough to lose rays that graze an edge, unless the
/// exit is widened.
///
/// **Degenerate inputs.** What becomes of a ray within a plane of the box (0 · ∞ is NaN) is decided
/// by the [`Order`] of operands: only one of the three hits. A flat box is hit like any other.
///
/// **Operations**, per box: 6 subtractions, 6 multiplications, 6 minima, 6 maxima, 1 comparison; 3
/// minima and 3 maxima more if each distance is clipped.
///
/// Sources: Kay, Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986; Smits, "Efficiency Issues for
/// Ray Tracing", JGT 3(2), 1998 (let IEEE infinities do the axis-parallel rays); Barnes, "Fast,
/// Branchless Ray/Bounding Box Intersections", 2022 (each clipped).
#[derive(Clone, Copy, Debug)]
pub struct Unordered<C, O, W>(PhantomData<(C, O, W)>);

impl<C: Reciprocal, O: Order, W: Widening> BoxKernel for Unordered<C, O, W> {
    const NAME: &'static str = "unordered";
    const EXACT: bool = C::EXACT;

    type Reciprocal = C;

    fn variant() -> String {
        words(&[C::NAME, O::NAME, W::NAME])
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
        s: V::Simd,
        boxes: &B,
        packet: &Packet<V>,
        _: &F,
        limit: V,
    ) -> Option<Crossing<V>> {
        let [x, y, z] = slabs(s, boxes, packet);
        let within = O::narrow([packet.tmin, limit], x[0], x[1]);
        let within = O::narrow(within, y[0], y[1]);
        let [enter, exit] = O::narrow(within, z[0], z[1]);
        let mask = enter.le(W::widen(s, exit));
        mask.any().then_some(Crossing { mask, enter })
    }
}

/// For each axis the distances to the lower plane and to the upper one.
#[inline(always)]
pub(super) fn slabs<V: SimdF32, B: Boxes<V>>(
    s: V::Simd,
    boxes: &B,
    packet: &Packet<V>,
) -> [[V; 2]; 3] {
    let Packet { origin, inv, .. } = packet;
    [
        slab(s, boxes, 0, origin.x, inv.x),
        slab(s, boxes, 1, origin.y, inv.y),
        slab(s, boxes, 2, origin.z, inv.z),
    ]
}

#[inline(always)]
fn slab<V: SimdF32, B: Boxes<V>>(s: V::Simd, boxes: &B, axis: usize, origin: V, inv: V) -> [V; 2] {
    let (low, high) = (boxes.side(s, axis, 0), boxes.side(s, axis, 1));
    [Relative::to(low, origin, inv), Relative::to(high, origin, inv)]
}
