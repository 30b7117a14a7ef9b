//! Top-down building by the [surface area heuristic](super::sah), with candidate splits at the borders
//! of bins.
//!
//! A level of the tree passes over its references twice: to fill the bins, and to partition in place,
//! which also finds by what the next level bins. Both passes go over halves of many references at
//! once. The tree does not depend on `join`: least and greatest coordinates do not depend on the
//! order, and halves are disjoint.
//!
//! Source: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007. Deviation: all
//! three axes are binned.

use simd4::f32x4;
use simd4::prelude::*;

use super::sah::{Block, SAH_DEPTH, Side, both};
use super::{Bounds, Join, Node, Reference, Tree};
use crate::bvh::layout::MAX_SLOTS;
use crate::primitives::Primitives;

/// The most bins an axis.
const BINS: usize = 16;

/// The least number of references of which the halves may be passed over at once.
const PARALLEL: usize = 1 << 15;

/// From so many references on, every other one has bins of its own: neighbours go to the same bins, and
/// the second would wait until the first is in memory.
const APART: usize = 64;

/// The bins an axis for so many references. Among few, more borders find nothing much cheaper, and to
/// look through the bins would take longer than to fill them.
fn bins_for(references: usize) -> usize {
    BINS.min(4 + references / 4)
}

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
    let mut order: Vec<Reference> = Reference::all(primitives).collect();
    let root = (!order.is_empty()).then(|| {
        let extent = Extent::of(&order);
        subtree(&mut order, extent, 0, block, depth, join)
    });
    Tree { root, order }
}

/// The tree of these references, which begin at `first` of all; `depth` is that of its root.
fn subtree(
    references: &mut [Reference],
    extent: Extent,
    first: usize,
    block: Block,
    depth: usize,
    join: &impl Join,
) -> Node {
    let split = if depth < SAH_DEPTH && block.tests(references.len()) > 1 {
        best_split(references, &extent.centers, block, join)
    } else {
        None
    };
    let [left, right] = match split {
        Some(split) if extent.side.pays(split.cost, block) => split.partition(references, join),
        _ if references.len() > MAX_SLOTS => halve(references, &extent.centers),
        _ => return extent.side.leaf(first),
    };
    let middle = left.side.count;
    let (lefts, rights) = references.split_at_mut(middle);
    extent.side.inner(both(
        join,
        [lefts.len(), rights.len()],
        || subtree(lefts, left, first, block, depth + 1, join),
        || subtree(rights, right, first + middle, block, depth + 1, join),
    ))
}

/// Where references are.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    pub(super) side: Side,
    /// The box around twice their centres.
    pub(super) centers: Bounds,
}

impl Extent {
    pub(super) fn of(references: &[Reference]) -> Extent {
        let mut centers = Bounds::empty();
        for reference in references {
            centers = centers.union(&Bounds::point(reference.center()));
        }
        Extent { side: Side::of(references), centers }
    }
}

/// From centres to bins, in the lanes of the axes.
#[derive(Clone, Copy)]
struct Binning {
    origin: f32x4,
    scale: f32x4,
    bins: usize,
}

impl Binning {
    #[inline(always)]
    fn new(centers: &Bounds, bins: usize) -> Binning {
        let [origin, end] = centers.corners();
        Binning { origin, scale: f32x4::from(bins as f32) / (end - origin), bins }
    }

    /// Where a reference is on each axis, in bins from the first. (`max` makes 0 of the NaN of an axis
    /// without extent.)
    #[inline(always)]
    fn along(&self, reference: &Reference) -> f32x4 {
        let along = (reference.center() - self.origin) * self.scale;
        along.max(f32x4::from(0.0)).min(f32x4::from((self.bins - 1) as f32))
    }

    /// The bins of a reference on all axes.
    #[inline(always)]
    fn bins(&self, reference: &Reference) -> [usize; 3] {
        let [x, y, z, _] = self.along(reference).to_i32_fast().to_array();
        [x as usize, y as usize, z as usize]
    }

    /// What is in each bin of each axis.
    fn fill<const B: usize>(&self, references: &[Reference], join: &impl Join) -> Bins<B> {
        if references.len() >= PARALLEL {
            let (left, right) = references.split_at(references.len() / 2);
            let (mut bins, more) =
                join.join(|| self.fill::<B>(left, join), || self.fill::<B>(right, join));
            merge(&mut bins, &more);
            return bins;
        }
        let (pairs, others) = match references.len() {
            APART.. => references.as_chunks(),
            _ => (&[][..], references),
        };
        let mut bins = [[Side::empty(); B]; 3];
        others.iter().for_each(|reference| self.put(reference, &mut bins));
        if !pairs.is_empty() {
            let mut more = [[Side::empty(); B]; 3];
            for [one, next] in pairs {
                self.put(one, &mut bins);
                self.put(next, &mut more);
            }
            merge(&mut bins, &more);
        }
        bins
    }

    /// Puts a reference into its bins.
    #[inline(always)]
    fn put<const B: usize>(&self, reference: &Reference, bins: &mut Bins<B>) {
        for (bins, place) in bins.iter_mut().zip(self.bins(reference)) {
            bins[place].add(reference.bounds(), 1);
        }
    }
}

/// The bins of each axis.
type Bins<const B: usize> = [[Side; B]; 3];

/// Adds to bins what is in others.
fn merge<const B: usize>(bins: &mut Bins<B>, more: &Bins<B>) {
    for (bin, more) in bins.as_flattened_mut().iter_mut().zip(more.as_flattened()) {
        bin.add(&more.bounds, more.count);
    }
}

/// A split between two bins.
pub(super) struct Split {
    binning: Binning,
    axis: usize,
    /// The first bin that goes right.
    border: usize,
    /// What goes left, and what right.
    pub(super) sides: [Side; 2],
    /// The sum of the sides' costs.
    pub(super) cost: f32,
}

/// The cheapest split with something on both sides.
pub(super) fn best_split(
    references: &[Reference],
    centers: &Bounds,
    block: Block,
    join: &impl Join,
) -> Option<Split> {
    // To clear bins that nobody uses would take longer than to fill those of a few references.
    let used = bins_for(references.len());
    if used <= BINS / 2 {
        best_of::<{ BINS / 2 }>(references, centers, used, block, join)
    } else {
        best_of::<BINS>(references, centers, used, block, join)
    }
}

/// The cheapest of the splits between so many bins, at most `B`.
fn best_of<const B: usize>(
    references: &[Reference],
    centers: &Bounds,
    used: usize,
    block: Block,
    join: &impl Join,
) -> Option<Split> {
    if references.len() < 2 {
        return None;
    }
    let binning = Binning::new(centers, used);
    let bins = binning.fill::<B>(references, join);
    let mut best = None;
    let mut least = f32::INFINITY;
    for (axis, bins) in bins.iter().enumerate() {
        let bins = &bins[..used];
        let mut right_costs = [0.0; B];
        let mut right = Side::empty();
        for (bin, cost) in bins.iter().zip(&mut right_costs[..used]).skip(1).rev() {
            right.add(&bin.bounds, bin.count);
            *cost = right.cost(block);
        }
        let mut left = Side::empty();
        for border in 1..used {
            left.add(&bins[border - 1].bounds, bins[border - 1].count);
            let cost = left.cost(block) + right_costs[border];
            let both = left.count > 0 && left.count < references.len();
            if both && cost < least {
                (best, least) = (Some((axis, border)), cost);
            }
        }
    }
    let (axis, border) = best?;
    let mut sides = [Side::empty(); 2];
    for (place, bin) in bins[axis][..used].iter().enumerate() {
        sides[usize::from(place >= border)].add(&bin.bounds, bin.count);
    }
    Some(Split { binning, axis, border, sides, cost: least })
}

impl Split {
    /// Puts what goes left first. Where both sides are then.
    pub(super) fn partition(&self, references: &mut [Reference], join: &impl Join) -> [Extent; 2] {
        let (_, centers) = self.sort(references, join);
        [0, 1].map(|i| Extent { side: self.sides[i], centers: centers[i] })
    }

    /// Puts what goes left first. How many those are, and the boxes around the centres of both sides.
    fn sort(&self, references: &mut [Reference], join: &impl Join) -> (usize, [Bounds; 2]) {
        let count = references.len();
        if count >= PARALLEL {
            let (first, second) = references.split_at_mut(count / 2);
            let ((before, centers), (after, more)) =
                join.join(|| self.sort(first, join), || self.sort(second, join));
            // What goes right of the first half changes places with what goes left of the second.
            let (wrong, right) = (&mut first[before..], &mut second[..after]);
            let moved = wrong.len().min(after);
            swap(&mut wrong[..moved], &mut right[after - moved..], join);
            return (before + after, [0, 1].map(|i| centers[i].union(&more[i])));
        }
        let border = f32x4::from(self.border as f32);
        let mut centers = [Bounds::empty(); 2];
        let mut middle = 0;
        for next in 0..count {
            let reference = references[next];
            let left = self.binning.along(&reference).lt(border).bitmask() >> self.axis & 1;
            let side = &mut centers[1 - left as usize];
            *side = side.union(&Bounds::point(reference.center()));
            // Those from `middle` on go right, so that it is right to swap in any case: a branch here
            // is one that no CPU foretells.
            references.swap(next, middle);
            middle += left as usize;
        }
        (middle, centers)
    }
}

/// Swaps as many references for as many.
fn swap(a: &mut [Reference], b: &mut [Reference], join: &impl Join) {
    if a.len() < PARALLEL {
        return a.swap_with_slice(b);
    }
    let middle = a.len() / 2;
    let ((a, more_a), (b, more_b)) = (a.split_at_mut(middle), b.split_at_mut(middle));
    join.join(|| swap(a, b, join), || swap(more_a, more_b, join));
}

/// Splits by count, along the axis on which the centres spread most.
pub(super) fn halve(references: &mut [Reference], centers: &Bounds) -> [Extent; 2] {
    let spread = centers.extent();
    let axis = (1..3).fold(0, |best, k| if spread[k] > spread[best] { k } else { best });
    let middle = references.len() / 2;
    references.select_nth_unstable_by(middle, |a, b| {
        let (a_center, b_center) = (a.center().to_array()[axis], b.center().to_array()[axis]);
        a_center.total_cmp(&b_center).then(a.prim().cmp(&b.prim()))
    });
    let (left, right) = references.split_at(middle);
    [Extent::of(left), Extent::of(right)]
}
