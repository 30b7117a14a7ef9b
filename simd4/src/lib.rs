//! Lanes that mean the same on every CPU.
//!
//! The same program gives the same bits on SSE2, SSE4.1, AVX2, AVX-512, NEON, WebAssembly's simd128
//! and on plain scalar code. [`spec`] holds the definition: one scalar function for each operation. Every level equals it
//! bit for bit in every lane, for every input; only which NaN a NaN result is remains open.
//!
//! # Three things to know
//!
//! * A **level** is a set of instructions, from `scalar` over `sse2` to `avx512`, or `neon`, or
//!   `simd128`. [`Level`] is one that this CPU has, found once and then passed around.
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
//! * **Lanes.** Lane 0 is the lowest address. `f32x4` is always four lanes, `f32x8` eight, `f32x16`
//!   sixteen, out of several registers where one is too narrow; `S::f32s` is the level's native
//!   width, [`Simd::LANES`] lanes.
//! * **Rounding.** Arithmetic is IEEE 754, rounded to nearest even, with subnormals.
//! * **Fusing.** Never unasked. `mul_add` and its kin round twice everywhere, `fused_mul_add` and
//!   its kin once everywhere, by emulation where the CPU cannot; `mul_add_fast` and its kin do
//!   what is faster.
//! * **NaN.** `min(a, b)` is `a < b ? a : b` and `max(a, b)` is `a > b ? a : b`: a NaN in either
//!   operand gives `b`. `min_num` and `max_num` prefer the number. Comparisons are ordered and
//!   quiet; only `ne` is true on NaN. Which NaN a NaN result is remains open.
//! * **Signed zeros** compare equal, so `min` and `max` of two give `b`; `min_num` and `max_num`
//!   tell them apart. Rounding to integers keeps the sign of zero.
//! * **Reductions** fold lane `i` with lane `i + n / 2` until one is left, on every level.
//! * **Conversions** to integers are Rust's `as`: toward zero, saturating, NaN to 0.
//! * **Shifts** by 32 and more give 0, or the sign.
//! * **Masks** are types of their own, never floats; one bit a lane where the CPU has it so.
//! * **Bounds.** Nothing reads or writes past a slice; what does not fit panics.
//!
//! Only operations whose names end in `_est` and `_fast` may differ between levels, within the
//! bounds that they state. [`check::levels_agree`] shows that a kernel of your own keeps the
//! promise too.
//!
//! # The levels
//!
//! | level | CPUs | lanes | found | guaranteed by a build for |
//! |---|---|---:|---|---|
//! | `scalar` | all | 4 | always | everything |
//! | `sse2` | x86-64, most of x86 | 4 | at run time | x86-64 |
//! | `sse4.1` | since 2008 | 4 | at run time | x86-64-v2 |
//! | `avx2` | x86-64-v3: with FMA, BMI1, BMI2, LZCNT, POPCNT, F16C, MOVBE | 8 | at run time | x86-64-v3 |
//! | `avx512` | x86-64-v4: F, BW, CD, DQ, VL | 16 | at run time | x86-64-v4 |
//! | `neon` | AArch64 | 4 | at run time | AArch64 |
//! | `simd128` | WebAssembly | 4 | when compiling | `-C target-feature=+simd128` |
//!
//! What each operation is compiled to at each level: [`instructions`].
//!
//! AVX without AVX2 and FMA falls back to `sse4.1`. 32-bit ARM has no level, since its NEON flushes
//! subnormals; AltiVec (which the paper that this crate began with had), RVV and SVE have none
//! because their intrinsics are for nightly Rust alone: there the scalar level runs, as the
//! compiler vectorises it. When stable Rust reaches one of them, it is a file in `arch` and a line
//! in each list of levels; kernels that are written for any level stay as they are.
//!
//! For AltiVec that loses less than it seems. Of the sample kernels in `simd4/probe`, built for
//! powerpc64le, `dot` and `normalize` do all their arithmetic on four lanes at once (`xvmulsp`,
//! `xvaddsp`, `xvdivsp`, `xvsqrtsp`: VSX, which has AltiVec's registers and as many more), `slab`
//! all but 6 instructions of 165 (`xvmaxsp`, `xvcmpgtsp`, AltiVec's own `vadduwm`); `argmin` is
//! scalar. So is an operation whose lanes come in registers and not in memory (four `xsmulsp`).
//! To see it:
//!
//! ```sh
//! rustup target add powerpc64le-unknown-linux-gnu
//! cargo rustc --release --lib -p simd4-probe --target powerpc64le-unknown-linux-gnu -- \
//!     --emit asm -Ccodegen-units=1 -Cdebuginfo=0
//! ```
//!
//! A build leaves out what is weaker than the level that it guarantees, but for `scalar`: with
//! `-C target-cpu=x86-64-v3` there are `scalar`, `avx2` and `avx512`. Code is compiled for no other,
//! so such builds are smaller and take less time.
//!
//! `Level::best` takes the last that the CPU has, or the one that the environment variable
//! `SIMD4_LEVEL` names. Without the default feature `std` there is neither detection nor
//! environment: levels are then those that the build guarantees.
//!
//! # Levels cannot be forged
//!
//! A token has no public constructor, and the trait is sealed:
//!
//! ```compile_fail
//! let token = simd4::Sse2 { _private: () };
//! ```
//!
//! ```compile_fail
//! #[derive(Clone, Copy, Debug)]
//! struct Mine;
//! impl simd4::Guaranteed for Mine {
//!     const TOKEN: Self = Mine;
//! }
//! ```
//!
//! Nor does a vector of a level come from nowhere, by `Default` or out of bytes; what is kept in
//! memory are blocks ([`Block4`], [`Block8`], [`Block16`]) and the [`AlignedBuf`].
//!
//! # The pit
//!
//! Instructions beyond the baseline are inlined only into functions compiled for them, and on
//! stable Rust a closure or a plain helper inside a kernel is not one. If it is not inlined itself
//! it calls every operation as a function, and runs fifty times slower; whether it is inlined is
//! decided by its size. So in a kernel:
//!
//! * mark **every** function `#[inline(always)]`, from what is dispatched down;
//! * write loops, not iterator chains: `map` and `for_each` take closures through functions that
//!   are not yours to mark;
//! * where a closure must be, pass it straight to an `#[inline(always)]` function, with the
//!   attribute on the closure expression too.
//!
//! What fell in shows in a release binary: `nm -C BINARY | grep core_arch` lists intrinsics that
//! became functions, and should list none but `_xgetbv`.
#![cfg_attr(not(feature = "std"), no_std)]

mod arch;
#[cfg(feature = "std")]
pub mod check;
mod dispatch;
// Not for the compiler: the table is made of what that makes of this crate.
#[cfg(doc)]
#[doc = include_str!("../INSTRUCTIONS.md")]
pub mod instructions {}
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

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
