//! The targets that are compiled for reading, and their levels.

use super::text::Arch;

/// A target.
#[derive(Debug)]
pub(crate) struct Target {
    pub(crate) arch: Arch,
    /// The architecture's name, for reports.
    pub(crate) name: &'static str,
    /// What cargo is told. Nothing is linked, so the standard library is all that it takes.
    pub(crate) triple: &'static str,
    /// The levels that the instruction table shows.
    pub(crate) levels: &'static [Level],
}

/// A level.
#[derive(Debug)]
pub(crate) struct Level {
    pub(crate) name: &'static str,
    /// Its module in the probe.
    pub(crate) module: &'static str,
    /// The lanes of one register.
    pub(crate) lanes: usize,
}

pub(crate) const TARGETS: [Target; 3] = [
    Target {
        arch: Arch::X86,
        name: "x86_64",
        triple: "x86_64-unknown-linux-gnu",
        levels: &[
            Level { name: "sse2", module: "sse2", lanes: 4 },
            Level { name: "sse4.1", module: "sse41", lanes: 4 },
            Level { name: "avx2", module: "avx2", lanes: 8 },
        ],
    },
    Target {
        arch: Arch::Arm,
        name: "aarch64",
        triple: "aarch64-unknown-linux-musl",
        levels: &[Level { name: "neon", module: "neon", lanes: 4 }],
    },
    Target { arch: Arch::Wasm, name: "wasm32", triple: "wasm32-wasip1", levels: &[] },
];

/// The level of a function, from its path: the probe's module, or the token among its types.
pub(crate) fn of_path(path: &str) -> Option<&'static str> {
    let levels = TARGETS.iter().flat_map(|target| target.levels);
    let of = |module: &str| {
        let file = format!("::{module}::");
        path.contains("simd4") && path.contains(&file)
    };
    levels.filter(|level| of(level.module)).map(|level| level.name).next_back().or_else(|| of("scalar").then_some("scalar"))
}
