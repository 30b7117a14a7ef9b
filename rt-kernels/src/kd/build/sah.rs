//! The surface area heuristic of cells.
//!
//! Of the rays that meet a cell, those that meet a part of it are as many as the part's surface is of
//! the cell's. A split pays if to test a node, and on each side its pieces by that share, costs less
//! than to test all pieces. Empty space is worth a fifth of the cost.
//!
//! Source: MacDonald and Booth 1990; Wald and Havran, "On building fast kd-Trees for Ray Tracing, and
//! on doing that in O(N log N)", 2006, Section 3.

use crate::geom::Aabb;

/// The cost of a node, in tests of a primitive.
const NODE_COST: f32 = 1.0;

/// What remains of a split's cost where one side is empty.
const EMPTY: f32 = 0.8;

/// A plane across an axis that splits a cell in two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    pub(super) axis: usize,
    pub(super) at: f32,
    /// Whether pieces that are flat and lie in the plane go to the lower side.
    pub(super) flat_low: bool,
    /// How many pieces both sides have.
    pub(super) counts: [usize; 2],
    /// In tests of a primitive.
    pub(super) cost: f32,
}

/// The costs of splits of a cell across an axis.
pub(super) struct Costs {
    axis: usize,
    low: f32,
    high: f32,
    /// Half the surface is that of an end, and that of the sides for each unit of length.
    end: f32,
    side: f32,
    whole: f32,
}

impl Costs {
    /// `None` if there is nothing to split.
    pub(super) fn new(cell: &Aabb, axis: usize) -> Option<Costs> {
        let [a, b] = [1, 2].map(|i| {
            let [low, high] = cell.axes[(axis + i) % 3];
            high - low
        });
        let [low, high] = cell.axes[axis];
        let (end, side) = (a * b, a + b);
        let whole = end + (high - low) * side;
        (whole > 0.0).then_some(Costs { axis, low, high, end, side, whole })
    }

    /// Replaces the best split by that at `at` with so many pieces below, above, and flat within the
    /// plane, if that is cheaper.
    #[inline(always)]
    pub(super) fn offer(
        &self,
        best: &mut Option<Split>,
        at: f32,
        low: usize,
        high: usize,
        flat: usize,
    ) {
        if !(at > self.low && at < self.high) {
            return;
        }
        let below = self.end + (at - self.low) * self.side;
        let above = self.end + (self.high - at) * self.side;
        let flat_low = flat > 0 && below < above;
        let counts = if flat_low { [low + flat, high] } else { [low, high + flat] };
        let tests = (below * counts[0] as f32 + above * counts[1] as f32) / self.whole;
        let part = if counts.contains(&0) { EMPTY } else { 1.0 };
        let cost = part * (NODE_COST + tests);
        if best.as_ref().is_none_or(|best| cost < best.cost) {
            *best = Some(Split { axis: self.axis, at, flat_low, counts, cost });
        }
    }
}

/// Whether a split is cheaper than to test all these pieces.
pub(super) fn pays(split: &Split, pieces: usize) -> bool {
    split.cost < pieces as f32
}
