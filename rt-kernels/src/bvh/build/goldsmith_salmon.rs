//! Building by insertion: one primitive after the other goes where the tree's expected cost grows
//! least.
//!
//! The cost of a tree is the expected number of boxes that a ray tests, times the surface of the
//! root: each node adds its surface as often as it has children. A search for the cheapest place
//! begins at the root. At a node with k children, of surface A, or A' with the new primitive:
//!
//! - to become a child of that node costs k (A' - A) + A';
//! - where it is a leaf, the two become children of a new node, which costs 2 A';
//! - all places further down inherit k (A' - A), and the search goes on to the child whose surface
//!   would grow least.
//!
//! The place with the least sum of inherited and own costs is taken.
//!
//! Primitives are inserted in random order, always the same: a file lists neighbours together, and
//! what comes in order makes long chains of nodes.
//!
//! Source: Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", 1987.
//! That children are then sorted by surface, in decreasing order, is Geimer and Müller's change
//! (2003, Section 3.3); the [layout](crate::bvh::layout) does so for every builder. Deviations:
//! 1. of children that would grow alike, the search goes on to that with the fewest primitives, so
//!    that coinciding ones make a bushy tree;
//! 2. a node has at most 16 children, and the tree at most 64 nodes one below the other: the time to
//!    insert a primitive is bounded;
//! 3. nodes become leaves where testing all primitives below costs no more than testing boxes first.

use super::sah::Block;
use super::{Bounds, Content, Node, Reference, Sequential, Tree};
use crate::bvh::layout::MAX_SLOTS;
use crate::primitives::Primitives;

/// The most children of a node.
const MAX_CHILDREN: usize = 16;

/// The most nodes from the root to a leaf: at the last a leaf takes all that comes.
const MAX_DEPTH: usize = 64;

/// Builds the tree of all primitives.
pub(crate) fn build(primitives: &Primitives) -> Tree {
    let mut references = Reference::all(primitives, &Sequential);
    shuffle(&mut references);
    Growing::new(&references).finish()
}

/// Fisher and Yates' shuffle, with the numbers of SplitMix64.
fn shuffle(references: &mut [Reference]) {
    let mut state = 0u64;
    for i in (1..references.len()).rev() {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = state;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        references.swap(i, (bits % (i as u64 + 1)) as usize);
    }
}

/// A tree to insert into. Nodes know each other by their index; the first is the root.
#[derive(Default)]
struct Growing {
    nodes: Vec<Growth>,
}

/// A node of it.
#[derive(Clone)]
struct Growth {
    bounds: Bounds,
    /// The number of primitives below.
    count: usize,
    below: Below,
}

/// What is below a node.
#[derive(Clone)]
enum Below {
    Nodes(Vec<u32>),
    /// One primitive, or on the last level any number.
    Prims(Vec<Reference>),
}

impl Growing {
    /// The tree of all, inserted in that order.
    fn new(references: &[Reference]) -> Growing {
        let mut tree = Growing::default();
        for reference in references {
            tree.insert(reference);
        }
        tree
    }

    fn insert(&mut self, reference: &Reference) {
        let bounds = reference.bounds();
        let leaf = Growth { bounds: *bounds, count: 1, below: Below::Prims(vec![*reference]) };
        if self.nodes.is_empty() {
            self.nodes.push(leaf);
            return;
        }
        let way = self.cheapest_way(bounds);
        let place = way[way.len() - 1] as usize;
        if matches!(self.nodes[place].below, Below::Prims(_)) && way.len() < MAX_DEPTH {
            let old = self.push(self.nodes[place].clone());
            self.nodes[place].below = Below::Nodes(vec![old]);
        }
        for &node in &way {
            let node = &mut self.nodes[node as usize];
            node.bounds = node.bounds.union(bounds);
            node.count += 1;
        }
        let new = self.nodes.len() as u32;
        match &mut self.nodes[place].below {
            Below::Prims(prims) => prims.push(*reference),
            Below::Nodes(children) => {
                children.push(new);
                self.push(leaf);
            }
        }
    }

    fn push(&mut self, node: Growth) -> u32 {
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    /// The nodes from the root to the cheapest place for a box: a node to become a child of, or a
    /// leaf to pair up with.
    fn cheapest_way(&self, bounds: &Bounds) -> Vec<u32> {
        let (mut way, mut inherited) = (vec![0], 0.0);
        let (mut best, mut least) = (1, f32::INFINITY);
        loop {
            let node = &self.nodes[way[way.len() - 1] as usize];
            let area = node.bounds.union(bounds).half_area();
            let (new, children) = match &node.below {
                Below::Prims(_) => (2.0, None),
                Below::Nodes(children) => (1.0, Some(children)),
            };
            if let Some(children) = children {
                inherited += (area - node.bounds.half_area()) * children.len() as f32;
            }
            let full = children.is_some_and(|children| children.len() == MAX_CHILDREN);
            if !full && inherited + new * area < least {
                (best, least) = (way.len(), inherited + new * area);
            }
            match children {
                Some(children) => way.push(self.least_growing(children, bounds)),
                None => break,
            }
        }
        way.truncate(best);
        way
    }

    /// The child whose surface would grow least; of equal ones, that with the fewest primitives.
    fn least_growing(&self, children: &[u32], bounds: &Bounds) -> u32 {
        let mut best = (f32::INFINITY, usize::MAX, children[0]);
        for &child in children {
            let node = &self.nodes[child as usize];
            let growth = node.bounds.union(bounds).half_area() - node.bounds.half_area();
            if growth < best.0 || growth == best.0 && node.count < best.1 {
                best = (growth, node.count, child);
            }
        }
        best.2
    }

    /// The build tree.
    fn finish(self) -> Tree {
        let mut order = Vec::with_capacity(self.nodes.first().map_or(0, |root| root.count));
        let root = (!self.nodes.is_empty()).then(|| self.convert(0, &mut order).0);
        Tree { root, order }
    }

    /// A node, and the expected number of tests below it times its surface.
    fn convert(&self, node: usize, order: &mut Vec<Reference>) -> (Node, f32) {
        let Growth { bounds, count, below } = &self.nodes[node];
        let first = order.len();
        let leaf_cost = *count as f32 * bounds.half_area();
        let inner = match below {
            Below::Prims(prims) => {
                order.extend(prims);
                None
            }
            Below::Nodes(children) => {
                let converted = children.iter().map(|&i| self.convert(i as usize, order));
                let (children, costs): (Vec<_>, Vec<_>) = converted.unzip();
                // Without them there would be one box to test instead of one a child.
                let more =
                    Block::ONE.node_cost() * (children.len() - 1) as f32 * bounds.half_area();
                let cost = more + costs.into_iter().sum::<f32>();
                (*count > MAX_SLOTS || cost < leaf_cost).then_some((children, cost))
            }
        };
        let (content, cost) = match inner {
            Some((children, cost)) => (Content::Inner(children.into()), cost),
            None => (Content::Leaf(first..order.len()), leaf_cost),
        };
        (Node { aabb: bounds.aabb(), content }, cost)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::geom::Triangle;

    /// Each is a little larger than all before: without a bound, 134 nodes deep.
    #[test]
    fn an_unkind_order_does_not_make_it_deep() {
        let triangle = |i: i32| {
            let size = 1.02f32.powi(i - 1000);
            let corners = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.3), Vec3::new(0.3, 1.0, 1.0)];
            Triangle { corners: corners.map(|corner| corner * size) }
        };
        let scene =
            Primitives { triangles: (0..2000).map(triangle).collect(), ..Primitives::default() };
        let references = Reference::all(&scene, &Sequential);
        let tree = Growing::new(&references).finish();
        assert_eq!(tree.root.expect("there are primitives").depth(), MAX_DEPTH);
        assert_eq!(tree.order.len(), scene.len());
    }
}
