//! Top-down building with spatial splits: where a plane through a box beats every way to share the
//! references out, those it passes through are cut in two.
//!
//! A split of references ([`binned_sah`](super::binned_sah)) is compared with planes at the borders of bins, if the boxes
//! of its sides overlap by more than 10^-5 of the root's surface. A reference that straddles the plane
//! goes to both sides with a piece of its box, or whole to one where that is cheaper. References grow
//! by no more than three tenths of the primitives; what may be added is shared out among subtrees in
//! proportion to their references, so the tree does not depend on `join`.
//!
//! # Why pieces are enough
//!
//! The crate's [argument](crate#why-the-answer-is-one) wants own boxes within those of the nodes.
//! Here a node has only pieces. It is enough that the pieces of an own box cover it and **share the
//! plane of the cut, bit for bit**. Say that a box is *good* for a hit at `t` if the ray's entry into
//! it is at most `t`, and its padded exit is at least that entry and `tmin`. A node that contains a
//! good box is good, since nested boxes have nested intervals, and a good node is visited: no limit
//! is ever below the `t` of the closest hit. The own box of a hit is good by the definition of a hit.
//! Now cut a good box in two, and let p be the distance to the plane, as the slab expression has it;
//! near and far are the pieces before and behind it. All sides but the cut are those of the whole.
//!
//! - `t < p`: the near piece is entered with the whole, and left no sooner than the whole or p, which
//!   is greater than `t`, hence than entry and `tmin`. It is good.
//! - `p <= t` and p is no later than the padded exit: the far piece is entered with the whole or at
//!   p, both at most `t`, and left with the whole. It is good.
//! - `p <= t` and p is later than the padded exit: the near piece is left with the whole. It is good.
//! - p is NaN: the ray runs in the plane, and neither piece has an end there, just as the whole has
//!   none that matters. Both are good.
//!
//! So some piece is good however often a box is cut, for every kernel and kind of primitive.
//!
//! Hence the deviation: **boxes are cut, triangles are not**. A box around the part of a triangle
//! beyond the plane would be smaller, but seen edge-on, the computed `t` of a hit may lie anywhere
//! in the depth of the triangle, by no constant margin. It may precede the entry into the one
//! piece that the ray passes, and whether it is found would depend on what was found before.
//!
//! Source: Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies", 2009.
//! Deviations: the above; references grow within a bound.

use super::binned_sah::{Binned, Extent};
use super::sah::{Block, SAH_DEPTH, Side, both};
use super::{Bounds, Join, Node, Reference, Tree};
use crate::bvh::layout::MAX_SLOTS;
use crate::primitives::{MAX_PRIMITIVES, Primitives};

/// Bins an axis.
const BINS: usize = 16;

/// Spatial splits are tried where the sides of the other split have a greater surface in common, as
/// a part of the root's.
const OVERLAP: f32 = 1e-5;

/// How many references there may be beyond one for each primitive, as a part of those.
const GROWTH: f64 = 0.3;

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
    let mut order = Reference::all(primitives, join);
    let count = order.len();
    if count == 0 {
        return Tree { root: None, order };
    }
    let binned = Binned::new(block, join);
    let extent = binned.extent(&order);
    let overlap = OVERLAP * extent.side.bounds.half_area();
    let spare = ((count as f64 * GROWTH) as usize).min(MAX_PRIMITIVES - count);
    order.resize(count + spare, order[0]);
    let room = Room { references: &mut order, extent, first: 0 };
    let root = room.subtree(&binned, overlap, depth);
    Tree { root: Some(root), order }
}

/// References, and room for those that cuts will add.
struct Room<'a> {
    /// Beyond those that `extent` counts they mean nothing.
    references: &'a mut [Reference],
    extent: Extent,
    /// Where the room begins among all.
    first: usize,
}

impl<'a> Room<'a> {
    /// The tree of the references; `depth` is that of its root. Spatial splits are tried where others
    /// overlap by more than `overlap`.
    fn subtree<J: Join>(self, binned: &Binned<'_, J>, overlap: f32, depth: usize) -> Node {
        let (Extent { side: whole, centers }, block) = (self.extent, binned.block);
        let (all, spare) = self.references.split_at_mut(whole.count);
        let split = if depth < SAH_DEPTH && block.tests(whole.count) > 1 {
            binned.best_split(all, &centers)
        } else {
            None
        };
        let cut = split.as_ref().filter(|split| common_area(&split.sides) > overlap);
        let cut = cut.and_then(|split| {
            let plane = best_plane(all, &whole.bounds, spare.len(), block)?;
            (plane.cost < split.cost && whole.pays(plane.cost, block))
                .then(|| plane.cut(all, block))?
        });
        let (left, right) = match (cut, split) {
            (Some(sides), _) => self.share_out(binned, &sides),
            (None, Some(split)) if whole.pays(split.cost, block) => {
                let extents = binned.partition(&split, all);
                self.split(extents)
            }
            _ if whole.count > MAX_SLOTS => {
                let extents = binned.halve(all, &centers);
                self.split(extents)
            }
            _ => return whole.leaf(self.first),
        };
        whole.inner(both(
            binned.join,
            [left.extent.side.count, right.extent.side.count],
            || left.subtree(binned, overlap, depth + 1),
            || right.subtree(binned, overlap, depth + 1),
        ))
    }

    /// The references of the left and those of the right, which follow, each with their part of the
    /// room.
    fn split(self, [left, right]: [Extent; 2]) -> (Room<'a>, Room<'a>) {
        let middle = left.side.count;
        let count = middle + right.side.count;
        let spare = self.references.len() - count;
        let at = middle + (spare as u64 * middle as u64 / count as u64) as usize;
        self.references.copy_within(middle..count, at);
        let Room { references, first, .. } = self;
        let (lefts, rights) = references.split_at_mut(at);
        (
            Room { references: lefts, extent: left, first },
            Room { references: rights, extent: right, first: first + at },
        )
    }

    /// These references in place of those that are there.
    fn share_out(
        self,
        binned: &Binned<'_, impl Join>,
        [left, right]: &[Vec<Reference>; 2],
    ) -> (Room<'a>, Room<'a>) {
        let middle = left.len();
        self.references[..middle].copy_from_slice(left);
        self.references[middle..middle + right.len()].copy_from_slice(right);
        self.split([binned.extent(left), binned.extent(right)])
    }
}

/// Half the surface that both sides of a split have in common.
fn common_area([left, right]: &[Side; 2]) -> f32 {
    let common = left.bounds.intersection(&right.bounds);
    if common.extent().iter().any(|length| *length < 0.0) { 0.0 } else { common.half_area() }
}

/// A plane to cut by.
struct Plane {
    axis: usize,
    at: f32,
    /// What falls to either side.
    sides: [Side; 2],
    cost: f32,
}

/// The cheapest plane with something less on both sides that adds at most `spare` references.
fn best_plane(
    references: &[Reference],
    whole: &Bounds,
    spare: usize,
    block: Block,
) -> Option<Plane> {
    let mut best: Option<Plane> = None;
    for axis in 0..3 {
        let [low, high] = whole.aabb().axes[axis];
        let step = (high - low) / BINS as f32;
        let mut planes = [0.0; BINS - 1];
        for (i, plane) in (1..).zip(&mut planes) {
            *plane = low + step * i as f32;
        }

        // A bin's box is that of all parts within; `enter` and `leave` count where references begin
        // and end.
        let mut boxes = [Bounds::empty(); BINS];
        let (mut enter, mut leave) = ([0; BINS], [0; BINS]);
        for reference in references {
            let [min, max] = reference.bounds().aabb().axes[axis];
            let from = planes.iter().filter(|plane| **plane <= min).count();
            let to = planes.iter().filter(|plane| **plane < max).count().max(from);
            enter[from] += 1;
            leave[to] += 1;
            for bin in from..=to {
                let low = if bin == 0 { low } else { planes[bin - 1] };
                let high = if bin == BINS - 1 { high } else { planes[bin] };
                let slab = Bounds::slab(axis, [low, high]);
                boxes[bin] = boxes[bin].union(&reference.bounds().intersection(&slab));
            }
        }

        let mut rights = [Side::empty(); BINS];
        let mut right = Side::empty();
        for i in (1..BINS).rev() {
            right.add(&boxes[i], leave[i]);
            rights[i] = right;
        }
        let mut left = Side::empty();
        for i in 1..BINS {
            left.add(&boxes[i - 1], enter[i - 1]);
            let (right, count) = (rights[i], references.len());
            let cost = left.cost(block) + right.cost(block);
            let less = left.count.max(right.count) < count && left.count.min(right.count) > 0;
            let fits = left.count + right.count <= count + spare;
            if less && fits && best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(Plane { axis, at: planes[i - 1], sides: [left, right], cost });
            }
        }
    }
    best
}

impl Plane {
    /// The references on both sides: those that the plane passes through are cut, or go to one side
    /// where that is cheaper. `None` if nothing is left on one side.
    fn cut(mut self, references: &[Reference], block: Block) -> Option<[Vec<Reference>; 2]> {
        let mut sides = self.sides.map(|side| Vec::with_capacity(side.count));
        for reference in references {
            let [min, max] = reference.bounds().aabb().axes[self.axis];
            if min >= self.at {
                sides[1].push(*reference);
            } else if max <= self.at {
                sides[0].push(*reference);
            } else if let Some(whole) = self.cheaper_whole(reference.bounds(), block) {
                sides[whole].push(*reference);
            } else {
                let slabs = [[min, self.at], [self.at, max]];
                for (side, slab) in sides.iter_mut().zip(slabs) {
                    side.push(reference.within(&Bounds::slab(self.axis, slab)));
                }
            }
        }
        let less = sides.iter().all(|side| !side.is_empty() && side.len() < references.len());
        less.then_some(sides)
    }

    /// The side that a box would go to whole, if that is cheaper than to cut it. The sides follow.
    fn cheaper_whole(&mut self, bounds: &Bounds, block: Block) -> Option<usize> {
        let cost = |grown: usize| {
            let [whole, other] = [&self.sides[grown], &self.sides[1 - grown]];
            let area = whole.bounds.union(bounds).half_area();
            let [tests, of_other] = [whole.count, other.count - 1].map(|n| block.tests(n) as f32);
            area * tests + other.bounds.half_area() * of_other
        };
        let both = self.sides[0].cost(block) + self.sides[1].cost(block);
        let (left, right) = (cost(0), cost(1));
        let side = usize::from(right < left);
        if left.min(right) >= both {
            return None;
        }
        self.sides[side].bounds = self.sides[side].bounds.union(bounds);
        self.sides[1 - side].count -= 1;
        Some(side)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::bvh::build::Sequential;
    use crate::geom::{Sphere, Triangle};

    /// Large and small, along the axes and askew.
    fn scene() -> Primitives {
        let wave = |i: usize, k: usize| (i as f32 * [0.61, 1.37, 2.71][k]).sin();
        let at = |i: usize| Vec3::new(wave(i, 0), wave(i, 1), wave(i, 2));
        let triangle = |i: usize| {
            let mut reach = Vec3::splat(0.02);
            if i.is_multiple_of(8) {
                reach[i / 8 % 3] = 1.5;
                reach[i / 24 % 3] = 1.0;
            }
            Triangle { corners: [5, 7, 11].map(|k| at(i) + at(k * i + k) * reach) }
        };
        let sphere = |i: usize| {
            let radius = if i.is_multiple_of(10) { 0.5 } else { 0.03 };
            Sphere { center: at(3 * i + 1), radius }
        };
        Primitives {
            triangles: (0..800).map(triangle).collect(),
            spheres: (0..60).map(sphere).collect(),
            ..Primitives::default()
        }
    }

    /// What the argument of this file stands on. The planes of all pieces make a grid, and every
    /// cell of it within the own box is in some piece.
    #[test]
    fn pieces_cover_own_boxes_to_the_last_bit() {
        let scene = scene();
        let tree = build(&scene, Block::ONE, &Sequential);
        let mut pieces = vec![Vec::new(); scene.len()];
        tree.root.expect("there are primitives").leaves(&mut |_, range| {
            for reference in &tree.order[range] {
                pieces[reference.prim() as usize].push(reference.bounds().aabb().axes);
            }
        });
        let mut most = 0;
        for (own, pieces) in scene.own_boxes().zip(pieces) {
            most = most.max(pieces.len());
            let planes = [0, 1, 2].map(|k| {
                let sides = pieces.iter().flat_map(|piece| piece[k]).chain(own.axes[k]);
                let mut planes: Vec<f32> = sides.collect();
                planes.sort_by(f32::total_cmp);
                planes
            });
            for x in planes[0].windows(2) {
                for y in planes[1].windows(2) {
                    for z in planes[2].windows(2) {
                        let within = |piece: &[[f32; 2]; 3]| {
                            let cell = [x, y, z].into_iter().zip(piece);
                            cell.into_iter().all(|(c, [min, max])| *min <= c[0] && c[1] <= *max)
                        };
                        assert!(pieces.iter().any(within), "{x:?} {y:?} {z:?} of {own:?}");
                        assert!(within(&own.axes), "{pieces:?} of {own:?}");
                    }
                }
            }
        }
        assert!(most > 4, "at most {most} pieces");
    }
}
