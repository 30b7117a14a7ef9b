//! What is compared: something that traces rays, in one of its ways.

use std::fmt;
use std::time::Duration;

/// The instructions that both sides are limited to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Isa {
    /// SSE4.1 for us, 4.2 for Embree, which has nothing between it and SSE2.
    Sse4,
    Avx2,
    Avx512,
    /// What the CPU has and the compiler was told to use.
    Native,
}

impl Isa {
    pub(crate) const ALL: [Isa; 4] = [Isa::Sse4, Isa::Avx2, Isa::Avx512, Isa::Native];

    /// As in the JSON file.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Isa::Sse4 => "sse4",
            Isa::Avx2 => "avx2",
            Isa::Avx512 => "avx512",
            Isa::Native => "native",
        }
    }
}

impl fmt::Display for Isa {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Who traces, and how.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Mode {
    /// `rt`, `embree4`, …
    pub(crate) peer: &'static str,
    /// What it calls the way.
    pub(crate) name: String,
    /// The direction of the rays, where there is a choice.
    pub(crate) order: &'static str,
    /// Whether it is what one gets without asking.
    pub(crate) default: bool,
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Mode { name, order, .. } = self;
        let gap = if order.is_empty() { "" } else { ", " };
        f.pad(&format!("{name}{gap}{order}"))
    }
}

/// What it takes to have a hierarchy.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Built {
    pub(crate) time: Duration,
    /// With the hierarchy's copy of the triangles.
    pub(crate) bytes: usize,
}

/// The closest hit of a ray, or that there is one: then both are 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    pub(crate) t: f32,
    pub(crate) prim: u32,
}

/// A way to trace certain rays, which lie ready in the layout that it likes best.
pub(crate) trait Way {
    fn mode(&self) -> &Mode;

    /// Restores what a run overwrites. It is not timed.
    fn reset(&mut self) {}

    /// Traces all rays.
    fn run(&mut self);

    /// What the last run found, in the order of the rays.
    fn hits(&self) -> Vec<Option<Hit>>;
}
