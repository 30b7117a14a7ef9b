//! The test of Möller and Trumbore: fewest numbers, by Cramer's rule.

use std::marker::PhantomData;

use simd4::{SimdF32, SimdMask};

use super::knobs::{Reciprocal, Rounding, words};
use super::{Found, Record, Records, TriangleKernel, own_box};
use crate::geom::Triangle;
use crate::packet::{Frame, Packet};

/// Möller and Trumbore's test.
///
/// **Decides** whether a ray meets a triangle: solves `origin + t dir = a + u (b − a) + v (c − a)`
/// and asks for `u >= 0`, `v >= 0` and `u + v <= 1`.
///
/// **Parameters.** World space. The `t` interval is closed at both ends. Both sides are hit. The
/// record is a corner and two edges, each rounded once; with `OWN_BOX` the corners, of which the
/// test makes the same edges, to the bit, and the own box that holds its hits
/// ([why](crate#why-the-answer-is-one)).
///
/// With `SIGNS_FIRST` nothing is divided before it is known that the ray hits: `u`, `v` and `u + v` are
/// compared with 0 and with the determinant.
///
/// **Precision.** Not watertight: two triangles that share an edge compute it from different
/// corners, and the third edge as `u + v <= 1`, so that both may round to "outside". Of rays aimed
/// at shared edges one in ten or twenty passes between. `t` is right to about 3 units in the last
/// place, far from the origin too, since all is relative to the ray.
///
/// **Degenerate inputs.** A determinant of 0 makes `u` and `v`, or `t`, infinite or NaN: no hit. There
/// is no epsilon, which would lose small triangles.
///
/// **Operations**: 3 subtractions, 27 products and 15 sums, 1 reciprocal, 5 comparisons; with
/// `OWN_BOX` 6 subtractions more, and for a candidate the own box.
///
/// Source: Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT 2(1), 1997.
/// Deviations: 1. no epsilon; 2. both
/// sides; 3. `SIGNS_FIRST`, as Embree has it (`triangle_intersector_moeller.h`).
#[derive(Clone, Copy, Debug)]
pub struct MollerTrumbore<C, A, const SIGNS_FIRST: bool, const OWN_BOX: bool = false>(
    PhantomData<(C, A)>,
);

impl<C: Reciprocal, A: Rounding, const SIGNS_FIRST: bool, const OWN_BOX: bool> TriangleKernel
    for MollerTrumbore<C, A, SIGNS_FIRST, OWN_BOX>
{
    const NAME: &'static str = "moller-trumbore";
    const EXACT: bool = C::EXACT;
    const FUSED: bool = A::FUSED;
    const IN_OWN_BOX: bool = OWN_BOX;

    fn variant() -> String {
        words::<C, A>(&[
            if SIGNS_FIRST { "signs first" } else { "" },
            if OWN_BOX { "own box" } else { "" },
        ])
    }

    fn record(triangle: &Triangle, prim: u32) -> Record {
        if OWN_BOX {
            return Record::corners(triangle, prim);
        }
        let [a, b, c] = triangle.corners;
        Record::new([a, b - a, c - a].map(|row| row.to_array()), prim, 0)
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Found<V>> {
        let (a, mut ab, mut ac) = (records.vec3(s, 0), records.vec3(s, 1), records.vec3(s, 2));
        if OWN_BOX {
            (ab, ac) = (ab - a, ac - a);
        }
        let p = A::cross(packet.dir, ac);
        let det = A::dot(ab, p);
        // The test below is for u, v and 1, each times this factor.
        let (factor, one) = if SIGNS_FIRST {
            (V::splat(s, 1.0).copysign(det), det.abs())
        } else {
            (C::of(s, det), V::splat(s, 1.0))
        };
        let from_a = packet.origin - a;
        let u = A::dot(from_a, p) * factor;
        let q = A::cross(from_a, ab);
        let v = A::dot(packet.dir, q) * factor;
        let zero = V::splat(s, 0.0);
        let inside = u.ge(zero) & v.ge(zero) & (u + v).le(one);
        if inside.none() {
            return None;
        }
        let scale = if SIGNS_FIRST { C::of(s, one) } else { one };
        let (t, u, v) = (A::dot(ac, q) * factor * scale, u * scale, v * scale);
        let found = Found { mask: inside & packet.tmin.le(t) & t.le(limit), t, u, v };
        if !OWN_BOX {
            return Some(found);
        }
        if found.mask.none() {
            return None;
        }
        Some(own_box::held(s, &records.own_boxes(s), packet, frame, limit, found))
    }
}
