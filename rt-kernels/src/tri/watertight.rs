//! The watertight test of Woop, Benthin and Wald: the one that renders.

use std::marker::PhantomData;

use simd4::{SimdF32, SimdMask};

use super::knobs::{Division, Plain, Reciprocal, Rounding, words};
use super::{Found, Record, Records, TriangleKernel, own_box};
use crate::geom::Triangle;
use crate::packet::{Frame, Packet};

/// The watertight triangle test.
///
/// **Decides** whether rays meet one triangle, and where. Each ray's space is sheared so that the
/// ray runs along z; what is left is whether the origin lies in a triangle of the plane, by the
/// signs of three edge functions.
///
/// **Parameters.** World space. The `t` interval is closed at both ends. Both sides are hit.
///
/// **Watertight.** Two triangles that share an edge see the same sheared corners, and the edge
/// function of one is the negative of the other's: each is the difference of two products, each
/// rounded by itself. Rounding is monotone, so a difference never has the wrong sign; at worst it
/// is 0. Where one is 0 and it matters, that lane is decided again in f64, in which the products are
/// exact and the sign of their difference is right. So the signs are those of exact arithmetic on
/// the sheared corners, edges and corners included, and a closed mesh has no gap to pass through.
/// Without `EXACT_ZEROS` a 0 stays one: no gap either, but both neighbours are hit. `A` may round
/// shears and sums once, and differences by [`Split`](super::knobs::Split) or
/// [`Kahan`](super::knobs::Kahan); contracted ([`Fused`](super::knobs::Fused)) they are not
/// antisymmetric, and rays leak.
///
/// **Precision.** With x' the sheared x of a corner at (x, y, z) from the origin, and u = 2^-24:
/// x' = x (1 + α) − (dx/dz) z (1 + β), where |α| ≤ 2u (its subtraction of the origin, the last
/// subtraction) and |β| ≤ 4u (slope, z's subtraction of the origin, product, last subtraction). So
/// the test is exact for corners moved by 2u |x| + 4u |z dx/dz| along x, and likewise along y. With
/// z = t dz both terms are proportional to distances to the origin along one axis: that is what
/// [`padded`](crate::geom::Aabb::padded) and the [slab test](crate::slab::robust) make room for.
/// `t` is the mean of the corners' distances, weighted by the edge functions; with `OWN_BOX` the entry
/// into the triangle's own box where that is greater, and only rays that meet that box hit: what
/// makes the answer one ([the crate's documentation](crate#why-the-answer-is-one)).
///
/// **Degenerate inputs.** A triangle without area, seen from the ray after the shear, is not hit: its
/// edge functions sum to 0. Its neighbours share its edges and take the ray. An origin within about
/// one unit in the last place of the surface has no side: whether it is met at `t` = 0 is rounding.
///
/// **Operations**: 18 subtractions, 12 multiplications, 4 minima and maxima and 2 comparisons to the
/// first rejection; then 7 multiplications, 4 additions, 1 reciprocal, 2 comparisons, and for a
/// candidate the own box. The shear of a packet takes two divisions, once.
///
/// Source: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. Deviations:
/// 1. winding is not kept when the dominant axis is negative, since both sides are hit;
/// 2. the f64 fallback is per lane and only for lanes that no nonzero sign rejects;
/// 3. `t` is clamped to the own box.
#[derive(Clone, Copy, Debug)]
pub struct Watertight<
    C = Division,
    A = Plain,
    const EXACT_ZEROS: bool = true,
    const OWN_BOX: bool = true,
>(PhantomData<(C, A)>);

impl<C: Reciprocal, A: Rounding, const EXACT_ZEROS: bool, const OWN_BOX: bool> TriangleKernel
    for Watertight<C, A, EXACT_ZEROS, OWN_BOX>
{
    const NAME: &'static str = "watertight";
    const EXACT: bool = C::EXACT;
    const FUSED: bool = A::FUSED;
    const FRAMED: bool = true;
    const ANY_PACKET: bool = true;
    const IN_OWN_BOX: bool = OWN_BOX;

    fn variant() -> String {
        words::<C, A>(&[
            if EXACT_ZEROS { "exact zeros" } else { "" },
            if OWN_BOX { "own box" } else { "" },
        ])
    }

    fn record(triangle: &Triangle, prim: u32) -> Record {
        Record::corners(triangle, prim)
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Found<V>> {
        let shear = frame.shear();
        let a = frame.relative(s, records, 0);
        let b = frame.relative(s, records, 1);
        let c = frame.relative(s, records, 2);
        let (ax, ay) = (A::nmul_add(shear.x, a.z, a.x), A::nmul_add(shear.y, a.z, a.y));
        let (bx, by) = (A::nmul_add(shear.x, b.z, b.x), A::nmul_add(shear.y, b.z, b.y));
        let (cx, cy) = (A::nmul_add(shear.x, c.z, c.x), A::nmul_add(shear.y, c.z, c.y));

        // The edge functions: the weights of a, b and c, times twice the area.
        let mut edges = [
            A::difference(cx, by, cy, bx),
            A::difference(ax, cy, ay, cx),
            A::difference(bx, ay, by, ax),
        ];
        let Signs { mut inside, doubtful } = Signs::of(s, edges);
        if R::EARLY_OUT && inside.none() {
            return None;
        }
        if EXACT_ZEROS && doubtful.any() {
            edges = exact_edges(s, doubtful, [[ax, ay], [bx, by], [cx, cy]], edges);
            inside = Signs::of(s, edges).inside;
        }

        let [u, v, w] = edges;
        // Without area t is NaN, or infinite where the area vanishes in the reciprocal: beyond any
        // limit.
        let inv_det = C::of(s, u + v + w);
        let t = A::mul_add(w, c.z, A::mul_add(v, b.z, u * a.z)) * inv_det * shear.z;
        let candidates = inside & packet.tmin.le(t) & t.le(limit);
        let (u, v) = (v * inv_det, w * inv_det);
        let found = Found { mask: candidates, t, u, v };
        if !OWN_BOX {
            return Some(found);
        }
        if candidates.none() {
            return None;
        }
        Some(own_box::held(s, &records.own_boxes(s), packet, frame, limit, found))
    }
}

/// What the signs of the edge functions say.
struct Signs<V: SimdF32> {
    /// Where no two are opposite.
    inside: V::Mask,
    /// Where so, and one is 0.
    doubtful: V::Mask,
}

impl<V: SimdF32> Signs<V> {
    #[inline(always)]
    fn of(s: V::Simd, [u, v, w]: [V; 3]) -> Self {
        let zero = V::splat(s, 0.0);
        let (least, greatest) = (u.min(v).min(w), u.max(v).max(w));
        Signs {
            inside: least.ge(zero) | greatest.le(zero),
            doubtful: least.eq(zero) | greatest.eq(zero),
        }
    }
}

/// The edge functions again, in the lanes of `doubtful`: rounded from their exact values, so that
/// they are 0 only on the edge itself.
#[inline(always)]
fn exact_edges<V: SimdF32>(
    s: V::Simd,
    doubtful: V::Mask,
    corners: [[V; 2]; 3],
    edges: [V; 3],
) -> [V; 3] {
    let [[ax, ay], [bx, by], [cx, cy]] = corners;
    [
        exact_edge(s, doubtful, [cx, by, cy, bx], edges[0]),
        exact_edge(s, doubtful, [ax, cy, ay, cx], edges[1]),
        exact_edge(s, doubtful, [bx, ay, by, ax], edges[2]),
    ]
}

/// One edge function, from its four factors.
#[inline(always)]
fn exact_edge<V: SimdF32>(s: V::Simd, doubtful: V::Mask, [a, b, c, d]: [V; 4], edge: V) -> V {
    let (a, b, c, d) = (a.to_array(), b.to_array(), c.to_array(), d.to_array());
    let mut edge = edge.to_array();
    let factors = [a.as_ref(), b.as_ref(), c.as_ref(), d.as_ref()];
    exact_differences(doubtful.bitmask(), factors, edge.as_mut());
    V::from_array(s, edge)
}

/// `a · b − c · d`, rounded once but for the last place, in those lanes.
#[cold]
#[inline(never)]
fn exact_differences(lanes: u32, [a, b, c, d]: [&[f32]; 4], values: &mut [f32]) {
    for (i, value) in values.iter_mut().enumerate() {
        if lanes >> i & 1 == 1 {
            let [a, b, c, d] = [a[i], b[i], c[i], d[i]].map(f64::from);
            *value = (a * b - c * d) as f32;
        }
    }
}
