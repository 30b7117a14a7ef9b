//! From a build tree to [wide nodes](super::wide).
//!
//! Which nodes of the build tree are a node's children is chosen for the least surface of all nodes
//! but the first ([`collapse`](super::collapse)). Subtrees of up to N triangles become one block, whose
//! triangles are tested at once too: that takes little longer than to test a node, and is quicker than
//! to test them one by one from the second on.
//!
//! What is converted does not depend on `join`: subtrees are put together, and blocks filled, each by
//! itself; nodes are laid out one after the other.

use std::ops::Range;

use super::MAX_SLOTS;
use super::collapse::{Inner, Subtree};
use super::wide::{Child, Wide, WideNode, cone, record, sphere};
use crate::bvh::build::{self, Content, Join, Reference};
use crate::geom::Aabb;
use crate::primitives::{KINDS, Primitives, kind};
use crate::tri::{Record, RecordBlock};

/// On so many levels from the root on, what is largest is opened first: most rays pass all of these
/// nodes, and it counts how soon the first hit is found. With the least sum of surfaces there too, a
/// room seen from outside takes a quarter more time; further down it saves a twentieth or less.
const FIRST_DEPTHS: usize = 2;

impl<const N: usize> Wide<N> {
    /// Converts a build tree.
    pub(crate) fn new(primitives: &Primitives, tree: build::Tree, join: &impl Join) -> Self {
        let build::Tree { root, order: mut references } = tree;
        let counts = primitives.counts();
        let mut wide = Wide {
            nodes: Vec::new(),
            blocks: Vec::new(),
            spheres: Vec::with_capacity(primitives.spheres.len()),
            cones: Vec::with_capacity(primitives.cones.len()),
            counts,
            depth: 0,
        };
        let Some(root) = root else { return wide };
        if counts.iter().filter(|&&count| count > 0).count() > 1 {
            root.leaves(&mut |_, range| {
                references[range].sort_by_key(|one| kind(&counts, one.prim()));
            });
        }
        let blocks = Blocks { counts, references: &references };
        let whole = blocks.subtree(root, 0, join);
        let most = blocks.most(&whole);
        let leaves = [const { Vec::new() }; KINDS];
        let (slots, prims) = (Vec::new(), Vec::new());
        let mut converter = Converter { primitives, blocks, leaves, wide: &mut wide, slots, prims };
        let children = match whole {
            Subtree::Inner(inner) => open(inner, 1),
            leaf => vec![leaf],
        };
        // Memory for the blocks takes about as long as to lay out the nodes.
        let (_, empty) =
            join.join(|| converter.node(children, 1), || vec![RecordBlock::new(&[]); most]);
        let Converter { leaves: [_, of_spheres, of_cones], slots, .. } = converter;
        let (blocks, spheres) = (slots.len(), wide.spheres.len());
        for (leaves, before) in [(of_spheres, blocks), (of_cones, blocks + spheres)] {
            for (node, lane) in leaves {
                let Child(slots) = wide.nodes[node].child(lane);
                wide.nodes[node].set_child(lane, Child(slots + ((before as u32) << 4)));
            }
        }
        wide.blocks = empty;
        // In a leaf, several pieces of a triangle are one.
        wide.blocks.truncate(blocks);
        fill(primitives, &slots, &mut wide.blocks, join);
        wide
    }
}

/// At so many levels of the build tree from the root on, what is below may be converted at once.
const PARALLEL_DEPTHS: usize = 10;

/// What is a leaf here, and what is a node.
struct Blocks<'a, const N: usize> {
    counts: [usize; KINDS],
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

    /// How many blocks there may be.
    fn most(&self, whole: &Subtree<N>) -> usize {
        let mut most = 0;
        whole.leaves(&mut |node| {
            let mut references = 0;
            node.leaves(&mut |_, range| {
                if self.kind(&self.references[range.start]) == 0 {
                    references += range.len();
                }
            });
            most += references.div_ceil(N);
        });
        most
    }

    /// How many nodes [`part`](Blocks::part) makes of one; 0 for what is a leaf here.
    fn parts(&self, node: &build::Node) -> usize {
        match &node.content {
            _ if self.is_block(node) => 0,
            Content::Inner(children) if children.len() > N => 2,
            Content::Inner(children) => children.len(),
            Content::Leaf(range) => {
                let references = &self.references[range.clone()];
                let of_one_kind =
                    references.windows(2).all(|two| self.kind(&two[0]) == self.kind(&two[1]));
                if of_one_kind && references.len() <= MAX_SLOTS { 0 } else { 2 }
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
                let mut references = self.references[range.clone()].iter();
                left.is_some() && references.all(|one| self.kind(one) == 0)
            }
        }
    }
}

/// A layout that grows.
struct Converter<'a, const N: usize> {
    primitives: &'a Primitives,
    blocks: Blocks<'a, N>,
    wide: &'a mut Wide<N>,
    /// The nodes and lanes of the leaves of each kind, whose slots count from the first of that kind.
    leaves: [Vec<(usize, usize)>; KINDS],
    /// What will be in the blocks.
    slots: Vec<Slot<N>>,
    /// Those of one leaf.
    prims: Vec<u32>,
}

/// The triangles of a block, and after them as often as need be [`NO_PRIM`].
type Slot<const N: usize> = [u32; N];

/// No triangle.
const NO_PRIM: u32 = u32::MAX;

impl<const N: usize> Converter<'_, N> {
    /// Lays out a node and all below, and returns where it is.
    fn node(&mut self, children: Vec<Subtree<N>>, depth: usize) -> usize {
        let at = self.wide.nodes.len();
        self.wide.nodes.push(WideNode::EMPTY);
        self.wide.depth = self.wide.depth.max(depth);
        for (lane, child) in in_halves(children).into_iter().enumerate() {
            self.wide.nodes[at].set_box(lane, child.aabb());
            let child = match child {
                Subtree::Inner(inner) => Child::node(self.node(open(inner, depth + 1), depth + 1)),
                Subtree::Leaf(node) => self.leaf(&node, (at, lane)),
            };
            self.wide.nodes[at].set_child(lane, child);
        }
        self.wide.nodes[at].set_order();
        at
    }

    /// Lays out the primitives of all leaves below; `place` is the child's.
    fn leaf(&mut self, node: &build::Node, place: (usize, usize)) -> Child {
        let Converter { primitives, blocks, wide, prims, slots, .. } = self;
        prims.clear();
        node.leaves(&mut |_, range| {
            prims.extend(blocks.references[range].iter().map(Reference::prim));
        });
        // Of a box that was cut there may be several pieces.
        prims.sort_unstable();
        prims.dedup();
        let kind = kind(&blocks.counts, prims[0]);
        self.leaves[kind].push(place);
        if kind == 0 {
            let first = slots.len();
            slots.extend(prims.chunks(N).map(|prims| {
                let mut slot = [NO_PRIM; N];
                slot[..prims.len()].copy_from_slice(prims);
                slot
            }));
            Child::leaf(first..slots.len())
        } else if kind == 1 {
            let first = wide.spheres.len();
            wide.spheres.extend(prims.iter().map(|&prim| sphere(primitives, prim)));
            Child::leaf(first..wide.spheres.len())
        } else {
            let first = wide.cones.len();
            wide.cones.extend(prims.iter().map(|&prim| cone(primitives, prim)));
            Child::leaf(first..wide.cones.len())
        }
    }
}

/// The least number of blocks of which the halves may be filled at once.
const PARALLEL_BLOCKS: usize = 1024;

/// Puts the triangles that slots name into as many blocks.
fn fill<const N: usize>(
    primitives: &Primitives,
    slots: &[Slot<N>],
    blocks: &mut [RecordBlock<N>],
    join: &impl Join,
) {
    if slots.len() >= PARALLEL_BLOCKS {
        let ((slots, more_slots), (blocks, more_blocks)) =
            (slots.split_at(slots.len() / 2), blocks.split_at_mut(slots.len() / 2));
        join.join(
            || fill(primitives, slots, blocks, join),
            || fill(primitives, more_slots, more_blocks, join),
        );
        return;
    }
    for (slot, block) in slots.iter().zip(blocks) {
        let mut records = [Record::nothing(); N];
        let prims = slot.iter().take_while(|&&prim| prim != NO_PRIM);
        let count =
            records.iter_mut().zip(prims).map(|(to, &i)| *to = record(primitives, i)).count();
        *block = RecordBlock::new(&records[..count]);
    }
}

/// The children of a node at that depth; the root's is 1.
fn open<const N: usize>(inner: Inner<N>, depth: usize) -> Vec<Subtree<N>> {
    if depth <= FIRST_DEPTHS { inner.open_largest() } else { inner.open() }
}

/// The children in the order of their lanes, so that each half of a node has neighbours.
fn in_halves<const N: usize>(mut children: Vec<Subtree<N>>) -> Vec<Subtree<N>> {
    if children.len() > 4 {
        sort_apart(&mut children, Subtree::aabb);
    }
    children
}

/// Sorts along the axis on which the boxes' centres are furthest apart.
fn sort_apart<T>(parts: &mut [T], aabb: impl Fn(&T) -> &Aabb) {
    let center = |part: &T| aabb(part).min() + aabb(part).max();
    let centers = parts.iter().fold(Aabb::EMPTY, |all, part| all.union(&Aabb::point(center(part))));
    let axis = centers.extent().max_position();
    parts.sort_by(|a, b| center(a)[axis].total_cmp(&center(b)[axis]));
}

/// Two nodes with one half each of some nodes, parted where their boxes' centres are furthest apart.
fn halves(mut nodes: Vec<build::Node>) -> [build::Node; 2] {
    sort_apart(&mut nodes, |node| &node.aabb);
    let right = nodes.split_off(nodes.len() / 2);
    [nodes, right].map(|children| {
        let aabb = children.iter().fold(Aabb::EMPTY, |all, child| all.union(&child.aabb));
        build::Node { aabb, content: Content::Inner(children.into()) }
    })
}
