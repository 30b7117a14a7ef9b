//! Lanes of `f32`.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::{Lanes, SimdI32, SimdU32};

/// Lanes of `f32`. Arithmetic is IEEE 754, rounded to nearest even, and never contracted.
pub trait SimdF32:
    Lanes<Elem = f32>
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Mul<Output = Self>
    + MulAssign
    + Div<Output = Self>
    + DivAssign
    + Neg<Output = Self>
{
    /// As many lanes of `i32`.
    type I32: SimdI32<Simd = Self::Simd, Mask = Self::Mask>;
    /// As many lanes of `u32`.
    type U32: SimdU32<Simd = Self::Simd, Mask = Self::Mask>;

    /// [`spec::sqrt`](crate::spec::sqrt).
    fn sqrt(self) -> Self;
    /// [`spec::abs`](crate::spec::abs).
    fn abs(self) -> Self;
    /// [`spec::min`](crate::spec::min): `a < b ? a : b`, so a NaN in either gives `other`.
    fn min(self, other: Self) -> Self;
    /// [`spec::max`](crate::spec::max): `a > b ? a : b`, so a NaN in either gives `other`.
    fn max(self, other: Self) -> Self;

    /// `self == other`; false on NaN.
    fn eq(self, other: Self) -> Self::Mask;
    /// `self != other`; true on NaN.
    fn ne(self, other: Self) -> Self::Mask;
    /// `self < other`; false on NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`; false on NaN.
    fn le(self, other: Self) -> Self::Mask;

    /// `self > other`; false on NaN.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }

    /// `self >= other`; false on NaN.
    #[inline(always)]
    fn ge(self, other: Self) -> Self::Mask {
        other.le(self)
    }

    /// The bits of each lane.
    fn to_bits(self) -> Self::U32;
    /// Lanes from their bits.
    fn from_bits(bits: Self::U32) -> Self;
    /// The nearest `f32` to each integer, ties to even.
    fn from_i32(i: Self::I32) -> Self;
}
