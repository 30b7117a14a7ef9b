//! The quadratic formula without a difference in the numerator.

use std::marker::PhantomData;

use simd4::{SimdF32, SimdMask};

use super::form::{Form, words};
use super::{Found, QuadricKernel, Record, Records, Roots};
use crate::geom::Curved;
use crate::packet::{Frame, Packet};
use crate::tri::knobs::Rounding;

/// The test with the remedy that numerical analysts give: q = b ± √(b² − a c), with the sign of b, so
/// that nothing cancels; the roots are q / a and c / q.
///
/// **Decides** and **Parameters** as [`Textbook`](super::Textbook).
///
/// **Precision.** Mends the root that is nearer to 0, as of rays that start near the surface. Mends
/// nothing of b² − a c, which is where far surfaces are lost.
///
/// **Degenerate inputs.** Where `a` is 0, one root is infinite and the other one right.
///
/// **Operations**, for a sphere: 14 products, 11 sums, a root and two divisions.
///
/// Source: Press et al., "Numerical Recipes", section 5.6; Hearn, Baker, "Computer Graphics".
#[derive(Clone, Copy, Debug)]
pub struct Stable<S, A>(PhantomData<(S, A)>);

impl<S: Form, A: Rounding> QuadricKernel for Stable<S, A> {
    const NAME: &'static str = "stable q";
    const FUSED: bool = A::FUSED;

    fn variant() -> String {
        words::<S, A>()
    }

    fn record(surface: &Curved, prim: u32) -> Option<Record> {
        S::record(surface, prim)
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        _: &F,
        limit: V,
    ) -> Option<Found<V>> {
        let seen = S::see::<A, V, R>(s, records, packet);
        let discriminant = A::difference(seen.b, seen.b, seen.a, seen.c);
        let meets = discriminant.ge(V::splat(s, 0.0));
        if meets.none() {
            return None;
        }
        let roots = Roots { meets, t: q_roots(s, seen.equation(), discriminant.sqrt()) };
        roots.first::<S, R>(s, records, &seen, packet, limit)
    }
}

/// Both roots of a t² − 2 b t + c = 0, from √(b² − a c).
#[inline(always)]
pub(super) fn q_roots<V: SimdF32>(s: V::Simd, [a, b, c]: [V; 3], root: V) -> [V; 2] {
    let q = b + b.ge(V::splat(s, 0.0)).select(root, -root);
    [c / q, q / a]
}
