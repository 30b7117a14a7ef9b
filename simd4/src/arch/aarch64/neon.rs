//! NEON: four lanes in one 128-bit register.

use core::arch::aarch64::*;
use core::mem::transmute;

use super::super::{proven, token};
use crate::simd::sealed::Sealed;
use crate::types::{conversions, operators, unary_operator};
use crate::{Halves, Lanes, Level, Simd, SimdF32, SimdI32, SimdMask, SimdU32};

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
    type f32s = f32x4;

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
    #[inline(always)]
    fn select(m: mask32x4, a: Self, b: Self) -> Self {
        f32x4(proven!(vbslq_f32(m.0, a.0, b.0)), a.1)
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

    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x4(proven!(vsqrtq_f32(self.0)), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32x4(proven!(vabsq_f32(self.0)), self.1)
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
    fn ne(self, b: Self) -> mask32x4 {
        !self.eq(b)
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
}

// i32 and u32

/// The integers, whose instructions differ by their suffix alone.
macro_rules! integers {
    (
        $name:ident: $Trait:ident, $elem:ident, $register:ident;
        $dup:ident $select:ident $add:ident $sub:ident $mul:ident $and:ident $or:ident $xor:ident
        $min:ident $max:ident $eq:ident $lt:ident
    ) => {
        impl Lanes for $name {
            type Simd = Neon;
            type Elem = $elem;
            type Array = [$elem; 4];
            type Mask = mask32x4;

            const LANES: usize = 4;

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
            fn select(m: mask32x4, a: Self, b: Self) -> Self {
                $name(proven!($select(m.0, a.0, b.0)), a.1)
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

        impl $Trait for $name {
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
        }
    };
}

integers! {
    i32x4: SimdI32, i32, int32x4_t;
    vdupq_n_s32 vbslq_s32 vaddq_s32 vsubq_s32 vmulq_s32 vandq_s32 vorrq_s32 veorq_s32
    vminq_s32 vmaxq_s32 vceqq_s32 vcltq_s32
}
integers! {
    u32x4: SimdU32, u32, uint32x4_t;
    vdupq_n_u32 vbslq_u32 vaddq_u32 vsubq_u32 vmulq_u32 vandq_u32 vorrq_u32 veorq_u32
    vminq_u32 vmaxq_u32 vceqq_u32 vcltq_u32
}

// mask

impl SimdMask for mask32x4 {
    type Simd = Neon;
    type Array = [bool; 4];

    const LANES: usize = 4;

    #[inline(always)]
    fn splat(s: Neon, b: bool) -> Self {
        Self::from_array(s, [b; 4])
    }
    #[inline(always)]
    fn from_array(s: Neon, a: [bool; 4]) -> Self {
        let lanes = a.map(|b| u32::from(b).wrapping_neg());
        mask32x4(proven!(transmute::<[u32; 4], uint32x4_t>(lanes)), s)
    }
    #[inline(always)]
    fn to_array(self) -> [bool; 4] {
        proven!(transmute::<uint32x4_t, [u32; 4]>(self.0)).map(|lane| lane != 0)
    }
    #[inline(always)]
    fn bitmask(self) -> u32 {
        proven!({
            let bits = transmute::<[u32; 4], uint32x4_t>([1, 2, 4, 8]);
            vaddvq_u32(vandq_u32(self.0, bits))
        })
    }
    #[inline(always)]
    fn any(self) -> bool {
        proven!(vmaxvq_u32(self.0)) != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        proven!(vminvq_u32(self.0)) != 0
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
