//! Lanes that mean the same on every CPU.
//!
//! The same program gives the same bits on SSE2, SSE4.1, AVX2, NEON and on plain scalar code.
//! [`spec`] holds the definition: one scalar function for each operation. Every level equals it
//! bit for bit in every lane, for every input; only which NaN a NaN result is remains open.
//!
//! # Three things to know
//!
//! * A **level** is a set of instructions: `scalar`, `sse2`, `sse4.1`, `avx2` (all of x86-64-v3),
//!   `neon`. [`Level`] is one that this CPU has, found once and then passed around.
//! * A **token** ([`Scalar`], `Sse2`, `Avx2`, …) is the proof of a level, of no size. Only
//!   detection hands it out, so safe code cannot run an instruction that the CPU lacks.
//! * A **kernel** is a generic function on a token's types. [`dispatch!`] compiles it once for
//!   each level and calls the one that the [`Level`] names.
//!
//! ```
//! use simd4::prelude::*;
//!
//! /// Multiplies every element by `factor`.
//! #[inline(always)]
//! fn scale<S: Simd>(s: S, factor: f32, xs: &mut [f32]) {
//!     let factor = S::f32s::splat(s, factor);
//!     let mut chunks = xs.chunks_exact_mut(S::LANES);
//!     for chunk in &mut chunks {
//!         (S::f32s::load(s, chunk) * factor).store(chunk);
//!     }
//!     let rest = chunks.into_remainder();
//!     (S::f32s::load_prefix(s, rest, 0.0) * factor).store_prefix(rest);
//! }
//!
//! let mut xs = [1.0, 2.0, 3.0, 4.0, 5.0];
//! let level = Level::best()?;
//! simd4::dispatch!(level, s => scale(s, 2.0, &mut xs));
//! assert_eq!(xs, [2.0, 4.0, 6.0, 8.0, 10.0]);
//! # Ok::<(), simd4::LevelError>(())
//! ```
//!
//! Without dispatch, [`f32x4`] and its kin at the root are the best types that the build itself
//! guarantees:
//!
//! ```
//! use simd4::{f32x4, prelude::*};
//!
//! let a = f32x4::from([1.0, 2.0, 3.0, 4.0]);
//! let b = a * a + f32x4::from(0.5);
//! assert_eq!(b.to_array(), [1.5, 4.5, 9.5, 16.5]);
//! ```
//!
//! # The rules
//!
//! * Lane 0 is the lowest address. `f32x4` is always four lanes, `f32x8` always eight;
//!   `S::f32s` is the level's native width, [`Simd::LANES`].
//! * Arithmetic is IEEE 754, rounded to nearest even, subnormals kept, and never contracted into
//!   fused operations.
//! * `min(a, b)` is `a < b ? a : b` and `max(a, b)` is `a > b ? a : b`: a NaN in either operand
//!   gives `b`, and so do zeros of different sign.
//! * Comparisons are ordered and quiet; only `ne` is true on NaN.
//! * Masks are types of their own, never floats.
//!
//! # The pit
//!
//! Instructions beyond the baseline are inlined only into functions compiled for them. In a
//! kernel mark **every** function `#[inline(always)]`, down from what is dispatched, and write no
//! closures but those passed straight to an `#[inline(always)]` function: a helper that is not
//! inlined is compiled for the baseline, calls every operation as a function, and runs fifty
//! times slower.
#![cfg_attr(not(feature = "std"), no_std)]

mod arch;
#[cfg(feature = "std")]
pub mod check;
mod dispatch;
mod level;
pub mod math;
mod simd;
pub mod spec;
mod storage;
mod types;

pub use arch::native::{
    f32x4, f32x8, f32x16, i32x4, i32x8, i32x16, mask32x4, mask32x8, mask32x16, u32x4, u32x8, u32x16,
};
pub use arch::tokens::*;
pub use level::{Level, LevelError};
pub use simd::{Guaranteed, Simd};
#[cfg(feature = "std")]
pub use storage::AlignedBuf;
pub use storage::{Block, Block4, Block8, Block16};
pub use types::{
    Element, Halves, LaneArray, Lanes, SimdF32, SimdI32, SimdInt, SimdMask, SimdU32, Swizzle, Wide,
};

pub use arch::scalar;

/// All traits and [`Level`]: what a file that writes kernels imports.
pub mod prelude {
    pub use crate::{
        Guaranteed, Lanes, Level, Simd, SimdF32, SimdI32, SimdInt, SimdMask, SimdU32, Wide,
    };
}
