//! Top-down building by the [surface area heuristic](super::sah), with candidate splits at the borders
//! of bins.
//!
//! A level of the tree passes over its references twice: to fill the bins, and to partition in place,
//! which also finds by what the next level bins. Both passes are compiled for each level of instructions,
//! and go over halves of many references at once. The tree depends neither on the level nor on `join`:
//! each lane does the same operations everywhere, and how references are parted into halves, which are
//! disjoint, depends on their number alone.
//!
//! Source: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007. Deviation: all
//! three axes are binned.

use simd4::prelude::*;
use simd4::{dispatch, f32x4};

use super::sah::{Block, SAH_DEPTH, Side, both};
use super::{Bounds, Join, Node, Reference, Tree};
use crate::bvh::layout::MAX_SLOTS;
use crate::primitives::Primitives;

/// The most bins an axis.
const BINS: usize = 16;

/// The least number of references of which the halves may be passed over at once.
const PARALLEL: usize = 1 << 15;

/// From so many references on, every other one is put into bins of its own: neighbours go to the same bins,
/// and the second would wait until the first is in memory.
const APART: usize = 64;

/// From so many on, two of three are.
const FAR_APART: usize = 1024;

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
    Binned::new(block, join).tree(primitives, depth)
}

/// How it is built. No tree depends on the level or on `join`.
pub(super) struct Binned<'a, J> {
    level: Level,
    pub(super) block: Block,
    pub(super) join: &'a J,
}

impl<'a, J: Join> Binned<'a, J> {
    /// At the best level of this CPU.
    pub(super) fn new(block: Block, join: &'a J) -> Self {
        // What is wrong with the environment is told where rays are traced.
        let best = Level::best().ok().or_else(|| Level::available().next_back());
        Binned { level: best.expect("there is always one"), block, join }
    }

    /// The tree of all primitives, as if the root were at that depth.
    fn tree(&self, primitives: &Primitives, depth: usize) -> Tree {
        let mut order = Reference::all(primitives, self.join);
        let root = (!order.is_empty()).then(|| {
            let extent = self.extent(&order);
            self.subtree(&mut order, extent, 0, depth)
        });
        Tree { root, order }
    }

    /// The tree of these references, which begin at `first` of all; `depth` is that of its root.
    fn subtree(
        &self,
        references: &mut [Reference],
        extent: Extent,
        first: usize,
        depth: usize,
    ) -> Node {
        let split = if depth < SAH_DEPTH && self.block.tests(references.len()) > 1 {
            self.best_split(references, &extent.centers)
        } else {
            None
        };
        let [left, right] = match split {
            Some(split) if extent.side.pays(split.cost, self.block) => {
                self.partition(&split, references)
            }
            _ if references.len() > MAX_SLOTS => self.halve(references, &extent.centers),
            _ => return extent.side.leaf(first),
        };
        let middle = left.side.count;
        let (lefts, rights) = references.split_at_mut(middle);
        extent.side.inner(both(
            self.join,
            [lefts.len(), rights.len()],
            || self.subtree(lefts, left, first, depth + 1),
            || self.subtree(rights, right, first + middle, depth + 1),
        ))
    }

    /// Where these references are.
    pub(super) fn extent(&self, references: &[Reference]) -> Extent {
        if references.len() < PARALLEL {
            return dispatch!(self.level, s => Extent::of(s, references));
        }
        let (left, right) = references.split_at(references.len() / 2);
        let (left, right) = self.join.join(|| self.extent(left), || self.extent(right));
        Extent { side: left.side.and(&right.side), centers: left.centers.union(&right.centers) }
    }

    /// The cheapest split with something on both sides.
    pub(super) fn best_split(&self, references: &[Reference], centers: &Bounds) -> Option<Split> {
        if references.len() < 2 {
            return None;
        }
        let binning = Binning::new(centers, bins_for(references.len()));
        // To clear bins that nobody uses would take longer than to fill those of a few references.
        if binning.bins <= BINS / 2 {
            self.best_of::<{ BINS / 2 }>(&binning, references)
        } else {
            self.best_of::<BINS>(&binning, references)
        }
    }

    fn best_of<const B: usize>(
        &self,
        binning: &Binning,
        references: &[Reference],
    ) -> Option<Split> {
        if references.len() >= PARALLEL {
            let bins = self.bins::<B>(binning, references);
            return binning.cheapest(&bins, references.len(), self.block);
        }
        dispatch!(self.level, s => {
            let mut bins = no_bins::<_, B>(s);
            binning.fill(s, references, &mut bins);
            binning.cheapest(&bins, references.len(), self.block)
        })
    }

    /// What is in each bin of each axis.
    fn bins<const B: usize>(&self, binning: &Binning, references: &[Reference]) -> Bins<B> {
        if references.len() < PARALLEL {
            return dispatch!(self.level, s => {
                let mut bins = no_bins(s);
                binning.fill(s, references, &mut bins);
                bins
            });
        }
        let (left, right) = references.split_at(references.len() / 2);
        let (mut bins, more) =
            self.join.join(|| self.bins(binning, left), || self.bins(binning, right));
        merge(&mut bins, &more);
        bins
    }

    /// Puts what goes left first. Where both sides are then.
    pub(super) fn partition(&self, split: &Split, references: &mut [Reference]) -> [Extent; 2] {
        let (_, centers) = self.sort(split, references);
        [0, 1].map(|i| Extent { side: split.sides[i], centers: centers[i] })
    }

    /// Puts what goes left first. How many those are, and the boxes around the centres of both sides.
    fn sort(&self, split: &Split, references: &mut [Reference]) -> (usize, [Bounds; 2]) {
        let count = references.len();
        if count < PARALLEL {
            return dispatch!(self.level, s => split.sort(s, references));
        }
        let (first, second) = references.split_at_mut(count / 2);
        let ((before, centers), (after, more)) =
            self.join.join(|| self.sort(split, first), || self.sort(split, second));
        // What goes right of the first half changes places with what goes left of the second.
        let (wrong, right) = (&mut first[before..], &mut second[..after]);
        let moved = wrong.len().min(after);
        swap(&mut wrong[..moved], &mut right[after - moved..], self.join);
        (before + after, [0, 1].map(|i| centers[i].union(&more[i])))
    }

    /// Splits by count, along the axis on which the centres spread most.
    pub(super) fn halve(&self, references: &mut [Reference], centers: &Bounds) -> [Extent; 2] {
        let spread = centers.extent();
        let axis = (1..3).fold(0, |best, k| if spread[k] > spread[best] { k } else { best });
        let middle = references.len() / 2;
        references.select_nth_unstable_by(middle, |a, b| {
            let (a_center, b_center) = (a.center().to_array()[axis], b.center().to_array()[axis]);
            a_center.total_cmp(&b_center).then(a.prim().cmp(&b.prim()))
        });
        let (left, right) = references.split_at(middle);
        [self.extent(left), self.extent(right)]
    }
}

/// Where references are.
#[derive(Clone, Copy)]
pub(super) struct Extent {
    pub(super) side: Side,
    /// The box around twice their centres.
    pub(super) centers: Bounds,
}

impl Extent {
    #[inline(always)]
    fn of<S: Simd>(s: S, references: &[Reference]) -> Extent {
        let [mut bounds, mut centers] = [S::f32x8::splat(s, f32::INFINITY); 2];
        for reference in references {
            let lanes = reference.bounds().lanes(s);
            bounds = bounds.min(lanes);
            centers = centers.min(point::<S>(center::<S>(lanes)));
        }
        let side = Side { bounds: Bounds::new(bounds), count: references.len() };
        Extent { side, centers: Bounds::new(centers) }
    }
}

/// From centres to bins, in the lanes of the axes.
#[derive(Clone, Copy)]
struct Binning {
    origin: [f32; 4],
    scale: [f32; 4],
    bins: usize,
}

impl Binning {
    #[inline(always)]
    fn new(centers: &Bounds, bins: usize) -> Binning {
        let [origin, end] = centers.corners();
        let scale = f32x4::from(bins as f32) / (end - origin);
        Binning { origin: origin.to_array(), scale: scale.to_array(), bins }
    }

    /// Puts references into their bins.
    #[inline(always)]
    fn fill<S: Simd, const B: usize>(&self, s: S, references: &[Reference], bins: &mut Bins<B>) {
        match references.len() {
            FAR_APART.. => self.fill_apart::<S, B, 2>(s, references, bins),
            APART.. => self.fill_apart::<S, B, 1>(s, references, bins),
            _ => self.fill_apart::<S, B, 0>(s, references, bins),
        }
    }

    /// The same, where each of so many neighbours more is put into bins of its own before all are merged.
    #[inline(always)]
    fn fill_apart<S: Simd, const B: usize, const MORE: usize>(
        &self,
        s: S,
        references: &[Reference],
        bins: &mut Bins<B>,
    ) {
        let along = Along::new(s, self);
        let mut more: [Bins<B>; MORE] = [no_bins(s); MORE];
        let mut groups = references.chunks_exact(1 + MORE);
        for group in &mut groups {
            along.put(s, &group[0], bins);
            for i in 0..MORE {
                along.put(s, &group[1 + i], &mut more[i]);
            }
        }
        groups.remainder().iter().for_each(|one| along.put(s, one, bins));
        more.iter().for_each(|more| merge(bins, more));
    }

    /// The cheapest split of so many references, with something on both sides.
    #[inline(always)]
    fn cheapest<const B: usize>(
        &self,
        bins: &Bins<B>,
        count: usize,
        block: Block,
    ) -> Option<Split> {
        let used = self.bins;
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
                let both = left.count > 0 && left.count < count;
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
        Some(Split { binning: *self, axis, border, sides, cost: least })
    }
}

/// The same in registers.
struct Along<S: Simd> {
    origin: S::f32x4,
    scale: S::f32x4,
    last: S::f32x4,
}

impl<S: Simd> Along<S> {
    #[inline(always)]
    fn new(s: S, binning: &Binning) -> Self {
        let Binning { origin, scale, bins } = binning;
        let [origin, scale] = [origin, scale].map(|lanes| S::f32x4::load(s, lanes));
        Along { origin, scale, last: S::f32x4::splat(s, (bins - 1) as u32 as f32) }
    }

    /// Where twice a centre is on each axis, in bins from the first. (`max` makes 0 of NaN, which is where
    /// the least are on an axis with no extent, or with one so small that its reciprocal is infinite.)
    #[inline(always)]
    fn of(&self, s: S, center: S::f32x4) -> S::f32x4 {
        ((center - self.origin) * self.scale).max(S::f32x4::splat(s, 0.0))
    }

    /// Puts a reference into its bins.
    #[inline(always)]
    fn put<const B: usize>(&self, s: S, reference: &Reference, bins: &mut Bins<B>) {
        let lanes = reference.bounds().lanes(s);
        let along = self.of(s, center::<S>(lanes)).min(self.last);
        let [x, y, z, _] = along.to_i32_fast().to_array();
        for (bins, place) in bins.iter_mut().zip([x, y, z]) {
            let bin = &mut bins[place as usize % B];
            bin.bounds = Bounds::new(bin.bounds.lanes(s).min(lanes));
            bin.count += 1;
        }
    }
}

/// The box of one point.
#[inline(always)]
fn point<S: Simd>(point: S::f32x4) -> S::f32x8 {
    S::f32x8::concat(point, -point)
}

/// Twice the centre of a box.
#[inline(always)]
fn center<S: Simd>(lanes: S::f32x8) -> S::f32x4 {
    let (low, high) = lanes.halves();
    low - high
}

/// The bins of each axis.
type Bins<const B: usize> = [[Side; B]; 3];

/// Nothing in any. (Written by whole registers, as it is read.)
#[inline(always)]
fn no_bins<S: Simd, const B: usize>(s: S) -> Bins<B> {
    let bounds = Bounds::new(S::f32x8::splat(s, f32::INFINITY));
    [[Side { bounds, count: 0 }; B]; 3]
}

/// Adds to bins what is in others.
#[inline(always)]
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

impl Split {
    /// Puts what goes left first. How many those are, and the boxes around the centres of both sides.
    #[inline(always)]
    fn sort<S: Simd>(&self, s: S, references: &mut [Reference]) -> (usize, [Bounds; 2]) {
        let along = Along::new(s, &self.binning);
        let border = S::f32x4::splat(s, self.border as f32);
        let none = S::f32x8::splat(s, f32::INFINITY);
        let [mut lefts, mut rights] = [none; 2];
        let (axis, mut middle) = (self.axis, 0);
        for next in 0..references.len() {
            let reference = references[next];
            let center = center::<S>(reference.bounds().lanes(s));
            let left = along.of(s, center).lt(border).bitmask() >> axis & 1;
            let point = point::<S>(center);
            let other =
                S::f32x8::splat(s, if left == 1 { f32::NEG_INFINITY } else { f32::INFINITY });
            lefts = lefts.min(point.max(other));
            rights = rights.min(point.max(-other));
            // Those from `middle` on go right, so that it is right to swap in any case: a branch here
            // is one that no CPU foretells.
            references[next] = references[middle];
            references[middle] = reference;
            middle += left as usize;
        }
        (middle, [lefts, rights].map(Bounds::new))
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

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::bvh::build::{Content, Sequential};
    use crate::geom::{Aabb, Triangle};

    /// Enough for halves to be passed over by themselves; some in one plane, some in one place.
    fn scene() -> Primitives {
        let triangle = |i: usize| {
            let at = |k: usize| (Vec3::new(0.61, 1.37, 2.71) * (i * k) as f32).map(f32::sin);
            let heap = [at(1), at(2) * Vec3::new(1.0, 0.0, 1.0), Vec3::ONE * 2.0][i % 3];
            Triangle { corners: [3, 5, 7].map(|k| heap + at(k) * 0.01) }
        };
        let triangles = (0..2 * PARALLEL + 100).map(triangle).collect();
        Primitives { triangles, ..Primitives::default() }
    }

    /// All nodes, the boxes of leaves with what is in them.
    fn nodes(node: &Node, order: &[Reference], all: &mut Vec<(Aabb, Vec<u32>)>) {
        let prims = match &node.content {
            Content::Inner(children) => {
                children.iter().for_each(|child| nodes(child, order, all));
                Vec::new()
            }
            Content::Leaf(range) => order[range.clone()].iter().map(Reference::prim).collect(),
        };
        all.push((node.aabb, prims));
    }

    #[test]
    fn every_level_builds_the_same_tree() {
        let scene = scene();
        let tree = |level| {
            let Tree { root, order } =
                Binned { level, block: Block::of(8), join: &Sequential }.tree(&scene, 0);
            let mut all = Vec::new();
            nodes(&root.expect("there are primitives"), &order, &mut all);
            all
        };
        let mut levels = Level::available();
        let first = tree(levels.next().expect("scalar is always there"));
        assert!(first.len() > scene.len() / 8, "{} nodes", first.len());
        for level in levels {
            assert!(tree(level) == first, "{level}");
        }
    }

    /// Down to extents whose reciprocals are infinite and whose surfaces are 0.
    #[test]
    fn leaves_are_in_their_boxes_however_small_the_scene() {
        for exponent in [-138, -80, -60, 0, 38] {
            let mut scene = scene();
            scene.triangles.truncate(5000);
            for corner in scene.triangles.iter_mut().flat_map(|triangle| &mut triangle.corners) {
                *corner *= 2.0f32.powi(exponent);
            }
            let Tree { root, order } = build(&scene, Block::of(8), &Sequential);
            let (mut leaves, mut count) = (0, 0);
            root.expect("there are primitives").leaves(&mut |node, range| {
                leaves += 1;
                count += range.len();
                let boxes = order[range].iter().map(|one| one.bounds().aabb());
                assert_eq!(node.aabb, boxes.fold(Aabb::EMPTY, |all, one| all.union(&one)));
            });
            assert!(count == 5000 && leaves >= count / MAX_SLOTS, "{count} in {leaves}");
        }
    }

    /// By bins that are filled one reference after the other in double precision.
    #[test]
    fn a_split_is_the_cheapest_between_bins() {
        let scene = scene();
        let join = &Sequential;
        let binned = Binned::new(Block::ONE, join);
        for count in [2, 7, 40, APART + 1, FAR_APART + 2, PARALLEL + 1] {
            let references = &Reference::all(&scene, join)[..count];
            let extent = binned.extent(references);
            let split = binned.best_split(references, &extent.centers).expect("they are apart");
            let boxes: Vec<Aabb> = references.iter().map(|one| one.bounds().aabb()).collect();
            let bins = bins_for(count);
            let mut least = f64::INFINITY;
            for axis in 0..3 {
                let center = |aabb: &Aabb| aabb.axes[axis][0] + aabb.axes[axis][1];
                let low = boxes.iter().map(center).fold(f32::INFINITY, f32::min);
                let high = boxes.iter().map(center).fold(f32::NEG_INFINITY, f32::max);
                let scale = bins as f32 / (high - low);
                let bin = |aabb: &Aabb| (((center(aabb) - low) * scale) as usize).min(bins - 1);
                for border in 1..bins {
                    let side = |left: bool| {
                        let those = boxes.iter().filter(|aabb| (bin(aabb) < border) == left);
                        let whole = those.clone().fold(Aabb::EMPTY, |all, one| all.union(one));
                        let [x, y, z] = whole.extent().as_dvec3().to_array();
                        (those.count(), x * y + y * z + z * x)
                    };
                    let [(left, left_area), (right, right_area)] = [side(true), side(false)];
                    if left > 0 && right > 0 {
                        least = least.min(left as f64 * left_area + right as f64 * right_area);
                    }
                }
            }
            let cost = f64::from(split.cost);
            assert!((cost - least).abs() <= 1e-5 * least, "{count}: {cost}, not {least}");
            let mut sorted = references.to_vec();
            let sides = binned.partition(&split, &mut sorted);
            let (left, right) = sorted.split_at(sides[0].side.count);
            for (extent, side) in sides.iter().zip([left, right]) {
                let found = binned.extent(side);
                assert_eq!(extent.side.count, side.len());
                assert_eq!(extent.side.bounds.aabb(), found.side.bounds.aabb());
                assert_eq!(extent.centers.aabb(), found.centers.aabb());
            }
        }
    }
}
