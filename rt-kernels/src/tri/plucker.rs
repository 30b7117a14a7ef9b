//! The Plücker test: three volumes, seen from the ray's origin.

use std::marker::PhantomData;

use simd4::{SimdF32, SimdMask};

use super::knobs::{Reciprocal, Rounding, words};
use super::{Found, Record, Records, TriangleKernel};
use crate::geom::Triangle;
use crate::packet::{Frame, Packet};

/// The Plücker test, relative to the ray.
///
/// **Decides** whether a ray meets a triangle by the side on which it passes each edge: the signs of
/// the volumes that the direction spans with each edge and the origin.
///
/// **Parameters.** World space. The `t` interval is closed at both ends. Both sides are hit. The
/// record is the corners.
///
/// **Precision.** Tight along edges: of a shared edge both triangles compute the same volume but for
/// the sign, since its ends come in as their sum and their difference. Not watertight at vertices:
/// the signs of the edges around one need not agree, and one ray in hundreds that is aimed at a
/// vertex leaks. Fused sums keep the edges tight and make the vertices worse. `t` is right to about
/// 3 units in the last place.
///
/// **Degenerate inputs.** If the volumes' sum or the plane's speed is 0, `t` or the weights are
/// infinite or NaN: no hit. Where a volume is exactly 0 both neighbours are hit.
///
/// **Operations**: 18 subtractions and 9 sums for the edges, 27 products and 15 sums for the volumes, 4
/// minima and maxima and 2 comparisons to the first rejection; then 15 products, 9 sums, 2
/// reciprocals and 2 comparisons.
///
/// Source: Erickson, "Plücker Coordinates", RTNews 10(3), 1997; the form relative to the ray as in
/// Embree's `triangle_intersector_pluecker.h`. Deviation: no epsilon, which would close vertices at
/// the price of double hits.
#[derive(Clone, Copy, Debug)]
pub struct Plucker<C, A>(PhantomData<(C, A)>);

impl<C: Reciprocal, A: Rounding> TriangleKernel for Plucker<C, A> {
    const NAME: &'static str = "plucker";
    const EXACT: bool = C::EXACT;
    const FUSED: bool = A::FUSED;

    fn variant() -> String {
        words::<C, A>(&[])
    }

    fn record(triangle: &Triangle, prim: u32) -> Record {
        Record::corners(triangle, prim)
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        _: &F,
        limit: V,
    ) -> Option<Found<V>> {
        let a = records.vec3(s, 0) - packet.origin;
        let b = records.vec3(s, 1) - packet.origin;
        let c = records.vec3(s, 2) - packet.origin;
        let (bc, ca, ab) = (c - b, a - c, b - a);
        let u = A::dot(packet.dir, A::cross(bc, c + b));
        let v = A::dot(packet.dir, A::cross(ca, a + c));
        let w = A::dot(packet.dir, A::cross(ab, b + a));
        let zero = V::splat(s, 0.0);
        let inside = u.min(v).min(w).ge(zero) | u.max(v).max(w).le(zero);
        if inside.none() {
            return None;
        }
        let normal = A::cross(ab, ca);
        let t = A::dot(normal, a) * C::of(s, A::dot(normal, packet.dir));
        let inv_sum = C::of(s, u + v + w);
        let mask = inside & packet.tmin.le(t) & t.le(limit);
        Some(Found { mask, t, u: v * inv_sum, v: w * inv_sum })
    }
}
