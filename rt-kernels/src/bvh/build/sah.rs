//! The surface area heuristic, as far as the top-down builders share it.
//!
//! A ray that meets a box meets a box within it with the probability of their surfaces' ratio. So
//! what is below a node costs, in tests and times the node's surface, the sum of its sides' surfaces,
//! each times the tests there. A split pays if that and the test of a node is less than to test all
//! primitives.
//!
//! Where a layout tests the primitives of a leaf block by block, tests are of blocks, and what makes
//! one block is not split.
//!
//! Source: MacDonald and Booth, "Heuristics for Ray Tracing Using Space Subdivision", 1990.

use super::{Bounds, Content, Join, Node, Reference, Sequential};

/// Below this depth splits are by count, so that the depth is bounded by this and the logarithm of
/// the number of primitives.
pub(super) const SAH_DEPTH: usize = 64;

/// The least number of references for which the halves may go to different threads.
const PARALLEL: usize = 4096;

/// How many primitives are tested at once: a power of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    log2: u32,
}

impl Block {
    /// One by one.
    pub(crate) const ONE: Block = Block { log2: 0 };

    /// So many, which is a power of two.
    pub(crate) const fn of(count: usize) -> Block {
        Block { log2: count.ilog2() }
    }

    /// The cost of testing a node, in tests: a block of triangles takes longer than a node of as many
    /// children, and one ray of a packet that is tested against it makes all others wait.
    pub(super) fn node_cost(self) -> f32 {
        if self.log2 == 0 { 1.0 } else { 0.25 }
    }

    /// How often so many primitives are tested.
    #[inline(always)]
    pub(super) fn tests(self, count: usize) -> usize {
        (count + (1 << self.log2) - 1) >> self.log2
    }
}

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

    /// Both.
    pub(super) fn and(mut self, other: &Side) -> Side {
        self.add(&other.bounds, other.count);
        self
    }

    /// The cost of testing all.
    #[inline(always)]
    pub(super) fn cost(&self, block: Block) -> f32 {
        block.tests(self.count) as u32 as f32 * self.bounds.half_area()
    }

    /// Whether a split with that sum of costs pays.
    pub(super) fn pays(&self, split: f32, block: Block) -> bool {
        split + block.node_cost() * self.bounds.half_area() < self.cost(block)
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
