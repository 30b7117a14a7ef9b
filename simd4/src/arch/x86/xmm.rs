//! Four lanes in one 128-bit register, for every level from SSE2 up.

#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
use core::mem::transmute;

use super::super::proven;
use crate::simd::sealed::Sealed;
use crate::types::{conversions, operators, unary_operator};
use crate::{Lanes, Simd, SimdF32, SimdI32, SimdMask, SimdU32};

/// What differs between the levels of 128-bit registers. As provided: SSE4.1 and later.
pub trait Xmm: Simd {
    #[inline(always)]
    fn blend(self, m: __m128, a: __m128, b: __m128) -> __m128 {
        proven!(_mm_blendv_ps(b, a, m))
    }
    #[inline(always)]
    fn blend_i32(self, m: __m128i, a: __m128i, b: __m128i) -> __m128i {
        proven!(_mm_blendv_epi8(b, a, m))
    }
    #[inline(always)]
    fn min_i32(self, a: __m128i, b: __m128i) -> __m128i {
        proven!(_mm_min_epi32(a, b))
    }
    #[inline(always)]
    fn max_i32(self, a: __m128i, b: __m128i) -> __m128i {
        proven!(_mm_max_epi32(a, b))
    }
    #[inline(always)]
    fn min_u32(self, a: __m128i, b: __m128i) -> __m128i {
        proven!(_mm_min_epu32(a, b))
    }
    #[inline(always)]
    fn max_u32(self, a: __m128i, b: __m128i) -> __m128i {
        proven!(_mm_max_epu32(a, b))
    }
    #[inline(always)]
    fn mul_i32(self, a: __m128i, b: __m128i) -> __m128i {
        proven!(_mm_mullo_epi32(a, b))
    }
}

/// `a < b` on unsigned lanes: there are only signed comparisons, so both are moved by 2^31.
#[inline(always)]
pub(super) fn lt_u32<L: Xmm>(_: L, a: __m128i, b: __m128i) -> __m128i {
    proven!({
        let bias = _mm_set1_epi32(i32::MIN);
        _mm_cmplt_epi32(_mm_xor_si128(a, bias), _mm_xor_si128(b, bias))
    })
}

/// Four lanes of `f32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct f32x4<L>(__m128, L);

/// Four lanes of `i32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct i32x4<L>(__m128i, L);

/// Four lanes of `u32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct u32x4<L>(__m128i, L);

/// Four lanes of truth: the bits of a lane are all 1 or all 0.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct mask32x4<L>(__m128, L);

impl<L> Sealed for f32x4<L> {}
impl<L> Sealed for i32x4<L> {}
impl<L> Sealed for u32x4<L> {}
impl<L> Sealed for mask32x4<L> {}

// f32

impl<L: Xmm> Lanes for f32x4<L> {
    type Simd = L;
    type Elem = f32;
    type Array = [f32; 4];
    type Mask = mask32x4<L>;

    const LANES: usize = 4;

    #[inline(always)]
    fn splat(s: L, x: f32) -> Self {
        f32x4(proven!(_mm_set1_ps(x)), s)
    }
    #[inline(always)]
    fn from_array(s: L, a: [f32; 4]) -> Self {
        f32x4(proven!(transmute::<[f32; 4], __m128>(a)), s)
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 4] {
        proven!(transmute::<__m128, [f32; 4]>(self.0))
    }
    #[inline(always)]
    fn select(m: mask32x4<L>, a: Self, b: Self) -> Self {
        f32x4(a.1.blend(m.0, a.0, b.0), a.1)
    }
}

conversions! { [L: Xmm] f32x4<L>, L }
operators! { [L: Xmm] f32x4<L> {
    Add add AddAssign add_assign |a, b| f32x4(proven!(_mm_add_ps(a.0, b.0)), a.1);
    Sub sub SubAssign sub_assign |a, b| f32x4(proven!(_mm_sub_ps(a.0, b.0)), a.1);
    Mul mul MulAssign mul_assign |a, b| f32x4(proven!(_mm_mul_ps(a.0, b.0)), a.1);
    Div div DivAssign div_assign |a, b| f32x4(proven!(_mm_div_ps(a.0, b.0)), a.1);
}}
unary_operator! { [L: Xmm] f32x4<L> {
    Neg neg |a| f32x4(proven!(_mm_xor_ps(a.0, _mm_set1_ps(-0.0))), a.1)
}}

impl<L: Xmm> SimdF32 for f32x4<L> {
    type I32 = i32x4<L>;
    type U32 = u32x4<L>;

    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x4(proven!(_mm_sqrt_ps(self.0)), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32x4(proven!(_mm_andnot_ps(_mm_set1_ps(-0.0), self.0)), self.1)
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        f32x4(proven!(_mm_min_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        f32x4(proven!(_mm_max_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Self::Mask {
        mask32x4(proven!(_mm_cmpeq_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn ne(self, b: Self) -> Self::Mask {
        mask32x4(proven!(_mm_cmpneq_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Self::Mask {
        mask32x4(proven!(_mm_cmplt_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn le(self, b: Self) -> Self::Mask {
        mask32x4(proven!(_mm_cmple_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn to_bits(self) -> Self::U32 {
        u32x4(proven!(_mm_castps_si128(self.0)), self.1)
    }
    #[inline(always)]
    fn from_bits(bits: Self::U32) -> Self {
        f32x4(proven!(_mm_castsi128_ps(bits.0)), bits.1)
    }
    #[inline(always)]
    fn from_i32(i: Self::I32) -> Self {
        f32x4(proven!(_mm_cvtepi32_ps(i.0)), i.1)
    }
}

// i32 and u32

/// What is the same instruction for both signs.
macro_rules! integers {
    ($name:ident, $elem:ty) => {
        impl<L: Xmm> Lanes for $name<L> {
            type Simd = L;
            type Elem = $elem;
            type Array = [$elem; 4];
            type Mask = mask32x4<L>;

            const LANES: usize = 4;

            #[inline(always)]
            fn splat(s: L, x: $elem) -> Self {
                $name(proven!(_mm_set1_epi32(x as i32)), s)
            }
            #[inline(always)]
            fn from_array(s: L, a: [$elem; 4]) -> Self {
                $name(proven!(transmute::<[$elem; 4], __m128i>(a)), s)
            }
            #[inline(always)]
            fn to_array(self) -> [$elem; 4] {
                proven!(transmute::<__m128i, [$elem; 4]>(self.0))
            }
            #[inline(always)]
            fn select(m: mask32x4<L>, a: Self, b: Self) -> Self {
                $name(a.1.blend_i32(proven!(_mm_castps_si128(m.0)), a.0, b.0), a.1)
            }
        }

        conversions! { [L: Xmm] $name<L>, L }
        operators! { [L: Xmm] $name<L> {
            Add add AddAssign add_assign |a, b| $name(proven!(_mm_add_epi32(a.0, b.0)), a.1);
            Sub sub SubAssign sub_assign |a, b| $name(proven!(_mm_sub_epi32(a.0, b.0)), a.1);
            Mul mul MulAssign mul_assign |a, b| $name(a.1.mul_i32(a.0, b.0), a.1);
            BitAnd bitand BitAndAssign bitand_assign |a, b| {
                $name(proven!(_mm_and_si128(a.0, b.0)), a.1)
            };
            BitOr bitor BitOrAssign bitor_assign |a, b| {
                $name(proven!(_mm_or_si128(a.0, b.0)), a.1)
            };
            BitXor bitxor BitXorAssign bitxor_assign |a, b| {
                $name(proven!(_mm_xor_si128(a.0, b.0)), a.1)
            };
        }}
    };
}

integers!(i32x4, i32);
integers!(u32x4, u32);

impl<L: Xmm> SimdI32 for i32x4<L> {
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        i32x4(self.1.min_i32(self.0, b.0), self.1)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        i32x4(self.1.max_i32(self.0, b.0), self.1)
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Self::Mask {
        mask32x4(proven!(_mm_castsi128_ps(_mm_cmpeq_epi32(self.0, b.0))), self.1)
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Self::Mask {
        mask32x4(proven!(_mm_castsi128_ps(_mm_cmplt_epi32(self.0, b.0))), self.1)
    }
}

impl<L: Xmm> SimdU32 for u32x4<L> {
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        u32x4(self.1.min_u32(self.0, b.0), self.1)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        u32x4(self.1.max_u32(self.0, b.0), self.1)
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Self::Mask {
        mask32x4(proven!(_mm_castsi128_ps(_mm_cmpeq_epi32(self.0, b.0))), self.1)
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Self::Mask {
        mask32x4(proven!(_mm_castsi128_ps(lt_u32(self.1, self.0, b.0))), self.1)
    }
}

// mask

impl<L: Xmm> SimdMask for mask32x4<L> {
    type Simd = L;
    type Array = [bool; 4];

    const LANES: usize = 4;

    #[inline(always)]
    fn splat(s: L, b: bool) -> Self {
        Self::from_array(s, [b; 4])
    }
    #[inline(always)]
    fn from_array(s: L, a: [bool; 4]) -> Self {
        let lanes = a.map(|b| -i32::from(b));
        mask32x4(proven!(transmute::<[i32; 4], __m128>(lanes)), s)
    }
    #[inline(always)]
    fn to_array(self) -> [bool; 4] {
        proven!(transmute::<__m128, [u32; 4]>(self.0)).map(|lane| lane != 0)
    }
    #[inline(always)]
    fn bitmask(self) -> u32 {
        proven!(_mm_movemask_ps(self.0)) as u32
    }
}

operators! { [L: Xmm] mask32x4<L> {
    BitAnd bitand BitAndAssign bitand_assign |a, b| mask32x4(proven!(_mm_and_ps(a.0, b.0)), a.1);
    BitOr bitor BitOrAssign bitor_assign |a, b| mask32x4(proven!(_mm_or_ps(a.0, b.0)), a.1);
    BitXor bitxor BitXorAssign bitxor_assign |a, b| mask32x4(proven!(_mm_xor_ps(a.0, b.0)), a.1);
}}
unary_operator! { [L: Xmm] mask32x4<L> {
    Not not |a| {
        let ones = proven!(_mm_castsi128_ps(_mm_set1_epi32(-1)));
        mask32x4(proven!(_mm_xor_ps(a.0, ones)), a.1)
    }
}}

impl<L: Xmm> core::fmt::Debug for mask32x4<L> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.to_array().fmt(f)
    }
}
