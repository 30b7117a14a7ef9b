//! What a scene is made of, as a caller states it and as leaves hold it.

use std::ops::Range;

use glam::Vec3;
use simd4::SimdF32;

use crate::geom::{Aabb, Cone, Sphere, Triangle};
use crate::packet::{Frame, Packet, Query};
use crate::quadric::cone::{self, ConeRecord};
use crate::quadric::sphere;
use crate::tri::{self, Method, Record, TriangleKernel};
use crate::{BuildError, Counters, Join};

/// The primitives of a scene. They are numbered in this order: triangles first, then spheres, then
/// cones.
#[derive(Clone, Debug, Default)]
pub struct Primitives {
    /// Triangles.
    pub triangles: Vec<Triangle>,
    /// Spheres.
    pub spheres: Vec<Sphere>,
    /// Cones and cylinders.
    pub cones: Vec<Cone>,
}

/// How many kinds of primitives there are.
pub(crate) const KINDS: usize = 3;

/// The kind of a primitive, from 0, if there are so many of each.
pub(crate) fn kind(counts: &[usize; KINDS], prim: u32) -> usize {
    let [triangles, spheres, _] = *counts;
    usize::from(prim as usize >= triangles) + usize::from(prim as usize >= triangles + spheres)
}

/// One of them.
pub(crate) enum Primitive<'a> {
    Triangle(&'a Triangle),
    Sphere(&'a Sphere),
    Cone(&'a Cone),
}

/// The greatest coordinate of a primitive. See the crate's documentation, "The range".
const MAX_COORDINATE: f32 = (1u64 << 40) as f32;

/// The greatest number of primitives: a slot has 28 bits in a node.
pub(crate) const MAX_PRIMITIVES: usize = 1 << 28;

impl Primitives {
    /// The triangles whose corners are these vertices, by number.
    ///
    /// # Errors
    /// If a corner has a number beyond the last vertex.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::Primitives;
    /// let vertices = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    /// let tetrahedron = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    /// let scene = Primitives::mesh(&vertices, &tetrahedron)?;
    /// assert_eq!(scene.triangles[3].corners, [Vec3::X, Vec3::Y, Vec3::Z]);
    ///
    /// let error = Primitives::mesh(&vertices, &[[0, 1, 4]]).expect_err("there is no vertex 4");
    /// assert_eq!(error.to_string(), "primitive 0 has the vertex 4, but there are 4");
    /// # Ok::<(), rt_kernels::BuildError>(())
    /// ```
    pub fn mesh(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Result<Primitives, BuildError> {
        let mut scene = Primitives::default();
        scene.triangles.reserve_exact(triangles.len());
        for (prim, numbers) in triangles.iter().enumerate() {
            let mut corners = [Vec3::ZERO; 3];
            for (corner, &vertex) in corners.iter_mut().zip(numbers) {
                let found = vertices.get(vertex as usize).copied();
                let vertices = vertices.len();
                *corner = found.ok_or(BuildError::NoVertex { prim, vertex, vertices })?;
            }
            scene.triangles.push(Triangle { corners });
        }
        Ok(scene)
    }

    /// The number of primitives.
    pub fn len(&self) -> usize {
        self.counts().iter().sum()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many there are of each kind.
    pub(crate) fn counts(&self) -> [usize; KINDS] {
        [self.triangles.len(), self.spheres.len(), self.cones.len()]
    }

    /// The primitive of that number.
    ///
    /// # Panics
    /// If there is none.
    #[inline(always)]
    pub(crate) fn get(&self, prim: u32) -> Primitive<'_> {
        let prim = prim as usize;
        let (spheres, cones) = (self.triangles.len(), self.triangles.len() + self.spheres.len());
        if prim < spheres {
            Primitive::Triangle(&self.triangles[prim])
        } else if prim < cones {
            Primitive::Sphere(&self.spheres[prim - spheres])
        } else {
            Primitive::Cone(&self.cones[prim - cones])
        }
    }

    /// The own box of the primitive of that number.
    ///
    /// # Panics
    /// If there is none.
    #[inline(always)]
    pub(crate) fn own_box(&self, prim: u32) -> Aabb {
        match self.get(prim) {
            Primitive::Triangle(triangle) => triangle.own_box(),
            Primitive::Sphere(sphere) => sphere.own_box(),
            Primitive::Cone(cone) => cone.own_box(),
        }
    }

    /// The own boxes of all primitives, in their order.
    pub(crate) fn own_boxes(&self) -> impl Iterator<Item = Aabb> {
        (0..self.len() as u32).map(|prim| self.own_box(prim))
    }

    /// Refuses what the kernels make no promise for.
    pub(crate) fn check(&self, join: &impl Join) -> Result<(), BuildError> {
        if self.len() > MAX_PRIMITIVES {
            return Err(BuildError::TooMany { primitives: self.len(), limit: MAX_PRIMITIVES });
        }
        check_triangles(0, &self.triangles, join)?;
        for (prim, sphere) in (self.triangles.len()..).zip(&self.spheres) {
            check_points(prim, &[sphere.center, Vec3::splat(sphere.radius)])?;
            if sphere.radius <= 0.0 {
                return Err(BuildError::NoRadius { prim });
            }
        }
        for (prim, cone) in (self.triangles.len() + self.spheres.len()..).zip(&self.cones) {
            let [base, apex] = [cone.base_radius, cone.apex_radius];
            check_points(prim, &[cone.base, cone.apex, Vec3::new(base, apex, 0.0)])?;
            if cone.base == cone.apex || base.min(apex) < 0.0 || base.max(apex) == 0.0 {
                return Err(BuildError::NoMantle { prim });
            }
        }
        Ok(())
    }
}

/// The least number of triangles of which the halves may be looked at at once.
const PARALLEL: usize = 1 << 14;

/// Refuses the first that is to be refused of some triangles, of which the first has that number.
fn check_triangles(
    first: usize,
    triangles: &[Triangle],
    join: &impl Join,
) -> Result<(), BuildError> {
    if triangles.len() >= PARALLEL {
        let middle = triangles.len() / 2;
        let (left, right) = triangles.split_at(middle);
        let (left, right) = join.join(
            || check_triangles(first, left, join),
            || check_triangles(first + middle, right, join),
        );
        return left.and(right);
    }
    let mut triangles = (first..).zip(triangles);
    triangles.try_for_each(|(prim, triangle)| check_points(prim, &triangle.corners))
}

/// Refuses a primitive with a coordinate that is not finite or too large.
#[inline(always)]
fn check_points<const P: usize>(prim: usize, points: &[Vec3; P]) -> Result<(), BuildError> {
    let in_range = |x: f32| x.abs() <= MAX_COORDINATE;
    let in_range = |point: &Vec3| in_range(point.x) & in_range(point.y) & in_range(point.z);
    if points.iter().fold(true, |all, point| all & in_range(point)) {
        return Ok(());
    }
    if !points.iter().all(|point| point.is_finite()) {
        return Err(BuildError::NotFinite { prim });
    }
    Err(BuildError::OutOfRange { prim })
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
/// then cones, so that a range of slots of one kind needs no tag.
#[derive(Clone, Debug, Default)]
pub(crate) struct Store {
    /// The test that the triangles' records are made for.
    method: Method,
    /// How many primitives there are of each kind: some may have several slots.
    counts: [usize; KINDS],
    triangles: Vec<Record>,
    /// The triangles' own boxes, unless the method's kernel has them from the records.
    own_boxes: Vec<Aabb>,
    spheres: Vec<SphereRecord>,
    cones: Vec<ConeRecord>,
}

impl Store {
    /// All primitives in their own order.
    pub(crate) fn in_order(primitives: &Primitives, method: Method) -> Store {
        Store::reordered(primitives, method, 0..primitives.len() as u32)
    }

    /// The primitives of these numbers, each kind in the order given.
    pub(crate) fn reordered(
        primitives: &Primitives,
        method: Method,
        order: impl Iterator<Item = u32>,
    ) -> Store {
        let boxes = if method.in_own_box() { 0 } else { primitives.triangles.len() };
        let mut store = Store {
            method,
            counts: primitives.counts(),
            triangles: Vec::with_capacity(primitives.triangles.len()),
            own_boxes: Vec::with_capacity(boxes),
            spheres: Vec::with_capacity(primitives.spheres.len()),
            cones: Vec::with_capacity(primitives.cones.len()),
        };
        for prim in order {
            match primitives.get(prim) {
                Primitive::Triangle(triangle) => {
                    store.triangles.push(method.record(triangle, prim));
                    if boxes > 0 {
                        store.own_boxes.push(triangle.own_box());
                    }
                }
                Primitive::Sphere(&sphere) => store.spheres.push(SphereRecord { sphere, prim }),
                Primitive::Cone(cone) => store.cones.push(ConeRecord::new(cone, prim)),
            }
        }
        store
    }

    /// Takes new positions of the same primitives.
    pub(crate) fn replace(&mut self, primitives: &Primitives) {
        let order: Vec<u32> = (0..self.slots()).map(|slot| self.prim(slot)).collect();
        *self = Store::reordered(primitives, self.method, order.into_iter());
    }

    /// How many primitives there are of each kind.
    pub(crate) fn counts(&self) -> [usize; KINDS] {
        self.counts
    }

    /// The primitive in a slot.
    pub(crate) fn prim(&self, slot: usize) -> u32 {
        let [_, spheres, cones] = self.slots_by_kind();
        if slot < spheres.start {
            self.triangles[slot].number()
        } else if slot < cones.start {
            self.spheres[slot - spheres.start].prim
        } else {
            self.cones[slot - cones.start].prim
        }
    }

    /// The triangle in a slot; `None` if there is something else.
    #[inline(always)]
    pub(crate) fn triangle(&self, slot: usize) -> Option<&Record> {
        self.triangles.get(slot)
    }

    /// The number of slots: a primitive may have several.
    pub(crate) fn slots(&self) -> usize {
        let [.., cones] = self.slots_by_kind();
        cones.end
    }

    /// The slots of all primitives of each kind.
    #[inline(always)]
    pub(crate) fn slots_by_kind(&self) -> [Range<usize>; KINDS] {
        let spheres = self.triangles.len();
        let cones = spheres + self.spheres.len();
        [0..spheres, spheres..cones, cones..cones + self.cones.len()]
    }

    /// The test that the triangles' records are made for.
    pub(crate) fn method(&self) -> Method {
        self.method
    }

    /// Tests a packet against a range of slots of one kind; `K` is the kernel of the
    /// [method](Store::method).
    #[inline(always)]
    pub(crate) fn intersect<K: TriangleKernel, V: SimdF32, F: Frame<V>, Q: Query<V>>(
        &self,
        s: V::Simd,
        slots: Range<usize>,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Q,
        stats: &mut impl Counters,
    ) {
        let tests = (slots.len() * V::LANES) as u64;
        if slots.end <= self.triangles.len() {
            stats.count(|stats| stats.triangle_tests += tests);
            if K::IN_OWN_BOX {
                for triangle in &self.triangles[slots] {
                    tri::intersect::<K, V, F, _, Q>(s, triangle, packet, frame, query);
                }
            } else {
                let own_boxes = &self.own_boxes[slots.clone()];
                for (triangle, own_box) in self.triangles[slots].iter().zip(own_boxes) {
                    tri::intersect_in::<K, V, F, Q>(s, triangle, own_box, packet, frame, query);
                }
            }
            return;
        }
        let [_, spheres, cones] = self.slots_by_kind();
        if slots.end <= spheres.end {
            stats.count(|stats| stats.sphere_tests += tests);
            for sphere in &self.spheres[slots.start - spheres.start..slots.end - spheres.start] {
                sphere::intersect(s, sphere, packet, frame, query);
            }
        } else {
            stats.count(|stats| stats.cone_tests += tests);
            for cone in &self.cones[slots.start - cones.start..slots.end - cones.start] {
                cone::intersect(s, cone, packet, frame, query);
            }
        }
    }

    /// The memory that the records take.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.triangles)
            + size_of_val(&*self.own_boxes)
            + size_of_val(&*self.spheres)
            + size_of_val(&*self.cones)
    }
}
