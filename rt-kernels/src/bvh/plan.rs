//! What there is to choose of a hierarchy.

use super::Builder;
use super::build::Block;
use crate::Primitives;
use crate::tri::Method;

/// What hierarchy to build. The hits depend on the triangle test alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Plan {
    /// How it is built.
    pub builder: Builder,
    /// How it lies in memory, as far as there is code for the triangle test: see
    /// [`Plan::layout`].
    pub layout: Layout,
    /// The triangle test.
    pub method: Method,
}

impl Plan {
    /// The layout that it comes to: wide nodes are for the default triangle test alone.
    pub fn layout(&self) -> Layout {
        if self.method == Method::default() { self.layout } else { Layout::Skip }
    }
}

/// How a hierarchy lies in memory, and with that how it is traversed. The hits do not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Layout {
    /// Eight children a node ([`Wide`](super::layout::Wide)): for all rays, many together or one by
    /// one.
    #[default]
    Bvh8,
    /// Four children a node.
    Bvh4,
    /// Depth first with skip pointers ([`SkipArray`](super::layout::SkipArray)): for rays in packets,
    /// and for triangle tests other than the default.
    Skip,
}

impl Layout {
    /// All of them, the default first.
    pub const ALL: [Layout; 3] = [Layout::Bvh8, Layout::Bvh4, Layout::Skip];

    /// What it is called, on the command line too.
    pub fn name(self) -> &'static str {
        match self {
            Layout::Skip => "skip",
            Layout::Bvh4 => "bvh4",
            Layout::Bvh8 => "bvh8",
        }
    }

    /// How many of these primitives it tests at once: triangles as many as a node has children, others
    /// one by one.
    pub(super) fn block(self, primitives: &Primitives) -> Block {
        let [_, others @ ..] = primitives.counts();
        match self {
            Layout::Bvh4 if others == [0; 2] => Block::of(4),
            Layout::Bvh8 if others == [0; 2] => Block::of(8),
            _ => Block::ONE,
        }
    }
}
