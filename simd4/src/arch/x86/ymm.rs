//! Eight lanes in one 256-bit register, for every level from AVX2 up.

#[cfg(target_arch = "x86")]
use core::arch::x86::*;
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
use core::mem::transmute;

use super::super::proven;
use super::xmm::{self, Xmm};
use crate::simd::sealed::Sealed;
use crate::types::reduce::Fold;
use crate::types::{self, conversions, operators, soft, unary_operator};
use crate::{Lanes, SimdF32, SimdI32, SimdInt, SimdMask, SimdU32, Wide};

/// What differs between the levels of 256-bit registers; their token proves AVX2 and FMA. As
/// provided: AVX2.
pub trait Ymm: Xmm {
    #[inline(always)]
    fn blend(self, m: __m256, a: __m256, b: __m256) -> __m256 {
        proven!(_mm256_blendv_ps(b, a, m))
    }
    /// As in `xmm`, by lanes and not by bytes.
    #[inline(always)]
    fn blend_i32(self, m: __m256i, a: __m256i, b: __m256i) -> __m256i {
        proven!({
            let (a, b) = (_mm256_castsi256_ps(a), _mm256_castsi256_ps(b));
            _mm256_castps_si256(_mm256_blendv_ps(b, a, _mm256_castsi256_ps(m)))
        })
    }
    /// As in `xmm`.
    #[inline(always)]
    fn u32_to_f32(self, u: u32x8<Self>) -> f32x8<Self> {
        proven!({
            let low = _mm256_blend_epi16::<0xaa>(u.0, _mm256_set1_epi32(0x4b00_0000));
            let high = _mm256_srli_epi32::<16>(u.0);
            let high = _mm256_blend_epi16::<0xaa>(high, _mm256_set1_epi32(0x5300_0000));
            let high = _mm256_castsi256_ps(high);
            let high = _mm256_sub_ps(high, _mm256_set1_ps(soft::TWO_39_AND_23));
            f32x8(_mm256_add_ps(high, _mm256_castsi256_ps(low)), self)
        })
    }
    /// As in `xmm`.
    #[inline(always)]
    fn f32_to_u32(self, x: f32x8<Self>) -> u32x8<Self> {
        proven!({
            let x = f32x8(_mm256_max_ps(x.0, _mm256_setzero_ps()), self);
            let great = _mm256_cmp_ps::<_CMP_GE_OQ>(x.0, _mm256_set1_ps(4_294_967_296.0));
            let fits = Ymm::f32_to_u32_fast(self, x).0;
            u32x8(_mm256_or_si256(fits, _mm256_castps_si256(great)), self)
        })
    }
    /// As in `xmm`.
    #[inline(always)]
    fn f32_to_u32_fast(self, x: f32x8<Self>) -> u32x8<Self> {
        proven!({
            let low = _mm256_cvttps_epi32(x.0);
            let rest = _mm256_sub_ps(x.0, _mm256_set1_ps(2_147_483_648.0));
            let rest = _mm256_and_si256(_mm256_cvttps_epi32(rest), _mm256_srai_epi32::<31>(low));
            u32x8(_mm256_or_si256(low, rest), self)
        })
    }
}

/// Eight lanes of `f32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct f32x8<L>(pub(super) __m256, pub(super) L);

/// Eight lanes of `i32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct i32x8<L>(pub(super) __m256i, pub(super) L);

/// Eight lanes of `u32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct u32x8<L>(pub(super) __m256i, pub(super) L);

/// Eight lanes of truth: the bits of a lane are all 1 or all 0.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct mask32x8<L>(pub(super) __m256, pub(super) L);

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
    fn token(self) -> L {
        self.1
    }
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
    /// In the register: through memory it takes several times as long where the stack is such that
    /// the register straddles two pages.
    #[inline(always)]
    fn lane(self, lane: usize) -> f32 {
        assert!(lane < 8, "lane {lane} of 8");
        proven!({
            let lane = _mm256_castsi128_si256(_mm_cvtsi32_si128(lane as i32));
            _mm256_cvtss_f32(_mm256_permutevar8x32_ps(self.0, lane))
        })
    }
    #[inline(always)]
    fn load_prefix(s: L, from: &[f32], fill: f32) -> Self {
        types::load_prefix(s, from, fill)
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
    fn select(m: mask32x8<L>, a: Self, b: Self) -> Self {
        f32x8(Ymm::blend(a.1, m.0, a.0, b.0), a.1)
    }
    #[inline(always)]
    fn masked(self, m: mask32x8<L>) -> Self {
        f32x8(proven!(_mm256_and_ps(m.0, self.0)), self.1)
    }
    /// The compiler makes a masked store of a blend that is stored, which takes AMD before Zen 5
    /// ten times as long as the two.
    #[inline(always)]
    fn merge(m: mask32x8<L>, a: Self, b: Self) -> Self {
        f32x8(proven!(_mm256_or_ps(_mm256_and_ps(m.0, a.0), _mm256_andnot_ps(m.0, b.0))), a.1)
    }
    #[inline(always)]
    fn reverse(self) -> Self {
        proven!({
            let order = _mm256_set_epi32(0, 1, 2, 3, 4, 5, 6, 7);
            f32x8(_mm256_permutevar8x32_ps(self.0, order), self.1)
        })
    }
    #[inline(always)]
    fn zip(self, b: Self) -> (Self, Self) {
        proven!({
            let low = _mm256_unpacklo_ps(self.0, b.0);
            let high = _mm256_unpackhi_ps(self.0, b.0);
            (
                f32x8(_mm256_permute2f128_ps::<0x20>(low, high), self.1),
                f32x8(_mm256_permute2f128_ps::<0x31>(low, high), self.1),
            )
        })
    }
    #[inline(always)]
    fn unzip(self, b: Self) -> (Self, Self) {
        proven!({
            let even = _mm256_shuffle_ps::<0b_10_00_10_00>(self.0, b.0);
            let odd = _mm256_shuffle_ps::<0b_11_01_11_01>(self.0, b.0);
            // The pairs of both registers' lower halves come first.
            let even = _mm256_permute4x64_pd::<0b_11_01_10_00>(_mm256_castps_pd(even));
            let odd = _mm256_permute4x64_pd::<0b_11_01_10_00>(_mm256_castps_pd(odd));
            (f32x8(_mm256_castpd_ps(even), self.1), f32x8(_mm256_castpd_ps(odd), self.1))
        })
    }
    #[inline(always)]
    fn reduce<F: Fold>(self) -> f32 {
        {
            let (low, high) = self.halves();
            F::fold(low, high).reduce::<F>()
        }
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

    const FUSED: bool = true;

    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x8(proven!(_mm256_sqrt_ps(self.0)), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32x8(proven!(_mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0)), self.1)
    }
    #[inline(always)]
    fn fused_mul_add(self, b: Self, c: Self) -> Self {
        f32x8(proven!(_mm256_fmadd_ps(self.0, b.0, c.0)), self.1)
    }
    /// Of equal operands, `min` gives the second: that is a negative `self` or a positive one's
    /// partner. A NaN that is second is replaced, one that is first loses in `min`.
    #[inline(always)]
    fn min_num(self, b: Self) -> Self {
        proven!({
            let first = _mm256_blendv_ps(self.0, b.0, self.0);
            let second = _mm256_blendv_ps(b.0, self.0, self.0);
            let least = _mm256_min_ps(first, second);
            let nan = _mm256_cmp_ps::<_CMP_UNORD_Q>(second, second);
            f32x8(_mm256_blendv_ps(least, first, nan), self.1)
        })
    }
    /// As [`SimdF32::min_num`], with the signs the other way round.
    #[inline(always)]
    fn max_num(self, b: Self) -> Self {
        proven!({
            let first = _mm256_blendv_ps(b.0, self.0, self.0);
            let second = _mm256_blendv_ps(self.0, b.0, self.0);
            let greatest = _mm256_max_ps(first, second);
            let nan = _mm256_cmp_ps::<_CMP_UNORD_Q>(second, second);
            f32x8(_mm256_blendv_ps(greatest, first, nan), self.1)
        })
    }
    #[inline(always)]
    fn round_ties_even(self) -> Self {
        f32x8(
            proven!(_mm256_round_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(self.0)),
            self.1,
        )
    }
    #[inline(always)]
    fn floor(self) -> Self {
        f32x8(
            proven!(_mm256_round_ps::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>(self.0)),
            self.1,
        )
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        f32x8(
            proven!(_mm256_round_ps::<{ _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC }>(self.0)),
            self.1,
        )
    }
    #[inline(always)]
    fn trunc(self) -> Self {
        f32x8(
            proven!(_mm256_round_ps::<{ _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC }>(self.0)),
            self.1,
        )
    }
    #[inline(always)]
    fn rcp_est(self) -> Self {
        f32x8(proven!(_mm256_rcp_ps(self.0)), self.1)
    }
    #[inline(always)]
    fn rsqrt_est(self) -> Self {
        f32x8(proven!(_mm256_rsqrt_ps(self.0)), self.1)
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
    #[inline(always)]
    fn from_u32(u: Self::U32) -> Self {
        Ymm::u32_to_f32(u.1, u)
    }
    #[inline(always)]
    fn to_i32(self) -> Self::I32 {
        proven!({
            // What does not fit becomes i32::MIN: of too great values all bits are to be turned,
            // of NaN none is to stay.
            let great = _mm256_cmp_ps::<_CMP_GE_OQ>(self.0, _mm256_set1_ps(2_147_483_648.0));
            let number = _mm256_cmp_ps::<_CMP_ORD_Q>(self.0, self.0);
            let turned = _mm256_xor_si256(_mm256_cvttps_epi32(self.0), _mm256_castps_si256(great));
            i32x8(_mm256_and_si256(turned, _mm256_castps_si256(number)), self.1)
        })
    }
    #[inline(always)]
    fn to_u32(self) -> Self::U32 {
        Ymm::f32_to_u32(self.1, self)
    }
    #[inline(always)]
    fn to_i32_fast(self) -> Self::I32 {
        i32x8(proven!(_mm256_cvttps_epi32(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32_fast(self) -> Self::U32 {
        Ymm::f32_to_u32_fast(self.1, self)
    }
}

// i32 and u32

/// What is the same text for both signs.
macro_rules! integers {
    ($name:ident, $elem:ty, $min:ident, $max:ident, |$a:ident, $b:ident| $lt:expr) => {
        impl<L: Ymm> Lanes for $name<L> {
            type Simd = L;
            type Elem = $elem;
            type Array = [$elem; 8];
            type Mask = mask32x8<L>;

            const LANES: usize = 8;

            #[inline(always)]
            fn token(self) -> L {
                self.1
            }
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
            fn lane(self, lane: usize) -> $elem {
                assert!(lane < 8, "lane {lane} of 8");
                proven!({
                    let lane = _mm256_castsi128_si256(_mm_cvtsi32_si128(lane as i32));
                    _mm256_cvtsi256_si32(_mm256_permutevar8x32_epi32(self.0, lane)) as $elem
                })
            }
            #[inline(always)]
            fn load_prefix(s: L, from: &[$elem], fill: $elem) -> Self {
                types::load_prefix(s, from, fill)
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
                mask32x8(proven!(_mm256_castsi256_ps(_mm256_cmpeq_epi32(self.0, b.0))), self.1)
            }
            #[inline(always)]
            fn lt(self, b: Self) -> Self::Mask {
                let ($a, $b) = (self.0, b.0);
                mask32x8(proven!(_mm256_castsi256_ps($lt)), self.1)
            }
            #[inline(always)]
            fn le(self, b: Self) -> Self::Mask {
                !b.lt(self)
            }
            #[inline(always)]
            fn select(m: mask32x8<L>, a: Self, b: Self) -> Self {
                $name(Ymm::blend_i32(a.1, proven!(_mm256_castps_si256(m.0)), a.0, b.0), a.1)
            }
            #[inline(always)]
            fn masked(self, m: mask32x8<L>) -> Self {
                $name(proven!(_mm256_and_si256(_mm256_castps_si256(m.0), self.0)), self.1)
            }
            #[inline(always)]
            fn merge(m: mask32x8<L>, a: Self, b: Self) -> Self {
                proven!({
                    let m = _mm256_castps_si256(m.0);
                    $name(
                        _mm256_or_si256(_mm256_and_si256(m, a.0), _mm256_andnot_si256(m, b.0)),
                        a.1,
                    )
                })
            }
            #[inline(always)]
            fn reverse(self) -> Self {
                proven!({
                    let order = _mm256_set_epi32(0, 1, 2, 3, 4, 5, 6, 7);
                    $name(_mm256_permutevar8x32_epi32(self.0, order), self.1)
                })
            }
            #[inline(always)]
            fn zip(self, b: Self) -> (Self, Self) {
                proven!({
                    let low = _mm256_unpacklo_epi32(self.0, b.0);
                    let high = _mm256_unpackhi_epi32(self.0, b.0);
                    (
                        $name(_mm256_permute2x128_si256::<0x20>(low, high), self.1),
                        $name(_mm256_permute2x128_si256::<0x31>(low, high), self.1),
                    )
                })
            }
            #[inline(always)]
            fn unzip(self, b: Self) -> (Self, Self) {
                proven!({
                    let (x, y) = (_mm256_castsi256_ps(self.0), _mm256_castsi256_ps(b.0));
                    let (even, odd) = f32x8(x, self.1).unzip(f32x8(y, b.1));
                    (
                        $name(_mm256_castps_si256(even.0), self.1),
                        $name(_mm256_castps_si256(odd.0), self.1),
                    )
                })
            }
            #[inline(always)]
            fn reduce<F: Fold>(self) -> $elem {
                {
                    let (low, high) = self.halves();
                    F::fold(low, high).reduce::<F>()
                }
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
        unary_operator! { [L: Ymm] $name<L> {
            Not not |a| $name(proven!(_mm256_xor_si256(a.0, _mm256_set1_epi32(-1))), a.1)
        }}

        impl<L: Ymm> SimdInt for $name<L> {
            #[inline(always)]
            fn shl(self, n: u32) -> Self {
                $name(proven!(_mm256_sll_epi32(self.0, _mm_cvtsi32_si128(n as i32))), self.1)
            }
            #[inline(always)]
            fn shr(self, n: u32) -> Self {
                $name(proven!(_mm256_srl_epi32(self.0, _mm_cvtsi32_si128(n as i32))), self.1)
            }
        }
    };
}

integers!(i32x8, i32, _mm256_min_epi32, _mm256_max_epi32, |a, b| _mm256_cmpgt_epi32(b, a));
integers!(u32x8, u32, _mm256_min_epu32, _mm256_max_epu32, |a, b| {
    // There are only signed comparisons, so both are moved by 2^31.
    let bias = _mm256_set1_epi32(i32::MIN);
    _mm256_cmpgt_epi32(_mm256_xor_si256(b, bias), _mm256_xor_si256(a, bias))
});

unary_operator! { [L: Ymm] i32x8<L> {
    Neg neg |a| i32x8(proven!(_mm256_sub_epi32(_mm256_setzero_si256(), a.0)), a.1)
}}

impl<L: Ymm> SimdI32 for i32x8<L> {
    type U32 = u32x8<L>;

    #[inline(always)]
    fn sar(self, n: u32) -> Self {
        i32x8(proven!(_mm256_sra_epi32(self.0, _mm_cvtsi32_si128(n as i32))), self.1)
    }
    #[inline(always)]
    fn to_u32(self) -> Self::U32 {
        u32x8(self.0, self.1)
    }
    #[inline(always)]
    fn from_u32(u: Self::U32) -> Self {
        i32x8(u.0, u.1)
    }
}

impl<L: Ymm> SimdU32 for u32x8<L> {
    #[inline(always)]
    fn permute(self, order: Self) -> Self {
        u32x8(proven!(_mm256_permutevar8x32_epi32(self.0, order.0)), self.1)
    }
}

/// Two 128-bit registers to one and back.
macro_rules! wide {
    ($name:ident, $Half:ident, $concat:ident, $low:ident, $high:ident) => {
        impl<L: Ymm> Wide for $name<L> {
            type Half = xmm::$Half<L>;

            #[inline(always)]
            fn concat(low: Self::Half, high: Self::Half) -> Self {
                $name(proven!($concat(high.0, low.0)), low.1)
            }
            #[inline(always)]
            fn halves(self) -> (Self::Half, Self::Half) {
                proven!((xmm::$Half($low(self.0), self.1), xmm::$Half($high::<1>(self.0), self.1)))
            }
        }
    };
}

wide!(f32x8, f32x4, _mm256_set_m128, _mm256_castps256_ps128, _mm256_extractf128_ps);
wide!(i32x8, i32x4, _mm256_set_m128i, _mm256_castsi256_si128, _mm256_extracti128_si256);
wide!(u32x8, u32x4, _mm256_set_m128i, _mm256_castsi256_si128, _mm256_extracti128_si256);

// mask

impl<L: Ymm> SimdMask for mask32x8<L> {
    type Simd = L;
    type Array = [bool; 8];

    const LANES: usize = 8;

    #[inline(always)]
    fn token(self) -> L {
        self.1
    }
    #[inline(always)]
    fn splat(s: L, b: bool) -> Self {
        mask32x8(proven!(_mm256_castsi256_ps(_mm256_set1_epi32(-i32::from(b)))), s)
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
