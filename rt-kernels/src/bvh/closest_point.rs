//! The point of a scene that is closest to another.
//!
//! In f64, and each primitive by itself: a node is left out only if its box is farther than what was
//! found by more than rounding, so the answer is that of trying all, bit for bit.

use std::ops::Range;

use glam::{DVec3, Vec3};

use super::layout::{Child, SkipArray, Wide, WideNode};
use super::with_array;
use super::{Array, Bvh};
use crate::geom::{Aabb, Cone, Sphere, Triangle};
use crate::primitives::{Primitive, Primitives};

/// A point on a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPoint {
    /// How far it is, rounded.
    pub distance: f32,
    /// Where it is, rounded.
    pub point: Vec3,
    /// The primitive: triangles are numbered first, then spheres, then cones.
    pub prim: u32,
}

impl Bvh {
    /// The point of the surfaces of all primitives that is closest to `point` and no farther than
    /// `max_distance`; of equally close ones that of the lowest primitive. `primitives` are those
    /// that it was built for, or [refitted](Bvh::refit) to. The inside of a sphere or a cone is
    /// as far from its surface as the outside.
    ///
    /// A point that is not finite is close to nothing.
    ///
    /// # Panics
    /// If there are fewer primitives than it was built for.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Bvh, Primitives, Sequential, geom::Triangle};
    /// let floor = Triangle { corners: [Vec3::ZERO, Vec3::X * 4.0, Vec3::Z * 4.0] };
    /// let scene = Primitives { triangles: vec![floor], ..Primitives::default() };
    /// let bvh = Bvh::build(&scene, &Sequential)?;
    ///
    /// let above = Vec3::new(1.0, 3.0, 2.0);
    /// let closest = bvh.closest_point(&scene, above, f32::INFINITY).expect("there is a floor");
    /// assert_eq!((closest.distance, closest.point), (3.0, Vec3::new(1.0, 0.0, 2.0)));
    /// assert_eq!(bvh.closest_point(&scene, above, 2.5), None);
    /// # Ok::<(), rt_kernels::BuildError>(())
    /// ```
    pub fn closest_point(
        &self,
        primitives: &Primitives,
        point: Vec3,
        max_distance: f32,
    ) -> Option<ClosestPoint> {
        let mut search = Search::new(primitives, point, max_distance)?;
        with_array!(&self.array, array => search.descend(array));
        search.found()
    }
}

/// A layout whose boxes can be gone through from the root down.
pub(super) trait Boxed {
    /// A box with something in it.
    type Place: Copy;

    /// Calls with what is at the top.
    fn top(&self, visit: impl FnMut(Self::Place, Aabb));

    /// Calls with the boxes in a place, or gives its primitives to `leaf`.
    fn below(
        &self,
        place: Self::Place,
        visit: impl FnMut(Self::Place, Aabb),
        leaf: impl FnMut(u32),
    );
}

impl Boxed for SkipArray {
    type Place = usize;

    /// A root that is a leaf of both kinds is two nodes.
    fn top(&self, visit: impl FnMut(usize, Aabb)) {
        siblings(self, 0..self.nodes().len(), visit);
    }

    fn below(&self, place: usize, visit: impl FnMut(usize, Aabb), leaf: impl FnMut(u32)) {
        let node = &self.nodes()[place];
        match node.slots() {
            Some(slots) => slots.map(|slot| self.store.prim(slot)).for_each(leaf),
            None => siblings(self, place + 1..node.skip as usize, visit),
        }
    }
}

/// Calls with every node of a range that is below no other.
fn siblings(array: &SkipArray, range: Range<usize>, mut visit: impl FnMut(usize, Aabb)) {
    let mut place = range.start;
    while place < range.end {
        let node = &array.nodes()[place];
        visit(place, node.aabb);
        place = node.skip as usize;
    }
}

impl<const N: usize> Boxed for Wide<N> {
    type Place = Child;

    fn top(&self, mut visit: impl FnMut(Child, Aabb)) {
        let root = self.nodes().first();
        root.into_iter().flat_map(WideNode::boxes).for_each(|(child, aabb)| visit(child, aabb));
    }

    fn below(&self, place: Child, mut visit: impl FnMut(Child, Aabb), leaf: impl FnMut(u32)) {
        match place.find() {
            Ok(node) => self.nodes()[node].boxes().for_each(|(child, aabb)| visit(child, aabb)),
            Err(slots) => self.prims(&slots).for_each(leaf),
        }
    }
}

/// What was found so far.
struct Search<'a> {
    primitives: &'a Primitives,
    point: DVec3,
    /// The least square of a distance, and whose it is.
    best: (f64, u32),
    closest: DVec3,
}

/// No primitive has this number.
const NONE: u32 = u32::MAX;

impl<'a> Search<'a> {
    fn new(primitives: &'a Primitives, point: Vec3, max_distance: f32) -> Option<Self> {
        let reach = f64::from(max_distance);
        let best = (reach * reach, NONE);
        let sensible = point.is_finite() && max_distance >= 0.0;
        let point = point.as_dvec3();
        sensible.then_some(Search { primitives, point, best, closest: point })
    }

    /// Nearer boxes first.
    fn descend<B: Boxed>(&mut self, boxes: &B) {
        let mut open: Vec<(f64, B::Place)> = Vec::new();
        boxes.top(|place, aabb| open.push((square_to_box(self.point, &aabb), place)));
        while let Some((least, place)) = open.pop() {
            // More than all the roundings of a square of a distance.
            if least * (1.0 - 1e-12) > self.best.0 {
                continue;
            }
            let first = open.len();
            let point = self.point;
            boxes.below(
                place,
                |place, aabb| open.push((square_to_box(point, &aabb), place)),
                |prim| self.consider(prim),
            );
            open[first..].sort_by(|a, b| b.0.total_cmp(&a.0));
        }
    }

    fn consider(&mut self, prim: u32) {
        let closest = match self.primitives.get(prim) {
            Primitive::Triangle(triangle) => on_triangle(self.point, triangle),
            Primitive::Sphere(sphere) => on_sphere(self.point, sphere),
            Primitive::Cone(cone) => on_cone(self.point, cone),
        };
        let square = self.point.distance_squared(closest);
        if (square, prim) < self.best {
            self.best = (square, prim);
            self.closest = closest;
        }
    }

    fn found(&self) -> Option<ClosestPoint> {
        let (square, prim) = self.best;
        let distance = square.sqrt() as f32;
        let point = self.closest.as_vec3();
        (prim != NONE).then_some(ClosestPoint { distance, point, prim })
    }
}

/// The square of the distance to a box; 0 in it.
fn square_to_box(point: DVec3, aabb: &Aabb) -> f64 {
    (0..3).fold(0.0, |square, axis| {
        let [low, high] = aabb.axes[axis].map(f64::from);
        let outside = (low - point[axis]).max(point[axis] - high).max(0.0);
        square + outside * outside
    })
}

/// The closest of the closest points of the three edges and, where it is within, the foot of the
/// perpendicular. Without area there are only the edges.
fn on_triangle(point: DVec3, triangle: &Triangle) -> DVec3 {
    let [a, b, c] = triangle.corners.map(|corner| corner.as_dvec3());
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let normal = ab.cross(ac);
    let square = normal.length_squared();
    let (v, w) = (ap.cross(ac).dot(normal) / square, ab.cross(ap).dot(normal) / square);
    let edges = [on_edge(point, a, b), on_edge(point, b, c), on_edge(point, c, a)];
    // Of numbers that are not, nothing is true.
    let within = v >= 0.0 && w >= 0.0 && v + w <= 1.0;
    let foot = within.then(|| a + ab * v + ac * w);
    let nearer = |p: DVec3, q: DVec3| {
        if point.distance_squared(q) < point.distance_squared(p) { q } else { p }
    };
    edges.into_iter().chain(foot).fold(a, nearer)
}

fn on_edge(point: DVec3, a: DVec3, b: DVec3) -> DVec3 {
    let (ab, ap) = (b - a, point - a);
    let share = ab.dot(ap) / ab.length_squared();
    // An edge without a length has one end.
    if share > 0.0 { a + ab * share.min(1.0) } else { a }
}

/// From the center all directions are as good: x.
fn on_sphere(point: DVec3, sphere: &Sphere) -> DVec3 {
    let center = sphere.center.as_dvec3();
    center + (point - center).try_normalize().unwrap_or(DVec3::X) * f64::from(sphere.radius)
}

/// In the half plane through the axis and the point, the mantle is an edge. From the axis all half
/// planes are as good.
fn on_cone(point: DVec3, cone: &Cone) -> DVec3 {
    let (axis, base) = (cone.axis(), cone.base.as_dvec3());
    let from_base = point - base;
    let along = from_base.dot(axis);
    let across = from_base - axis * along;
    let out = across.try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
    let at = |radius: f32, along: f64| DVec3::new(radius.into(), along, 0.0);
    let height = (cone.apex.as_dvec3() - base).length();
    let here = DVec3::new(across.length(), along, 0.0);
    let closest = on_edge(here, at(cone.base_radius, 0.0), at(cone.apex_radius, height));
    base + out * closest.x + axis * closest.y
}
