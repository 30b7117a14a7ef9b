//! The depth-first array with skip pointers, 32 bytes a node.
//!
//! A node's first child is the next in the array; its skip pointer is the node to go on with when
//! it is missed. Source: Geimer and Müller 2003, Section 3.3; Smits 1998.

use std::ops::Range;

use crate::bvh::build::{self, Content};
use crate::geom::Aabb;
use crate::primitives::{Primitives, Store};
use crate::tri::Method;

/// A box, and where to go from it.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Node {
    /// The union of the own boxes of all that is below.
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
    /// Converts a build tree. Of two children the one with the larger surface comes first: it is
    /// the likelier to be hit, and a hit bounds the rest.
    pub(crate) fn new(primitives: &Primitives, tree: &build::Tree, method: Method) -> SkipArray {
        let mut flat =
            Flattener { primitives, tree, nodes: Vec::new(), order: Vec::new(), slots: [0; 2] };
        flat.slots[1] = primitives.triangles.len();
        if let Some(root) = &tree.root {
            flat.emit(root);
        }
        let store = Store::reordered(primitives, method, flat.order.into_iter());
        SkipArray { nodes: flat.nodes, store }
    }

    /// The nodes, depth first.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The memory of nodes and primitives.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + self.store.bytes()
    }
}

struct Flattener<'a> {
    primitives: &'a Primitives,
    tree: &'a build::Tree,
    nodes: Vec<Node>,
    order: Vec<u32>,
    /// The next free slot of each kind: triangles, spheres.
    slots: [usize; 2],
}

impl Flattener<'_> {
    fn emit(&mut self, node: &build::Node) {
        match &node.content {
            Content::Inner(children) => {
                let at = self.nodes.len();
                self.nodes.push(Node { aabb: node.aabb, skip: 0, leaf: 0 });
                let [a, b] = &**children;
                let (first, second) =
                    if a.aabb.half_area() >= b.aabb.half_area() { (a, b) } else { (b, a) };
                self.emit(first);
                self.emit(second);
                self.nodes[at].skip = self.nodes.len() as u32;
            }
            Content::Leaf(range) => {
                // A leaf holds one kind of primitive: of two kinds make two leaves.
                let triangles = self.primitives.triangles.len();
                let (flat, round): (Vec<_>, Vec<_>) = self.tree.order[range.clone()]
                    .iter()
                    .partition(|reference| (reference.prim as usize) < triangles);
                for (kind, references) in [flat, round].into_iter().enumerate() {
                    for leaf in references.chunks(MAX_SLOTS) {
                        self.leaf(kind, leaf);
                    }
                }
            }
        }
    }

    fn leaf(&mut self, kind: usize, references: &[build::Reference]) {
        let first = self.slots[kind];
        self.slots[kind] += references.len();
        self.order.extend(references.iter().map(|reference| reference.prim));
        let aabb = references.iter().fold(Aabb::EMPTY, |all, one| all.union(&one.aabb));
        self.nodes.push(Node {
            aabb,
            skip: self.nodes.len() as u32 + 1,
            leaf: (first as u32) << 4 | references.len() as u32,
        });
    }
}
