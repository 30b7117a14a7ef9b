//! SSE2: the baseline of x86-64, and what it lacks of the later levels.

#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;

use super::super::{proven, token};
use super::xmm::{self, Xmm};
use crate::types::soft;
use crate::{Halves, Level, Simd};

token! {
    /// The token of the level `sse2`.
    Sse2, is_x86_feature_detected, ["sse2"]
}

impl Simd for Sse2 {
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
        Level::Sse2(self)
    }

    #[inline(always)]
    fn prefetch<T>(self, at: *const T) {
        super::prefetch(at);
    }

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "sse2")]
        fn sse2<R>(f: impl FnOnce() -> R) -> R {
            f()
        }
        proven!(sse2(f))
    }
}

impl Xmm for Sse2 {
    #[inline(always)]
    fn blend(self, m: __m128, a: __m128, b: __m128) -> __m128 {
        proven!(_mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b)))
    }
    #[inline(always)]
    fn blend_i32(self, m: __m128i, a: __m128i, b: __m128i) -> __m128i {
        proven!(_mm_or_si128(_mm_and_si128(m, a), _mm_andnot_si128(m, b)))
    }
    #[inline(always)]
    fn min_i32(self, a: __m128i, b: __m128i) -> __m128i {
        self.blend_i32(proven!(_mm_cmplt_epi32(a, b)), a, b)
    }
    #[inline(always)]
    fn max_i32(self, a: __m128i, b: __m128i) -> __m128i {
        self.blend_i32(proven!(_mm_cmpgt_epi32(a, b)), a, b)
    }
    #[inline(always)]
    fn min_u32(self, a: __m128i, b: __m128i) -> __m128i {
        self.blend_i32(xmm::lt_u32(a, b), a, b)
    }
    #[inline(always)]
    fn max_u32(self, a: __m128i, b: __m128i) -> __m128i {
        self.blend_i32(xmm::lt_u32(a, b), b, a)
    }
    #[inline(always)]
    fn mul_i32(self, a: __m128i, b: __m128i) -> __m128i {
        proven!({
            // The products of the even lanes, and of the odd ones moved to even places.
            let even = _mm_mul_epu32(a, b);
            let odd = _mm_mul_epu32(_mm_srli_epi64::<32>(a), _mm_srli_epi64::<32>(b));
            // Their low words, put in place again.
            let even = _mm_shuffle_epi32::<0b_00_00_10_00>(even);
            let odd = _mm_shuffle_epi32::<0b_00_00_10_00>(odd);
            _mm_unpacklo_epi32(even, odd)
        })
    }
    #[inline(always)]
    fn permute(self, u: xmm::u32x4<Self>, order: xmm::u32x4<Self>) -> xmm::u32x4<Self> {
        soft::permute(u, order)
    }
    #[inline(always)]
    fn round_ties_even(self, x: xmm::f32x4<Self>) -> xmm::f32x4<Self> {
        soft::round_ties_even(x)
    }
    #[inline(always)]
    fn floor(self, x: xmm::f32x4<Self>) -> xmm::f32x4<Self> {
        soft::floor(x)
    }
    #[inline(always)]
    fn ceil(self, x: xmm::f32x4<Self>) -> xmm::f32x4<Self> {
        soft::ceil(x)
    }
    #[inline(always)]
    fn trunc(self, x: xmm::f32x4<Self>) -> xmm::f32x4<Self> {
        proven!({
            // From 2^23 on there are no fractions: all bits stay, below it only the sign.
            let sign = _mm_set1_ps(-0.0);
            let small = _mm_cmplt_ps(_mm_andnot_ps(sign, x.0), _mm_set1_ps(8_388_608.0));
            let integer = _mm_and_ps(_mm_cvtepi32_ps(_mm_cvttps_epi32(x.0)), small);
            let kept = _mm_andnot_ps(_mm_andnot_ps(sign, small), x.0);
            xmm::f32x4(_mm_or_ps(integer, kept), self)
        })
    }
    #[inline(always)]
    fn floor_to_i32_fast(self, x: xmm::f32x4<Self>) -> xmm::i32x4<Self> {
        proven!({
            // Toward zero, and one less (all ones) where that is above.
            let integer = _mm_cvttps_epi32(x.0);
            let above = _mm_castps_si128(_mm_cmplt_ps(x.0, _mm_cvtepi32_ps(integer)));
            xmm::i32x4(_mm_add_epi32(integer, above), self)
        })
    }
    #[inline(always)]
    fn u32_to_f32(self, u: xmm::u32x4<Self>) -> xmm::f32x4<Self> {
        soft::from_u32(u)
    }
}
