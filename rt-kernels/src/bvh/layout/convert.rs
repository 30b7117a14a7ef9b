//! From a build tree to [wide nodes](super::wide).
//!
//! Which nodes of the build tree are a node's children is chosen for the least surface of all nodes
//! but the first ([`collapse`](super::collapse)). Subtrees of up to N triangles become one block, whose
//! triangles are tested at once too: that takes little longer than to test a node, and is quicker than
//! to test them one by one from the second on.
//!
//! What is converted does not depend on `join`: subtrees are put together, and blocks filled, each by
//! itself, and so are the nodes below the first ones laid out, and put one after the other.

use std::ops::Range;

use simd4::f32x4;
use simd4::prelude::*;

use super::MAX_SLOTS;
use super::collapse::{Inner, Subtree};
use super::wide::{Child, Wide, WideNode, cone, record, sphere};
use crate::bvh::build::{self, Content, Join, Reference};
use crate::collect::collect;
use crate::geom::Aabb;
use crate::primitives::{KINDS, Primitives, kind};
use crate::tri::RecordBlock;

/// On so many levels from the root on, what is largest is opened first: most rays pass all of these
/// nodes, and it counts how soon the first hit is found. With the least sum of surfaces there too, a
/// room seen from outside takes a quarter more time; further down it saves a twentieth or less.
const FIRST_DEPTHS: usize = 2;

impl<const N: usize> Wide<N> {
    /// Converts a build tree.
    pub(crate) fn new(primitives: &Primitives, tree: build::Tree, join: &impl Join) -> Self {
        let build::Tree { root, order: mut references } = tree;
        let counts = primitives.counts();
        let several = counts.iter().filter(|&&count| count > 0).count() > 1;
        if let Some(root) = root.as_ref().filter(|_| several) {
            root.leaves(&mut |_, range| {
                references[range].sort_by_key(|one| kind(&counts, one.prim()));
            });
        }
        let pieces = references.len() > primitives.len();
        let blocks = Blocks { counts, pieces, references: &references };
        let Part { nodes, depth, blocks, round } = match root {
            Some(root) => blocks.layout(root, join),
            None => Part::default(),
        };
        let [spheres, cones] = &round;
        let mut wide = Wide {
            nodes,
            blocks: self::blocks(primitives, &blocks, join),
            spheres: spheres.prims.iter().map(|&prim| sphere(primitives, prim)).collect(),
            cones: cones.prims.iter().map(|&prim| cone(primitives, prim)).collect(),
            counts,
            depth,
        };
        let [of_spheres, of_cones] = [blocks.len(), blocks.len() + spheres.prims.len()];
        for (Round { leaves, .. }, before) in round.iter().zip([of_spheres, of_cones]) {
            for &(node, lane) in leaves {
                let child = wide.nodes[node].child(lane).after(before);
                wide.nodes[node].set_child(lane, child);
            }
        }
        wide
    }
}

/// At so many levels of the build tree from the root on, what is below may be converted at once.
const PARALLEL_DEPTHS: usize = 10;

/// What is a leaf here, and what is a node.
struct Blocks<'a, const N: usize> {
    counts: [usize; KINDS],
    /// Whether a primitive may have several references.
    pieces: bool,
    /// Those of a leaf are in the order of their kinds.
    references: &'a [Reference],
}

impl<const N: usize> Blocks<'_, N> {
    /// A node and all below, down to what is a leaf here; `depth` is how deep it is itself.
    fn subtree(&self, node: build::Node, depth: usize, join: &impl Join) -> Subtree<N> {
        if self.parts(&node) == 0 {
            return Subtree::Leaf(node);
        }
        let aabb = node.aabb;
        let mut parts = self.part(node);
        let all = |parts: Vec<build::Node>| -> Vec<_> {
            parts.into_iter().map(|part| self.subtree(part, depth + 1, join)).collect()
        };
        if depth >= PARALLEL_DEPTHS {
            return Subtree::inner(aabb, all(parts));
        }
        let last = parts.split_off(parts.len() / 2);
        let (mut children, last) = join.join(|| all(parts), || all(last));
        children.extend(last);
        Subtree::inner(aabb, children)
    }

    /// How many nodes [`part`](Blocks::part) makes of one; 0 for what is a leaf here.
    fn parts(&self, node: &build::Node) -> usize {
        match &node.content {
            _ if self.is_block(node) => 0,
            Content::Inner(children) if children.len() > N => 2,
            Content::Inner(children) => children.len(),
            Content::Leaf(range) => {
                let references = &self.references[range.clone()];
                let [first, last] = [0, references.len() - 1].map(|i| self.kind(&references[i]));
                if first == last && references.len() <= MAX_SLOTS { 0 } else { 2 }
            }
        }
    }

    /// A node's children, or the halves of those if they are more than N, or of a leaf if it is of
    /// several kinds or too large.
    fn part(&self, node: build::Node) -> Vec<build::Node> {
        match node.content {
            Content::Inner(children) if children.len() > N => halves(children.into_vec()).into(),
            Content::Inner(children) => children.into_vec(),
            Content::Leaf(Range { start, end }) => {
                let references = &self.references[start..end];
                let least = self.kind(&references[0]);
                let first = references.partition_point(|one| self.kind(one) == least);
                let count = references.len();
                let first = if first < count { first } else { count / 2 };
                [start..start + first, start + first..end]
                    .map(|range| {
                        let boxes =
                            self.references[range.clone()].iter().map(|r| r.bounds().aabb());
                        let aabb = boxes.fold(Aabb::EMPTY, |all, one| all.union(&one));
                        build::Node { aabb, content: Content::Leaf(range) }
                    })
                    .into()
            }
        }
    }

    fn kind(&self, reference: &Reference) -> usize {
        kind(&self.counts, reference.prim())
    }

    /// Whether all below is triangles, and no more than N.
    fn is_block(&self, node: &build::Node) -> bool {
        let mut room = N;
        self.fits(node, &mut room)
    }

    /// Whether all below is triangles that fit into the room that is left.
    fn fits(&self, node: &build::Node, room: &mut usize) -> bool {
        match &node.content {
            Content::Inner(children) => children.iter().all(|child| self.fits(child, room)),
            Content::Leaf(range) => {
                let left = room.checked_sub(range.len());
                *room = left.unwrap_or_default();
                // Triangles are first.
                left.is_some() && self.kind(&self.references[range.end - 1]) == 0
            }
        }
    }
}

/// Down to this depth nodes are laid out one after the other, and what is below them by itself.
const FIRST_PARTS: usize = 2;

impl<const N: usize> Blocks<'_, N> {
    /// Lays out a build tree.
    fn layout(&self, root: build::Node, join: &impl Join) -> Part<N> {
        let children = match self.subtree(root, 0, join) {
            Subtree::Inner(inner) => open(inner, 1),
            leaf => vec![leaf],
        };
        let mut first = Layout::new(self, FIRST_PARTS);
        first.node(children, 1);
        let Layout { mut part, below, .. } = first;
        let (places, below): (Vec<_>, Vec<_>) = below.into_iter().unzip();
        for (place, below) in places.into_iter().zip(self.parts_below(below, join)) {
            part.append(place, below);
        }
        part
    }

    /// Lays out the nodes below those of the [first](FIRST_PARTS), each by itself.
    fn parts_below(&self, mut below: Vec<Inner<N>>, join: &impl Join) -> Vec<Part<N>> {
        if below.len() > 1 {
            let last = below.split_off(below.len() / 2);
            let (mut parts, last) =
                join.join(|| self.parts_below(below, join), || self.parts_below(last, join));
            parts.extend(last);
            return parts;
        }
        let part = |inner| {
            let mut layout = Layout::new(self, usize::MAX);
            layout.node(open(inner, FIRST_PARTS + 1), FIRST_PARTS + 1);
            layout.part
        };
        below.into_iter().map(part).collect()
    }
}

/// Nodes, of which the first is above all others, and what is in their leaves. Whatever is numbered counts
/// from the first of this part.
struct Part<const N: usize> {
    nodes: Vec<WideNode<N>>,
    /// Of the whole, as far as it is known here.
    depth: usize,
    /// The triangles of each block, and after them as often as need be [`NO_PRIM`].
    blocks: Vec<[u32; N]>,
    /// Spheres and cones.
    round: [Round; KINDS - 1],
}

/// Primitives of a kind, each of which has a slot of its own, and the nodes and lanes of their leaves: their
/// slots count from the first of the kind.
#[derive(Default)]
struct Round {
    prims: Vec<u32>,
    leaves: Vec<(usize, usize)>,
}

/// No triangle.
const NO_PRIM: u32 = u32::MAX;

impl<const N: usize> Default for Part<N> {
    fn default() -> Self {
        Part { nodes: Vec::new(), depth: 0, blocks: Vec::new(), round: Default::default() }
    }
}

impl<const N: usize> Part<N> {
    /// Adds what is below the child in a lane of a node.
    fn append(&mut self, (node, lane): (usize, usize), part: Part<N>) {
        let (nodes, blocks) = (self.nodes.len(), self.blocks.len());
        self.nodes[node].set_child(lane, Child::node(nodes));
        self.nodes.extend(part.nodes.iter().map(|node| node.after(nodes, blocks)));
        self.blocks.extend(part.blocks);
        self.depth = self.depth.max(part.depth);
        for (round, Round { prims, leaves }) in self.round.iter_mut().zip(part.round) {
            for (node, lane) in leaves {
                let child = part.nodes[node].child(lane).after(round.prims.len());
                self.nodes[nodes + node].set_child(lane, child);
                round.leaves.push((nodes + node, lane));
            }
            round.prims.extend(prims);
        }
    }
}

/// A part that grows.
struct Layout<'a, const N: usize> {
    blocks: &'a Blocks<'a, N>,
    part: Part<N>,
    /// Nodes below this depth are not laid out but put aside, with the node and the lane that they are
    /// children of.
    last: usize,
    below: Vec<((usize, usize), Inner<N>)>,
    /// The primitives of one leaf.
    prims: Vec<u32>,
}

impl<'a, const N: usize> Layout<'a, N> {
    fn new(blocks: &'a Blocks<'a, N>, last: usize) -> Self {
        Layout { blocks, part: Part::default(), last, below: Vec::new(), prims: Vec::new() }
    }

    /// Lays out a node and all below, and returns where it is.
    fn node(&mut self, children: Vec<Subtree<N>>, depth: usize) -> usize {
        let at = self.part.nodes.len();
        self.part.nodes.push(WideNode::EMPTY);
        self.part.depth = self.part.depth.max(depth);
        for (lane, child) in in_lanes(children).into_iter().flatten().enumerate() {
            self.part.nodes[at].set_box(lane, child.aabb());
            let child = match child {
                Subtree::Inner(inner) if depth == self.last => {
                    self.below.push(((at, lane), inner));
                    continue;
                }
                Subtree::Inner(inner) => Child::node(self.node(open(inner, depth + 1), depth + 1)),
                Subtree::Leaf(node) => self.leaf(&node, (at, lane)),
            };
            self.part.nodes[at].set_child(lane, child);
        }
        self.part.nodes[at].set_order();
        at
    }

    /// Lays out the primitives of all leaves below; `place` is the child's.
    fn leaf(&mut self, node: &build::Node, place: (usize, usize)) -> Child {
        let Layout { blocks, part, prims, .. } = self;
        prims.clear();
        node.leaves(&mut |_, range| {
            prims.extend(blocks.references[range].iter().map(Reference::prim));
        });
        if blocks.pieces {
            prims.sort_unstable();
            prims.dedup();
        }
        let Some(kind) = kind(&blocks.counts, prims[0]).checked_sub(1) else {
            let first = part.blocks.len();
            part.blocks.extend(prims.chunks(N).map(|prims| {
                let mut block = [NO_PRIM; N];
                block[..prims.len()].copy_from_slice(prims);
                block
            }));
            return Child::leaf(first..part.blocks.len());
        };
        let round = &mut part.round[kind];
        let first = round.prims.len();
        round.prims.extend(&*prims);
        round.leaves.push(place);
        Child::leaf(first..round.prims.len())
    }
}

/// So many blocks before the triangles of one are needed, they are sent for.
const AHEAD: usize = 4;

/// The blocks of some triangles each.
fn blocks<const N: usize>(
    primitives: &Primitives,
    blocks: &[[u32; N]],
    join: &impl Join,
) -> Vec<RecordBlock<N>> {
    let s = <f32x4 as Lanes>::Simd::TOKEN;
    let prims = |i: usize| blocks[i].iter().take_while(|&&prim| prim != NO_PRIM);
    collect(blocks.len(), join, |i| {
        for &prim in blocks.get(i + AHEAD).into_iter().flatten() {
            s.prefetch(primitives.triangles.as_ptr().wrapping_add(prim as usize));
        }
        RecordBlock::new(prims(i).map(|&prim| record(primitives, prim)))
    })
}

/// The children of a node at that depth; the root's is 1.
fn open<const N: usize>(inner: Inner<N>, depth: usize) -> Vec<Subtree<N>> {
    if depth <= FIRST_DEPTHS { inner.open_largest() } else { inner.open() }
}

/// A node's children, each in its lane: those of each half are neighbours.
fn in_lanes<const N: usize>(children: Vec<Subtree<N>>) -> [Option<Subtree<N>>; N] {
    let mut along = [0.0; N];
    let along = &mut along[..children.len()];
    if children.len() > 4 {
        let axis = axis_apart(children.iter().map(Subtree::aabb));
        along.iter_mut().zip(&children).for_each(|(at, child)| *at = middle(child.aabb(), axis));
    }
    let mut lanes = [const { None }; N];
    for (i, child) in children.into_iter().enumerate() {
        // After those that are less far along.
        let (at, (before, after)) = (along[i], along.split_at(i));
        let before = before.iter().filter(|other| **other <= at).count();
        lanes[before + after.iter().filter(|other| **other < at).count()] = Some(child);
    }
    lanes
}

/// The axis on which the boxes' centres are furthest apart.
fn axis_apart<'a>(boxes: impl Iterator<Item = &'a Aabb>) -> usize {
    let centers = boxes.map(|aabb| Aabb::point(aabb.min() + aabb.max()));
    centers.fold(Aabb::EMPTY, |all, one| all.union(&one)).extent().max_position()
}

/// Twice where the centre is on an axis.
fn middle(aabb: &Aabb, axis: usize) -> f32 {
    let [low, high] = aabb.axes[axis];
    low + high
}

/// Two nodes with one half each of some nodes, parted where their boxes' centres are furthest apart.
fn halves(mut nodes: Vec<build::Node>) -> [build::Node; 2] {
    let axis = axis_apart(nodes.iter().map(|node| &node.aabb));
    nodes.sort_by(|a, b| middle(&a.aabb, axis).total_cmp(&middle(&b.aabb, axis)));
    let right = nodes.split_off(nodes.len() / 2);
    [nodes, right].map(|children| {
        let aabb = children.iter().fold(Aabb::EMPTY, |all, child| all.union(&child.aabb));
        build::Node { aabb, content: Content::Inner(children.into()) }
    })
}
