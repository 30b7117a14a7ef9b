//! What builders work on: the part of a primitive that a cell has, as a box.

use glam::DVec3;

use crate::geom::{Aabb, Triangle};
use crate::kd::{REACH, THICKNESS};
use crate::primitives::Primitives;
use crate::tri::Method;

/// A box around the part of a primitive within a cell, and nothing outside of the cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) bounds: Aabb,
    pub(super) prim: u32,
}

/// Cuts primitives to cells: what the [argument](crate::kd#why-the-answer-is-one) lets be cut.
pub(super) struct Cutter<'a> {
    primitives: &'a Primitives,
    /// Whether hits lie in the planes of their triangles.
    planes: bool,
}

impl<'a> Cutter<'a> {
    pub(super) fn new(primitives: &'a Primitives, method: Method) -> Cutter<'a> {
        Cutter { primitives, planes: method == Method::Watertight }
    }

    /// All primitives, whole.
    pub(super) fn pieces(&self) -> Vec<Piece> {
        let boxes = self.primitives.own_boxes().zip(0..);
        boxes.map(|(bounds, prim)| Piece { bounds, prim }).collect()
    }

    /// The part of a piece within a slab of the same cell; `None` if there is nothing.
    pub(super) fn within(&self, piece: &Piece, axis: usize, slab: [f32; 2]) -> Option<Piece> {
        let mut cut = *piece;
        let [low, high] = &mut cut.bounds.axes[axis];
        (*low, *high) = (low.max(slab[0]), high.min(slab[1]));
        if let Some(triangle) = self.primitives.triangles.get(piece.prim as usize)
            && self.planes
            && let Some(plane) = Plane::of(triangle)
        {
            cut.bounds = plane.section(&cut.bounds)?;
        }
        Some(cut)
    }
}

/// All points no farther than `reach` from a triangle's plane, measured by n · x.
struct Plane {
    through: DVec3,
    normal: DVec3,
    reach: f64,
}

impl Plane {
    /// `None` for a triangle that is too thin to have a plane.
    fn of(triangle: &Triangle) -> Option<Plane> {
        let [a, b, c] = triangle.corners.map(|corner| corner.as_dvec3());
        let normal = (b - a).cross(c - a);
        let extent = a.max(b).max(c) - a.min(b).min(c);
        let longest =
            [b - a, c - b, a - c].map(DVec3::length_squared).into_iter().fold(0.0, f64::max);
        // The least height is |n| / longest.
        let thin = normal.length_squared() * REACH * REACH < longest * extent.length_squared();
        let pad = extent.max_element() * THICKNESS;
        let reach = pad * normal.abs().element_sum();
        (!thin && reach > 0.0).then_some(Plane { through: a, normal, reach })
    }

    /// The smallest box around the part of a box within reach, rounded outwards.
    ///
    /// For each axis: wherever on the two others, n · x is between bounds that add up, and what it
    /// lacks of ± reach the third has to make up for.
    fn section(&self, whole: &Aabb) -> Option<Aabb> {
        let mut part = *whole;
        let terms = [0, 1, 2].map(|k| {
            let [a, b] = whole.axes[k].map(|x| self.normal[k] * (f64::from(x) - self.through[k]));
            [a.min(b), a.max(b)]
        });
        for (k, [min, max]) in part.axes.iter_mut().enumerate() {
            let (n, through) = (self.normal[k], self.through[k]);
            if n == 0.0 {
                continue;
            }
            let [a, b] = [terms[(k + 1) % 3], terms[(k + 2) % 3]];
            let ends = [(-self.reach - a[1] - b[1]) / n, (self.reach - a[0] - b[0]) / n];
            *min = min.max(((ends[0].min(ends[1]) + through) as f32).next_down());
            *max = max.min(((ends[0].max(ends[1]) + through) as f32).next_up());
            if *min > *max {
                return None;
            }
        }
        Some(part)
    }
}
