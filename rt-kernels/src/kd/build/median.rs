//! The middle of the longest axis: the simplest rule.
//!
//! A cell of few pieces is a leaf. Source: Sung and Shirley, "Ray Tracing with the BSP Tree", Graphics
//! Gems III, 1992, which Wald et al. 2001 refer to; they do not say how they split. Deviation: the
//! axis is the longest and not the next.

use super::piece::{Cutter, Piece};
use super::sah::Split;
use super::{Rule, count, share_out};
use crate::geom::Aabb;

/// The most pieces that are not split.
const FEW: usize = 3;

pub(super) struct Middle(Vec<Piece>);

impl Rule for Middle {
    fn new(pieces: Vec<Piece>) -> Self {
        Middle(pieces)
    }

    fn pieces(&self) -> &[Piece] {
        &self.0
    }

    fn best(&self, cell: &Aabb) -> Option<Split> {
        let extent = cell.extent();
        let axis = extent.max_position();
        let [low, high] = cell.axes[axis];
        let at = low + extent[axis] * 0.5;
        if self.0.len() <= FEW || !(at > low && at < high) {
            return None;
        }
        let counts = count(&self.0, axis, at);
        Some(Split { axis, at, flat_low: false, counts, cost: 0.0 })
    }

    fn split(self, split: &Split, cutter: &Cutter<'_>) -> [Self; 2] {
        share_out(&self.0, split, cutter).map(Middle)
    }
}
