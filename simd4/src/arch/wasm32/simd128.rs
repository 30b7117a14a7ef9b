//! WebAssembly's fixed-width SIMD: four lanes in one 128-bit register. Of relaxed SIMD nothing is
//! used: its results differ between machines.

use core::arch::wasm32::*;
use core::mem::transmute;

use super::super::proven;
use crate::simd::sealed::Sealed;
use crate::types::reduce::{self, Fold};
use crate::types::{conversions, operators, unary_operator};
use crate::{Guaranteed, Halves, Lanes, Level, Simd, SimdF32, SimdI32, SimdInt, SimdMask, SimdU32};

/// The token of the level `simd128`.
#[derive(Clone, Copy, Debug)]
pub struct Simd128 {
    _private: (),
}

impl Simd128 {
    /// The token: a machine that has loaded the module has the level.
    #[inline]
    pub fn detect() -> Option<Self> {
        Some(Self::TOKEN)
    }
}

impl Sealed for Simd128 {}

impl Guaranteed for Simd128 {
    const TOKEN: Self = Simd128 { _private: () };
}

impl Simd for Simd128 {
    type f32x4 = f32x4;
    type i32x4 = i32x4;
    type u32x4 = u32x4;
    type mask32x4 = mask32x4;
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
        Level::Simd128(self)
    }

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        f()
    }
}

/// Four lanes of `f32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct f32x4(v128, Simd128);

/// Four lanes of `i32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct i32x4(v128, Simd128);

/// Four lanes of `u32`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct u32x4(v128, Simd128);

/// Four lanes of truth: the bits of a lane are all 1 or all 0.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy)]
pub struct mask32x4(v128, Simd128);

impl Sealed for f32x4 {}
impl Sealed for i32x4 {}
impl Sealed for u32x4 {}
impl Sealed for mask32x4 {}

// f32

impl Lanes for f32x4 {
    type Simd = Simd128;
    type Elem = f32;
    type Array = [f32; 4];
    type Mask = mask32x4;

    const LANES: usize = 4;

    #[inline(always)]
    fn token(self) -> Simd128 {
        self.1
    }
    #[inline(always)]
    fn splat(s: Simd128, x: f32) -> Self {
        f32x4(proven!(f32x4_splat(x)), s)
    }
    #[inline(always)]
    fn from_array(s: Simd128, a: [f32; 4]) -> Self {
        f32x4(proven!(transmute::<[f32; 4], v128>(a)), s)
    }
    #[inline(always)]
    fn to_array(self) -> [f32; 4] {
        proven!(transmute::<v128, [f32; 4]>(self.0))
    }
    // `pmin(x, y)` is `y < x ? y : x`, and `pmax` likewise.
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        f32x4(proven!(f32x4_pmin(b.0, self.0)), self.1)
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        f32x4(proven!(f32x4_pmax(b.0, self.0)), self.1)
    }
    #[inline(always)]
    fn eq(self, b: Self) -> mask32x4 {
        mask32x4(proven!(f32x4_eq(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn ne(self, b: Self) -> mask32x4 {
        mask32x4(proven!(f32x4_ne(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn lt(self, b: Self) -> mask32x4 {
        mask32x4(proven!(f32x4_lt(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn le(self, b: Self) -> mask32x4 {
        mask32x4(proven!(f32x4_le(self.0, b.0)), self.1)
    }
    #[inline(always)]
    fn select(m: mask32x4, a: Self, b: Self) -> Self {
        f32x4(proven!(v128_bitselect(a.0, b.0, m.0)), a.1)
    }
    #[inline(always)]
    fn zip(self, b: Self) -> (Self, Self) {
        proven!((
            f32x4(i32x4_shuffle::<0, 4, 1, 5>(self.0, b.0), self.1),
            f32x4(i32x4_shuffle::<2, 6, 3, 7>(self.0, b.0), self.1),
        ))
    }
    #[inline(always)]
    fn unzip(self, b: Self) -> (Self, Self) {
        proven!((
            f32x4(i32x4_shuffle::<0, 2, 4, 6>(self.0, b.0), self.1),
            f32x4(i32x4_shuffle::<1, 3, 5, 7>(self.0, b.0), self.1),
        ))
    }
    #[inline(always)]
    fn reduce<F: Fold>(self) -> f32 {
        reduce::four::<F, Self>(self)
    }
}

conversions! { [] f32x4, Simd128 }
operators! { [] f32x4 {
    Add add AddAssign add_assign |a, b| f32x4(proven!(f32x4_add(a.0, b.0)), a.1);
    Sub sub SubAssign sub_assign |a, b| f32x4(proven!(f32x4_sub(a.0, b.0)), a.1);
    Mul mul MulAssign mul_assign |a, b| f32x4(proven!(f32x4_mul(a.0, b.0)), a.1);
    Div div DivAssign div_assign |a, b| f32x4(proven!(f32x4_div(a.0, b.0)), a.1);
}}
unary_operator! { [] f32x4 { Neg neg |a| f32x4(proven!(f32x4_neg(a.0)), a.1) } }

impl SimdF32 for f32x4 {
    type I32 = i32x4;
    type U32 = u32x4;

    const FUSED: bool = false;

    #[inline(always)]
    fn sqrt(self) -> Self {
        f32x4(proven!(f32x4_sqrt(self.0)), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32x4(proven!(f32x4_abs(self.0)), self.1)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f32x4(proven!(v128_bitselect(sign.0, self.0, u32x4_splat(1 << 31))), self.1)
    }
    #[inline(always)]
    fn fused_mul_add(self, b: Self, c: Self) -> Self {
        proven!({
            let low = fused_to_odd(self.0, b.0, c.0);
            let high = fused_to_odd(upper(self.0), upper(b.0), upper(c.0));
            let (low, high) = (f32x4_demote_f64x2_zero(low), f32x4_demote_f64x2_zero(high));
            f32x4(i64x2_shuffle::<0, 2>(low, high), self.1)
        })
    }
    #[inline(always)]
    fn round_ties_even(self) -> Self {
        f32x4(proven!(f32x4_nearest(self.0)), self.1)
    }
    #[inline(always)]
    fn floor(self) -> Self {
        f32x4(proven!(f32x4_floor(self.0)), self.1)
    }
    #[inline(always)]
    fn ceil(self) -> Self {
        f32x4(proven!(f32x4_ceil(self.0)), self.1)
    }
    #[inline(always)]
    fn trunc(self) -> Self {
        f32x4(proven!(f32x4_trunc(self.0)), self.1)
    }
    #[inline(always)]
    fn to_bits(self) -> u32x4 {
        u32x4(self.0, self.1)
    }
    #[inline(always)]
    fn from_bits(bits: u32x4) -> Self {
        f32x4(bits.0, bits.1)
    }
    #[inline(always)]
    fn from_i32(i: i32x4) -> Self {
        f32x4(proven!(f32x4_convert_i32x4(i.0)), i.1)
    }
    #[inline(always)]
    fn from_u32(u: u32x4) -> Self {
        f32x4(proven!(f32x4_convert_u32x4(u.0)), u.1)
    }
    #[inline(always)]
    fn to_i32(self) -> i32x4 {
        i32x4(proven!(i32x4_trunc_sat_f32x4(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32(self) -> u32x4 {
        u32x4(proven!(u32x4_trunc_sat_f32x4(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32_fast(self) -> u32x4 {
        self.to_u32()
    }
}

/// The upper two lanes in the lower places.
#[inline(always)]
fn upper(v: v128) -> v128 {
    proven!(i64x2_shuffle::<1, 1>(v, v))
}

/// `a * b + c` of the lower two lanes in `f64`, rounded to odd: one more rounding to `f32` then
/// is the only one. [`spec::fused_mul_add`](crate::spec::fused_mul_add) explains it.
#[inline(always)]
fn fused_to_odd(a: v128, b: v128, c: v128) -> v128 {
    proven!({
        let c = f64x2_promote_low_f32x4(c);
        let product = f64x2_mul(f64x2_promote_low_f32x4(a), f64x2_promote_low_f32x4(b));
        let sum = f64x2_add(product, c);
        let from_product = f64x2_sub(sum, c);
        let lost =
            f64x2_add(f64x2_sub(product, from_product), f64x2_sub(c, f64x2_sub(sum, from_product)));
        let zero = f64x2_splat(0.0);
        // +1 where the lost part points away from zero as the sum does, else −1; nothing where
        // the sum is exact or odd.
        let differ = v128_xor(f64x2_gt(lost, zero), f64x2_gt(sum, zero));
        let inexact = v128_or(f64x2_lt(lost, zero), f64x2_gt(lost, zero));
        let one = i64x2_splat(1);
        let even = i64x2_sub(v128_and(sum, one), one);
        let step = v128_and(v128_and(v128_or(differ, one), inexact), even);
        i64x2_add(sum, step)
    })
}

// i32 and u32

/// The integers, whose instructions differ by their prefix where there are two kinds.
macro_rules! integers {
    ($name:ident, $elem:ident; $splat:ident $min:ident $max:ident $lt:ident $le:ident) => {
        impl Lanes for $name {
            type Simd = Simd128;
            type Elem = $elem;
            type Array = [$elem; 4];
            type Mask = mask32x4;

            const LANES: usize = 4;

            #[inline(always)]
            fn token(self) -> Simd128 {
                self.1
            }
            #[inline(always)]
            fn splat(s: Simd128, x: $elem) -> Self {
                $name(proven!($splat(x)), s)
            }
            #[inline(always)]
            fn from_array(s: Simd128, a: [$elem; 4]) -> Self {
                $name(proven!(transmute::<[$elem; 4], v128>(a)), s)
            }
            #[inline(always)]
            fn to_array(self) -> [$elem; 4] {
                proven!(transmute::<v128, [$elem; 4]>(self.0))
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
                mask32x4(proven!(i32x4_eq(self.0, b.0)), self.1)
            }
            #[inline(always)]
            fn ne(self, b: Self) -> mask32x4 {
                mask32x4(proven!(i32x4_ne(self.0, b.0)), self.1)
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
                $name(proven!(v128_bitselect(a.0, b.0, m.0)), a.1)
            }
            #[inline(always)]
            fn zip(self, b: Self) -> (Self, Self) {
                proven!((
                    $name(i32x4_shuffle::<0, 4, 1, 5>(self.0, b.0), self.1),
                    $name(i32x4_shuffle::<2, 6, 3, 7>(self.0, b.0), self.1),
                ))
            }
            #[inline(always)]
            fn unzip(self, b: Self) -> (Self, Self) {
                proven!((
                    $name(i32x4_shuffle::<0, 2, 4, 6>(self.0, b.0), self.1),
                    $name(i32x4_shuffle::<1, 3, 5, 7>(self.0, b.0), self.1),
                ))
            }
            #[inline(always)]
            fn reduce<F: Fold>(self) -> $elem {
                reduce::four::<F, Self>(self)
            }
        }

        conversions! { [] $name, Simd128 }
        operators! { [] $name {
            Add add AddAssign add_assign |a, b| $name(proven!(i32x4_add(a.0, b.0)), a.1);
            Sub sub SubAssign sub_assign |a, b| $name(proven!(i32x4_sub(a.0, b.0)), a.1);
            Mul mul MulAssign mul_assign |a, b| $name(proven!(i32x4_mul(a.0, b.0)), a.1);
            BitAnd bitand BitAndAssign bitand_assign |a, b| $name(proven!(v128_and(a.0, b.0)), a.1);
            BitOr bitor BitOrAssign bitor_assign |a, b| $name(proven!(v128_or(a.0, b.0)), a.1);
            BitXor bitxor BitXorAssign bitxor_assign |a, b| $name(proven!(v128_xor(a.0, b.0)), a.1);
        }}
        unary_operator! { [] $name { Not not |a| $name(proven!(v128_not(a.0)), a.1) } }

        // The instructions count modulo 32.
        impl SimdInt for $name {
            #[inline(always)]
            fn shl(self, n: u32) -> Self {
                if n < 32 { $name(proven!(i32x4_shl(self.0, n)), self.1) } else { self ^ self }
            }
            #[inline(always)]
            fn shr(self, n: u32) -> Self {
                if n < 32 { $name(proven!(u32x4_shr(self.0, n)), self.1) } else { self ^ self }
            }
        }
    };
}

integers!(i32x4, i32; i32x4_splat i32x4_min i32x4_max i32x4_lt i32x4_le);
integers!(u32x4, u32; u32x4_splat u32x4_min u32x4_max u32x4_lt u32x4_le);

unary_operator! { [] i32x4 { Neg neg |a| i32x4(proven!(i32x4_neg(a.0)), a.1) } }

impl SimdI32 for i32x4 {
    type U32 = u32x4;

    #[inline(always)]
    fn sar(self, n: u32) -> Self {
        i32x4(proven!(i32x4_shr(self.0, n.min(31))), self.1)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        i32x4(proven!(i32x4_abs(self.0)), self.1)
    }
    #[inline(always)]
    fn to_u32(self) -> u32x4 {
        u32x4(self.0, self.1)
    }
    #[inline(always)]
    fn from_u32(u: u32x4) -> Self {
        i32x4(u.0, u.1)
    }
}

impl SimdU32 for u32x4 {
    #[inline(always)]
    fn permute(self, order: Self) -> Self {
        proven!({
            // Of each lane's number the numbers of its four bytes.
            let lanes = v128_and(order.0, i32x4_splat(3));
            let bytes =
                i32x4_add(i32x4_mul(lanes, i32x4_splat(0x0404_0404)), i32x4_splat(0x0302_0100));
            u32x4(i8x16_swizzle(self.0, bytes), self.1)
        })
    }
}

// mask

impl SimdMask for mask32x4 {
    type Simd = Simd128;
    type Array = [bool; 4];

    const LANES: usize = 4;

    #[inline(always)]
    fn token(self) -> Simd128 {
        self.1
    }
    #[inline(always)]
    fn splat(s: Simd128, b: bool) -> Self {
        mask32x4(proven!(i32x4_splat(-i32::from(b))), s)
    }
    #[inline(always)]
    fn from_array(s: Simd128, a: [bool; 4]) -> Self {
        proven!({
            // A lane is −1 where its byte is 1.
            let bytes = i32x4_splat(transmute::<[bool; 4], i32>(a));
            let lanes = u32x4_extend_low_u16x8(u16x8_extend_low_u8x16(bytes));
            mask32x4(i32x4_neg(lanes), s)
        })
    }
    #[inline(always)]
    fn to_array(self) -> [bool; 4] {
        let bytes = proven!({
            let halfwords = i16x8_narrow_i32x4(self.0, self.0);
            let bytes = i8x16_narrow_i16x8(halfwords, halfwords);
            i32x4_extract_lane::<0>(v128_and(bytes, i8x16_splat(1)))
        });
        // SAFETY: a byte is 0 or 1.
        unsafe { transmute::<i32, [bool; 4]>(bytes) }
    }
    #[inline(always)]
    fn bitmask(self) -> u32 {
        let bits = u32::from(proven!(i32x4_bitmask(self.0)));
        // SAFETY: there are four lanes. Known to the compiler, it spares checks of them.
        unsafe { core::hint::assert_unchecked(bits < 16) };
        bits
    }
    #[inline(always)]
    fn any(self) -> bool {
        proven!(v128_any_true(self.0))
    }
    #[inline(always)]
    fn all(self) -> bool {
        proven!(i32x4_all_true(self.0))
    }
}

operators! { [] mask32x4 {
    BitAnd bitand BitAndAssign bitand_assign |a, b| mask32x4(proven!(v128_and(a.0, b.0)), a.1);
    BitOr bitor BitOrAssign bitor_assign |a, b| mask32x4(proven!(v128_or(a.0, b.0)), a.1);
    BitXor bitxor BitXorAssign bitxor_assign |a, b| mask32x4(proven!(v128_xor(a.0, b.0)), a.1);
}}
unary_operator! { [] mask32x4 { Not not |a| mask32x4(proven!(v128_not(a.0)), a.1) } }

impl core::fmt::Debug for mask32x4 {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.to_array().fmt(f)
    }
}
