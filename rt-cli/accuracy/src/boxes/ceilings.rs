//! What slab tests were found to get wrong, at most.

/// The worst of one kernel: no measurement may exceed it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ceiling {
    /// The method.
    pub kernel: &'static str,
    /// Its choices.
    pub variant: &'static str,
    /// False misses of a million rays, in the worst family.
    pub false_misses: f64,
    /// False hits of a million rays, in the worst family.
    pub false_hits: f64,
    /// The 99th percentile of the error of the entry, in units in the last place, near the origin.
    pub t_p99: f64,
}

/// All kernels of the catalogue.
pub const CEILINGS: [Ceiling; 0] = [];
