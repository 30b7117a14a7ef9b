//! Wald's projection test: the fewest operations, from precomputed numbers.

use std::marker::PhantomData;

use glam::DVec3;
use simd4::{SimdF32, SimdMask};

use super::knobs::{Reciprocal, Rounding, words};
use super::{Found, Record, Records, TriangleKernel};
use crate::geom::Triangle;
use crate::packet::{Axes, Frame, Packet};

/// Wald's projection test.
///
/// **Decides** whether a ray meets a triangle: goes to the triangle's plane, drops the axis that is
/// greatest in the plane's normal, and asks two edge equations, scaled to be the weights of two
/// corners, on which side the point lies.
///
/// **Parameters.** World space. The `t` interval is closed at both ends. Both sides are hit. The
/// record is the plane, divided by the normal's greatest component, the two equations, and the
/// axis.
///
/// **Precision.** Not watertight, and worse the farther the triangle is from the world's origin: its
/// equations are about that origin, so their error is of the size of the coordinates and not of the
/// triangle. Near the origin one ray in ten leaks at edges, and `t` is right to about 3 units in
/// the last place.
///
/// **Degenerate inputs.** A triangle without area has a record of NaN, and is not hit. A ray that
/// runs in the plane divides by 0: `t` is infinite or NaN, no hit.
///
/// **Operations**: 11 products and 12 sums, 1 reciprocal, 5 comparisons; with an axis for each lane
/// 12 selections more.
///
/// Source: Wald, Slusallek, Benthin, Wagner, "Interactive Rendering with Coherent Ray Tracing",
/// 2001, Section 3.1; the layout after Wald's thesis (2004), Section 7.1. Deviations: 1. the record
/// is computed in `f64` and rounded once; 2. a record for each lane, which the paper rules out
/// because of the three projections, selects among them.
#[derive(Clone, Copy, Debug)]
pub struct Wald<C, A>(PhantomData<(C, A)>);

impl<C: Reciprocal, A: Rounding> TriangleKernel for Wald<C, A> {
    const NAME: &'static str = "wald";
    const EXACT: bool = C::EXACT;
    const FUSED: bool = A::FUSED;

    fn variant() -> String {
        words::<C, A>(&[])
    }

    fn record(triangle: &Triangle, prim: u32) -> Record {
        let [a, b, c] = triangle.corners.map(|corner| corner.as_dvec3());
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(ac);
        let axis = normal.abs().max_position();
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let n = normal[axis];
        // The weight of a corner is 0 at `a` and along the other edge, and 1 at the corner itself.
        let weight = |edge: DVec3| {
            let (x, y) = (-edge[v] / n, edge[u] / n);
            [x, y, -(x * a[u] + y * a[v])]
        };
        let [b_x, b_y, b_d] = weight(ac);
        let rows =
            [[normal[u] / n, normal[v] / n, normal.dot(a) / n], [-b_x, -b_y, -b_d], weight(ab)];
        Record::new(rows.map(|row| row.map(|number| number as f32)), prim, axis as u32)
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        _: &F,
        limit: V,
    ) -> Option<Found<V>> {
        let axes = records.axes(s);
        let (origin, dir) = (axes.last(packet.origin), axes.last(packet.dir));
        let plane = records.vec3(s, 0);
        let speed = A::mul_add(plane.y, dir.y, A::mul_add(plane.x, dir.x, dir.z));
        let height = plane.z - origin.z;
        let height = A::nmul_add(plane.y, origin.y, A::nmul_add(plane.x, origin.x, height));
        let t = height * C::of(s, speed);
        let ahead = packet.tmin.le(t) & t.le(limit);
        if ahead.none() {
            return None;
        }
        let (x, y) = (A::mul_add(t, dir.x, origin.x), A::mul_add(t, dir.y, origin.y));
        let (b, c) = (records.vec3(s, 1), records.vec3(s, 2));
        let u = A::mul_add(b.y, y, A::mul_add(b.x, x, b.z));
        let v = A::mul_add(c.y, y, A::mul_add(c.x, x, c.z));
        let (zero, one) = (V::splat(s, 0.0), V::splat(s, 1.0));
        let mask = ahead & u.ge(zero) & v.ge(zero) & (u + v).le(one);
        Some(Found { mask, t, u, v })
    }
}
