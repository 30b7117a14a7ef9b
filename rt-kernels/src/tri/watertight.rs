//! The watertight triangle test.
//!
//! **Decides** whether rays meet one triangle, and where. Each ray's space is sheared so that the
//! ray runs along z; what is left is whether the origin lies in a triangle of the plane, by the
//! signs of three edge functions.
//!
//! **Parameters.** World space. The `t` interval is closed at both ends. Both sides are hit.
//!
//! **Watertight.** Two triangles that share an edge see the same sheared corners, and the edge
//! function of one is the negative of the other's: each is the difference of two products, each
//! rounded by itself. Rounding is monotone, so a difference never has the wrong sign; at worst it
//! is 0. Where one is 0 and it matters, that lane is decided again in f64, in which the products are
//! exact and the sign of their difference is right. So the signs are those of exact arithmetic on
//! the sheared corners, edges and corners included, and a closed mesh has no gap to pass through.
//! Contracting the differences to fused operations would break this: they are not antisymmetric.
//!
//! **Precision.** With x' the sheared x of a corner at (x, y, z) from the origin, and u = 2^-24:
//! x' = x (1 + α) − (dx/dz) z (1 + β), where |α| ≤ 2u (its subtraction of the origin, the last
//! subtraction) and |β| ≤ 4u (slope, z's subtraction of the origin, product, last subtraction). So
//! the test is exact for corners moved by 2u |x| + 4u |z dx/dz| along x, and likewise along y. With
//! z = t dz both terms are proportional to distances to the origin along one axis: that is what
//! [`padded`](crate::geom::Aabb::padded) and the [slab test](crate::slab::robust) make room for.
//! `t` is the mean of the corners' distances, weighted by the edge functions, or the entry into the
//! triangle's own box where that is greater.
//!
//! **Degenerate inputs.** A triangle without area, seen from the ray after the shear, is not hit: its
//! edge functions sum to 0. Its neighbours share its edges and take the ray. An origin within about
//! one unit in the last place of the surface has no side: whether it is met at `t` = 0 is rounding.
//!
//! **Operations**: 18 subtractions, 12 multiplications, 4 minima and maxima and 2 comparisons to the
//! first rejection; then 4 multiplications, 4 additions, a division, and for a candidate the own
//! box and two divisions more.
//!
//! Source: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. Deviations:
//! 1. winding is not kept when the dominant axis is negative, since both sides are hit;
//! 2. the f64 fallback is per lane and only for lanes that no nonzero sign rejects;
//! 3. `t` is clamped to the own box.

use simd4::{SimdF32, SimdMask};

use crate::packet::{Frame, Packet, Query};
use crate::primitives::TriangleRecord;
use crate::slab::robust;

/// Tests a packet against one triangle and records the hits.
#[inline(always)]
pub fn intersect<V: SimdF32, F: Frame<V>, Q: Query<V>>(
    s: V::Simd,
    triangle: &TriangleRecord,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Q,
) {
    let shear = frame.shear();
    let a = frame.relative(s, &triangle.a);
    let b = frame.relative(s, &triangle.b);
    let c = frame.relative(s, &triangle.c);
    let (ax, ay) = (a.x - shear.x * a.z, a.y - shear.y * a.z);
    let (bx, by) = (b.x - shear.x * b.z, b.y - shear.y * b.z);
    let (cx, cy) = (c.x - shear.x * c.z, c.y - shear.y * c.z);

    // The edge functions: the weights of a, b and c, times twice the area.
    let mut edges = [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax];
    let mut inside = same_signs(s, edges);
    if inside.none() {
        return;
    }
    let zero = V::splat(s, 0.0);
    let doubtful = inside & (edges[0].eq(zero) | edges[1].eq(zero) | edges[2].eq(zero));
    if doubtful.any() {
        edges = exact_edges(s, doubtful, [[ax, ay], [bx, by], [cx, cy]], edges);
        inside = same_signs(s, edges);
    }

    let [u, v, w] = edges;
    let det = u + v + w;
    // Without area t is NaN, or infinite where the area vanishes in the reciprocal: beyond any limit.
    let inv_det = V::splat(s, 1.0) / det;
    let t = (u * a.z + v * b.z + w * c.z) * inv_det * shear.z;
    let candidates = inside & packet.tmin.le(t) & t.le(query.limit());
    if candidates.none() {
        return;
    }
    let (enter, exit) = robust::enter_exit(s, &triangle.own_box(s), packet, frame);
    let t = t.max(enter);
    let hits = candidates & enter.le(exit) & packet.tmin.le(exit) & t.le(query.limit());
    if hits.any() {
        query.record(s, hits, triangle.prim, t, v * inv_det, w * inv_det);
    }
}

/// The lanes whose edge functions have no two opposite signs.
#[inline(always)]
fn same_signs<V: SimdF32>(s: V::Simd, [u, v, w]: [V; 3]) -> V::Mask {
    let zero = V::splat(s, 0.0);
    u.min(v).min(w).ge(zero) | u.max(v).max(w).le(zero)
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
