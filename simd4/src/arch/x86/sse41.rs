//! SSE4.1: blends, and the integer operations that SSE2 lacks.

use super::super::{proven, token};
use super::xmm::{self, Xmm};
use crate::{Halves, Level, Simd};

token! {
    /// The token of the level `sse4.1`.
    Sse41, is_x86_feature_detected, ["sse4.1"]
}

impl Simd for Sse41 {
    type f32x4 = xmm::f32x4<Self>;
    type i32x4 = xmm::i32x4<Self>;
    type u32x4 = xmm::u32x4<Self>;
    type mask32x4 = xmm::mask32x4<Self>;
    type f32x8 = Halves<Self::f32x4>;
    type i32x8 = Halves<Self::i32x4>;
    type u32x8 = Halves<Self::u32x4>;
    type mask32x8 = Halves<Self::mask32x4>;
    type f32x16 = Halves<Self::f32x8>;
    type i32x16 = Halves<Self::i32x8>;
    type u32x16 = Halves<Self::u32x8>;
    type mask32x16 = Halves<Self::mask32x8>;
    type f32s = Self::f32x4;
    type i32s = Self::i32x4;
    type u32s = Self::u32x4;
    type mask32s = Self::mask32x4;

    #[inline(always)]
    fn level(self) -> Level {
        Level::Sse41(self)
    }

    #[inline(always)]
    fn prefetch<T>(self, at: *const T) {
        super::prefetch(at);
    }

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "sse4.1")]
        fn sse41<R>(f: impl FnOnce() -> R) -> R {
            f()
        }
        proven!(sse41(f))
    }
}

impl Xmm for Sse41 {}
