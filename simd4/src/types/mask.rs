//! Lanes of truth.

use core::ops::{BitAnd, BitAndAssign, BitOr, BitOrAssign, BitXor, BitXorAssign, Not};

use super::{LaneArray, Lanes};
use crate::Simd;
use crate::simd::sealed::Sealed;

/// Lanes of truth: a type of its own, whatever register it lives in.
pub trait SimdMask:
    Copy
    + Send
    + Sync
    + core::fmt::Debug
    + Sealed
    + BitAnd<Output = Self>
    + BitAndAssign
    + BitOr<Output = Self>
    + BitOrAssign
    + BitXor<Output = Self>
    + BitXorAssign
    + Not<Output = Self>
    + 'static
{
    /// The level's token.
    type Simd: Simd;
    /// All lanes, lane 0 first.
    type Array: LaneArray<bool>;

    /// The number of lanes.
    const LANES: usize;

    /// The same truth in every lane.
    fn splat(s: Self::Simd, b: bool) -> Self;
    /// From an array, lane 0 first.
    fn from_array(s: Self::Simd, a: Self::Array) -> Self;
    /// To an array, lane 0 first.
    fn to_array(self) -> Self::Array;
    /// Bit `i` is lane `i`; the bits beyond the lanes are 0.
    fn bitmask(self) -> u32;

    /// The token that every value carries.
    fn token(self) -> Self::Simd;

    /// `self & !other`, lane by lane.
    #[inline(always)]
    fn and_not(self, other: Self) -> Self {
        self & !other
    }

    /// Whether any lane is true.
    #[inline(always)]
    fn any(self) -> bool {
        self.bitmask() != 0
    }

    /// Whether all lanes are true.
    #[inline(always)]
    fn all(self) -> bool {
        self.bitmask() == u32::MAX >> (32 - Self::LANES)
    }

    /// Whether no lane is true.
    #[inline(always)]
    fn none(self) -> bool {
        !self.any()
    }

    /// How many lanes are true.
    #[inline(always)]
    fn count(self) -> u32 {
        self.bitmask().count_ones()
    }

    /// The lowest lane that is true.
    #[inline(always)]
    fn first(self) -> Option<usize> {
        match self.bitmask() {
            0 => None,
            bits => Some(bits.trailing_zeros() as usize),
        }
    }

    /// `self ? a : b`, lane by lane.
    #[inline(always)]
    fn select<V: Lanes<Mask = Self>>(self, a: V, b: V) -> V {
        V::select(self, a, b)
    }
}
