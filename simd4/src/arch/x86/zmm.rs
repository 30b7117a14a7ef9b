//! Sixteen lanes in one 512-bit register, and masks of one bit a lane.

#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
use core::mem::transmute;

use super::super::proven;
use super::ymm::{self, Ymm};
use crate::simd::sealed::Sealed;
use crate::types::reduce::Fold;
use crate::types::{conversions, operators, soft, unary_operator};
use crate::{Lanes, SimdF32, SimdI32, SimdInt, SimdMask, SimdU32, Wide};

/// A level whose token proves AVX-512 F, BW, DQ and VL.
pub trait Zmm: Ymm {}

/// Sixteen lanes of `f32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct f32x16<L>(pub(super) __m512, pub(super) L);

/// Sixteen lanes of `i32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct i32x16<L>(pub(super) __m512i, pub(super) L);

/// Sixteen lanes of `u32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct u32x16<L>(pub(super) __m512i, pub(super) L);

/// Sixteen lanes of truth: bit `i` is lane `i`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct mask32x16<L>(pub(super) __mmask16, pub(super) L);

impl<L> Sealed for f32x16<L> {}
impl<L> Sealed for i32x16<L> {}
impl<L> Sealed for u32x16<L> {}
impl<L> Sealed for mask32x16<L> {}

/// The lowest lanes, `n` of them but no more than there are.
#[inline(always)]
fn prefix(n: usize) -> __mmask16 {
    if n < 16 { (1 << n) - 1 } else { __mmask16::MAX }
}

/// How many elements a slice must have for all lanes of the mask.
#[inline(always)]
fn reach(mask: __mmask16) -> usize {
    16 - mask.leading_zeros() as usize
}

/// Loads and stores that touch the mask's lanes only.
macro_rules! masked_memory {
    ($elem:ty, $load:ident, $store:ident, $compress:ident) => {
        #[inline(always)]
        fn load_prefix(s: L, from: &[$elem], fill: $elem) -> Self {
            let fill = Self::splat(s, fill);
            // SAFETY: the token proves the level; the mask's lanes are elements of the slice, and
            // others are not read.
            Self(unsafe { $load(fill.0, prefix(from.len()), from.as_ptr().cast()) }, s)
        }
        #[inline(always)]
        fn store_prefix(self, to: &mut [$elem]) {
            // SAFETY: the token proves the level; the mask's lanes are elements of the slice, and
            // others are not written.
            unsafe { $store(to.as_mut_ptr().cast(), prefix(to.len()), self.0) }
        }
        #[inline(always)]
        fn load_masked(s: L, from: &[$elem], mask: mask32x16<L>, fill: $elem) -> Self {
            let (from, fill) = (&from[..reach(mask.0)], Self::splat(s, fill));
            // SAFETY: as in `load_prefix`.
            Self(unsafe { $load(fill.0, mask.0, from.as_ptr().cast()) }, s)
        }
        #[inline(always)]
        fn store_masked(self, to: &mut [$elem], mask: mask32x16<L>) {
            let to = &mut to[..reach(mask.0)];
            // SAFETY: as in `store_prefix`.
            unsafe { $store(to.as_mut_ptr().cast(), mask.0, self.0) }
        }
        #[inline(always)]
        fn compress_store(self, mask: mask32x16<L>, to: &mut [$elem]) -> usize {
            let n = mask.count() as usize;
            // In a register first: to memory the instruction is slow on some CPUs.
            Self(proven!($compress(mask.0, self.0)), self.1).store_prefix(&mut to[..n]);
            n
        }
    };
}

// f32

impl<L: Zmm> Lanes for f32x16<L> {
    type Simd = L;
    type Elem = f32;
    type Array = [f32; 16];
    type Mask = mask32x16<L>;

    const LANES: usize = 16;

    #[inline(always)]
    fn token(self) -> L {
        self.1
    }
    #[inline(always)]
    fn splat(s: L, x: f32) -> Self {
        f32x16(proven!(_mm512_set1_ps(x)), s)
    }
    #[inline(always)]
    fn from_array(s: L, a: [f32; 16]) -> Self {
        f32x16(proven!(transmute::<[f32; 16], __m512>(a)), s)
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 16] {
        proven!(transmute::<__m512, [f32; 16]>(self.0))
    }

    masked_memory! { f32, _mm512_mask_loadu_ps, _mm512_mask_storeu_ps, _mm512_maskz_compress_ps }

    #[inline(always)]
    fn min(self, b: Self) -> Self {
        f32x16(proven!(_mm512_min_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        f32x16(proven!(_mm512_max_ps(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Self::Mask {
        mask32x16(proven!(_mm512_cmp_ps_mask::<_CMP_EQ_OQ>(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn ne(self, b: Self) -> Self::Mask {
        mask32x16(proven!(_mm512_cmp_ps_mask::<_CMP_NEQ_UQ>(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Self::Mask {
        mask32x16(proven!(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn le(self, b: Self) -> Self::Mask {
        mask32x16(proven!(_mm512_cmp_ps_mask::<_CMP_LE_OQ>(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn select(m: mask32x16<L>, a: Self, b: Self) -> Self {
        f32x16(proven!(_mm512_mask_blend_ps(m.0, b.0, a.0)), a.1)
    }
    #[inline(always)]
    fn reduce<F: Fold>(self) -> f32 {
        let (low, high) = self.halves();
        F::fold(low, high).reduce::<F>()
    }
}

conversions! { [L: Zmm] f32x16<L>, L }
operators! { [L: Zmm] f32x16<L> {
    Add add AddAssign add_assign |a, b| f32x16(proven!(_mm512_add_ps(a.0, b.0)), a.1);
    Sub sub SubAssign sub_assign |a, b| f32x16(proven!(_mm512_sub_ps(a.0, b.0)), a.1);
    Mul mul MulAssign mul_assign |a, b| f32x16(proven!(_mm512_mul_ps(a.0, b.0)), a.1);
    Div div DivAssign div_assign |a, b| f32x16(proven!(_mm512_div_ps(a.0, b.0)), a.1);
}}
unary_operator! { [L: Zmm] f32x16<L> {
    Neg neg |a| f32x16(proven!(_mm512_xor_ps(a.0, _mm512_set1_ps(-0.0))), a.1)
}}

impl<L: Zmm> SimdF32 for f32x16<L> {
    type I32 = i32x16<L>;
    type U32 = u32x16<L>;

    const FUSED: bool = true;

    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x16(proven!(_mm512_sqrt_ps(self.0)), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32x16(proven!(_mm512_andnot_ps(_mm512_set1_ps(-0.0), self.0)), self.1)
    }
    #[inline(always)]
    fn fused_mul_add(self, b: Self, c: Self) -> Self {
        f32x16(proven!(_mm512_fmadd_ps(self.0, b.0, c.0)), self.1)
    }
    #[inline(always)]
    fn round_ties_even(self) -> Self {
        const NEAREST: i32 = _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC;
        f32x16(proven!(_mm512_roundscale_ps::<NEAREST>(self.0)), self.1)
    }
    #[inline(always)]
    fn floor(self) -> Self {
        const DOWN: i32 = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
        f32x16(proven!(_mm512_roundscale_ps::<DOWN>(self.0)), self.1)
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        const UP: i32 = _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC;
        f32x16(proven!(_mm512_roundscale_ps::<UP>(self.0)), self.1)
    }
    #[inline(always)]
    fn trunc(self) -> Self {
        const ZERO: i32 = _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC;
        f32x16(proven!(_mm512_roundscale_ps::<ZERO>(self.0)), self.1)
    }
    #[inline(always)]
    fn rcp_est(self) -> Self {
        f32x16(proven!(_mm512_rcp14_ps(self.0)), self.1)
    }
    #[inline(always)]
    fn rsqrt_est(self) -> Self {
        f32x16(proven!(_mm512_rsqrt14_ps(self.0)), self.1)
    }
    #[inline(always)]
    fn rcp_fast(self) -> Self {
        soft::rcp_step(self, self.rcp_est())
    }
    #[inline(always)]
    fn rsqrt_fast(self) -> Self {
        soft::rsqrt_step(self, self.rsqrt_est())
    }
    #[inline(always)]
    fn to_bits(self) -> Self::U32 {
        u32x16(proven!(_mm512_castps_si512(self.0)), self.1)
    }
    #[inline(always)]
    fn from_bits(bits: Self::U32) -> Self {
        f32x16(proven!(_mm512_castsi512_ps(bits.0)), bits.1)
    }
    #[inline(always)]
    fn from_i32(i: Self::I32) -> Self {
        f32x16(proven!(_mm512_cvtepi32_ps(i.0)), i.1)
    }
    #[inline(always)]
    fn from_u32(u: Self::U32) -> Self {
        f32x16(proven!(_mm512_cvtepu32_ps(u.0)), u.1)
    }
    #[inline(always)]
    fn to_i32(self) -> Self::I32 {
        proven!({
            // What does not fit becomes i32::MIN: right but for NaN and too great values.
            let number = _mm512_cmp_ps_mask::<_CMP_ORD_Q>(self.0, self.0);
            let great = _mm512_cmp_ps_mask::<_CMP_GE_OQ>(self.0, _mm512_set1_ps(2_147_483_648.0));
            let converted = _mm512_maskz_cvttps_epi32(number, self.0);
            i32x16(_mm512_mask_blend_epi32(great, converted, _mm512_set1_epi32(i32::MAX)), self.1)
        })
    }
    #[inline(always)]
    fn to_u32(self) -> Self::U32 {
        // What is not above zero, NaN too, becomes 0; what is too great becomes all ones.
        u32x16(proven!(_mm512_cvttps_epu32(_mm512_max_ps(self.0, _mm512_setzero_ps()))), self.1)
    }
    #[inline(always)]
    fn to_i32_fast(self) -> Self::I32 {
        i32x16(proven!(_mm512_cvttps_epi32(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32_fast(self) -> Self::U32 {
        u32x16(proven!(_mm512_cvttps_epu32(self.0)), self.1)
    }
}

// i32 and u32

/// What is the same text for both signs.
macro_rules! integers {
    ($name:ident, $elem:ty, $min:ident, $max:ident, $lt:ident, $le:ident) => {
        impl<L: Zmm> Lanes for $name<L> {
            type Simd = L;
            type Elem = $elem;
            type Array = [$elem; 16];
            type Mask = mask32x16<L>;

            const LANES: usize = 16;

            #[inline(always)]
            fn token(self) -> L {
                self.1
            }
            #[inline(always)]
            fn splat(s: L, x: $elem) -> Self {
                $name(proven!(_mm512_set1_epi32(x as i32)), s)
            }
            #[inline(always)]
            fn from_array(s: L, a: [$elem; 16]) -> Self {
                $name(proven!(transmute::<[$elem; 16], __m512i>(a)), s)
            }
            #[inline(always)]
            fn to_array(self) -> [$elem; 16] {
                proven!(transmute::<__m512i, [$elem; 16]>(self.0))
            }

            masked_memory! {
                $elem, _mm512_mask_loadu_epi32, _mm512_mask_storeu_epi32, _mm512_maskz_compress_epi32
            }

            #[inline(always)]
            fn min(self, b: Self) -> Self {
                $name(proven!($min(self.0, b.0)), self.1)
            }
            #[inline(always)]
            fn max(self, b: Self) -> Self {
                $name(proven!($max(self.0, b.0)), self.1)
            }
            #[inline(always)]
            fn eq(self, b: Self) -> Self::Mask {
                mask32x16(proven!(_mm512_cmpeq_epi32_mask(self.0, b.0)), self.1)
            }
            #[inline(always)]
            fn lt(self, b: Self) -> Self::Mask {
                mask32x16(proven!($lt(self.0, b.0)), self.1)
            }
            #[inline(always)]
            fn le(self, b: Self) -> Self::Mask {
                mask32x16(proven!($le(self.0, b.0)), self.1)
            }
            #[inline(always)]
            fn select(m: mask32x16<L>, a: Self, b: Self) -> Self {
                $name(proven!(_mm512_mask_blend_epi32(m.0, b.0, a.0)), a.1)
            }
            #[inline(always)]
            fn reduce<F: Fold>(self) -> $elem {
                let (low, high) = self.halves();
                F::fold(low, high).reduce::<F>()
            }
        }

        conversions! { [L: Zmm] $name<L>, L }
        operators! { [L: Zmm] $name<L> {
            Add add AddAssign add_assign |a, b| $name(proven!(_mm512_add_epi32(a.0, b.0)), a.1);
            Sub sub SubAssign sub_assign |a, b| $name(proven!(_mm512_sub_epi32(a.0, b.0)), a.1);
            Mul mul MulAssign mul_assign |a, b| $name(proven!(_mm512_mullo_epi32(a.0, b.0)), a.1);
            BitAnd bitand BitAndAssign bitand_assign |a, b| {
                $name(proven!(_mm512_and_si512(a.0, b.0)), a.1)
            };
            BitOr bitor BitOrAssign bitor_assign |a, b| {
                $name(proven!(_mm512_or_si512(a.0, b.0)), a.1)
            };
            BitXor bitxor BitXorAssign bitxor_assign |a, b| {
                $name(proven!(_mm512_xor_si512(a.0, b.0)), a.1)
            };
        }}
        unary_operator! { [L: Zmm] $name<L> {
            Not not |a| $name(proven!(_mm512_xor_si512(a.0, _mm512_set1_epi32(-1))), a.1)
        }}

        impl<L: Zmm> SimdInt for $name<L> {
            #[inline(always)]
            fn shl(self, n: u32) -> Self {
                $name(proven!(_mm512_sll_epi32(self.0, _mm_cvtsi32_si128(n as i32))), self.1)
            }
            #[inline(always)]
            fn shr(self, n: u32) -> Self {
                $name(proven!(_mm512_srl_epi32(self.0, _mm_cvtsi32_si128(n as i32))), self.1)
            }
        }
    };
}

integers! {
    i32x16, i32,
    _mm512_min_epi32, _mm512_max_epi32, _mm512_cmplt_epi32_mask, _mm512_cmple_epi32_mask
}
integers! {
    u32x16, u32,
    _mm512_min_epu32, _mm512_max_epu32, _mm512_cmplt_epu32_mask, _mm512_cmple_epu32_mask
}

unary_operator! { [L: Zmm] i32x16<L> {
    Neg neg |a| i32x16(proven!(_mm512_sub_epi32(_mm512_setzero_si512(), a.0)), a.1)
}}

impl<L: Zmm> SimdI32 for i32x16<L> {
    type U32 = u32x16<L>;

    #[inline(always)]
    fn sar(self, n: u32) -> Self {
        i32x16(proven!(_mm512_sra_epi32(self.0, _mm_cvtsi32_si128(n as i32))), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        i32x16(proven!(_mm512_abs_epi32(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32(self) -> Self::U32 {
        u32x16(self.0, self.1)
    }
    #[inline(always)]
    fn from_u32(u: Self::U32) -> Self {
        i32x16(u.0, u.1)
    }
}

impl<L: Zmm> SimdU32 for u32x16<L> {
    #[inline(always)]
    fn permute(self, order: Self) -> Self {
        u32x16(proven!(_mm512_permutexvar_epi32(order.0, self.0)), self.1)
    }
}

/// Two 256-bit registers to one and back.
macro_rules! wide {
    ($name:ident, $Half:ident, $widen:ident, $insert:ident, $low:ident, $high:ident) => {
        impl<L: Zmm> Wide for $name<L> {
            type Half = ymm::$Half<L>;

            #[inline(always)]
            fn concat(low: Self::Half, high: Self::Half) -> Self {
                $name(proven!($insert::<1>($widen(low.0), high.0)), low.1)
            }
            #[inline(always)]
            fn halves(self) -> (Self::Half, Self::Half) {
                proven!((ymm::$Half($low(self.0), self.1), ymm::$Half($high::<1>(self.0), self.1)))
            }
        }
    };
}

wide! {
    f32x16, f32x8,
    _mm512_castps256_ps512, _mm512_insertf32x8, _mm512_castps512_ps256, _mm512_extractf32x8_ps
}
wide! {
    i32x16, i32x8,
    _mm512_castsi256_si512, _mm512_inserti32x8, _mm512_castsi512_si256, _mm512_extracti32x8_epi32
}
wide! {
    u32x16, u32x8,
    _mm512_castsi256_si512, _mm512_inserti32x8, _mm512_castsi512_si256, _mm512_extracti32x8_epi32
}

// mask

impl<L: Zmm> SimdMask for mask32x16<L> {
    type Simd = L;
    type Array = [bool; 16];

    const LANES: usize = 16;

    #[inline(always)]
    fn token(self) -> L {
        self.1
    }
    #[inline(always)]
    fn splat(s: L, b: bool) -> Self {
        mask32x16(if b { __mmask16::MAX } else { 0 }, s)
    }
    #[inline(always)]
    fn from_array(s: L, a: [bool; 16]) -> Self {
        proven!({
            let bytes = transmute::<[bool; 16], __m128i>(a);
            mask32x16(_mm_test_epi8_mask(bytes, bytes), s)
        })
    }
    #[inline(always)]
    fn to_array(self) -> [bool; 16] {
        let bytes = proven!(_mm_maskz_set1_epi8(self.0, 1));
        proven!(transmute::<__m128i, [u8; 16]>(bytes)).map(|lane| lane != 0)
    }
    #[inline(always)]
    fn bitmask(self) -> u32 {
        u32::from(self.0)
    }
}

operators! { [L: Zmm] mask32x16<L> {
    BitAnd bitand BitAndAssign bitand_assign |a, b| mask32x16(a.0 & b.0, a.1);
    BitOr bitor BitOrAssign bitor_assign |a, b| mask32x16(a.0 | b.0, a.1);
    BitXor bitxor BitXorAssign bitxor_assign |a, b| mask32x16(a.0 ^ b.0, a.1);
}}
unary_operator! { [L: Zmm] mask32x16<L> { Not not |a| mask32x16(!a.0, a.1) } }

impl<L: Zmm> core::fmt::Debug for mask32x16<L> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.to_array().fmt(f)
    }
}
