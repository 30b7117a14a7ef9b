//! Four lanes in one 128-bit register, for every level from SSE2 up.

#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
use core::mem::transmute;

use super::super::proven;
use crate::simd::sealed::Sealed;
use crate::types::reduce::{self, Fold};
use crate::types::{conversions, operators, soft, unary_operator};
use crate::{Lanes, Simd, SimdF32, SimdI32, SimdInt, SimdMask, SimdU32};

/// What differs between the levels of 128-bit registers. As provided: SSE4.1 and later.
pub trait Xmm: Simd {
    #[inline(always)]
    fn blend(self, m: __m128, a: __m128, b: __m128) -> __m128 {
        proven!(_mm_blendv_ps(b, a, m))
    }
    /// By lanes and not by bytes: the compiler then knows what the comparison before it means.
    #[inline(always)]
    fn blend_i32(self, m: __m128i, a: __m128i, b: __m128i) -> __m128i {
        proven!({
            let (m, a, b) = (_mm_castsi128_ps(m), _mm_castsi128_ps(a), _mm_castsi128_ps(b));
            _mm_castps_si128(_mm_blendv_ps(b, a, m))
        })
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
    #[inline(always)]
    fn permute(self, u: u32x4<Self>, order: u32x4<Self>) -> u32x4<Self> {
        proven!({
            // Of each lane's number the numbers of its four bytes.
            let lanes = _mm_and_si128(order.0, _mm_set1_epi32(3));
            let lanes = _mm_shuffle_epi8(
                lanes,
                _mm_set_epi8(12, 12, 12, 12, 8, 8, 8, 8, 4, 4, 4, 4, 0, 0, 0, 0),
            );
            let bytes = _mm_or_si128(_mm_slli_epi32::<2>(lanes), _mm_set1_epi32(0x0302_0100));
            u32x4(_mm_shuffle_epi8(u.0, bytes), self)
        })
    }
    #[inline(always)]
    fn round_ties_even(self, x: f32x4<Self>) -> f32x4<Self> {
        f32x4(proven!(_mm_round_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(x.0)), self)
    }
    #[inline(always)]
    fn floor(self, x: f32x4<Self>) -> f32x4<Self> {
        f32x4(proven!(_mm_round_ps::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>(x.0)), self)
    }
    #[inline(always)]
    fn ceil(self, x: f32x4<Self>) -> f32x4<Self> {
        f32x4(proven!(_mm_round_ps::<{ _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC }>(x.0)), self)
    }
    #[inline(always)]
    fn trunc(self, x: f32x4<Self>) -> f32x4<Self> {
        f32x4(proven!(_mm_round_ps::<{ _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC }>(x.0)), self)
    }
    #[inline(always)]
    fn floor_to_i32_fast(self, x: f32x4<Self>) -> i32x4<Self> {
        x.floor().to_i32_fast()
    }
    /// As in `soft`, the halves put beside the high words of the floats.
    #[inline(always)]
    fn u32_to_f32(self, u: u32x4<Self>) -> f32x4<Self> {
        proven!({
            let low = _mm_blend_epi16::<0xaa>(u.0, _mm_set1_epi32(0x4b00_0000));
            let high = _mm_srli_epi32::<16>(u.0);
            let high = _mm_blend_epi16::<0xaa>(high, _mm_set1_epi32(0x5300_0000));
            let high = _mm_sub_ps(_mm_castsi128_ps(high), _mm_set1_ps(soft::TWO_39_AND_23));
            f32x4(_mm_add_ps(high, _mm_castsi128_ps(low)), self)
        })
    }
    #[inline(always)]
    fn f32_to_u32(self, x: f32x4<Self>) -> u32x4<Self> {
        proven!({
            // What is not above zero, NaN too, becomes 0.
            let x = f32x4(_mm_max_ps(x.0, _mm_setzero_ps()), self);
            let great = _mm_cmpge_ps(x.0, _mm_set1_ps(4_294_967_296.0));
            u32x4(_mm_or_si128(self.f32_to_u32_fast(x).0, _mm_castps_si128(great)), self)
        })
    }
    #[inline(always)]
    fn f32_to_u32_fast(self, x: f32x4<Self>) -> u32x4<Self> {
        proven!({
            // What does not fit an i32 becomes i32::MIN: to its bit comes the rest above 2^31.
            let low = _mm_cvttps_epi32(x.0);
            let rest = _mm_sub_ps(x.0, _mm_set1_ps(2_147_483_648.0));
            let rest = _mm_and_si128(_mm_cvttps_epi32(rest), _mm_srai_epi32::<31>(low));
            u32x4(_mm_or_si128(low, rest), self)
        })
    }

    /// Whether [`Xmm::fused_mul_add`] is one instruction.
    const FUSED: bool = false;

    /// As [`spec::fused_mul_add`](crate::spec::fused_mul_add), which explains it.
    #[inline(always)]
    fn fused_mul_add(self, a: __m128, b: __m128, c: __m128) -> __m128 {
        #[inline(always)]
        fn to_odd<L: Xmm>(_: L, a: __m128, b: __m128, c: __m128) -> __m128 {
            proven!({
                let (a, b, c) = (_mm_cvtps_pd(a), _mm_cvtps_pd(b), _mm_cvtps_pd(c));
                let product = _mm_mul_pd(a, b);
                let sum = _mm_add_pd(product, c);
                let from_product = _mm_sub_pd(sum, c);
                let lost = _mm_add_pd(
                    _mm_sub_pd(product, from_product),
                    _mm_sub_pd(c, _mm_sub_pd(sum, from_product)),
                );
                let zero = _mm_setzero_pd();
                // +1 where the lost part points away from zero as the sum does, else −1; nothing
                // where the sum is exact or odd.
                let bits = _mm_castpd_si128(sum);
                let differ =
                    _mm_castpd_si128(_mm_xor_pd(_mm_cmpgt_pd(lost, zero), _mm_cmpgt_pd(sum, zero)));
                let inexact =
                    _mm_castpd_si128(_mm_or_pd(_mm_cmplt_pd(lost, zero), _mm_cmpgt_pd(lost, zero)));
                let one = _mm_srli_epi64::<63>(_mm_set1_epi32(-1));
                let step = _mm_or_si128(differ, one);
                let even = _mm_sub_epi64(_mm_and_si128(bits, one), one);
                let step = _mm_and_si128(_mm_and_si128(step, inexact), even);
                _mm_cvtpd_ps(_mm_castsi128_pd(_mm_add_epi64(bits, step)))
            })
        }
        let low = to_odd(self, a, b, c);
        let high =
            proven!(to_odd(self, _mm_movehl_ps(a, a), _mm_movehl_ps(b, b), _mm_movehl_ps(c, c)));
        proven!(_mm_movelh_ps(low, high))
    }
}

/// `a < b` on unsigned lanes: there are only signed comparisons, so both are moved by 2^31.
#[inline(always)]
pub(super) fn lt_u32(a: __m128i, b: __m128i) -> __m128i {
    proven!({
        let bias = _mm_set1_epi32(i32::MIN);
        _mm_cmplt_epi32(_mm_xor_si128(a, bias), _mm_xor_si128(b, bias))
    })
}

/// Four lanes of `f32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct f32x4<L>(pub(super) __m128, pub(super) L);

/// Four lanes of `i32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct i32x4<L>(pub(super) __m128i, pub(super) L);

/// Four lanes of `u32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct u32x4<L>(pub(super) __m128i, pub(super) L);

/// Four lanes of truth: the bits of a lane are all 1 or all 0.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct mask32x4<L>(pub(super) __m128, pub(super) L);

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
    fn token(self) -> L {
        self.1
    }
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
    fn select(m: mask32x4<L>, a: Self, b: Self) -> Self {
        f32x4(a.1.blend(m.0, a.0, b.0), a.1)
    }
    #[inline(always)]
    fn masked(self, m: mask32x4<L>) -> Self {
        f32x4(proven!(_mm_and_ps(m.0, self.0)), self.1)
    }
    #[inline(always)]
    fn reverse(self) -> Self {
        f32x4(proven!(_mm_shuffle_ps::<0b_00_01_10_11>(self.0, self.0)), self.1)
    }
    #[inline(always)]
    fn zip(self, b: Self) -> (Self, Self) {
        proven!((
            f32x4(_mm_unpacklo_ps(self.0, b.0), self.1),
            f32x4(_mm_unpackhi_ps(self.0, b.0), self.1),
        ))
    }
    #[inline(always)]
    fn unzip(self, b: Self) -> (Self, Self) {
        proven!((
            f32x4(_mm_shuffle_ps::<0b_10_00_10_00>(self.0, b.0), self.1),
            f32x4(_mm_shuffle_ps::<0b_11_01_11_01>(self.0, b.0), self.1),
        ))
    }
    #[inline(always)]
    fn reduce<F: Fold>(self) -> f32 {
        reduce::four::<F, Self>(self)
    }
    #[inline(always)]
    fn fold_all<F: Fold>(self) -> Self {
        reduce::four_all::<F, Self>(self)
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
    // LLVM makes it an exclusive or, or a part of a fused operation; an exclusive or written here
    // it does not take for a negation.
    Neg neg |a| f32x4(proven!(_mm_sub_ps(_mm_set1_ps(-0.0), a.0)), a.1)
}}

impl<L: Xmm> SimdF32 for f32x4<L> {
    type I32 = i32x4<L>;
    type U32 = u32x4<L>;

    const FUSED: bool = L::FUSED;

    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x4(proven!(_mm_sqrt_ps(self.0)), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32x4(proven!(_mm_andnot_ps(_mm_set1_ps(-0.0), self.0)), self.1)
    }
    #[inline(always)]
    fn fused_mul_add(self, b: Self, c: Self) -> Self {
        f32x4(self.1.fused_mul_add(self.0, b.0, c.0), self.1)
    }
    #[inline(always)]
    fn round_ties_even(self) -> Self {
        self.1.round_ties_even(self)
    }
    #[inline(always)]
    fn floor(self) -> Self {
        self.1.floor(self)
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        self.1.ceil(self)
    }
    #[inline(always)]
    fn trunc(self) -> Self {
        self.1.trunc(self)
    }
    #[inline(always)]
    fn rcp_est(self) -> Self {
        f32x4(proven!(_mm_rcp_ps(self.0)), self.1)
    }
    #[inline(always)]
    fn rsqrt_est(self) -> Self {
        f32x4(proven!(_mm_rsqrt_ps(self.0)), self.1)
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
    #[inline(always)]
    fn floor_to_i32_fast(self) -> Self::I32 {
        self.1.floor_to_i32_fast(self)
    }
    #[inline(always)]
    fn from_u32(u: Self::U32) -> Self {
        u.1.u32_to_f32(u)
    }
    #[inline(always)]
    fn to_i32(self) -> Self::I32 {
        proven!({
            // What does not fit becomes i32::MIN: of too great values all bits are to be turned,
            // of NaN none is to stay.
            let great = _mm_cmpge_ps(self.0, _mm_set1_ps(2_147_483_648.0));
            let number = _mm_cmpord_ps(self.0, self.0);
            let turned = _mm_xor_si128(_mm_cvttps_epi32(self.0), _mm_castps_si128(great));
            i32x4(_mm_and_si128(turned, _mm_castps_si128(number)), self.1)
        })
    }
    #[inline(always)]
    fn to_u32(self) -> Self::U32 {
        self.1.f32_to_u32(self)
    }
    #[inline(always)]
    fn to_i32_fast(self) -> Self::I32 {
        i32x4(proven!(_mm_cvttps_epi32(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32_fast(self) -> Self::U32 {
        self.1.f32_to_u32_fast(self)
    }
}

// i32 and u32

/// What is the same text for both signs.
macro_rules! integers {
    ($name:ident, $elem:ty, $min:ident, $max:ident, |$a:ident, $b:ident| $lt:expr) => {
        impl<L: Xmm> Lanes for $name<L> {
            type Simd = L;
            type Elem = $elem;
            type Array = [$elem; 4];
            type Mask = mask32x4<L>;

            const LANES: usize = 4;

            #[inline(always)]
            fn token(self) -> L {
                self.1
            }
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
            fn min(self, b: Self) -> Self {
                $name(self.1.$min(self.0, b.0), self.1)
            }
            #[inline(always)]
            fn max(self, b: Self) -> Self {
                $name(self.1.$max(self.0, b.0), self.1)
            }
            #[inline(always)]
            fn eq(self, b: Self) -> Self::Mask {
                mask32x4(proven!(_mm_castsi128_ps(_mm_cmpeq_epi32(self.0, b.0))), self.1)
            }
            #[inline(always)]
            fn lt(self, b: Self) -> Self::Mask {
                let ($a, $b) = (self.0, b.0);
                mask32x4(proven!(_mm_castsi128_ps($lt)), self.1)
            }
            #[inline(always)]
            fn le(self, b: Self) -> Self::Mask {
                !b.lt(self)
            }
            #[inline(always)]
            fn select(m: mask32x4<L>, a: Self, b: Self) -> Self {
                $name(a.1.blend_i32(proven!(_mm_castps_si128(m.0)), a.0, b.0), a.1)
            }
            #[inline(always)]
            fn masked(self, m: mask32x4<L>) -> Self {
                $name(proven!(_mm_and_si128(_mm_castps_si128(m.0), self.0)), self.1)
            }
            #[inline(always)]
            fn reverse(self) -> Self {
                $name(proven!(_mm_shuffle_epi32::<0b_00_01_10_11>(self.0)), self.1)
            }
            #[inline(always)]
            fn zip(self, b: Self) -> (Self, Self) {
                proven!((
                    $name(_mm_unpacklo_epi32(self.0, b.0), self.1),
                    $name(_mm_unpackhi_epi32(self.0, b.0), self.1),
                ))
            }
            #[inline(always)]
            fn unzip(self, b: Self) -> (Self, Self) {
                proven!({
                    let (x, y) = (_mm_castsi128_ps(self.0), _mm_castsi128_ps(b.0));
                    let (even, odd) = f32x4(x, self.1).unzip(f32x4(y, b.1));
                    (
                        $name(_mm_castps_si128(even.0), self.1),
                        $name(_mm_castps_si128(odd.0), self.1),
                    )
                })
            }
            #[inline(always)]
            fn reduce<F: Fold>(self) -> $elem {
                reduce::four::<F, Self>(self)
            }
            #[inline(always)]
            fn fold_all<F: Fold>(self) -> Self {
                reduce::four_all::<F, Self>(self)
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
        unary_operator! { [L: Xmm] $name<L> {
            Not not |a| $name(proven!(_mm_xor_si128(a.0, _mm_set1_epi32(-1))), a.1)
        }}

        impl<L: Xmm> SimdInt for $name<L> {
            #[inline(always)]
            fn shl(self, n: u32) -> Self {
                $name(proven!(_mm_sll_epi32(self.0, _mm_cvtsi32_si128(n as i32))), self.1)
            }
            #[inline(always)]
            fn shr(self, n: u32) -> Self {
                $name(proven!(_mm_srl_epi32(self.0, _mm_cvtsi32_si128(n as i32))), self.1)
            }
        }
    };
}

integers!(i32x4, i32, min_i32, max_i32, |a, b| _mm_cmplt_epi32(a, b));
integers!(u32x4, u32, min_u32, max_u32, |a, b| lt_u32(a, b));

unary_operator! { [L: Xmm] i32x4<L> {
    Neg neg |a| i32x4(proven!(_mm_sub_epi32(_mm_setzero_si128(), a.0)), a.1)
}}

impl<L: Xmm> SimdI32 for i32x4<L> {
    type U32 = u32x4<L>;

    #[inline(always)]
    fn sar(self, n: u32) -> Self {
        i32x4(proven!(_mm_sra_epi32(self.0, _mm_cvtsi32_si128(n as i32))), self.1)
    }
    #[inline(always)]
    fn to_u32(self) -> Self::U32 {
        u32x4(self.0, self.1)
    }
    #[inline(always)]
    fn from_u32(u: Self::U32) -> Self {
        i32x4(u.0, u.1)
    }
}

impl<L: Xmm> SimdU32 for u32x4<L> {
    #[inline(always)]
    fn permute(self, order: Self) -> Self {
        self.1.permute(self, order)
    }
    /// Two lanes at a time come out of the register.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn index(self, lane: usize) -> usize {
        let pair = proven!(match lane / 2 {
            0 => _mm_cvtsi128_si64(self.0),
            _ => _mm_cvtsi128_si64(_mm_unpackhi_epi64(self.0, self.0)),
        });
        (pair as u64 >> (32 * (lane % 2))) as u32 as usize
    }
}

// mask

impl<L: Xmm> SimdMask for mask32x4<L> {
    type Simd = L;
    type Array = [bool; 4];

    const LANES: usize = 4;

    #[inline(always)]
    fn token(self) -> L {
        self.1
    }
    #[inline(always)]
    fn splat(s: L, b: bool) -> Self {
        mask32x4(proven!(_mm_castsi128_ps(_mm_set1_epi32(-i32::from(b)))), s)
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
