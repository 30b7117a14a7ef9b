//! Eight lanes in one 256-bit register, for every level from AVX2 up.

#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
use core::mem::transmute;

use super::super::proven;
use crate::simd::sealed::Sealed;
use crate::types::{conversions, operators, unary_operator};
use crate::{Lanes, Simd, SimdF32, SimdI32, SimdMask, SimdU32};

/// A level whose token proves AVX2.
pub trait Ymm: Simd {}

/// Eight lanes of `f32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct f32x8<L>(__m256, L);

/// Eight lanes of `i32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct i32x8<L>(__m256i, L);

/// Eight lanes of `u32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct u32x8<L>(__m256i, L);

/// Eight lanes of truth: the bits of a lane are all 1 or all 0.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct mask32x8<L>(__m256, L);

impl<L> Sealed for f32x8<L> {}
impl<L> Sealed for i32x8<L> {}
impl<L> Sealed for u32x8<L> {}
impl<L> Sealed for mask32x8<L> {}

// f32

impl<L: Ymm> Lanes for f32x8<L> {
    type Simd = L;
    type Elem = f32;
    type Array = [f32; 8];
    type Mask = mask32x8<L>;

    const LANES: usize = 8;

    #[inline(always)]
    fn splat(s: L, x: f32) -> Self {
        f32x8(proven!(_mm256_set1_ps(x)), s)
    }
    #[inline(always)]
    fn from_array(s: L, a: [f32; 8]) -> Self {
        f32x8(proven!(transmute::<[f32; 8], __m256>(a)), s)
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 8] {
        proven!(transmute::<__m256, [f32; 8]>(self.0))
    }
    #[inline(always)]
    fn select(m: mask32x8<L>, a: Self, b: Self) -> Self {
        f32x8(proven!(_mm256_blendv_ps(b.0, a.0, m.0)), a.1)
    }
}

conversions! { [L: Ymm] f32x8<L>, L }
operators! { [L: Ymm] f32x8<L> {
    Add add AddAssign add_assign |a, b| f32x8(proven!(_mm256_add_ps(a.0, b.0)), a.1);
    Sub sub SubAssign sub_assign |a, b| f32x8(proven!(_mm256_sub_ps(a.0, b.0)), a.1);
    Mul mul MulAssign mul_assign |a, b| f32x8(proven!(_mm256_mul_ps(a.0, b.0)), a.1);
    Div div DivAssign div_assign |a, b| f32x8(proven!(_mm256_div_ps(a.0, b.0)), a.1);
}}
unary_operator! { [L: Ymm] f32x8<L> {
    Neg neg |a| f32x8(proven!(_mm256_xor_ps(a.0, _mm256_set1_ps(-0.0))), a.1)
}}

impl<L: Ymm> SimdF32 for f32x8<L> {
    type I32 = i32x8<L>;
    type U32 = u32x8<L>;

    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x8(proven!(_mm256_sqrt_ps(self.0)), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32x8(proven!(_mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0)), self.1)
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        f32x8(proven!(_mm256_min_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        f32x8(proven!(_mm256_max_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Self::Mask {
        mask32x8(proven!(_mm256_cmp_ps::<_CMP_EQ_OQ>(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn ne(self, b: Self) -> Self::Mask {
        mask32x8(proven!(_mm256_cmp_ps::<_CMP_NEQ_UQ>(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Self::Mask {
        mask32x8(proven!(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn le(self, b: Self) -> Self::Mask {
        mask32x8(proven!(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn to_bits(self) -> Self::U32 {
        u32x8(proven!(_mm256_castps_si256(self.0)), self.1)
    }
    #[inline(always)]
    fn from_bits(bits: Self::U32) -> Self {
        f32x8(proven!(_mm256_castsi256_ps(bits.0)), bits.1)
    }
    #[inline(always)]
    fn from_i32(i: Self::I32) -> Self {
        f32x8(proven!(_mm256_cvtepi32_ps(i.0)), i.1)
    }
}

// i32 and u32

/// What is the same instruction for both signs.
macro_rules! integers {
    ($name:ident, $elem:ty) => {
        impl<L: Ymm> Lanes for $name<L> {
            type Simd = L;
            type Elem = $elem;
            type Array = [$elem; 8];
            type Mask = mask32x8<L>;

            const LANES: usize = 8;

            #[inline(always)]
            fn splat(s: L, x: $elem) -> Self {
                $name(proven!(_mm256_set1_epi32(x as i32)), s)
            }
            #[inline(always)]
            fn from_array(s: L, a: [$elem; 8]) -> Self {
                $name(proven!(transmute::<[$elem; 8], __m256i>(a)), s)
            }
            #[inline(always)]
            fn to_array(self) -> [$elem; 8] {
                proven!(transmute::<__m256i, [$elem; 8]>(self.0))
            }
            #[inline(always)]
            fn select(m: mask32x8<L>, a: Self, b: Self) -> Self {
                $name(proven!(_mm256_blendv_epi8(b.0, a.0, _mm256_castps_si256(m.0))), a.1)
            }
        }

        conversions! { [L: Ymm] $name<L>, L }
        operators! { [L: Ymm] $name<L> {
            Add add AddAssign add_assign |a, b| $name(proven!(_mm256_add_epi32(a.0, b.0)), a.1);
            Sub sub SubAssign sub_assign |a, b| $name(proven!(_mm256_sub_epi32(a.0, b.0)), a.1);
            Mul mul MulAssign mul_assign |a, b| $name(proven!(_mm256_mullo_epi32(a.0, b.0)), a.1);
            BitAnd bitand BitAndAssign bitand_assign |a, b| {
                $name(proven!(_mm256_and_si256(a.0, b.0)), a.1)
            };
            BitOr bitor BitOrAssign bitor_assign |a, b| {
                $name(proven!(_mm256_or_si256(a.0, b.0)), a.1)
            };
            BitXor bitxor BitXorAssign bitxor_assign |a, b| {
                $name(proven!(_mm256_xor_si256(a.0, b.0)), a.1)
            };
        }}
    };
}

integers!(i32x8, i32);
integers!(u32x8, u32);

impl<L: Ymm> SimdI32 for i32x8<L> {
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        i32x8(proven!(_mm256_min_epi32(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        i32x8(proven!(_mm256_max_epi32(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Self::Mask {
        mask32x8(proven!(_mm256_castsi256_ps(_mm256_cmpeq_epi32(self.0, b.0))), self.1)
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Self::Mask {
        mask32x8(proven!(_mm256_castsi256_ps(_mm256_cmpgt_epi32(b.0, self.0))), self.1)
    }
}

impl<L: Ymm> SimdU32 for u32x8<L> {
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        u32x8(proven!(_mm256_min_epu32(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        u32x8(proven!(_mm256_max_epu32(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Self::Mask {
        mask32x8(proven!(_mm256_castsi256_ps(_mm256_cmpeq_epi32(self.0, b.0))), self.1)
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Self::Mask {
        // There are only signed comparisons, so both sides are moved by 2^31.
        let bias = Self::splat(self.1, 1 << 31);
        let (a, b) = (self ^ bias, b ^ bias);
        mask32x8(proven!(_mm256_castsi256_ps(_mm256_cmpgt_epi32(b.0, a.0))), self.1)
    }
}

// mask

impl<L: Ymm> SimdMask for mask32x8<L> {
    type Simd = L;
    type Array = [bool; 8];

    const LANES: usize = 8;

    #[inline(always)]
    fn splat(s: L, b: bool) -> Self {
        Self::from_array(s, [b; 8])
    }
    #[inline(always)]
    fn from_array(s: L, a: [bool; 8]) -> Self {
        let lanes = a.map(|b| -i32::from(b));
        mask32x8(proven!(transmute::<[i32; 8], __m256>(lanes)), s)
    }
    #[inline(always)]
    fn to_array(self) -> [bool; 8] {
        proven!(transmute::<__m256, [u32; 8]>(self.0)).map(|lane| lane != 0)
    }
    #[inline(always)]
    fn bitmask(self) -> u32 {
        proven!(_mm256_movemask_ps(self.0)) as u32
    }
}

operators! { [L: Ymm] mask32x8<L> {
    BitAnd bitand BitAndAssign bitand_assign |a, b| mask32x8(proven!(_mm256_and_ps(a.0, b.0)), a.1);
    BitOr bitor BitOrAssign bitor_assign |a, b| mask32x8(proven!(_mm256_or_ps(a.0, b.0)), a.1);
    BitXor bitxor BitXorAssign bitxor_assign |a, b| mask32x8(proven!(_mm256_xor_ps(a.0, b.0)), a.1);
}}
unary_operator! { [L: Ymm] mask32x8<L> {
    Not not |a| {
        let ones = proven!(_mm256_castsi256_ps(_mm256_set1_epi32(-1)));
        mask32x8(proven!(_mm256_xor_ps(a.0, ones)), a.1)
    }
}}

impl<L: Ymm> core::fmt::Debug for mask32x8<L> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.to_array().fmt(f)
    }
}
