//! Top-down building by the surface area heuristic, with candidate splits at the borders of bins.
//!
//! The tree does not depend on `join`: both halves of a split work on disjoint references. Source:
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007. Deviation: all three
//! axes are binned.

use super::{Content, Join, Node, Reference, Sequential, Tree};
use crate::bvh::layout::MAX_SLOTS;
use crate::geom::Aabb;
use crate::primitives::Primitives;

/// Bins an axis.
const BINS: usize = 16;

/// The cost of testing a node, in tests of a primitive.
const NODE_COST: f32 = 1.0;

/// Below this depth splits are by count, so that the depth is bounded by this and the logarithm of
/// the number of primitives.
const SAH_DEPTH: usize = 64;

/// The least number of references for which the halves may go to different threads.
const PARALLEL: usize = 4096;

/// Builds the tree of all primitives.
pub(crate) fn build(primitives: &Primitives, join: &impl Join) -> Tree {
    let mut order: Vec<Reference> =
        primitives.own_boxes().zip(0..).map(|(aabb, prim)| Reference { aabb, prim }).collect();
    let root = (!order.is_empty()).then(|| subtree(&mut order, 0, 0, join));
    Tree { root, order }
}

/// The tree of these references, which begin at `first` of all; `depth` is that of its root.
fn subtree(references: &mut [Reference], first: usize, depth: usize, join: &impl Join) -> Node {
    let aabb = references.iter().fold(Aabb::EMPTY, |all, one| all.union(&one.aabb));
    let split = if depth < SAH_DEPTH { best_split(references) } else { None };
    let leaf_cost = references.len() as f32 * aabb.half_area();
    let middle = match split {
        Some(split) if split.cost + NODE_COST * aabb.half_area() < leaf_cost => {
            partition(references, |reference| split.is_left(reference))
        }
        _ if references.len() > MAX_SLOTS => halve(references),
        _ => {
            let content = Content::Leaf(first..first + references.len());
            return Node { aabb, content };
        }
    };

    let (left, right) = references.split_at_mut(middle);
    let parallel = left.len().min(right.len()) >= PARALLEL;
    let left = || subtree(left, first, depth + 1, join);
    let right = || subtree(right, first + middle, depth + 1, join);
    let (left, right) =
        if parallel { join.join(left, right) } else { Sequential.join(left, right) };
    Node { aabb, content: Content::Inner(Box::new([left, right])) }
}

/// Twice the centre of a box.
fn center(aabb: &Aabb) -> [f32; 3] {
    aabb.axes.map(|[min, max]| min + max)
}

/// From centres to bins, on all axes.
#[derive(Clone, Copy)]
struct Binning {
    origin: [f32; 3],
    scale: [f32; 3],
}

impl Binning {
    fn new(references: &[Reference]) -> Binning {
        let centers = references.iter().fold(Aabb::EMPTY, |all, one| {
            let center = center(&one.aabb);
            all.union(&Aabb { axes: center.map(|center| [center, center]) })
        });
        Binning {
            origin: centers.axes.map(|[min, _]| min),
            scale: centers.axes.map(|[min, max]| BINS as f32 / (max - min)),
        }
    }

    /// The bin of a reference on one axis. (`as` makes 0 of the NaN of an axis without extent.)
    fn bin(&self, reference: &Reference, axis: usize) -> usize {
        let [min, max] = reference.aabb.axes[axis];
        let along = (min + max - self.origin[axis]) * self.scale[axis];
        (along as usize).min(BINS - 1)
    }
}

/// What is in a bin, or in several.
#[derive(Clone, Copy)]
struct Bin {
    aabb: Aabb,
    count: usize,
}

impl Bin {
    const EMPTY: Bin = Bin { aabb: Aabb::EMPTY, count: 0 };

    fn add(&mut self, aabb: &Aabb, count: usize) {
        self.aabb = self.aabb.union(aabb);
        self.count += count;
    }

    /// The expected number of primitive tests, times the area of the parent.
    fn cost(&self) -> f32 {
        self.count as f32 * self.aabb.half_area()
    }
}

/// A split between two bins: `bins..` go right.
struct Split {
    binning: Binning,
    axis: usize,
    bins: usize,
    cost: f32,
}

impl Split {
    fn is_left(&self, reference: &Reference) -> bool {
        self.binning.bin(reference, self.axis) < self.bins
    }
}

/// The cheapest split with something on both sides.
fn best_split(references: &[Reference]) -> Option<Split> {
    let binning = Binning::new(references);
    let mut bins = [[Bin::EMPTY; BINS]; 3];
    for reference in references {
        for (axis, bins) in bins.iter_mut().enumerate() {
            bins[binning.bin(reference, axis)].add(&reference.aabb, 1);
        }
    }

    let mut best: Option<Split> = None;
    for (axis, bins) in bins.iter().enumerate() {
        let mut right_costs = [0.0; BINS];
        let mut right = Bin::EMPTY;
        for i in (1..BINS).rev() {
            right.add(&bins[i].aabb, bins[i].count);
            right_costs[i] = right.cost();
        }
        let mut left = Bin::EMPTY;
        for i in 1..BINS {
            left.add(&bins[i - 1].aabb, bins[i - 1].count);
            let cost = left.cost() + right_costs[i];
            let both = left.count > 0 && left.count < references.len();
            if both && best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(Split { binning, axis, bins: i, cost });
            }
        }
    }
    best
}

/// Puts those for which `left` holds first, and returns their number.
fn partition(references: &mut [Reference], left: impl Fn(&Reference) -> bool) -> usize {
    let mut middle = 0;
    for i in 0..references.len() {
        if left(&references[i]) {
            references.swap(i, middle);
            middle += 1;
        }
    }
    middle
}

/// Splits by count, along the axis on which the centres spread most.
fn halve(references: &mut [Reference]) -> usize {
    let binning = Binning::new(references);
    let axis =
        (0..3).fold(0, |best, k| if binning.scale[k] < binning.scale[best] { k } else { best });
    let middle = references.len() / 2;
    references.select_nth_unstable_by(middle, |a, b| {
        let (a_center, b_center) = (center(&a.aabb)[axis], center(&b.aabb)[axis]);
        a_center.total_cmp(&b_center).then(a.prim.cmp(&b.prim))
    });
    middle
}
