//! The builders, to choose from at run time.

use super::{Block, Join, Tree, binned_sah, goldsmith_salmon, spatial_splits, sweep_sah};
use crate::primitives::Primitives;

/// How a hierarchy is built. The hits do not depend on it, the time to find them does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Builder {
    /// The surface area heuristic at the borders of bins ([`binned_sah`]): quick to build, quick to
    /// trace.
    #[default]
    BinnedSah,
    /// The surface area heuristic between all neighbours ([`sweep_sah`]).
    SweepSah,
    /// One primitive after the other ([`goldsmith_salmon`]).
    Insertion,
    /// Boxes may be cut, and their primitives be in several leaves ([`spatial_splits`]): for scenes
    /// in which large primitives lie among small ones.
    Spatial,
}

impl Builder {
    /// All of them, the default first.
    pub const ALL: [Builder; 4] =
        [Builder::BinnedSah, Builder::SweepSah, Builder::Insertion, Builder::Spatial];

    /// What it is called, on the command line too.
    pub fn name(self) -> &'static str {
        match self {
            Builder::BinnedSah => "binned-sah",
            Builder::SweepSah => "sweep-sah",
            Builder::Insertion => "insertion",
            Builder::Spatial => "spatial",
        }
    }

    /// Builds the tree of all primitives, which are tested in such blocks. It is the same for any
    /// `join`.
    pub(crate) fn build(self, primitives: &Primitives, block: Block, join: &impl Join) -> Tree {
        match self {
            Builder::BinnedSah => binned_sah::build(primitives, block, join),
            Builder::SweepSah => sweep_sah::build(primitives, block, join),
            Builder::Insertion => goldsmith_salmon::build(primitives),
            Builder::Spatial => spatial_splits::build(primitives, block, join),
        }
    }
}
