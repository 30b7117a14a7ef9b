//! What a scene is made of, as a caller states it and as leaves hold it.

use std::ops::Range;

use glam::Vec3;
use simd4::{Lanes, Simd, SimdF32, spec};

use crate::geom::{Aabb, PADDING, Sphere, Triangle};
use crate::packet::{Frame, Packet, Query};
use crate::quadric::sphere;
use crate::tri::watertight;
use crate::{BuildError, Stats};

/// The primitives of a scene. They are numbered in this order: triangles first, then spheres.
#[derive(Clone, Debug, Default)]
pub struct Primitives {
    /// Triangles.
    pub triangles: Vec<Triangle>,
    /// Spheres.
    pub spheres: Vec<Sphere>,
}

/// The greatest coordinate of a primitive. See the crate's documentation, "The range".
const MAX_COORDINATE: f32 = (1u64 << 40) as f32;

/// The greatest number of primitives: a slot has 28 bits in a node.
const MAX_PRIMITIVES: usize = 1 << 28;

impl Primitives {
    /// The number of primitives.
    pub fn len(&self) -> usize {
        self.triangles.len() + self.spheres.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The own boxes of all primitives, in their order.
    pub(crate) fn own_boxes(&self) -> impl Iterator<Item = Aabb> {
        let triangles = self.triangles.iter().map(Triangle::own_box);
        triangles.chain(self.spheres.iter().map(Sphere::own_box))
    }

    /// Refuses what the kernels make no promise for.
    pub(crate) fn check(&self) -> Result<(), BuildError> {
        if self.len() > MAX_PRIMITIVES {
            return Err(BuildError::TooMany { primitives: self.len(), limit: MAX_PRIMITIVES });
        }
        for (prim, triangle) in self.triangles.iter().enumerate() {
            check_points(prim, &triangle.corners)?;
        }
        for (prim, sphere) in (self.triangles.len()..).zip(&self.spheres) {
            check_points(prim, &[sphere.center, Vec3::splat(sphere.radius)])?;
            if sphere.radius <= 0.0 {
                return Err(BuildError::NoRadius { prim });
            }
        }
        Ok(())
    }
}

/// Refuses a primitive with a coordinate that is not finite or too large.
fn check_points(prim: usize, points: &[Vec3]) -> Result<(), BuildError> {
    if !points.iter().all(|point| point.is_finite()) {
        return Err(BuildError::NotFinite { prim });
    }
    if points.iter().any(|point| point.abs().max_element() > MAX_COORDINATE) {
        return Err(BuildError::OutOfRange { prim });
    }
    Ok(())
}

/// A triangle as leaves hold it: 48 bytes, three blocks of 16 (Geimer and Müller 2003,
/// Section 3.2, with corners in place of edges: an edge would be rounded).
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub struct TriangleRecord {
    /// First corner.
    pub a: [f32; 3],
    /// The primitive's number.
    pub prim: u32,
    /// Second corner.
    pub b: [f32; 3],
    _pad_b: u32,
    /// Third corner.
    pub c: [f32; 3],
    _pad_c: u32,
}

const _: () = assert!(size_of::<TriangleRecord>() == 48);

impl TriangleRecord {
    /// The own box of the triangle, the same bits as [`Triangle::own_box`]: all axes at once.
    #[inline(always)]
    pub(crate) fn own_box<S: Simd>(&self, s: S) -> Aabb {
        let (a, b, c) = (block(s, self.a), block(s, self.b), block(s, self.c));
        let min = a.min(b).min(c);
        let max = a.max(b).max(c);
        let [x, y, z, _] = (max - min).to_array();
        let extent = spec::max(spec::max(x, y), z);
        let magnitude = min.abs().max(max.abs());
        let pad =
            S::f32x4::splat(s, extent * PADDING) + magnitude * S::f32x4::splat(s, f32::EPSILON);
        let [x0, y0, z0, _] = (min - pad).to_array();
        let [x1, y1, z1, _] = (max + pad).to_array();
        Aabb { axes: [[x0, x1], [y0, y1], [z0, z1]] }
    }
}

/// A corner in one register; the fourth lane is of no account.
#[inline(always)]
fn block<S: Simd>(s: S, [x, y, z]: [f32; 3]) -> S::f32x4 {
    S::f32x4::from_array(s, [x, y, z, 0.0])
}

/// A sphere as leaves hold it: 32 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub struct SphereRecord {
    /// The sphere.
    pub sphere: Sphere,
    /// The primitive's number.
    pub prim: u32,
}

/// Primitives in the order of the leaves. A **slot** numbers them: triangles first, then spheres,
/// so that a range of slots of one kind needs no tag.
#[derive(Clone, Debug, Default)]
pub(crate) struct Store {
    triangles: Vec<TriangleRecord>,
    spheres: Vec<SphereRecord>,
}

impl Store {
    /// All primitives in their own order.
    pub(crate) fn in_order(primitives: &Primitives) -> Store {
        Store::reordered(primitives, 0..primitives.len() as u32)
    }

    /// The primitives of these numbers, each kind in the order given.
    pub(crate) fn reordered(primitives: &Primitives, order: impl Iterator<Item = u32>) -> Store {
        let mut store = Store {
            triangles: Vec::with_capacity(primitives.triangles.len()),
            spheres: Vec::with_capacity(primitives.spheres.len()),
        };
        for prim in order {
            match primitives.triangles.get(prim as usize) {
                Some(triangle) => {
                    let [a, b, c] = triangle.corners.map(|corner| corner.to_array());
                    store.triangles.push(TriangleRecord { a, prim, b, _pad_b: 0, c, _pad_c: 0 });
                }
                None => {
                    let sphere = primitives.spheres[prim as usize - primitives.triangles.len()];
                    store.spheres.push(SphereRecord { sphere, prim });
                }
            }
        }
        store
    }

    /// The slots of all triangles.
    pub(crate) fn triangle_slots(&self) -> Range<usize> {
        0..self.triangles.len()
    }

    /// The slots of all spheres.
    pub(crate) fn sphere_slots(&self) -> Range<usize> {
        self.triangles.len()..self.triangles.len() + self.spheres.len()
    }

    /// Tests a packet against a range of slots of one kind.
    #[inline(always)]
    pub(crate) fn intersect<V: SimdF32, F: Frame<V>, Q: Query<V>>(
        &self,
        s: V::Simd,
        slots: Range<usize>,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Q,
        stats: &mut Stats,
    ) {
        let tests = (slots.len() * V::LANES) as u64;
        if slots.end <= self.triangles.len() {
            stats.triangle_tests += tests;
            for triangle in &self.triangles[slots] {
                watertight::intersect(s, triangle, packet, frame, query);
            }
        } else {
            stats.sphere_tests += tests;
            let spheres = slots.start - self.triangles.len()..slots.end - self.triangles.len();
            for sphere in &self.spheres[spheres] {
                sphere::intersect(s, sphere, packet, frame, query);
            }
        }
    }

    /// The memory that the records take.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.triangles) + size_of_val(&*self.spheres)
    }
}
