//! AVX-512 with all of x86-64-v4: registers of sixteen lanes, masks of one bit a lane.
//!
//! The types of 4 and 8 lanes are those of `avx2`, masks in vector registers included: their
//! comparisons and blends need no mask register, and a mask that stays in vectors moves nowhere.
//! LLVM is free to use the new forms of their instructions all the same. They blend bit by bit,
//! which is one instruction here, vpternlog; of blendv LLVM would make two, by way of a mask
//! register.

#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;

use super::super::{proven, token};
use super::xmm::{self, Xmm};
use super::ymm::{self, Ymm};
use super::zmm::{self, Zmm};
use crate::{Level, Simd};

token! {
    /// The token of the level `avx512`.
    Avx512, is_x86_feature_detected,
    [
        "avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl",
        "avx2", "fma", "bmi1", "bmi2", "lzcnt", "popcnt", "f16c", "movbe"
    ]
}

impl Simd for Avx512 {
    type f32x4 = xmm::f32x4<Self>;
    type i32x4 = xmm::i32x4<Self>;
    type u32x4 = xmm::u32x4<Self>;
    type mask32x4 = xmm::mask32x4<Self>;
    type f32x8 = ymm::f32x8<Self>;
    type i32x8 = ymm::i32x8<Self>;
    type u32x8 = ymm::u32x8<Self>;
    type mask32x8 = ymm::mask32x8<Self>;
    type f32x16 = zmm::f32x16<Self>;
    type i32x16 = zmm::i32x16<Self>;
    type u32x16 = zmm::u32x16<Self>;
    type mask32x16 = zmm::mask32x16<Self>;
    type f32s = Self::f32x16;
    type i32s = Self::i32x16;
    type u32s = Self::u32x16;
    type mask32s = Self::mask32x16;

    #[inline(always)]
    fn level(self) -> Level {
        Level::Avx512(self)
    }

    #[inline(always)]
    fn prefetch<T>(self, at: *const T) {
        super::prefetch(at);
    }

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "avx512f,avx512bw,avx512cd,avx512dq,avx512vl")]
        #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt,f16c,movbe")]
        fn avx512<R>(f: impl FnOnce() -> R) -> R {
            f()
        }
        proven!(avx512(f))
    }
}

impl Xmm for Avx512 {
    #[inline(always)]
    fn blend(self, m: __m128, a: __m128, b: __m128) -> __m128 {
        proven!(_mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b)))
    }
    #[inline(always)]
    fn blend_i32(self, m: __m128i, a: __m128i, b: __m128i) -> __m128i {
        proven!(_mm_or_si128(_mm_and_si128(m, a), _mm_andnot_si128(m, b)))
    }
    #[inline(always)]
    fn u32_to_f32(self, u: xmm::u32x4<Self>) -> xmm::f32x4<Self> {
        // There is no intrinsic for the instruction of fewer lanes; LLVM knows it.
        let wide = proven!(_mm512_cvtepu32_ps(_mm512_castsi128_si512(u.0)));
        xmm::f32x4(proven!(_mm512_castps512_ps128(wide)), self)
    }
    #[inline(always)]
    fn f32_to_u32(self, x: xmm::f32x4<Self>) -> xmm::u32x4<Self> {
        // What is not above zero, NaN too, becomes 0; what is too great becomes all ones.
        xmm::u32x4(proven!(_mm_cvttps_epu32(_mm_max_ps(x.0, _mm_setzero_ps()))), self)
    }
    #[inline(always)]
    fn f32_to_u32_fast(self, x: xmm::f32x4<Self>) -> xmm::u32x4<Self> {
        xmm::u32x4(proven!(_mm_cvttps_epu32(x.0)), self)
    }

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

impl Ymm for Avx512 {
    #[inline(always)]
    fn blend(self, m: __m256, a: __m256, b: __m256) -> __m256 {
        proven!(_mm256_or_ps(_mm256_and_ps(m, a), _mm256_andnot_ps(m, b)))
    }
    #[inline(always)]
    fn blend_i32(self, m: __m256i, a: __m256i, b: __m256i) -> __m256i {
        proven!(_mm256_or_si256(_mm256_and_si256(m, a), _mm256_andnot_si256(m, b)))
    }
    #[inline(always)]
    fn u32_to_f32(self, u: ymm::u32x8<Self>) -> ymm::f32x8<Self> {
        let wide = proven!(_mm512_cvtepu32_ps(_mm512_castsi256_si512(u.0)));
        ymm::f32x8(proven!(_mm512_castps512_ps256(wide)), self)
    }
    #[inline(always)]
    fn f32_to_u32(self, x: ymm::f32x8<Self>) -> ymm::u32x8<Self> {
        ymm::u32x8(proven!(_mm256_cvttps_epu32(_mm256_max_ps(x.0, _mm256_setzero_ps()))), self)
    }
    #[inline(always)]
    fn f32_to_u32_fast(self, x: ymm::f32x8<Self>) -> ymm::u32x8<Self> {
        ymm::u32x8(proven!(_mm256_cvttps_epu32(x.0)), self)
    }
}

impl Zmm for Avx512 {}
