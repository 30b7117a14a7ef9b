//! Which rays of a common origin may hit a triangle: a filter before the [`Watertight`] test.
//!
//! **Decides** what is certain. With a, b, c the corners as the test has them, seen from the origin
//! with the dominant axis as z, and (x, y) a ray's slopes, the test's edge function of a is the volume
//! `(c × b) · (x, y, 1)`, up to rounding. That is so, too, when corners are sheared and slopes moved so that
//! the ray in the middle of a beam runs along z: then x and y are small, and so is what rounding does to the
//! volume. `c × b` is the same for all rays of the beam: three fused operations less than six subtractions
//! and products are left for each edge and ray. A ray is left out only if one edge function is surely negative
//! and another surely positive: that is how the test rejects. All others are for the test to decide, so the
//! answer is its own.
//!
//! Volumes are linear in the slopes. So from how far slopes are from the middle it is known how far a volume
//! may be from that in the middle, and which triangles are out of reach for all rays: they are sorted out
//! first, all lanes at once.
//!
//! **Precision.** With u = 2^-24, M the greatest coordinate of the three corners, D how far slopes are from the
//! middle, of which both are at most 1, S the greatest sheared x or y, which is at most 2M, and T = S + DM: no
//! corner, sheared for any of the rays, is further than T from the origin in x or y. The test has its sheared
//! coordinates up to 3uM, hence its edge function up to 12u MT + 18u² M² (before its own rounding, which does
//! not change a sign). Here they are off by 3uM too, and by 2uM for the slope: 20u MT + 50u² M². The cross
//! product is off by 6u S² ≤ 18u MT on z and by 6u SM on the others, which D makes no more than 6u MT each;
//! and 30u MT are for the roundings of the sum, whose terms are together no more than 10MT. What is beyond
//! 128u MT has the right sign, if T is made 2^-20 M greater for what has u². The extremes of a beam are off by
//! as much as the volume of a ray and 12u MT for what they are apart: where they are beyond twice that bound,
//! the volume of every ray is beyond it. Coordinates of up to 2^40 are within the range, and where the bound
//! vanishes so do all differences: it is no less than 2^-100.
//!
//! **Degenerate inputs.** A triangle without area is never certain. A lane without a triangle has
//! NaNs and is always left out.
//!
//! **Operations**, for each ray: 2 subtractions, 6 fused multiply-adds, 2 minima, 2 maxima, 2 comparisons; for
//! a beam 6 products and subtractions to shear, 4 fused multiply-adds, 3 multiplications, 6 additions, and as
//! many minima, maxima and comparisons as for a ray.
//!
//! Source: the volumes are those of Amanatides and Choi, "Ray Tracing Triangular Meshes", 1995; the
//! bound is worked out here.

use simd4::math::Vec3;
use simd4::{SimdF32, SimdMask};

use super::Records;
use crate::packet::Beam;

/// A bound of both tests' errors, times MT.
const BOUND: f32 = 1.0 / (1 << 17) as f32;

/// By how much of M T is made greater.
const MORE: f32 = 1.0 / (1 << 20) as f32;

/// The least bound.
const LEAST_BOUND: f32 = 1.0 / (1u128 << 100) as f32;

/// The edge volumes of triangles in lanes, to be spread over rays.
pub(crate) struct EdgeVolumes<B: SimdF32> {
    /// The cross products of b and c, c and a, a and b.
    normals: [[B::Array; 3]; 3],
    bound: B::Array,
    /// The slopes in the middle of the beam.
    middle: [f32; 2],
    /// The triangles that some ray of the beam may hit: a bit for each lane.
    pub(crate) lanes: u32,
}

impl<B: SimdF32> EdgeVolumes<B> {
    /// Of triangles whose records are their corners, seen from the `origin` of the rays of a beam, in
    /// the order of its axes.
    #[inline(always)]
    pub(crate) fn new<R: Records<B>>(
        s: B::Simd,
        records: &R,
        &Beam { axes, slopes, .. }: &Beam,
        origin: [f32; 3],
    ) -> Self {
        let middle = slopes.map(|[a, b]| (a + b) * 0.5);
        // The middle is rounded, and so is what is subtracted.
        let apart = slopes.map(|[a, b]| (b - a) * (0.5 + MORE) + MORE);
        let a = relative(s, records, 0, axes, origin);
        let b = relative(s, records, 1, axes, origin);
        let c = relative(s, records, 2, axes, origin);
        let greatest = greatest(a).max(greatest(b)).max(greatest(c));
        let [a, b, c] = [sheared(s, a, middle), sheared(s, b, middle), sheared(s, c, middle)];
        let across = across(a).max(across(b)).max(across(c));
        let reach = greatest.mul_add_fast(B::splat(s, apart[0].max(apart[1]) + MORE), across);
        let bound = (greatest * reach * B::splat(s, BOUND)).max(B::splat(s, LEAST_BOUND));
        let [na, nb, nc] = [cross(c, b), cross(a, c), cross(b, a)];
        let (least_a, greatest_a) = extremes(s, na, apart);
        let (least_b, greatest_b) = extremes(s, nb, apart);
        let (least_c, greatest_c) = extremes(s, nc, apart);
        let least = greatest_a.min(greatest_b).min(greatest_c);
        let greatest = least_a.max(least_b).max(least_c);
        let margin = bound + bound;
        EdgeVolumes {
            normals: [arrays(na), arrays(nb), arrays(nc)],
            bound: bound.to_array(),
            middle,
            lanes: (least.ge(-margin) | greatest.le(margin)).bitmask(),
        }
    }

    /// The triangle in that lane, for many rays.
    #[inline(always)]
    pub(crate) fn spread<V: SimdF32<Simd = B::Simd>>(&self, s: V::Simd, lane: usize) -> Spread<V> {
        let lane = lane & (B::LANES - 1);
        let [a, b, c] = &self.normals;
        Spread {
            normals: [
                splat::<B, V>(s, a, lane),
                splat::<B, V>(s, b, lane),
                splat::<B, V>(s, c, lane),
            ],
            bound: V::splat(s, self.bound.as_ref()[lane]),
            middle: self.middle.map(|slope| V::splat(s, slope)),
        }
    }
}

/// The edge volumes of one triangle in all lanes.
pub(crate) struct Spread<V> {
    normals: [Vec3<V>; 3],
    bound: V,
    middle: [V; 2],
}

impl<V: SimdF32> Spread<V> {
    /// The rays, by their slopes, that may hit the triangle.
    #[inline(always)]
    pub(crate) fn may_hit(&self, x: V, y: V) -> V::Mask {
        let ([a, b, c], [middle_x, middle_y]) = (self.normals, self.middle);
        let (x, y) = (x - middle_x, y - middle_y);
        let (a, b, c) = (volume(a, x, y), volume(b, x, y), volume(c, x, y));
        a.min(b).min(c).ge(-self.bound) | a.max(b).max(c).le(self.bound)
    }
}

#[inline(always)]
fn volume<V: SimdF32>(n: Vec3<V>, x: V, y: V) -> V {
    x.mul_add_fast(n.x, y.mul_add_fast(n.y, n.z))
}

/// The least and the greatest volume of rays with slopes so far from the middle.
#[inline(always)]
fn extremes<B: SimdF32>(s: B::Simd, n: Vec3<B>, [x, y]: [f32; 2]) -> (B, B) {
    let apart = B::splat(s, x).mul_add_fast(n.x.abs(), B::splat(s, y) * n.y.abs());
    (n.z - apart, n.z + apart)
}

/// What a point is when a ray with such slopes runs along z.
#[inline(always)]
fn sheared<B: SimdF32>(s: B::Simd, v: Vec3<B>, [x, y]: [f32; 2]) -> Vec3<B> {
    Vec3::new(v.x - v.z * B::splat(s, x), v.y - v.z * B::splat(s, y), v.z)
}

#[inline(always)]
fn across<B: SimdF32>(v: Vec3<B>) -> B {
    v.x.abs().max(v.y.abs())
}

#[inline(always)]
fn arrays<B: SimdF32>(v: Vec3<B>) -> [B::Array; 3] {
    [v.x.to_array(), v.y.to_array(), v.z.to_array()]
}

#[inline(always)]
fn relative<B: SimdF32, R: Records<B>>(
    s: B::Simd,
    records: &R,
    row: usize,
    [kx, ky, kz]: [usize; 3],
    [x, y, z]: [f32; 3],
) -> Vec3<B> {
    let point =
        Vec3::new(records.get(s, row, kx), records.get(s, row, ky), records.get(s, row, kz));
    point - Vec3::splat(s, [x, y, z])
}

#[inline(always)]
fn greatest<B: SimdF32>(v: Vec3<B>) -> B {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}

#[inline(always)]
fn cross<B: SimdF32>(a: Vec3<B>, b: Vec3<B>) -> Vec3<B> {
    let x = a.y.mul_sub_fast(b.z, a.z * b.y);
    let y = a.z.mul_sub_fast(b.x, a.x * b.z);
    let z = a.x.mul_sub_fast(b.y, a.y * b.x);
    Vec3::new(x, y, z)
}

#[inline(always)]
fn splat<B: SimdF32, V: SimdF32<Simd = B::Simd>>(
    s: V::Simd,
    [x, y, z]: &[B::Array; 3],
    lane: usize,
) -> Vec3<V> {
    Vec3::splat(s, [x.as_ref()[lane], y.as_ref()[lane], z.as_ref()[lane]])
}

#[cfg(test)]
mod tests {
    use simd4::{Lanes, Level, Simd, dispatch};

    use super::*;
    use crate::Ray;
    use crate::geom::Triangle;
    use crate::packet::{Coherent, Packet};
    use crate::tri::{BlockLanes, Record, RecordBlock, TriangleKernel, WithoutBox};

    /// Eight triangles of all sizes, about where the beam goes.
    fn block(seed: usize) -> RecordBlock<8> {
        let wave =
            |k: usize| (glam::Vec3::new(0.61, 1.37, 2.71) * (seed * 97 + k) as f32).map(f32::sin);
        let triangle = |i: usize| {
            let size = [0.01, 0.1, 1.0, 4.0][i % 4];
            Triangle {
                corners: [1, 2, 3].map(|k| wave(i) + wave(9 * i + k) * size + glam::Vec3::Z * 2.0),
            }
        };
        RecordBlock::new((0..7).map(|i| Record::corners(&triangle(i), i as u32)))
    }

    /// How many triangles are out of reach of the beam, and how many of those of some ray.
    #[inline(always)]
    fn missed<S: Simd>(s: S, block: &RecordBlock<8>, beam: &Beam) -> [u32; 2] {
        let volumes = EdgeVolumes::<S::f32x8>::new(s, &BlockLanes::new(block, 0), beam, [0.0; 3]);
        assert!(volumes.lanes >> 7 == 0, "the last lane has no triangle");
        let mut of_rays = u32::MAX;
        for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
            let [x, y] = [(beam.slopes[0], i), (beam.slopes[1], j)]
                .map(|([a, b], k)| (a + (b - a) * (k as f32 / 4.0)).clamp(a, b));
            for lane in 0..7 {
                let triangle = volumes.spread::<S::f32x4>(s, lane);
                if triangle.may_hit(S::f32x4::splat(s, x), S::f32x4::splat(s, y)).any() {
                    of_rays &= !(1 << lane);
                }
            }
        }
        let of_beam = !volumes.lanes & 127;
        assert_eq!(of_beam & of_rays, of_beam, "a ray may hit what its beam leaves out");
        [of_beam.count_ones(), (of_rays & 127).count_ones()]
    }

    /// Of rays from the origin at edges and corners of a block's triangles: how many hit one, of which none is
    /// left out, and how many miss one that is.
    #[inline(always)]
    fn grazed<S: Simd>(s: S, block: &RecordBlock<8>, slopes: &[[f32; 2]]) -> [u32; 2] {
        let bounds = |k: usize| {
            let along = slopes.iter().map(|slopes| slopes[k]);
            [along.clone().fold(1.0, f32::min), along.fold(-1.0, f32::max)]
        };
        let triangles = BlockLanes::new(block, 0);
        let volumes =
            EdgeVolumes::<S::f32x8>::new(s, &triangles, &beam([bounds(0), bounds(1)]), [0.0; 3]);
        let mut counts = [0; 2];
        for &[x, y] in slopes {
            let ray = Ray::new(glam::Vec3::ZERO, glam::Vec3::new(x, y, 1.0));
            let packet = Packet::<S::f32x8>::splat(s, &ray);
            let frame = Coherent::of_one(s, &ray);
            let found = WithoutBox::test(s, &triangles, &packet, &frame, packet.tmax);
            let found = found.map_or(0, |found| found.mask.bitmask());
            for lane in 0..7 {
                let triangle = volumes.spread::<S::f32x4>(s, lane);
                let may_hit = volumes.lanes >> lane & 1 == 1
                    && triangle.may_hit(S::f32x4::splat(s, x), S::f32x4::splat(s, y)).any();
                let hits = found >> lane & 1 == 1;
                assert!(may_hit || !hits, "lane {lane}: ({x}, {y}) hits");
                counts[0] += u32::from(hits);
                counts[1] += u32::from(!may_hit);
            }
        }
        counts
    }

    #[test]
    fn rays_at_the_edges_of_small_triangles_are_not_left_out() {
        let [mut hits, mut left_out] = [0; 2];
        for seed in 0..300 {
            let wave = |k: usize| {
                (glam::Vec3::new(0.61, 1.37, 2.71) * (seed * 89 + k) as f32).map(f32::sin)
            };
            let size = [1e-1, 1e-2, 1e-3, 1e-5][seed % 4];
            let middle = wave(1) * 0.9 + glam::Vec3::Z * 3.0;
            let triangles: Vec<[glam::Vec3; 3]> = (0..7)
                .map(|i| [2, 3, 4].map(|k| middle + (wave(9 * i + k) + wave(i) * 0.5) * size))
                .collect();
            let record = |(i, &corners): (usize, &[glam::Vec3; 3])| {
                Record::corners(&Triangle { corners }, i as u32)
            };
            let records: Vec<_> = triangles.iter().enumerate().map(record).collect();
            let mut slopes = Vec::new();
            for [a, b, c] in triangles {
                for at in [a, b, c, (a + b) * 0.5, b.lerp(c, 0.3), c.lerp(a, 0.9)] {
                    let [x, y] = [at.x / at.z, at.y / at.z];
                    slopes.extend([[x, y], [x.next_up(), y], [x, y.next_down()]]);
                }
            }
            for level in Level::available() {
                let block = RecordBlock::new(records.iter().copied());
                let counts = dispatch!(level, s => grazed(s, &block, &slopes));
                hits += counts[0];
                left_out += counts[1];
            }
        }
        assert!(hits > 10_000 && left_out > 10_000, "{hits} and {left_out}");
    }

    fn beam(slopes: [[f32; 2]; 2]) -> Beam {
        let all = [0.0, 0.0];
        Beam { axes: [0, 1, 2], negative: [false; 3], origin: [all; 3], inv: [all; 3], slopes }
    }

    #[test]
    fn a_beam_leaves_out_what_all_its_rays_miss() {
        let [mut by_beams, mut by_rays] = [0; 2];
        for seed in 0..200 {
            let width = [0.0, 0.01, 0.1, 1.0][seed % 4];
            let [x, y] = [0.37, 0.73].map(|k| (seed as f32 * k).sin() * (1.0 - width));
            let slopes = [[x, x + width], [y, y + width]];
            let beam = beam(slopes);
            for level in Level::available() {
                let [of_beam, of_rays] = dispatch!(level, s => missed(s, &block(seed), &beam));
                by_beams += of_beam;
                by_rays += of_rays;
            }
        }
        assert!(by_beams * 10 > by_rays * 8 && by_rays > 0, "{by_beams} of {by_rays}");
    }
}
