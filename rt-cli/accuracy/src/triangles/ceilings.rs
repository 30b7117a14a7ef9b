//! What kernels were found to get wrong, at most.

/// The worst of one kernel: no measurement may exceed it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ceiling {
    /// The method.
    pub kernel: &'static str,
    /// Its choices.
    pub variant: &'static str,
    /// Leaks of a million rays, in the worst closed family.
    pub leaks: f64,
    /// The 99th percentile of the error of `t`, in units in the last place, near the origin.
    pub t_p99: f64,
    /// The band in which rays are misjudged near the origin.
    pub band: f64,
}

/// All kernels of the catalogue.
pub const CEILINGS: [Ceiling; 0] = [];
