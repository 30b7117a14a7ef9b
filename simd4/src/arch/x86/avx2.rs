//! AVX2 with all of x86-64-v3: registers of eight lanes.

#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;

use super::super::{proven, token};
use super::xmm::{self, Xmm};
use super::ymm::{self, Ymm};
use crate::{Halves, Level, Simd};

token! {
    /// The token of the level `avx2`.
    Avx2, is_x86_feature_detected,
    ["avx2", "fma", "bmi1", "bmi2", "lzcnt", "popcnt", "f16c", "movbe"]
}

impl Simd for Avx2 {
    type f32x4 = xmm::f32x4<Self>;
    type i32x4 = xmm::i32x4<Self>;
    type u32x4 = xmm::u32x4<Self>;
    type mask32x4 = xmm::mask32x4<Self>;
    type f32x8 = ymm::f32x8<Self>;
    type i32x8 = ymm::i32x8<Self>;
    type u32x8 = ymm::u32x8<Self>;
    type mask32x8 = ymm::mask32x8<Self>;
    type f32x16 = Halves<Self::f32x8>;
    type i32x16 = Halves<Self::i32x8>;
    type u32x16 = Halves<Self::u32x8>;
    type mask32x16 = Halves<Self::mask32x8>;
    type f32s = Self::f32x8;
    type i32s = Self::i32x8;
    type u32s = Self::u32x8;
    type mask32s = Self::mask32x8;

    #[inline(always)]
    fn level(self) -> Level {
        Level::Avx2(self)
    }

    #[inline(always)]
    fn prefetch<T>(self, at: *const T) {
        super::prefetch(at);
    }

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt,f16c,movbe")]
        fn avx2<R>(f: impl FnOnce() -> R) -> R {
            f()
        }
        proven!(avx2(f))
    }
}

impl Xmm for Avx2 {
    #[inline(always)]
    fn permute(self, u: xmm::u32x4<Self>, order: xmm::u32x4<Self>) -> xmm::u32x4<Self> {
        let lanes = proven!(_mm_permutevar_ps(_mm_castsi128_ps(u.0), order.0));
        xmm::u32x4(proven!(_mm_castps_si128(lanes)), self)
    }

    const FUSED: bool = true;

    #[inline(always)]
    fn fused_mul_add(self, a: __m128, b: __m128, c: __m128) -> __m128 {
        proven!(_mm_fmadd_ps(a, b, c))
    }
}

impl Ymm for Avx2 {}
