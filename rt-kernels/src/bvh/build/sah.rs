//! The surface area heuristic, as far as the top-down builders share it.
//!
//! A ray that meets a box meets a box within it with the probability of their surfaces' ratio. So
//! what is below a node costs, in tests of a primitive and times the node's surface, the sum of its
//! sides' surfaces, each times the primitives there. A split pays if that and the test of a node is
//! less than to test all primitives.
//!
//! Source: MacDonald and Booth, "Heuristics for Ray Tracing Using Space Subdivision", 1990.

use super::{Bounds, Content, Join, Node, Reference, Sequential};

/// The cost of testing a node, in tests of a primitive.
pub(super) const NODE_COST: f32 = 1.0;

/// Below this depth splits are by count, so that the depth is bounded by this and the logarithm of
/// the number of primitives.
pub(super) const SAH_DEPTH: usize = 64;

/// The least number of references for which the halves may go to different threads.
const PARALLEL: usize = 4096;

/// References as the heuristic sees them.
#[derive(Clone, Copy)]
pub(super) struct Side {
    /// The box around them.
    pub(super) bounds: Bounds,
    /// How many there are.
    pub(super) count: usize,
}

impl Side {
    /// None.
    #[inline(always)]
    pub(super) fn empty() -> Side {
        Side { bounds: Bounds::empty(), count: 0 }
    }

    /// All of these.
    pub(super) fn of(references: &[Reference]) -> Side {
        let mut side = Side::empty();
        for reference in references {
            side.add(reference.bounds(), 1);
        }
        side
    }

    /// Adds so many with this box around them.
    #[inline(always)]
    pub(super) fn add(&mut self, bounds: &Bounds, count: usize) {
        self.bounds = self.bounds.union(bounds);
        self.count += count;
    }

    /// The cost of testing all.
    #[inline(always)]
    pub(super) fn cost(&self) -> f32 {
        self.count as f32 * self.bounds.half_area()
    }

    /// Whether a split with that sum of costs pays.
    pub(super) fn pays(&self, split: f32) -> bool {
        split + NODE_COST * self.bounds.half_area() < self.cost()
    }

    /// The leaf of the references that begin at `first` of all.
    pub(super) fn leaf(&self, first: usize) -> Node {
        Node { aabb: self.bounds.aabb(), content: Content::Leaf(first..first + self.count) }
    }

    /// The node of all, above these two.
    pub(super) fn inner(&self, children: [Node; 2]) -> Node {
        Node { aabb: self.bounds.aabb(), content: Content::Inner(Box::new(children)) }
    }
}

/// The subtrees of so many references each, at once if there is enough to do for both.
pub(super) fn both(
    join: &impl Join,
    [left_count, right_count]: [usize; 2],
    left: impl FnOnce() -> Node + Send,
    right: impl FnOnce() -> Node + Send,
) -> [Node; 2] {
    let parallel = left_count.min(right_count) >= PARALLEL;
    let (left, right) =
        if parallel { join.join(left, right) } else { Sequential.join(left, right) };
    [left, right]
}
