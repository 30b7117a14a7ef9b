//! Builders, all to one build tree: one file a method. A [`Builder`] is chosen at run time.
//!
//! Whatever the builder, the hits are the same; and no tree is deeper than a hundred nodes, however
//! unkind the scene, so that recursion is safe.

pub mod binned_sah;
mod builder;
pub mod goldsmith_salmon;
mod reference;
pub mod sah;
pub mod spatial_splits;
pub mod sweep_sah;

pub use builder::Builder;
pub(crate) use reference::{Bounds, Reference};
pub(crate) use sah::Block;

use std::ops::Range;

use crate::geom::Aabb;

/// Why a scene is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// A triangle names a vertex that is not there.
    #[error("primitive {prim} has the vertex {vertex}, but there are {vertices}")]
    NoVertex {
        /// The primitive's number.
        prim: usize,
        /// The vertex's.
        vertex: u32,
        /// How many there are.
        vertices: usize,
    },
    /// A coordinate is infinite or NaN.
    #[error("primitive {prim} has a coordinate that is not finite")]
    NotFinite {
        /// The primitive's number.
        prim: usize,
    },
    /// A coordinate is too large for the kernels' products.
    #[error("primitive {prim} has a coordinate greater than 2^40: scale the scene")]
    OutOfRange {
        /// The primitive's number.
        prim: usize,
    },
    /// A sphere's radius is 0 or less.
    #[error("primitive {prim} is a sphere without a radius")]
    NoRadius {
        /// The primitive's number.
        prim: usize,
    },
    /// A cone's ends are the same point, one of its radii is negative, or both are 0.
    #[error("primitive {prim} is a cone without a mantle")]
    NoMantle {
        /// The primitive's number.
        prim: usize,
    },
    /// There are more primitives than nodes can number.
    #[error("{primitives} primitives are too many: the limit is {limit}")]
    TooMany {
        /// How many there are.
        primitives: usize,
        /// How many there may be.
        limit: usize,
    },
}

/// Runs two things, at once if it likes: the caller's threads, handed to a builder.
pub trait Join: Sync {
    /// Runs both and returns both results.
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B);
}

/// One after the other.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sequential;

impl Join for Sequential {
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        (a(), b())
    }
}

/// The build tree.
pub(crate) struct Tree {
    /// `None` if there are no primitives.
    pub(crate) root: Option<Node>,
    /// All references; each leaf has a range of them. Those in no leaf mean nothing.
    pub(crate) order: Vec<Reference>,
}

/// A node of the build tree.
pub(crate) struct Node {
    /// The union of the boxes of all references below.
    pub(crate) aabb: Aabb,
    /// What is below.
    pub(crate) content: Content,
}

/// What is below a node.
pub(crate) enum Content {
    /// Two children or more.
    Inner(Box<[Node]>),
    /// A range of [`Tree::order`], not empty.
    Leaf(Range<usize>),
}

impl Node {
    /// The number of nodes on the longest way to a leaf.
    #[cfg(test)]
    fn depth(&self) -> usize {
        match &self.content {
            Content::Inner(children) => {
                1 + children.iter().map(Node::depth).max().unwrap_or_default()
            }
            Content::Leaf(_) => 1,
        }
    }

    /// Calls with every leaf.
    pub(crate) fn leaves(&self, leaf: &mut impl FnMut(&Node, Range<usize>)) {
        match &self.content {
            Content::Inner(children) => children.iter().for_each(|child| child.leaves(leaf)),
            Content::Leaf(range) => leaf(self, range.clone()),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::Primitives;
    use crate::bvh::layout::MAX_SLOTS;
    use crate::geom::Triangle;

    /// Around each other, each twice as large as the one before.
    fn nested() -> Primitives {
        let triangle = |i: i32| {
            let corners = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.5), Vec3::new(0.5, 1.0, 1.0)];
            Triangle { corners: corners.map(|corner| corner * 2.0f32.powi(i % 100 - 60)) }
        };
        Primitives { triangles: (0..1000).map(triangle).collect(), ..Primitives::default() }
    }

    /// Two heaps of triangles of all kinds, listed by turns.
    fn heaps() -> Primitives {
        let triangle = |i: usize| {
            let heap = Vec3::new(0.0, [0.0, 9.0][i % 2], 0.0);
            let at = |k: usize| (Vec3::new(0.61, 1.37, 2.71) * (i * k) as f32).map(f32::sin);
            Triangle { corners: [3, 5, 7].map(|k| at(k) + heap) }
        };
        Primitives { triangles: (0..500).map(triangle).collect(), ..Primitives::default() }
    }

    /// So that the depth is bounded, whatever the scene: the levels of the heuristic and these.
    #[test]
    fn below_the_levels_of_the_heuristic_splits_are_by_count() {
        let scene = nested();
        let bound = 1 + (scene.len() / MAX_SLOTS).ilog2() as usize + 1;
        let last = sah::SAH_DEPTH;
        let trees = |depth| {
            [
                binned_sah::build_from(&scene, Block::ONE, depth, &Sequential),
                sweep_sah::build_from(&scene, Block::ONE, depth, &Sequential),
                spatial_splits::build_from(&scene, Block::ONE, depth, &Sequential),
            ]
            .map(|tree| tree.root.expect("there are primitives").depth())
        };
        assert!(trees(0).into_iter().all(|depth| depth > 2 * bound), "{:?}", trees(0));
        assert_eq!(trees(last), [bound; 3]);
    }

    /// There is nothing to gain within a block, and no reason to part one.
    #[test]
    fn what_is_tested_at_once_is_not_split() {
        let scene = heaps();
        let eight = Primitives { triangles: scene.triangles[..8].into(), ..Primitives::default() };
        for builder in [Builder::BinnedSah, Builder::SweepSah, Builder::Spatial] {
            let leaves = |block| {
                let mut count = 0;
                let tree = builder.build(&eight, block, &Sequential);
                tree.root.expect("there are primitives").leaves(&mut |_, _| count += 1);
                count
            };
            assert!(leaves(Block::ONE) > 1, "{builder:?}");
            assert_eq!(leaves(Block::of(8)), 1, "{builder:?}");
            assert!(leaves(Block::of(4)) > 1, "{builder:?}");
        }
    }

    /// What the heuristic is for.
    #[test]
    fn two_heaps_are_two_subtrees() {
        for builder in [Builder::BinnedSah, Builder::SweepSah, Builder::Spatial] {
            let tree = builder.build(&heaps(), Block::ONE, &Sequential);
            let Some(Node { content: Content::Inner(children), .. }) = tree.root else {
                panic!("{builder:?} made one leaf of all");
            };
            for child in children {
                let [low, high] = child.aabb.axes[1];
                assert!(high - low < 4.0, "{builder:?}: from {low} to {high}");
            }
        }
    }

    #[test]
    fn every_primitive_is_in_a_leaf_and_every_box_in_its_node() {
        let scenes = [nested(), heaps()];
        let blocks = [Block::ONE, Block::of(8)];
        for (scene, (builder, block)) in scenes.iter().flat_map(|scene| {
            let ways = Builder::ALL.into_iter().flat_map(|builder| blocks.map(|b| (builder, b)));
            ways.map(move |way| (scene, way))
        }) {
            let tree = builder.build(scene, block, &Sequential);
            let mut found = vec![0; scene.len()];
            tree.root.expect("there are primitives").leaves(&mut |node, range| {
                for reference in &tree.order[range] {
                    found[reference.prim() as usize] += 1;
                    let aabb = reference.bounds().aabb();
                    assert_eq!(node.aabb.union(&aabb), node.aabb, "{builder:?}");
                }
            });
            let once = builder != Builder::Spatial;
            assert!(found.iter().all(|&n| if once { n == 1 } else { n >= 1 }), "{builder:?}");
        }
    }
}
