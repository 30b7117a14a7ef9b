//! Lanes of `f32`.

use core::ops::{Div, DivAssign, Neg};

use super::{Lanes, SimdI32, SimdU32, soft};
use crate::math::elementary;

/// Lanes of `f32`. Arithmetic is IEEE 754, rounded to nearest even, and never contracted.
pub trait SimdF32: Lanes<Elem = f32> + Div<Output = Self> + DivAssign + Neg<Output = Self> {
    /// As many lanes of `i32`.
    type I32: SimdI32<Simd = Self::Simd, Mask = Self::Mask, U32 = Self::U32>;
    /// As many lanes of `u32`.
    type U32: SimdU32<Simd = Self::Simd, Mask = Self::Mask>;

    /// Whether the level has instructions that multiply and add in one rounding.
    const FUSED: bool;

    // Arithmetic

    /// [`spec::sqrt`](crate::spec::sqrt).
    fn sqrt(self) -> Self;
    /// [`spec::abs`](crate::spec::abs).
    fn abs(self) -> Self;

    /// [`spec::copysign`](crate::spec::copysign): the magnitude of `self`, the sign of `sign`.
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        let sign_bit = Self::U32::splat(self.token(), 1 << 31);
        Self::from_bits(self.abs().to_bits() | sign.to_bits() & sign_bit)
    }

    /// `self * b + c` in two roundings.
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    /// `self * b - c` in two roundings.
    #[inline(always)]
    fn mul_sub(self, b: Self, c: Self) -> Self {
        self * b - c
    }
    /// `c - self * b` in two roundings.
    #[inline(always)]
    fn nmul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }
    /// `-(self * b) - c` in two roundings.
    #[inline(always)]
    fn nmul_sub(self, b: Self, c: Self) -> Self {
        -(self * b) - c
    }

    /// [`spec::fused_mul_add`](crate::spec::fused_mul_add): `self * b + c` in one rounding. Slow
    /// where the level has no such instruction.
    fn fused_mul_add(self, b: Self, c: Self) -> Self;
    /// `self * b - c` in one rounding.
    #[inline(always)]
    fn fused_mul_sub(self, b: Self, c: Self) -> Self {
        self.fused_mul_add(b, -c)
    }
    /// `c - self * b` in one rounding.
    #[inline(always)]
    fn fused_nmul_add(self, b: Self, c: Self) -> Self {
        (-self).fused_mul_add(b, c)
    }
    /// `-(self * b) - c` in one rounding.
    #[inline(always)]
    fn fused_nmul_sub(self, b: Self, c: Self) -> Self {
        (-self).fused_mul_add(b, -c)
    }

    /// `self * b + c` in one rounding or in two, whichever is faster.
    #[inline(always)]
    fn mul_add_fast(self, b: Self, c: Self) -> Self {
        if Self::FUSED { self.fused_mul_add(b, c) } else { self.mul_add(b, c) }
    }
    /// `self * b - c` in one rounding or in two, whichever is faster.
    #[inline(always)]
    fn mul_sub_fast(self, b: Self, c: Self) -> Self {
        if Self::FUSED { self.fused_mul_sub(b, c) } else { self.mul_sub(b, c) }
    }
    /// `c - self * b` in one rounding or in two, whichever is faster.
    #[inline(always)]
    fn nmul_add_fast(self, b: Self, c: Self) -> Self {
        if Self::FUSED { self.fused_nmul_add(b, c) } else { self.nmul_add(b, c) }
    }
    /// `-(self * b) - c` in one rounding or in two, whichever is faster.
    #[inline(always)]
    fn nmul_sub_fast(self, b: Self, c: Self) -> Self {
        if Self::FUSED { self.fused_nmul_sub(b, c) } else { self.nmul_sub(b, c) }
    }

    // Least and greatest of numbers

    /// [`spec::min_num`](crate::spec::min_num): IEEE 754 `minimumNumber`.
    #[inline(always)]
    fn min_num(self, other: Self) -> Self {
        // A NaN in `other` loses here; one in `self` loses in `min`.
        let least = Self::select(other.eq(other), self.min(other), self);
        // Of equals both signs: only those of zeros differ.
        Self::from_bits(least.to_bits() | self.to_bits().masked(self.eq(other)))
    }
    /// [`spec::max_num`](crate::spec::max_num): IEEE 754 `maximumNumber`.
    #[inline(always)]
    fn max_num(self, other: Self) -> Self {
        let greatest = Self::select(other.eq(other), self.max(other), self);
        let differ = Self::U32::splat(self.token(), u32::MAX).masked(self.ne(other));
        Self::from_bits(greatest.to_bits() & (self.to_bits() | differ))
    }

    // Rounding

    /// [`spec::round_ties_even`](crate::spec::round_ties_even).
    #[inline(always)]
    fn round_ties_even(self) -> Self {
        soft::round_ties_even(self)
    }
    /// [`spec::floor`](crate::spec::floor).
    #[inline(always)]
    fn floor(self) -> Self {
        soft::floor(self)
    }
    /// [`spec::ceil`](crate::spec::ceil).
    #[inline(always)]
    fn ceil(self) -> Self {
        soft::ceil(self)
    }
    /// [`spec::trunc`](crate::spec::trunc).
    #[inline(always)]
    fn trunc(self) -> Self {
        soft::trunc(self)
    }

    // Reciprocals

    /// About `1 / self`: relative error at most 2^-11. Unlike the exact quotient it may differ
    /// between levels, and:
    ///
    /// * ±0 gives ±∞ and ±∞ gives ±0; NaN gives NaN, and nothing else does;
    /// * of a subnormal it may give ±∞, and where the quotient is 2^-126 or less, ±0.
    #[inline(always)]
    fn rcp_est(self) -> Self {
        self.rcp_fast()
    }
    /// About `1 / self.sqrt()`: relative error at most 2^-11. Unlike the exact value it may
    /// differ between levels, and:
    ///
    /// * ±0 gives ±∞ and +∞ gives 0; NaN and what is below −0 give NaN, and nothing else does;
    /// * of a subnormal it may give an infinity of its sign.
    #[inline(always)]
    fn rsqrt_est(self) -> Self {
        self.rsqrt_fast()
    }
    /// As [`SimdF32::rcp_est`], with a relative error of at most 2^-21.
    ///
    /// The bound is what follows from the makers' promise for the estimate on x86 (1.5 · 2^-12 for
    /// SSE and AVX), one Newton step and its roundings; 2^-22 is what one CPU was measured to keep.
    #[inline(always)]
    fn rcp_fast(self) -> Self {
        Self::splat(self.token(), 1.0) / self
    }
    /// As [`SimdF32::rsqrt_est`], with a relative error of at most 2^-21, for the reason given at
    /// [`SimdF32::rcp_fast`].
    #[inline(always)]
    fn rsqrt_fast(self) -> Self {
        Self::splat(self.token(), 1.0) / self.sqrt()
    }

    // Elementary functions, the same bits on every level

    /// [`spec::exp2`](crate::spec::exp2): 2 to the power of each lane, to 1.11 ulp.
    #[inline(always)]
    fn exp2(self) -> Self {
        elementary::exp2(self)
    }
    /// [`spec::log2`](crate::spec::log2): the logarithm to base 2, to 2.17 ulp.
    #[inline(always)]
    fn log2(self) -> Self {
        elementary::log2(self)
    }
    /// [`spec::pow`](crate::spec::pow): each lane to the power of the other, to 4 ulp.
    #[inline(always)]
    fn pow(self, exponent: Self) -> Self {
        elementary::pow(self, exponent)
    }

    /// As [`SimdU32::permute`].
    #[inline(always)]
    fn permute(self, order: Self::U32) -> Self {
        Self::from_bits(self.to_bits().permute(order))
    }

    // Conversions

    /// The bits of each lane.
    fn to_bits(self) -> Self::U32;
    /// Lanes from their bits.
    fn from_bits(bits: Self::U32) -> Self;

    /// The nearest `f32` to each integer, ties to even.
    fn from_i32(i: Self::I32) -> Self;

    /// The nearest `f32` to each integer, ties to even.
    #[inline(always)]
    fn from_u32(u: Self::U32) -> Self {
        soft::from_u32(u)
    }

    /// The integer toward zero, or the nearest that there is; 0 for NaN: Rust's `as`.
    fn to_i32(self) -> Self::I32;

    /// The integer toward zero, or the nearest that there is; 0 for NaN: Rust's `as`.
    #[inline(always)]
    fn to_u32(self) -> Self::U32 {
        soft::to_u32(self)
    }

    /// As [`SimdF32::to_i32`], for values that have an `i32`; of others the result may differ
    /// between levels.
    #[inline(always)]
    fn to_i32_fast(self) -> Self::I32 {
        self.to_i32()
    }
    /// `floor().to_i32_fast()` in fewer instructions where there are such.
    #[inline(always)]
    fn floor_to_i32_fast(self) -> Self::I32 {
        self.floor().to_i32_fast()
    }
    /// As [`SimdF32::to_u32`], for values that have a `u32`; of others the result may differ
    /// between levels.
    #[inline(always)]
    fn to_u32_fast(self) -> Self::U32 {
        soft::to_u32_fast(self)
    }
}
