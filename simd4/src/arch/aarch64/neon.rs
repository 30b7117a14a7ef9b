//! NEON: four lanes in one 128-bit register.

use core::arch::aarch64::*;
use core::mem::transmute;

use super::super::{proven, token};
use crate::simd::sealed::Sealed;
use crate::types::reduce::{self, Fold};
use crate::types::{conversions, operators, unary_operator};
use crate::{Halves, Lanes, Level, Simd, SimdF32, SimdI32, SimdInt, SimdMask, SimdU32};

token! {
    /// The token of the level `neon`.
    Neon, is_aarch64_feature_detected, ["neon"]
}

impl Simd for Neon {
    type f32x4 = f32x4;
    type i32x4 = i32x4;
    type u32x4 = u32x4;
    type mask32x4 = mask32x4;
    type f32x8 = Halves<f32x4>;
    type i32x8 = Halves<i32x4>;
    type u32x8 = Halves<u32x4>;
    type mask32x8 = Halves<mask32x4>;
    type f32x16 = Halves<Self::f32x8>;
    type i32x16 = Halves<Self::i32x8>;
    type u32x16 = Halves<Self::u32x8>;
    type mask32x16 = Halves<Self::mask32x8>;
    type f32s = f32x4;
    type i32s = i32x4;
    type u32s = u32x4;
    type mask32s = mask32x4;

    #[inline(always)]
    fn level(self) -> Level {
        Level::Neon(self)
    }

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        #[target_feature(enable = "neon")]
        fn neon<R>(f: impl FnOnce() -> R) -> R {
            f()
        }
        proven!(neon(f))
    }
}

/// Four lanes of `f32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct f32x4(float32x4_t, Neon);

/// Four lanes of `i32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct i32x4(int32x4_t, Neon);

/// Four lanes of `u32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct u32x4(uint32x4_t, Neon);

/// Four lanes of truth: the bits of a lane are all 1 or all 0.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct mask32x4(uint32x4_t, Neon);

impl Sealed for f32x4 {}
impl Sealed for i32x4 {}
impl Sealed for u32x4 {}
impl Sealed for mask32x4 {}

// f32

impl Lanes for f32x4 {
    type Simd = Neon;
    type Elem = f32;
    type Array = [f32; 4];
    type Mask = mask32x4;

    const LANES: usize = 4;

    #[inline(always)]
    fn token(self) -> Neon {
        self.1
    }
    #[inline(always)]
    fn splat(s: Neon, x: f32) -> Self {
        f32x4(proven!(vdupq_n_f32(x)), s)
    }
    #[inline(always)]
    fn from_array(s: Neon, a: [f32; 4]) -> Self {
        f32x4(proven!(transmute::<[f32; 4], float32x4_t>(a)), s)
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 4] {
        proven!(transmute::<float32x4_t, [f32; 4]>(self.0))
    }
    // The instructions for minimum and maximum treat NaN and zeros otherwise.
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        Self::select(self.lt(b), self, b)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        Self::select(b.lt(self), self, b)
    }
    #[inline(always)]
    fn eq(self, b: Self) -> mask32x4 {
        mask32x4(proven!(vceqq_f32(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn lt(self, b: Self) -> mask32x4 {
        mask32x4(proven!(vcltq_f32(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn le(self, b: Self) -> mask32x4 {
        mask32x4(proven!(vcleq_f32(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn select(m: mask32x4, a: Self, b: Self) -> Self {
        f32x4(proven!(vbslq_f32(m.0, a.0, b.0)), a.1)
    }
    #[inline(always)]
    fn zip(self, b: Self) -> (Self, Self) {
        proven!((f32x4(vzip1q_f32(self.0, b.0), self.1), f32x4(vzip2q_f32(self.0, b.0), self.1)))
    }
    #[inline(always)]
    fn unzip(self, b: Self) -> (Self, Self) {
        proven!((f32x4(vuzp1q_f32(self.0, b.0), self.1), f32x4(vuzp2q_f32(self.0, b.0), self.1)))
    }
    #[inline(always)]
    fn reduce<F: Fold>(self) -> f32 {
        reduce::four::<F, Self>(self)
    }
}

conversions! { [] f32x4, Neon }
operators! { [] f32x4 {
    Add add AddAssign add_assign |a, b| f32x4(proven!(vaddq_f32(a.0, b.0)), a.1);
    Sub sub SubAssign sub_assign |a, b| f32x4(proven!(vsubq_f32(a.0, b.0)), a.1);
    Mul mul MulAssign mul_assign |a, b| f32x4(proven!(vmulq_f32(a.0, b.0)), a.1);
    Div div DivAssign div_assign |a, b| f32x4(proven!(vdivq_f32(a.0, b.0)), a.1);
}}
unary_operator! { [] f32x4 { Neg neg |a| f32x4(proven!(vnegq_f32(a.0)), a.1) } }

impl SimdF32 for f32x4 {
    type I32 = i32x4;
    type U32 = u32x4;

    const FUSED: bool = true;

    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x4(proven!(vsqrtq_f32(self.0)), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32x4(proven!(vabsq_f32(self.0)), self.1)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f32x4(proven!(vbslq_f32(vdupq_n_u32(1 << 31), sign.0, self.0)), self.1)
    }
    #[inline(always)]
    fn fused_mul_add(self, b: Self, c: Self) -> Self {
        f32x4(proven!(vfmaq_f32(c.0, self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn fused_nmul_add(self, b: Self, c: Self) -> Self {
        f32x4(proven!(vfmsq_f32(c.0, self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn round_ties_even(self) -> Self {
        f32x4(proven!(vrndnq_f32(self.0)), self.1)
    }
    #[inline(always)]
    fn floor(self) -> Self {
        f32x4(proven!(vrndmq_f32(self.0)), self.1)
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        f32x4(proven!(vrndpq_f32(self.0)), self.1)
    }
    #[inline(always)]
    fn trunc(self) -> Self {
        f32x4(proven!(vrndq_f32(self.0)), self.1)
    }
    // The raw estimates err by 2^-8.5. A step makes that 2^-16.9, and 2^-15.9 for the root; a
    // second one 2^-22.9. `rcp_fast` stays the division: one instruction, and a shorter chain than
    // seven. The root takes the two steps, which keep the divider free; it would need it twice.
    #[inline(always)]
    fn rcp_est(self) -> Self {
        proven!({
            let estimate = vrecpeq_f32(self.0);
            let step = vrecpsq_f32(self.0, estimate);
            f32x4(vmulq_f32(estimate, bounded(step)), self.1)
        })
    }
    #[inline(always)]
    fn rsqrt_est(self) -> Self {
        rsqrt_step(self, f32x4(proven!(vrsqrteq_f32(self.0)), self.1))
    }
    #[inline(always)]
    fn rsqrt_fast(self) -> Self {
        rsqrt_step(self, self.rsqrt_est())
    }
    #[inline(always)]
    fn to_bits(self) -> u32x4 {
        u32x4(proven!(vreinterpretq_u32_f32(self.0)), self.1)
    }
    #[inline(always)]
    fn from_bits(bits: u32x4) -> Self {
        f32x4(proven!(vreinterpretq_f32_u32(bits.0)), bits.1)
    }
    #[inline(always)]
    fn from_i32(i: i32x4) -> Self {
        f32x4(proven!(vcvtq_f32_s32(i.0)), i.1)
    }
    #[inline(always)]
    fn from_u32(u: u32x4) -> Self {
        f32x4(proven!(vcvtq_f32_u32(u.0)), u.1)
    }
    #[inline(always)]
    fn to_i32(self) -> i32x4 {
        i32x4(proven!(vcvtq_s32_f32(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32(self) -> u32x4 {
        u32x4(proven!(vcvtq_u32_f32(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32_fast(self) -> u32x4 {
        self.to_u32()
    }
}

/// About `1 / x.sqrt()` by one Newton step from an estimate.
#[inline(always)]
fn rsqrt_step(x: f32x4, estimate: f32x4) -> f32x4 {
    proven!({
        let step = vrsqrtsq_f32(vmulq_f32(x.0, estimate.0), estimate.0);
        f32x4(vmulq_f32(estimate.0, bounded(step)), x.1)
    })
}

/// The factor of a Newton step, which is about 1. Where one of 0 and ∞ is the estimate for the
/// other it is NaN, and −∞ where a subnormal's is ∞: it becomes one that leaves such an estimate
/// as it is. A NaN among the estimates stays one.
#[inline(always)]
fn bounded(step: float32x4_t) -> float32x4_t {
    proven!(vmaxnmq_f32(step, vdupq_n_f32(0.5)))
}

// i32 and u32

/// The integers, whose instructions differ by their suffix alone.
macro_rules! integers {
    (
        $name:ident, $elem:ident, $register:ident;
        $dup:ident $min:ident $max:ident $eq:ident $lt:ident $le:ident $select:ident
        $zip1:ident $zip2:ident $uzp1:ident $uzp2:ident
        $sum:ident $least:ident $greatest:ident
        $add:ident $sub:ident $mul:ident $and:ident $or:ident $xor:ident $not:ident
    ) => {
        impl Lanes for $name {
            type Simd = Neon;
            type Elem = $elem;
            type Array = [$elem; 4];
            type Mask = mask32x4;

            const LANES: usize = 4;

            #[inline(always)]
            fn token(self) -> Neon {
                self.1
            }
            #[inline(always)]
            fn splat(s: Neon, x: $elem) -> Self {
                $name(proven!($dup(x)), s)
            }
            #[inline(always)]
            fn from_array(s: Neon, a: [$elem; 4]) -> Self {
                $name(proven!(transmute::<[$elem; 4], $register>(a)), s)
            }
            #[inline(always)]
            fn to_array(self) -> [$elem; 4] {
                proven!(transmute::<$register, [$elem; 4]>(self.0))
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
            fn eq(self, b: Self) -> mask32x4 {
                mask32x4(proven!($eq(self.0, b.0)), self.1)
            }
            #[inline(always)]
            fn lt(self, b: Self) -> mask32x4 {
                mask32x4(proven!($lt(self.0, b.0)), self.1)
            }
            #[inline(always)]
            fn le(self, b: Self) -> mask32x4 {
                mask32x4(proven!($le(self.0, b.0)), self.1)
            }
            #[inline(always)]
            fn select(m: mask32x4, a: Self, b: Self) -> Self {
                $name(proven!($select(m.0, a.0, b.0)), a.1)
            }
            #[inline(always)]
            fn zip(self, b: Self) -> (Self, Self) {
                proven!(($name($zip1(self.0, b.0), self.1), $name($zip2(self.0, b.0), self.1)))
            }
            #[inline(always)]
            fn unzip(self, b: Self) -> (Self, Self) {
                proven!(($name($uzp1(self.0, b.0), self.1), $name($uzp2(self.0, b.0), self.1)))
            }
            #[inline(always)]
            fn reduce<F: Fold>(self) -> $elem {
                reduce::four::<F, Self>(self)
            }
            // In whatever order integers are added or compared, the result is the same.
            #[inline(always)]
            fn reduce_sum(self) -> $elem {
                proven!($sum(self.0))
            }
            #[inline(always)]
            fn reduce_min(self) -> $elem {
                proven!($least(self.0))
            }
            #[inline(always)]
            fn reduce_max(self) -> $elem {
                proven!($greatest(self.0))
            }
        }

        conversions! { [] $name, Neon }
        operators! { [] $name {
            Add add AddAssign add_assign |a, b| $name(proven!($add(a.0, b.0)), a.1);
            Sub sub SubAssign sub_assign |a, b| $name(proven!($sub(a.0, b.0)), a.1);
            Mul mul MulAssign mul_assign |a, b| $name(proven!($mul(a.0, b.0)), a.1);
            BitAnd bitand BitAndAssign bitand_assign |a, b| $name(proven!($and(a.0, b.0)), a.1);
            BitOr bitor BitOrAssign bitor_assign |a, b| $name(proven!($or(a.0, b.0)), a.1);
            BitXor bitxor BitXorAssign bitxor_assign |a, b| $name(proven!($xor(a.0, b.0)), a.1);
        }}
        unary_operator! { [] $name { Not not |a| $name(proven!($not(a.0)), a.1) } }
    };
}

integers! {
    i32x4, i32, int32x4_t;
    vdupq_n_s32 vminq_s32 vmaxq_s32 vceqq_s32 vcltq_s32 vcleq_s32 vbslq_s32
    vzip1q_s32 vzip2q_s32 vuzp1q_s32 vuzp2q_s32
    vaddvq_s32 vminvq_s32 vmaxvq_s32
    vaddq_s32 vsubq_s32 vmulq_s32 vandq_s32 vorrq_s32 veorq_s32 vmvnq_s32
}
integers! {
    u32x4, u32, uint32x4_t;
    vdupq_n_u32 vminq_u32 vmaxq_u32 vceqq_u32 vcltq_u32 vcleq_u32 vbslq_u32
    vzip1q_u32 vzip2q_u32 vuzp1q_u32 vuzp2q_u32
    vaddvq_u32 vminvq_u32 vmaxvq_u32
    vaddq_u32 vsubq_u32 vmulq_u32 vandq_u32 vorrq_u32 veorq_u32 vmvnq_u32
}

unary_operator! { [] i32x4 { Neg neg |a| i32x4(proven!(vnegq_s32(a.0)), a.1) } }

// The shifts take the low byte of a lane as a signed count, upwards: −32 … 32 suffices.

impl SimdInt for i32x4 {
    #[inline(always)]
    fn shl(self, n: u32) -> Self {
        i32x4(proven!(vshlq_s32(self.0, vdupq_n_s32(n.min(32) as i32))), self.1)
    }
    #[inline(always)]
    fn shr(self, n: u32) -> Self {
        Self::from_u32(self.to_u32().shr(n))
    }
}

impl SimdInt for u32x4 {
    #[inline(always)]
    fn shl(self, n: u32) -> Self {
        u32x4(proven!(vshlq_u32(self.0, vdupq_n_s32(n.min(32) as i32))), self.1)
    }
    #[inline(always)]
    fn shr(self, n: u32) -> Self {
        u32x4(proven!(vshlq_u32(self.0, vdupq_n_s32(-(n.min(32) as i32)))), self.1)
    }
}

impl SimdI32 for i32x4 {
    type U32 = u32x4;

    #[inline(always)]
    fn sar(self, n: u32) -> Self {
        i32x4(proven!(vshlq_s32(self.0, vdupq_n_s32(-(n.min(32) as i32)))), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        i32x4(proven!(vabsq_s32(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32(self) -> u32x4 {
        u32x4(proven!(vreinterpretq_u32_s32(self.0)), self.1)
    }
    #[inline(always)]
    fn from_u32(u: u32x4) -> Self {
        i32x4(proven!(vreinterpretq_s32_u32(u.0)), u.1)
    }
}

impl SimdU32 for u32x4 {
    #[inline(always)]
    fn permute(self, order: Self) -> Self {
        proven!({
            // Of each lane's number the numbers of its four bytes.
            let lanes = vandq_u32(order.0, vdupq_n_u32(3));
            let bytes = vmlaq_u32(vdupq_n_u32(0x0302_0100), lanes, vdupq_n_u32(0x0404_0404));
            let moved = vqtbl1q_u8(vreinterpretq_u8_u32(self.0), vreinterpretq_u8_u32(bytes));
            u32x4(vreinterpretq_u32_u8(moved), self.1)
        })
    }
}

// mask

impl SimdMask for mask32x4 {
    type Simd = Neon;
    type Array = [bool; 4];

    const LANES: usize = 4;

    #[inline(always)]
    fn token(self) -> Neon {
        self.1
    }
    #[inline(always)]
    fn splat(s: Neon, b: bool) -> Self {
        mask32x4(proven!(vdupq_n_u32(u32::from(b).wrapping_neg())), s)
    }
    #[inline(always)]
    fn from_array(s: Neon, a: [bool; 4]) -> Self {
        proven!({
            // A lane is −1 where its byte is 1.
            let bytes = transmute::<[[bool; 4]; 2], uint8x8_t>([a; 2]);
            let lanes = vmovl_u16(vget_low_u16(vmovl_u8(bytes)));
            mask32x4(vreinterpretq_u32_s32(vnegq_s32(vreinterpretq_s32_u32(lanes))), s)
        })
    }
    #[inline(always)]
    fn to_array(self) -> [bool; 4] {
        let bytes = proven!({
            let halfwords = vmovn_u32(self.0);
            let bytes = vmovn_u16(vcombine_u16(halfwords, halfwords));
            vand_u8(bytes, vdup_n_u8(1))
        });
        // SAFETY: a byte is 0 or 1.
        let [lanes, _] = unsafe { transmute::<uint8x8_t, [[bool; 4]; 2]>(bytes) };
        lanes
    }
    #[inline(always)]
    fn bitmask(self) -> u32 {
        let bits = proven!({
            let places = transmute::<[u32; 4], uint32x4_t>([1, 2, 4, 8]);
            vaddvq_u32(vandq_u32(self.0, places))
        });
        // SAFETY: all places make 15. Known to the compiler, it spares checks of lanes.
        unsafe { core::hint::assert_unchecked(bits < 16) };
        bits
    }
    #[inline(always)]
    fn any(self) -> bool {
        proven!(vmaxvq_u32(self.0)) != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        proven!(vminvq_u32(self.0)) != 0
    }
    #[inline(always)]
    fn count(self) -> u32 {
        // A true lane is −1.
        proven!(vaddvq_u32(self.0)).wrapping_neg()
    }
}

operators! { [] mask32x4 {
    BitAnd bitand BitAndAssign bitand_assign |a, b| mask32x4(proven!(vandq_u32(a.0, b.0)), a.1);
    BitOr bitor BitOrAssign bitor_assign |a, b| mask32x4(proven!(vorrq_u32(a.0, b.0)), a.1);
    BitXor bitxor BitXorAssign bitxor_assign |a, b| mask32x4(proven!(veorq_u32(a.0, b.0)), a.1);
}}
unary_operator! { [] mask32x4 { Not not |a| mask32x4(proven!(vmvnq_u32(a.0)), a.1) } }

impl core::fmt::Debug for mask32x4 {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.to_array().fmt(f)
    }
}
