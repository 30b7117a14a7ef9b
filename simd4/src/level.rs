//! Which levels there are, and which of them this CPU has.

use core::fmt;

use crate::arch::{native::Best, tokens::*};
use crate::{Guaranteed, Simd};

/// A level that this CPU has. The token inside is the proof: no other code can make one.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Level {
    /// Plain scalar code, in every build, and what vector units run that stable Rust does not
    /// reach, as the compiler vectorises it. AltiVec is one: its intrinsics are for nightly alone.
    /// What becomes of this level there, [the crate's documentation](crate#the-levels) says.
    Scalar(Scalar),
    /// SSE2: the baseline of x86-64.
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    Sse2(Sse2),
    /// SSE4.1.
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    Sse41(Sse41),
    /// AVX2 with all of x86-64-v3: FMA, BMI1, BMI2, LZCNT, POPCNT, F16C, MOVBE.
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    Avx2(Avx2),
    /// AVX-512 with all of x86-64-v4: F, BW, CD, DQ and VL on top of [`Level::Avx2`].
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    Avx512(Avx512),
    /// NEON: the baseline of AArch64.
    #[cfg(target_arch = "aarch64")]
    Neon(Neon),
    /// WebAssembly's fixed-width SIMD, in builds that enable it.
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    Simd128(Simd128),
}

impl Level {
    /// The names of all levels, of every architecture: what [`Level::named`] may be asked for.
    pub const NAMES: [&str; 7] = ["scalar", "sse2", "sse4.1", "avx2", "avx512", "neon", "simd128"];

    /// All levels of this architecture, weakest first; `None` for those that the CPU lacks.
    fn detect() -> impl DoubleEndedIterator<Item = Option<Level>> {
        [
            Some(Level::Scalar(Scalar::new())),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Sse2::detect().map(Level::Sse2),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Sse41::detect().map(Level::Sse41),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Avx2::detect().map(Level::Avx2),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Avx512::detect().map(Level::Avx512),
            #[cfg(target_arch = "aarch64")]
            Neon::detect().map(Level::Neon),
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Simd128::detect().map(Level::Simd128),
        ]
        .into_iter()
    }

    /// The levels that this CPU has and the build does not leave out, weakest first. Never empty: the
    /// first is always `scalar`.
    ///
    /// Without the feature `std` these are the ones that the build guarantees.
    pub fn available() -> impl DoubleEndedIterator<Item = Level> {
        Self::detect().flatten().filter(|level| !level.is_left_out())
    }

    /// Whether the build leaves it out: the build guarantees a better one.
    fn is_left_out(self) -> bool {
        match self {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse2(_) => Sse2::LEFT_OUT,
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse41(_) => Sse41::LEFT_OUT,
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx2(_) => Avx2::LEFT_OUT,
            _ => false,
        }
    }

    /// Itself, or the level that the build guarantees where it leaves this one out.
    #[doc(hidden)]
    pub fn in_this_build(self) -> Level {
        if self.is_left_out() { Best::TOKEN.level() } else { self }
    }

    /// The best level of this CPU, or the one that the environment variable `SIMD4_LEVEL` names
    /// if it is set and not empty.
    ///
    /// # Errors
    /// As [`named`](Self::named), if `SIMD4_LEVEL` is set.
    pub fn best() -> Result<Level, LevelError> {
        #[cfg(feature = "std")]
        if let Some(name) = std::env::var_os("SIMD4_LEVEL").filter(|name| !name.is_empty()) {
            return Self::named(&name.to_string_lossy());
        }
        Ok(Self::available().next_back().expect("scalar is always there"))
    }

    /// The level of that [name](Level::name).
    ///
    /// # Errors
    /// If there is no such level, this CPU lacks it, or the build leaves it out. The error lists those
    /// there are.
    pub fn named(name: &str) -> Result<Level, LevelError> {
        match Self::detect().flatten().find(|level| level.name() == name) {
            Some(level) if level.is_left_out() => Err(LevelError::LeftOut(level.name())),
            Some(level) => Ok(level),
            None => match Self::NAMES.into_iter().find(|known| *known == name) {
                Some(known) => Err(LevelError::Lacking(known)),
                None => Err(LevelError::Unknown),
            },
        }
    }

    /// `scalar`, `sse2`, `sse4.1`, `avx2`, `avx512`, `neon` or `simd128`.
    pub fn name(self) -> &'static str {
        match self {
            Level::Scalar(_) => "scalar",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse2(_) => "sse2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse41(_) => "sse4.1",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx2(_) => "avx2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx512(_) => "avx512",
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => "neon",
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Level::Simd128(_) => "simd128",
        }
    }

    /// The number of `f32` lanes in one register of this level, [`Simd::LANES`].
    pub fn lanes(self) -> usize {
        #[inline(always)]
        fn lanes<S: Simd>(_: S) -> usize {
            S::LANES
        }
        crate::dispatch!(self, s => lanes(s))
    }
}

impl PartialEq for Level {
    fn eq(&self, other: &Level) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Level {}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A level was asked for that is not [there](Level::available).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LevelError {
    /// There is none of that name.
    Unknown,
    /// The CPU lacks the level of that name.
    Lacking(&'static str),
    /// The build [leaves out](crate#the-levels) the level of that name.
    LeftOut(&'static str),
}

impl fmt::Display for LevelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LevelError::Unknown => write!(f, "there is no such level; this CPU has")?,
            LevelError::Lacking(name) => write!(f, "this CPU lacks the level {name}; it has")?,
            LevelError::LeftOut(name) => {
                let better = Best::TOKEN.level();
                write!(f, "this build, for CPUs with {better}, leaves out {name}; there are")?;
            }
        }
        for (i, level) in Level::available().enumerate() {
            write!(f, "{} {level}", if i == 0 { "" } else { "," })?;
        }
        Ok(())
    }
}

impl core::error::Error for LevelError {}
