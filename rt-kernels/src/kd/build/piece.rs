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
        let n = self.normal.to_array();
        let mut relative = [[0.0; 2]; 3];
        for (axis, side) in relative.iter_mut().enumerate() {
            *side = whole.axes[axis].map(|x| f64::from(x) - self.through[axis]);
        }
        let mut part = *whole;
        let terms = [0, 1, 2].map(|k| {
            let [a, b] = relative[k].map(|x| n[k] * x);
            [a.min(b), a.max(b)]
        });
        for k in 0..3 {
            if n[k] == 0.0 {
                continue;
            }
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let ends = [
                (-self.reach - terms[i][1] - terms[j][1]) / n[k],
                (self.reach - terms[i][0] - terms[j][0]) / n[k],
            ];
            let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            let [min, max] = &mut part.axes[k];
            *min = min.max(((low + self.through[k]) as f32).next_down());
            *max = max.min(((high + self.through[k]) as f32).next_up());
            if *min > *max {
                return None;
            }
        }
        Some(part)
    }
}
