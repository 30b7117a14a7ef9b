//! The estimate of Geimer and Müller: one answer for a packet, with a way out after each half.

use std::marker::PhantomData;

use simd4::{SimdF32, SimdMask};

use super::knobs::{EachClipped, IntervalLast, Order, Widening, words};
use super::unordered::slabs;
use super::{BoxKernel, Crossing};
use crate::packet::{Boxes, Frame, Packet};
use crate::tri::knobs::Reciprocal;

/// How the estimate is put.
pub trait Estimated: Send + Sync + 'static {
    /// In words.
    const NAMES: [&'static str; 2];

    /// Where the rays are within the box, and whether one of them may meet it before `limit`.
    fn estimate<V: SimdF32>(
        s: V::Simd,
        slabs: [[V; 2]; 3],
        packet: &Packet<V>,
        limit: V,
    ) -> (V, bool);
}

/// `!(all_ge(lmin, lmax) || all_le(lmax, 0))`, as in the paper: boxes without extent along some
/// axis, for which `lmin == lmax`, are never hit, nor is one that all rays just leave. A NaN from
/// the x axis makes a hit of any box, one from a lower plane of the others loses the ray. What was
/// found already is of no account.
#[derive(Clone, Copy, Debug)]
pub struct AsPrinted;

impl Estimated for AsPrinted {
    const NAMES: [&'static str; 2] = ["as printed", ""];

    #[inline(always)]
    fn estimate<V: SimdF32>(s: V::Simd, [x, y, z]: [[V; 2]; 3], _: &Packet<V>, _: V) -> (V, bool) {
        let within = [x[0].min(x[1]), x[0].max(x[1])];
        let within = IntervalLast::narrow(within, y[0], y[1]);
        let [enter, exit] = IntervalLast::narrow(within, z[0], z[1]);
        (enter, !(enter.ge(exit).all() || exit.le(V::splat(s, 0.0)).all()))
    }
}

/// The same with closed boxes, an order of operands that drops NaNs, rays that end, and the exit
/// widened by `W`.
#[derive(Clone, Copy, Debug)]
pub struct Corrected<W>(PhantomData<W>);

impl<W: Widening> Estimated for Corrected<W> {
    const NAMES: [&'static str; 2] = ["closed", W::NAME];

    #[inline(always)]
    fn estimate<V: SimdF32>(
        s: V::Simd,
        [x, y, z]: [[V; 2]; 3],
        packet: &Packet<V>,
        limit: V,
    ) -> (V, bool) {
        let infinity = V::splat(s, f32::INFINITY);
        let within = EachClipped::narrow([-infinity, infinity], x[0], x[1]);
        let within = EachClipped::narrow(within, y[0], y[1]);
        let [enter, exit] = EachClipped::narrow(within, z[0], z[1]);
        let exit = W::widen(s, exit);
        // So put that a lane without a ray, which is NaN, does not count.
        let missed = enter.le(exit).none() || packet.tmin.le(exit).none() || enter.le(limit).none();
        (enter, !missed)
    }
}

/// Geimer and Müller's estimate.
///
/// **Decides** whether some ray of a packet may meet a box: a packet is sent on if not all of its
/// rays miss for the same reason. One ray that misses the box and another that leaves it behind are
/// enough for a hit. With one lane there is nothing to estimate.
///
/// **Parameters.** World space. All lanes get the same answer.
///
/// **Precision.** As [`Unordered`](super::Unordered): rays that graze an edge are lost if the exit
/// is not widened.
///
/// **Degenerate inputs.** See [`AsPrinted`] and [`Corrected`].
///
/// **Operations**, per box: 6 subtractions, 6 multiplications, 5 minima, 5 maxima, 2 comparisons,
/// the second only if the first leaves a ray; 12, 12 and 3 in all if corrected.
///
/// Source: Geimer, Müller, "A Cross-Platform Framework for Interactive Ray Tracing", 2003, Section
/// 3.3. Deviation: the corrections.
#[derive(Clone, Copy, Debug)]
pub struct Conservative<C, E>(PhantomData<(C, E)>);

impl<C: Reciprocal, E: Estimated> BoxKernel for Conservative<C, E> {
    const NAME: &'static str = "conservative";
    const EXACT: bool = false;
    const TOGETHER: bool = true;

    type Reciprocal = C;

    fn variant() -> String {
        let [name, more] = E::NAMES;
        words(&[C::NAME, name, more])
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
        s: V::Simd,
        boxes: &B,
        packet: &Packet<V>,
        _: &F,
        limit: V,
    ) -> Option<Crossing<V>> {
        let (enter, hit) = E::estimate(s, slabs(s, boxes, packet), packet, limit);
        let enter = enter.max(packet.tmin);
        hit.then_some(Crossing { mask: V::Mask::splat(s, true), enter })
    }
}
