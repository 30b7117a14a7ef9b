//! The formula that everybody learns.

use std::marker::PhantomData;

use simd4::{SimdF32, SimdMask};

use super::form::{Form, words};
use super::{Found, QuadricKernel, Record, Records, Roots};
use crate::geom::Curved;
use crate::packet::{Frame, Packet};
use crate::tri::knobs::Rounding;

/// The test of the textbooks.
///
/// **Decides** whether rays meet a surface, and where they first do: t = (b ± √(b² − a c)) / a.
///
/// **Parameters.** World space. The `t` interval is closed at both ends; of the two roots the first
/// counts that is at least `tmin` and not cut off.
///
/// **Precision.** b² and a c are the squares of the distance to the centre, and their difference is
/// the square of a radius: at 1,000 radii little is left of it. The root that is nearer to 0 is a
/// difference as well.
///
/// **Degenerate inputs.** No hit where `a` is 0: a ray along the side of a cone.
///
/// **Operations**, for a sphere: 14 products, 12 sums, a root and two divisions.
///
/// Source: any; for example Glassner, ed., "An Introduction to Ray Tracing", 1989, chapter 2.
#[derive(Clone, Copy, Debug)]
pub struct Textbook<S, A>(PhantomData<(S, A)>);

impl<S: Form, A: Rounding> QuadricKernel for Textbook<S, A> {
    const NAME: &'static str = "textbook";
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
        let root = discriminant.sqrt();
        let roots = Roots { meets, t: [(seen.b - root) / seen.a, (seen.b + root) / seen.a] };
        roots.first::<S, R>(s, records, &seen, packet, limit)
    }
}
