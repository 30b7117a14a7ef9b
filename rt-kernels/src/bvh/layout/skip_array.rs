//! The depth-first array with skip pointers, 32 bytes a node.
//!
//! A node's first child is the next in the array; its skip pointer is the node to go on with when
//! it is missed. Source: Geimer and Müller 2003, Section 3.3; Smits 1998.

use std::ops::Range;

use crate::bvh::build::{self, Content, Reference};
use crate::bvh::refit::Refit;
use crate::geom::Aabb;
use crate::primitives::{KINDS, Primitives, Store, kind};
use crate::tri::Method;

/// A box, and where to go from it.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Node {
    /// The union of the own boxes of all that is below, or of the pieces of them that are.
    pub aabb: Aabb,
    /// The node to go on with if this one is missed.
    pub skip: u32,
    /// The first slot in the upper 28 bits, the number of slots in the lower 4; 0 slots: no leaf.
    leaf: u32,
}

const _: () = assert!(size_of::<Node>() == 32, "two nodes a cache line");

/// The greatest number of primitives in a leaf.
pub(crate) const MAX_SLOTS: usize = 15;

impl Node {
    /// The primitives of a leaf.
    #[inline(always)]
    pub(crate) fn slots(&self) -> Option<Range<usize>> {
        let first = (self.leaf >> 4) as usize;
        match (self.leaf & 15) as usize {
            0 => None,
            count => Some(first..first + count),
        }
    }
}

/// The array and the primitives in the order of its leaves.
#[derive(Clone, Debug)]
pub struct SkipArray {
    nodes: Vec<Node>,
    pub(crate) store: Store,
}

impl SkipArray {
    /// Converts a build tree. Children come in decreasing order of their surface: the larger is the
    /// likelier to be hit, and a hit bounds the rest.
    pub(crate) fn new(primitives: &Primitives, tree: build::Tree, method: Method) -> SkipArray {
        SkipArray::flattened(primitives, tree, method, true)
    }

    /// The same with children in the order in which the builder left them.
    pub(crate) fn unsorted(
        primitives: &Primitives,
        tree: build::Tree,
        method: Method,
    ) -> SkipArray {
        SkipArray::flattened(primitives, tree, method, false)
    }

    fn flattened(
        primitives: &Primitives,
        tree: build::Tree,
        method: Method,
        sorted: bool,
    ) -> SkipArray {
        let build::Tree { root, order: mut references } = tree;
        let mut flat = Flattener {
            sorted,
            counts: primitives.counts(),
            order: Vec::with_capacity(references.len()),
            ..Flattener::default()
        };
        if let Some(root) = root {
            flat.emit(root, &mut references);
        }
        // The slots of a kind follow those of the kinds before it.
        let [triangles, spheres, _] = flat.slots;
        for (kind, before) in [(1, triangles), (2, triangles + spheres)] {
            for &leaf in &flat.leaves[kind] {
                flat.nodes[leaf].leaf += before << 4;
            }
        }
        let store = Store::reordered(primitives, method, flat.order.into_iter());
        SkipArray { nodes: flat.nodes, store }
    }

    /// The nodes, depth first.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The number of nodes on the longest way from the root to a leaf.
    pub(crate) fn depth(&self) -> usize {
        let mut ends = Vec::new();
        let mut depth = 0;
        for (i, node) in self.nodes.iter().enumerate() {
            while ends.last().is_some_and(|end| *end <= i) {
                ends.pop();
            }
            ends.push(node.skip as usize);
            depth = depth.max(ends.len());
        }
        depth
    }

    /// How many primitives all leaves have together.
    pub(crate) fn references(&self) -> usize {
        self.store.slots()
    }

    /// The memory of nodes and primitives.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + self.store.bytes()
    }
}

impl Refit for SkipArray {
    fn counts(&self) -> [usize; KINDS] {
        self.store.counts()
    }

    fn replace(&mut self, primitives: &Primitives, own_boxes: &[Aabb]) {
        self.store.replace(primitives);
        for i in (0..self.nodes.len()).rev() {
            let node = self.nodes[i];
            let mut aabb = Aabb::EMPTY;
            match node.slots() {
                Some(slots) => {
                    for slot in slots {
                        aabb = aabb.union(&own_boxes[self.store.prim(slot) as usize]);
                    }
                }
                None => {
                    let mut child = i + 1;
                    while child < node.skip as usize {
                        aabb = aabb.union(&self.nodes[child].aabb);
                        child = self.nodes[child].skip as usize;
                    }
                }
            }
            self.nodes[i].aabb = aabb;
        }
    }
}

/// An array that grows.
#[derive(Default)]
struct Flattener {
    /// Whether children are sorted by surface.
    sorted: bool,
    /// How many primitives there are of each kind.
    counts: [usize; KINDS],
    nodes: Vec<Node>,
    order: Vec<u32>,
    /// How many slots there are of each kind.
    slots: [u32; KINDS],
    /// The leaves of each kind, whose slots count from the first of that kind.
    leaves: [Vec<usize>; KINDS],
}

impl Flattener {
    fn emit(&mut self, node: build::Node, references: &mut [Reference]) {
        match node.content {
            Content::Inner(mut children) => {
                let at = self.nodes.len();
                self.nodes.push(Node { aabb: node.aabb, skip: 0, leaf: 0 });
                if self.sorted {
                    children.sort_by(|a, b| b.aabb.half_area().total_cmp(&a.aabb.half_area()));
                }
                for child in children {
                    self.emit(child, references);
                }
                self.nodes[at].skip = self.nodes.len() as u32;
            }
            Content::Leaf(range) => {
                // A leaf holds one kind of primitive: of two kinds make two leaves.
                let references = &mut references[range];
                let counts = self.counts;
                let kind = |reference: &Reference| kind(&counts, reference.prim());
                references.sort_by_key(kind);
                for references in references.chunk_by(|a, b| kind(a) == kind(b)) {
                    for leaf in references.chunks(MAX_SLOTS) {
                        self.leaf(kind(&leaf[0]), leaf);
                    }
                }
            }
        }
    }

    fn leaf(&mut self, kind: usize, references: &[Reference]) {
        self.leaves[kind].push(self.nodes.len());
        let (first, count) = (self.slots[kind], references.len() as u32);
        self.slots[kind] += count;
        self.order.extend(references.iter().map(Reference::prim));
        let aabb = references.iter().fold(Aabb::EMPTY, |all, one| all.union(&one.bounds().aabb()));
        self.nodes.push(Node { aabb, skip: self.nodes.len() as u32 + 1, leaf: first << 4 | count });
    }
}
