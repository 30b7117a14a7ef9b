//! One ray against one triangle with the lanes across the test, beside the same with a ray in each
//! lane: what Wald et al. compare in their Table 1.
//!
//! For measurements: renderers have rays in lanes. Tests come in an order of the caller's, so that
//! records can be made to come from a cache or from memory. Source: Wald, Slusallek, Benthin, Wagner,
//! "Interactive Rendering with Coherent Ray Tracing", 2001, Sections 3.2 and 3.3.

use simd4::scalar::f32x1;
use simd4::{Lanes, Level, Scalar, Simd, SimdF32, SimdMask, dispatch};

use super::method::WaldMethod;
use super::{Record, TriangleKernel, intersect};
use crate::geom::Triangle;
use crate::packet::{Closest, Hits, Packet, Rays};
use crate::{Hit, Ray};

/// What the lanes are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Across {
    /// For nothing: Wald's test, in plain scalar code.
    WaldScalar,
    /// For the plane and the two edge equations of Wald's test.
    WaldEquations,
    /// For the three edges of Plücker's test.
    PluckerEdges,
    /// For four rays.
    WaldRays,
}

impl Across {
    /// All of them, in the order of the paper's table.
    pub const ALL: [Across; 4] =
        [Across::WaldScalar, Across::WaldEquations, Across::PluckerEdges, Across::WaldRays];

    /// What it keeps of triangles.
    pub fn records(self, triangles: &[Triangle]) -> Vec<Record> {
        let record = |(prim, triangle): (u32, &Triangle)| match self {
            Across::WaldScalar | Across::WaldRays => WaldMethod::record(triangle, prim),
            Across::WaldEquations => WaldMethod::record(triangle, prim).transposed(),
            Across::PluckerEdges => Record::corners(triangle, prim).transposed(),
        };
        (0..).zip(triangles).map(record).collect()
    }

    /// Finds the closest hit of every ray among the records of these numbers, in their order.
    pub fn closest(
        self,
        level: Level,
        records: &[Record],
        order: &[u32],
        rays: &Rays,
        hits: &mut Hits,
    ) {
        hits.resize(rays.len());
        let work = Work { records, order, rays, hits };
        match self {
            Across::WaldScalar => rays_in_lanes::<f32x1>(Scalar::new(), work),
            Across::WaldEquations => dispatch!(level, s => one_by_one::<WaldEquations, _>(s, work)),
            Across::PluckerEdges => dispatch!(level, s => one_by_one::<PluckerEdges, _>(s, work)),
            Across::WaldRays => dispatch!(level, s => four_rays(s, work)),
        }
    }
}

struct Work<'a> {
    records: &'a [Record],
    order: &'a [u32],
    rays: &'a Rays,
    hits: &'a mut Hits,
}

#[inline(always)]
fn four_rays<S: Simd>(s: S, work: Work<'_>) {
    rays_in_lanes::<S::f32x4>(s, work);
}

#[inline(always)]
fn rays_in_lanes<V: SimdF32>(s: V::Simd, work: Work<'_>) {
    let Work { records, order, rays, hits } = work;
    let mut first = 0;
    while first < rays.len() {
        let packet = Packet::<V>::load(s, rays, first);
        let frame = packet.mixed(s);
        let mut query = Closest::new(s, &packet);
        for &i in order {
            let record = &records[i as usize];
            intersect::<WaldMethod, V, _, _, _>(s, record, &packet, &frame, &mut query);
        }
        query.store(hits, first);
        first += V::LANES;
    }
}

/// A test of one ray with a triangle across four lanes.
trait Test {
    /// Where `t` is at most `limit`: `t` and the weights of the second and third corner.
    fn test<S: Simd>(s: S, record: &Record, ray: &Ray, limit: f32) -> Option<[f32; 3]>;
}

#[inline(always)]
fn one_by_one<T: Test, S: Simd>(s: S, work: Work<'_>) {
    let Work { records, order, rays, hits } = work;
    let mut i = 0;
    while i < rays.len() {
        let ray = rays.get(i);
        let mut hit = Hit { t: ray.tmax.min(f32::MAX), prim: Hits::NONE, u: 0.0, v: 0.0 };
        for &record in order {
            let record = &records[record as usize];
            if let Some([t, u, v]) = T::test(s, record, &ray, hit.t)
                && (t < hit.t || record.number() < hit.prim)
            {
                hit = Hit { t, prim: record.number(), u, v };
            }
        }
        hits.set(i, hit);
        i += 1;
    }
}

/// The plane in the first lane, and the equations of two edges in the others: all three are asked for
/// what they are at the origin, and by how much they change along the ray.
struct WaldEquations;

impl Test for WaldEquations {
    #[inline(always)]
    fn test<S: Simd>(s: S, record: &Record, ray: &Ray, limit: f32) -> Option<[f32; 3]> {
        let axis = record.axis();
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let (o, d) = (ray.origin.to_array(), ray.dir.to_array());
        let [u, v, rest] = [record.row(s, 0), record.row(s, 1), record.row(s, 2)];
        let (ou, ov) = (S::f32x4::splat(s, o[i]), S::f32x4::splat(s, o[j]));
        let (du, dv) = (S::f32x4::splat(s, d[i]), S::f32x4::splat(s, d[j]));
        let (along, at) = (u * du + v * dv, u * ou + v * ov);
        let t = (rest.lane(0) - at.lane(0) - o[axis % 3]) / (along.lane(0) + d[axis % 3]);
        if !(ray.tmin <= t && t <= limit) {
            return None;
        }
        let weights = along * S::f32x4::splat(s, t) + (at + rest);
        let (b, c) = (weights.lane(1), weights.lane(2));
        (b >= 0.0 && c >= 0.0 && b + c <= 1.0).then_some([t, b, c])
    }
}

/// An edge in each of three lanes.
struct PluckerEdges;

impl Test for PluckerEdges {
    #[inline(always)]
    fn test<S: Simd>(s: S, record: &Record, ray: &Ray, limit: f32) -> Option<[f32; 3]> {
        let (o, d) = (ray.origin.to_array(), ray.dir.to_array());
        let x = record.row(s, 0) - S::f32x4::splat(s, o[0]);
        let y = record.row(s, 1) - S::f32x4::splat(s, o[1]);
        let z = record.row(s, 2) - S::f32x4::splat(s, o[2]);
        let (dx, dy) = (S::f32x4::splat(s, d[0]), S::f32x4::splat(s, d[1]));
        let dz = S::f32x4::splat(s, d[2]);
        // From each corner to the next, and their sum.
        let [nx, ny, nz] = [next(x), next(y), next(z)];
        let (ex, ey, ez) = (nx - x, ny - y, nz - z);
        let (sx, sy, sz) = (nx + x, ny + y, nz + z);
        let volumes =
            (ey * sz - ez * sy) * dx + (ez * sx - ex * sz) * dy + (ex * sy - ey * sx) * dz;
        let zero = S::f32x4::splat(s, 0.0);
        let [some, others] = [volumes.ge(zero).bitmask() & 7, volumes.le(zero).bitmask() & 7];
        if some != 7 && others != 7 {
            return None;
        }
        // The edges ab and ca span the plane.
        let (ab, ca) = ([ex.lane(0), ey.lane(0), ez.lane(0)], [ex.lane(2), ey.lane(2), ez.lane(2)]);
        let normal = [
            ab[1] * ca[2] - ab[2] * ca[1],
            ab[2] * ca[0] - ab[0] * ca[2],
            ab[0] * ca[1] - ab[1] * ca[0],
        ];
        let height = normal[0] * x.lane(0) + normal[1] * y.lane(0) + normal[2] * z.lane(0);
        let t = height / (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]);
        let [w, u, v] = [volumes.lane(0), volumes.lane(1), volumes.lane(2)];
        let whole = 1.0 / (u + v + w);
        (ray.tmin <= t && t <= limit).then_some([t, v * whole, w * whole])
    }
}

/// In the first three lanes, the next of them.
#[inline(always)]
fn next<V: SimdF32>(v: V) -> V {
    simd4::swizzle!(v, [1, 2, 0, 3])
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// All find the same triangles, at about the same `t`.
    #[test]
    fn lanes_across_a_test_find_what_lanes_of_rays_find() {
        let wave = |i: usize| (Vec3::new(0.61, 1.37, 2.71) * i as f32).map(f32::sin);
        let triangles: Vec<_> = (0..200)
            .map(|i| Triangle { corners: [1, 2, 3].map(|k| wave(i) + wave(7 * i + k) * 0.5) })
            .collect();
        let rays: Rays =
            (0..203).map(|i| Ray::new(wave(3 * i) * 4.0, -wave(3 * i) + wave(i) * 0.1)).collect();
        let order: Vec<u32> = (0..200).map(|i| i * 77 % 200).collect();
        for level in Level::available() {
            let found = Across::ALL.map(|across| {
                let mut hits = Hits::new();
                across.closest(level, &across.records(&triangles), &order, &rays, &mut hits);
                hits
            });
            let want = (0..rays.len()).filter(|&i| found[0].get(i).is_some()).count();
            assert!(want > 100, "{want} hits");
            for (hits, across) in found.iter().zip(Across::ALL) {
                for i in 0..rays.len() {
                    let (got, want) = (hits.get(i), found[0].get(i));
                    let name = format!("{across:?}, {level}: {got:?} for {want:?}");
                    assert_eq!(got.map(|hit| hit.prim), want.map(|hit| hit.prim), "{name}");
                    let Some((got, want)) = got.zip(want) else { continue };
                    assert!(
                        (got.t - want.t).abs() < 1e-4 && (got.u - want.u).abs() < 1e-3,
                        "{name}"
                    );
                }
            }
        }
    }
}
