//! Top-down building by the [surface area heuristic](super::sah), with candidate splits between all
//! neighbours in the order of their centres, on all three axes.
//!
//! References are sorted once an axis; a split keeps the order on both of its sides. So all takes
//! O(n log n). Of equal centres the lowest primitive comes first: the order is total, and the tree
//! depends neither on the sort nor on `join`.
//!
//! Source of sorting once: Wald and Havran, "On Building Fast kd-Trees for Ray Tracing, and on Doing
//! That in O(N log N)", 2006.

use std::cmp::Ordering;

use simd4::prelude::*;

use super::sah::{Block, SAH_DEPTH, Side, both};
use super::{Join, Node, Reference, Tree};
use crate::bvh::layout::MAX_SLOTS;
use crate::primitives::Primitives;

/// Builds the tree of all primitives.
pub(crate) fn build(primitives: &Primitives, block: Block, join: &impl Join) -> Tree {
    build_from(primitives, block, 0, join)
}

/// As [`build`], as if the root were at that depth.
pub(super) fn build_from(
    primitives: &Primitives,
    block: Block,
    depth: usize,
    join: &impl Join,
) -> Tree {
    let all = Reference::all(primitives, join);
    let sorted = |axis| {
        let mut sorted = all.clone();
        sorted.sort_unstable_by(|a, b| compare(a, b, axis));
        sorted
    };
    let (mut x, (mut y, mut z)) = join.join(|| sorted(0), || join.join(|| sorted(1), || sorted(2)));
    let mut spare = all;
    let sweep = Sweep { sorted: [&mut x, &mut y, &mut z], spare: &mut spare };
    let root = (!sweep.spare.is_empty()).then(|| sweep.subtree(0, block, depth, join));
    Tree { root, order: x }
}

/// By the centre on that axis, then by number.
fn compare(a: &Reference, b: &Reference, axis: usize) -> Ordering {
    let [a_center, b_center] = [a, b].map(|reference| reference.center().to_array()[axis]);
    a_center.total_cmp(&b_center).then(a.prim().cmp(&b.prim()))
}

/// The same references three times, in the order of each axis, and room for as many.
struct Sweep<'a> {
    sorted: [&'a mut [Reference]; 3],
    spare: &'a mut [Reference],
}

/// A split: what comes before the reference at `middle` in the order of `axis` goes left.
struct Split {
    axis: usize,
    middle: usize,
    cost: f32,
}

impl Sweep<'_> {
    /// The tree of these references, which begin at `first` of all; `depth` is that of its root.
    fn subtree(mut self, first: usize, block: Block, depth: usize, join: &impl Join) -> Node {
        let whole = Side::of(self.sorted[0]);
        let split = if depth < SAH_DEPTH && block.tests(whole.count) > 1 {
            self.best_split(block)
        } else {
            None
        };
        let (axis, middle) = match split {
            Some(split) if whole.pays(split.cost, block) => (split.axis, split.middle),
            _ if whole.count > MAX_SLOTS => (self.widest_axis(), whole.count / 2),
            _ => return whole.leaf(first),
        };
        self.partition(axis, middle);
        let (left, right) = self.split_at(middle);
        whole.inner(both(
            join,
            [middle, whole.count - middle],
            || left.subtree(first, block, depth + 1, join),
            || right.subtree(first + middle, block, depth + 1, join),
        ))
    }

    /// The cheapest split; of equal ones the first, axis by axis.
    fn best_split(&self, block: Block) -> Option<Split> {
        let count = self.spare.len();
        let mut best: Option<Split> = None;
        let mut right_costs = vec![0.0; count];
        for (axis, sorted) in self.sorted.iter().enumerate() {
            let mut right = Side::empty();
            for (reference, cost) in sorted.iter().zip(&mut right_costs).rev() {
                right.add(reference.bounds(), 1);
                *cost = right.cost(block);
            }
            let mut left = Side::empty();
            for middle in 1..count {
                left.add(sorted[middle - 1].bounds(), 1);
                let cost = left.cost(block) + right_costs[middle];
                if best.as_ref().is_none_or(|best| cost < best.cost) {
                    best = Some(Split { axis, middle, cost });
                }
            }
        }
        best
    }

    /// The axis along which the centres spread most.
    fn widest_axis(&self) -> usize {
        let spread = |axis: usize| {
            let at = |i: usize| self.sorted[axis][i].center().to_array()[axis];
            at(self.spare.len() - 1) - at(0)
        };
        (1..3).fold(0, |best, axis| if spread(axis) > spread(best) { axis } else { best })
    }

    /// Puts what goes left first, in the orders of all axes.
    fn partition(&mut self, axis: usize, middle: usize) {
        let border = self.sorted[axis][middle];
        for (other, sorted) in self.sorted.iter_mut().enumerate() {
            if other == axis {
                continue;
            }
            let (mut left, mut right) = (0, 0);
            for i in 0..sorted.len() {
                let reference = sorted[i];
                if compare(&reference, &border, axis).is_lt() {
                    sorted[left] = reference;
                    left += 1;
                } else {
                    self.spare[right] = reference;
                    right += 1;
                }
            }
            sorted[left..].copy_from_slice(&self.spare[..right]);
        }
    }
}

impl<'a> Sweep<'a> {
    fn split_at(self, middle: usize) -> (Sweep<'a>, Sweep<'a>) {
        let [x, y, z] = self.sorted.map(|sorted| sorted.split_at_mut(middle));
        let spare = self.spare.split_at_mut(middle);
        (
            Sweep { sorted: [x.0, y.0, z.0], spare: spare.0 },
            Sweep { sorted: [x.1, y.1, z.1], spare: spare.1 },
        )
    }
}
