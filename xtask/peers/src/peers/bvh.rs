//! `bvh`. It leaves the triangles to its user, and its iterators do not know how far the closest hit
//! is; a query of our own tells them, so that they leave out what is behind it.

use std::cell::Cell;

use bvh::aabb::{Aabb, Bounded, IntersectsAabb};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::{Bvh, BvhNode};
use bvh::ray::Ray;
use glam::Vec3;
use nalgebra::{Point3, Vector3};

use super::single::{Single, Tracer};
use super::{Built, Hit, Peer};
use crate::clock::took;
use crate::mesh::Mesh;

/// A triangle, with what the crate wants to know of it.
struct Shape {
    corners: [Vec3; 3],
    prim: u32,
    node: usize,
}

impl Bounded<f32, 3> for Shape {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [a, b, c] = self.corners;
        let point = |v: Vec3| Point3::new(v.x, v.y, v.z);
        Aabb::with_bounds(point(a.min(b).min(c)), point(a.max(b).max(c)))
    }
}

impl BHShape<f32, 3> for Shape {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

struct Hierarchy {
    bvh: Bvh<f32, 3>,
    shapes: Vec<Shape>,
}

/// Builds it.
pub(super) fn build(mesh: &Mesh) -> Box<dyn Peer> {
    let shape = |i| Shape { corners: mesh.corners(i), prim: i as u32, node: 0 };
    let mut shapes: Vec<_> = (0..mesh.triangles.len()).map(shape).collect();
    let (bvh, took) = took(|| Bvh::build(&mut shapes));
    let bytes = bvh.nodes.len() * size_of::<BvhNode<f32, 3>>() + size_of_val(&*shapes);
    Box::new(Single { tracer: Hierarchy { bvh, shapes }, built: Built { took, bytes } })
}

/// A ray in the crate's form and in ours.
struct Both(Ray<f32, 3>, rt_kernels::Ray);

/// What is still of interest of a ray.
struct Query<'a> {
    ray: &'a Ray<f32, 3>,
    tmax: Cell<f32>,
}

impl IntersectsAabb<f32, 3> for Query<'_> {
    fn intersects_aabb(&self, aabb: &Aabb<f32, 3>) -> bool {
        let slice = self.ray.intersection_slice_for_aabb(aabb);
        slice.is_some_and(|(near, _)| near <= self.tmax.get())
    }
}

impl Tracer for Hierarchy {
    const NAME: [&str; 2] = ["bvh", "bvh"];
    type Ray = Both;

    fn ray(ray: &rt_kernels::Ray) -> Both {
        let (o, d) = (ray.origin, ray.dir);
        // The crate would normalise the direction, and its t with it.
        let mut theirs = Ray::new(Point3::new(o.x, o.y, o.z), Vector3::new(d.x, d.y, d.z));
        theirs.direction = Vector3::new(d.x, d.y, d.z);
        theirs.inv_direction = theirs.direction.map(|x| 1.0 / x);
        Both(theirs, *ray)
    }

    fn closest(&self, Both(theirs, ray): &Both) -> Option<Hit> {
        let query = Query { ray: theirs, tmax: Cell::new(ray.tmax) };
        let mut closest = None;
        for shape in self.bvh.traverse_iterator(&query, &self.shapes) {
            if let Some(t) = moller_trumbore(ray, &shape.corners, query.tmax.get()) {
                query.tmax.set(t);
                closest = Some(Hit { t, prim: shape.prim });
            }
        }
        closest
    }

    fn any(&self, Both(theirs, ray): &Both) -> bool {
        let query = Query { ray: theirs, tmax: Cell::new(ray.tmax) };
        let mut shapes = self.bvh.traverse_iterator(&query, &self.shapes);
        shapes.any(|shape| moller_trumbore(ray, &shape.corners, ray.tmax).is_some())
    }
}

/// The test of Möller and Trumbore (1997), of both sides: the crate's own is blind on one.
fn moller_trumbore(ray: &rt_kernels::Ray, [a, b, c]: &[Vec3; 3], tmax: f32) -> Option<f32> {
    let (ab, ac, to) = (b - a, c - a, ray.origin - a);
    let p = ray.dir.cross(ac);
    let inverse = 1.0 / ab.dot(p);
    let q = to.cross(ab);
    let (u, v, t) = (to.dot(p) * inverse, ray.dir.dot(q) * inverse, ac.dot(q) * inverse);
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    (inside && t >= ray.tmin && t <= tmax).then_some(t)
}
