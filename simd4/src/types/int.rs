//! Lanes of integers.

use core::ops::{BitAnd, BitAndAssign, BitOr, BitOrAssign, BitXor, BitXorAssign, Neg, Not};

use super::{Lanes, soft};

/// Lanes of integers of 32 bits. Arithmetic wraps.
pub trait SimdInt:
    Lanes
    + BitAnd<Output = Self>
    + BitAndAssign
    + BitOr<Output = Self>
    + BitOrAssign
    + BitXor<Output = Self>
    + BitXorAssign
    + Not<Output = Self>
{
    /// [`spec::shl`](crate::spec::shl): the bits of every lane moved up by `n`; 0 from 32 on.
    fn shl(self, n: u32) -> Self;
    /// [`spec::shr`](crate::spec::shr): the bits of every lane moved down by `n`, zeros above
    /// whatever the type's sign; 0 from 32 on.
    fn shr(self, n: u32) -> Self;
}

/// Lanes of `i32`. Arithmetic wraps.
pub trait SimdI32: SimdInt<Elem = i32> + Neg<Output = Self> {
    /// As many lanes of `u32`.
    type U32: SimdU32<Simd = Self::Simd, Mask = Self::Mask>;

    /// [`spec::sar`](crate::spec::sar): the bits of every lane moved down by `n`, copies of the
    /// sign above; only those from 32 on.
    fn sar(self, n: u32) -> Self;

    /// The magnitude; `i32::MIN` keeps its value, as [`i32::wrapping_abs`] does.
    #[inline(always)]
    fn abs(self) -> Self {
        let sign = self.sar(31);
        (self ^ sign) - sign
    }

    /// As [`SimdU32::permute`].
    #[inline(always)]
    fn permute(self, order: Self::U32) -> Self {
        Self::from_u32(self.to_u32().permute(order))
    }

    /// The same bits as `u32`.
    fn to_u32(self) -> Self::U32;
    /// The same bits as `i32`.
    fn from_u32(u: Self::U32) -> Self;
}

/// Lanes of `u32`. Arithmetic wraps.
pub trait SimdU32: SimdInt<Elem = u32> {
    /// Lane `i` of the result is lane `order[i]`, counted round: a swizzle in an order that is known
    /// at run time only.
    ///
    /// ```
    /// use simd4::{prelude::*, u32x4};
    ///
    /// let v = u32x4::from([10, 11, 12, 13]);
    /// let order = u32x4::from([3, 3, 0, 5]);
    /// assert_eq!(v.permute(order).to_array(), [13, 13, 10, 11]);
    /// ```
    #[inline(always)]
    fn permute(self, order: Self) -> Self {
        soft::permute(self, order)
    }

    /// One lane of all, to go through as an index.
    #[doc(hidden)]
    #[inline(always)]
    fn index(self, lane: usize) -> usize {
        self.to_array().as_ref()[lane] as usize
    }
}
