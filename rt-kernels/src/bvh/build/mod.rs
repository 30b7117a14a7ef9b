//! Builders, all to one build tree: one file a method.

pub mod binned_sah;

use std::ops::Range;

use crate::geom::Aabb;

/// Why a scene is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
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

/// A primitive in a builder's hands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reference {
    /// Its own box.
    pub(crate) aabb: Aabb,
    /// Its number.
    pub(crate) prim: u32,
}

/// The build tree.
#[derive(Debug)]
pub(crate) struct Tree {
    /// `None` if there are no primitives.
    pub(crate) root: Option<Node>,
    /// All references; each leaf has a range of them.
    pub(crate) order: Vec<Reference>,
}

/// A node of the build tree.
#[derive(Debug)]
pub(crate) struct Node {
    /// The union of all own boxes below.
    pub(crate) aabb: Aabb,
    /// What is below.
    pub(crate) content: Content,
}

/// What is below a node.
#[derive(Debug)]
pub(crate) enum Content {
    /// Two children.
    Inner(Box<[Node; 2]>),
    /// A range of [`Tree::order`], not empty.
    Leaf(Range<usize>),
}
