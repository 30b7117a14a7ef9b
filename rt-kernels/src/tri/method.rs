//! The triangle tests that render, to choose from at run time.

use super::knobs::{Division, Plain};
use super::{MollerTrumbore, Plucker, Record, TriangleKernel, Wald, Watertight};
use crate::geom::Triangle;

/// A triangle test that an accelerator is built for.
///
/// Each has one answer: its arithmetic is the same on every level, and its hits are held in the
/// triangle's own box ([the crate's documentation](crate#why-the-answer-is-one)). Only the default
/// leaks nothing; what the others misjudge near edges stands in their documentation.
/// `rt bench --kernels` shows what each saves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// [`Watertight`]: no leaks, at any distance from the origin.
    #[default]
    Watertight,
    /// [`MollerTrumbore`], signs first: leaks at edges.
    MollerTrumbore,
    /// [`Wald`]: leaks at edges, and more so far from the origin.
    Wald,
    /// [`Plucker`]: leaks at vertices.
    Plucker,
}

/// Evaluates an expression in which `$K` is the kernel of a method.
macro_rules! with_kernel {
    ($method:expr, $K:ident => $body:expr) => {
        match $method {
            $crate::tri::Method::Watertight => {
                type $K = $crate::tri::Watertight;
                $body
            }
            $crate::tri::Method::MollerTrumbore => {
                type $K = $crate::tri::method::MollerTrumboreMethod;
                $body
            }
            $crate::tri::Method::Wald => {
                type $K = $crate::tri::method::WaldMethod;
                $body
            }
            $crate::tri::Method::Plucker => {
                type $K = $crate::tri::method::PluckerMethod;
                $body
            }
        }
    };
}
pub(crate) use with_kernel;

pub(crate) type MollerTrumboreMethod = MollerTrumbore<Division, Plain, true, true>;
pub(crate) type WaldMethod = Wald<Division, Plain>;
pub(crate) type PluckerMethod = Plucker<Division, Plain>;

const _: () = assert!(
    <Watertight as TriangleKernel>::EXACT
        && MollerTrumboreMethod::EXACT
        && WaldMethod::EXACT
        && PluckerMethod::EXACT,
    "one answer on every level"
);

impl Method {
    /// All of them, the default first.
    pub const ALL: [Method; 4] =
        [Method::Watertight, Method::MollerTrumbore, Method::Wald, Method::Plucker];

    /// What it is called, on the command line too.
    pub fn name(self) -> &'static str {
        with_kernel!(self, K => K::NAME)
    }

    /// What its kernel keeps of a triangle.
    pub(crate) fn record(self, triangle: &Triangle, prim: u32) -> Record {
        with_kernel!(self, K => K::record(triangle, prim))
    }

    /// Whether its kernel holds hits in own boxes by itself.
    pub(crate) fn in_own_box(self) -> bool {
        with_kernel!(self, K => K::IN_OWN_BOX)
    }
}
