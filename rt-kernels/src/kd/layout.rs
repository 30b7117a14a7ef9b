//! The kd-tree in memory: 8 bytes a node, siblings side by side.
//!
//! A pair of siblings takes 16 aligned bytes, so that both come in one cache line. A leaf is a range
//! of a list of slots; a primitive that several cells have is in the list several times, but has one
//! record. Source: Wald et al. 2001, Section 4.2. Deviation: indices instead of pointers.

use std::ops::Range;

/// The plane across an axis that splits a cell, or the primitives of a leaf.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Node {
    /// The bits of the split; in a leaf the number of slots.
    word: u32,
    /// The children's pair, in a leaf its first slot in the list; and in the two low bits the axis,
    /// or [`LEAF`].
    link: u32,
}

/// What a leaf has instead of an axis.
const LEAF: u32 = 3;

/// The most entries of the list of slots, and the most pairs.
pub(super) const MAX_LINK: usize = (1 << 30) - 1;

impl Node {
    /// A cell that is split at `at` on an axis; its children are pair number `pair`.
    pub(super) fn inner(axis: usize, at: f32, pair: usize) -> Node {
        Node { word: at.to_bits(), link: (pair as u32) << 2 | axis as u32 }
    }

    /// A cell with that range of the list.
    pub(super) fn leaf(slots: Range<usize>) -> Node {
        Node { word: slots.len() as u32, link: (slots.start as u32) << 2 | LEAF }
    }

    /// The axis of the split; `None` for a leaf.
    #[inline(always)]
    pub(super) fn axis(self) -> Option<usize> {
        let axis = self.link & 3;
        (axis != LEAF).then_some(axis as usize)
    }

    /// Where an inner node is split.
    #[inline(always)]
    pub(super) fn at(self) -> f32 {
        f32::from_bits(self.word)
    }

    /// The number of an inner node's pair of children.
    #[inline(always)]
    pub(super) fn pair(self) -> usize {
        (self.link >> 2) as usize
    }

    /// A leaf's range of the list.
    #[inline(always)]
    pub(super) fn slots(self) -> Range<usize> {
        let first = (self.link >> 2) as usize;
        first..first + self.word as usize
    }

    /// The same node with its children or slots moved on.
    fn moved(self, pairs: usize, slots: usize) -> Node {
        let by = if self.axis().is_some() { pairs } else { slots };
        Node { link: self.link + ((by as u32) << 2), ..self }
    }
}

/// Siblings: the part of a cell below its split, and the part above.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(16))]
pub struct Pair(pub(super) [Node; 2]);

const _: () = assert!(size_of::<Pair>() == 16, "never across cache lines");

/// Nodes and the list of what leaves have, depth first; all of it or that of a subtree.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    pub(super) pairs: Vec<Pair>,
    pub(super) list: Vec<u32>,
    /// The number of nodes on the longest way from a root to a leaf.
    pub(super) depth: usize,
}

impl Cells {
    /// Adds a leaf of these.
    pub(super) fn leaf(&mut self, prims: impl Iterator<Item = u32>, depth: usize) -> Node {
        self.depth = self.depth.max(depth + 1);
        let first = self.list.len();
        self.list.extend(prims);
        Node::leaf(first..self.list.len())
    }

    /// Adds all of another subtree, whose root is then the node that is returned.
    pub(super) fn append(&mut self, (root, other): (Node, Cells)) -> Node {
        let (pairs, slots) = (self.pairs.len(), self.list.len());
        let moved = |Pair(nodes): &Pair| Pair(nodes.map(|node| node.moved(pairs, slots)));
        self.pairs.extend(other.pairs.iter().map(moved));
        self.list.extend(other.list);
        self.depth = self.depth.max(other.depth);
        root.moved(pairs, slots)
    }
}
