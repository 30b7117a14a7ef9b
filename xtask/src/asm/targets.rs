//! The targets that are compiled for reading, and their levels.

use super::text::Arch;

/// A target.
#[derive(Debug)]
pub(crate) struct Target {
    pub(crate) arch: Arch,
    /// The architecture's name, for reports.
    pub(crate) name: &'static str,
    /// What cargo is told. Nothing is linked, so its standard library is all that it takes.
    pub(crate) triple: &'static str,
    /// What the compiler has to be told beside, where there is no detection at run time.
    pub(crate) rustflags: &'static str,
    /// The levels that the instruction table shows.
    pub(crate) levels: &'static [Level],
}

/// A level of vector instructions.
#[derive(Debug)]
pub(crate) struct Level {
    pub(crate) name: &'static str,
    /// Its module in the probe, and its file in simd4.
    pub(crate) module: &'static str,
    /// The lanes of one register.
    pub(crate) lanes: usize,
}

pub(crate) const X86_64: Target = Target {
    arch: Arch::X86,
    name: "x86_64",
    triple: "x86_64-unknown-linux-gnu",
    rustflags: "",
    levels: &[
        Level { name: "sse2", module: "sse2", lanes: 4 },
        Level { name: "sse4.1", module: "sse41", lanes: 4 },
        Level { name: "avx2", module: "avx2", lanes: 8 },
        Level { name: "avx512", module: "avx512", lanes: 16 },
    ],
};

pub(crate) const TARGETS: [Target; 3] = [
    X86_64,
    Target {
        arch: Arch::Arm,
        name: "aarch64",
        triple: "aarch64-unknown-linux-musl",
        rustflags: "",
        levels: &[Level { name: "neon", module: "neon", lanes: 4 }],
    },
    Target {
        arch: Arch::Wasm,
        name: "wasm32",
        triple: "wasm32-wasip1",
        rustflags: "-Ctarget-feature=+simd128",
        levels: &[Level { name: "simd128", module: "simd128", lanes: 4 }],
    },
];

/// The name of the level that a function is of, if its path has one: as the module of the probe,
/// or as the file of a token among its types.
pub(crate) fn of_path(path: &str) -> Option<&'static str> {
    let names = TARGETS.iter().flat_map(|target| target.levels);
    let names = names.map(|level| (level.name, level.module)).chain([("scalar", "scalar")]);
    let part = |module: &str| path.contains(&format!("::{module}::"));
    names.filter(|(_, module)| path.contains("simd4") && part(module)).map(|(name, _)| name).next()
}

#[cfg(test)]
mod tests {
    use super::of_path;

    #[test]
    fn levels_are_found_in_paths() {
        for (path, level) in [
            ("simd4_probe::ops::sse41::f32x4::floor", Some("sse4.1")),
            (
                "<simd4::arch::x86::avx2::Avx2 as simd4::simd::Simd>::vectorize::avx2::<(), \
                 simd4_probe::kernels::x8::dot::{closure#3}>",
                Some("avx2"),
            ),
            ("simd4_probe::ops::scalar::f32x4::add", Some("scalar")),
            ("simd4_probe::kernels::x8::dot", None),
            ("core::core_arch::x86::avx2::_mm256_add_epi32", None),
        ] {
            assert_eq!(of_path(path), level, "{path}");
        }
    }
}
