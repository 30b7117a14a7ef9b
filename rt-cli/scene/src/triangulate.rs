//! Polygons to triangles: ears are cut in the plane, vertices stay where they are.
//!
//! A polygon with n corners always gives n-2 triangles. If it is simple, they cover it, turn the
//! way it does, and have an area, even where corners lie in the middle of a straight edge: such a
//! corner, left out, would be a gap between this polygon and its neighbour. If it crosses itself or
//! has no area, the triangles may overlap.
//!
//! Method: Meisters, "Polygons Have Ears", American Mathematical Monthly 82(6), 1975, with the
//! candidates in a queue. Corners that could lie in an ear are sorted by one coordinate. Newell's
//! normal says which way the polygon turns and which coordinate to drop.

use std::collections::VecDeque;
use std::ops::Range;

use glam::{DVec2, DVec3, Vec3};

use crate::diag::plural;

/// Indices of corners.
type Corners = [u32; 3];

const FAN: [Corners; 2] = [[0, 1, 2], [0, 2, 3]];
const CROSS_FAN: [Corners; 2] = [[0, 1, 3], [1, 2, 3]];

/// Comparisons spent on a polygon, for each of its corners. Only monstrous polygons need more: the
/// rest of them is cut unseen, so that time stays proportional to the file.
const EFFORT: u64 = 1 << 16;

/// Triangulates polygons one by one.
#[derive(Default)]
pub(crate) struct Triangulator {
    space: Vec<DVec3>,
    ring: Ring,
    triangles: Vec<Corners>,
    bad_polygons: u64,
}

impl Triangulator {
    /// The triangles of a polygon, as indices into its corners (three or more).
    pub(crate) fn polygon(&mut self, corners: &[Vec3]) -> &[Corners] {
        self.triangles.clear();
        if corners.len() == 3 {
            self.triangles.push([0, 1, 2]);
            return &self.triangles;
        }
        let origin = corners[0].as_dvec3();
        self.space.clear();
        self.space.extend(corners.iter().map(|corner| corner.as_dvec3() - origin));
        if corners.len() == 4 {
            self.triangles.extend(quad(&self.space));
        } else {
            self.ring.lay_out(&self.space);
            self.bad_polygons += u64::from(!self.ring.cut_ears(&mut self.triangles));
        }
        &self.triangles
    }

    /// A warning of polygons that could not be cut up neatly, if there were any.
    pub(crate) fn warning(&self) -> Option<String> {
        let polygons = plural(self.bad_polygons, "polygon");
        let what = "of no area or self-crossing: triangles may overlap";
        (self.bad_polygons > 0).then(|| format!("{polygons} {what}"))
    }
}

/// A quadrilateral along its first diagonal, or along the other if only that lies inside.
fn quad(corners: &[DVec3]) -> [Corners; 2] {
    let normal = newell(corners);
    let area = |[a, b, c]: Corners| {
        let [a, b, c] = [a, b, c].map(|corner| corners[corner as usize]);
        (b - a).cross(c - a).dot(normal)
    };
    let worse = |[first, second]: [Corners; 2]| area(first).min(area(second));
    if worse(FAN) <= 0.0 && worse(CROSS_FAN) > worse(FAN) { CROSS_FAN } else { FAN }
}

/// Twice the area times the unit normal of a polygon, plane or nearly so. Its first corner is the
/// origin.
fn newell(corners: &[DVec3]) -> DVec3 {
    corners.windows(2).map(|edge| edge[0].cross(edge[1])).sum()
}

/// A polygon in the plane that loses its ears.
#[derive(Default)]
struct Ring {
    points: Vec<DVec2>,
    previous: Vec<u32>,
    /// A corner that has been cut off comes after itself.
    next: Vec<u32>,
    /// Corners that may be ears.
    queue: VecDeque<u32>,
    /// Corners that may lie in an ear: those that were not convex at first, sorted by x.
    obstacles: Vec<u32>,
    effort: u64,
}

impl Ring {
    /// Projects a polygon to the plane, counterclockwise.
    fn lay_out(&mut self, space: &[DVec3]) {
        // Dropping a coordinate, unlike turning, rounds nothing: what is straight stays straight.
        let normal = newell(space);
        let size = normal.abs();
        let flat: fn(&DVec3) -> DVec2 = if size.z >= size.x && size.z >= size.y {
            if normal.z < 0.0 { |p| DVec2::new(p.y, p.x) } else { |p| DVec2::new(p.x, p.y) }
        } else if size.y >= size.x {
            if normal.y < 0.0 { |p| DVec2::new(p.x, p.z) } else { |p| DVec2::new(p.z, p.x) }
        } else {
            if normal.x < 0.0 { |p| DVec2::new(p.z, p.y) } else { |p| DVec2::new(p.y, p.z) }
        };
        self.points.clear();
        self.points.extend(space.iter().map(flat));
        self.put_across();

        let count = space.len() as u32;
        self.effort = EFFORT * u64::from(count);
        self.next.clear();
        self.next.extend((1..count).chain([0]));
        self.previous.clear();
        self.previous.extend([count - 1].into_iter().chain(0..count - 1));
        self.obstacles = (0..count).filter(|&corner| self.turn(corner) <= 0.0).collect();
        let x = |corner: &u32| self.points[*corner as usize].x;
        self.obstacles.sort_by(|a, b| x(a).total_cmp(&x(b)));
    }

    /// Turns the polygon by a right angle if that makes its edges shorter in x, the coordinate by
    /// which obstacles are looked up.
    fn put_across(&mut self) {
        let zero = (DVec2::ZERO, DVec2::ZERO, DVec2::ZERO);
        let (low, high, edges) = self.points.windows(2).fold(zero, |(low, high, edges), edge| {
            (low.min(edge[1]), high.max(edge[1]), edges + (edge[1] - edge[0]).abs())
        });
        let extent = high - low;
        if edges.x * extent.y > edges.y * extent.x {
            self.points.iter_mut().for_each(|point| *point = point.perp());
        }
    }

    /// Cuts ears until nothing is left. Says whether it was always an ear that was cut.
    fn cut_ears(&mut self, triangles: &mut Vec<Corners>) -> bool {
        let count = self.points.len();
        self.queue.clear();
        self.queue.extend(0..count as u32);
        let (mut neat, mut progress) = (true, true);
        while triangles.len() < count - 3 {
            let corner = match self.queue.pop_front() {
                Some(corner) if self.is_ear(corner) => corner,
                Some(_) => continue,
                None if progress => {
                    self.queue = (0..count as u32).filter(|&corner| self.is_left(corner)).collect();
                    progress = false;
                    continue;
                }
                None => {
                    neat = false;
                    self.least_bad(triangles)
                }
            };
            progress = self.effort > 0;
            triangles.push(self.cut(corner));
        }
        let last = (0..count as u32).find(|&corner| self.is_left(corner)).unwrap_or_default();
        triangles.push(self.triangle(last));
        neat && self.turn(last) > 0.0 && self.effort > 0
    }

    /// Takes a corner out of the ring; it may make ears of its neighbours.
    fn cut(&mut self, corner: u32) -> Corners {
        let triangle @ [previous, _, next] = self.triangle(corner);
        self.next[previous as usize] = next;
        self.previous[next as usize] = previous;
        self.next[corner as usize] = corner;
        self.queue.extend([previous, next]);
        triangle
    }

    /// Whether a corner is convex and its triangle holds no other corner.
    fn is_ear(&mut self, corner: u32) -> bool {
        if !self.is_left(corner) || self.turn(corner) <= 0.0 {
            return false;
        }
        let [a, b, c] = self.triangle(corner).map(|corner| self.point(corner));
        let holds = |p: DVec2| {
            let inside = cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0;
            inside && p != a && p != b && p != c
        };
        let near = self.obstacles_between(a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
        let cost = near.len() as u64 + 1;
        self.effort = self.effort.saturating_sub(cost);
        self.effort == 0
            || !self.obstacles[near].iter().any(|&o| self.is_left(o) && holds(self.point(o)))
    }

    fn obstacles_between(&self, low: f64, high: f64) -> Range<usize> {
        let start = self.obstacles.partition_point(|&o| self.point(o).x < low);
        start..self.obstacles.partition_point(|&o| self.point(o).x <= high)
    }

    /// Where there is no ear: the corner whose triangle is smallest, or any, if time is short.
    fn least_bad(&mut self, triangles: &[Corners]) -> u32 {
        let count = self.points.len() as u32;
        if self.effort == 0 {
            return triangles.last().map_or(0, |&[_, _, next]| next);
        }
        self.effort = self.effort.saturating_sub(count.into());
        let size = |corner: u32| self.turn(corner).abs();
        let left = (0..count).filter(|&corner| self.is_left(corner));
        left.min_by(|&a, &b| size(a).total_cmp(&size(b))).unwrap_or_default()
    }

    fn point(&self, corner: u32) -> DVec2 {
        self.points[corner as usize]
    }

    fn is_left(&self, corner: u32) -> bool {
        self.next[corner as usize] != corner
    }

    fn triangle(&self, corner: u32) -> Corners {
        [self.previous[corner as usize], corner, self.next[corner as usize]]
    }

    /// Positive where the ring is convex.
    fn turn(&self, corner: u32) -> f64 {
        let [a, b, c] = self.triangle(corner).map(|corner| self.point(corner));
        cross(a, b, c)
    }
}

/// Twice the signed area of a triangle.
fn cross(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}
