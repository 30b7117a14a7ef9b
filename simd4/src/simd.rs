//! The trait that a kernel is generic over.

use crate::{Lanes, Level, SimdF32, SimdI32, SimdMask, SimdU32, Wide};

pub(crate) mod sealed {
    /// Only this crate names levels: a type that implements [`Simd`](crate::Simd) proves that the
    /// CPU has its instructions.
    pub trait Sealed {}
}

/// A token of no size: the proof that the CPU has a level, and the types of that level.
///
/// It is had from [`Level`] by [`dispatch!`](crate::dispatch), from the token's own `detect`, or,
/// for a level that the build itself guarantees, from [`Guaranteed::TOKEN`].
#[allow(non_camel_case_types)]
pub trait Simd: Copy + Send + Sync + core::fmt::Debug + sealed::Sealed + 'static {
    /// Four lanes of `f32`.
    type f32x4: SimdF32<
            Simd = Self,
            Array = [f32; 4],
            I32 = Self::i32x4,
            U32 = Self::u32x4,
            Mask = Self::mask32x4,
        >;
    /// Four lanes of `i32`.
    type i32x4: SimdI32<Simd = Self, Array = [i32; 4], U32 = Self::u32x4, Mask = Self::mask32x4>;
    /// Four lanes of `u32`.
    type u32x4: SimdU32<Simd = Self, Array = [u32; 4], Mask = Self::mask32x4>;
    /// Four lanes of truth, for the types of four 32-bit lanes.
    type mask32x4: SimdMask<Simd = Self, Array = [bool; 4]>;

    /// Eight lanes of `f32`.
    type f32x8: SimdF32<
            Simd = Self,
            Array = [f32; 8],
            I32 = Self::i32x8,
            U32 = Self::u32x8,
            Mask = Self::mask32x8,
        > + Wide<Half = Self::f32x4>;
    /// Eight lanes of `i32`.
    type i32x8: SimdI32<Simd = Self, Array = [i32; 8], U32 = Self::u32x8, Mask = Self::mask32x8>
        + Wide<Half = Self::i32x4>;
    /// Eight lanes of `u32`.
    type u32x8: SimdU32<Simd = Self, Array = [u32; 8], Mask = Self::mask32x8>
        + Wide<Half = Self::u32x4>;
    /// Eight lanes of truth, for the types of eight 32-bit lanes.
    type mask32x8: SimdMask<Simd = Self, Array = [bool; 8]>;

    /// Sixteen lanes of `f32`.
    type f32x16: SimdF32<
            Simd = Self,
            Array = [f32; 16],
            I32 = Self::i32x16,
            U32 = Self::u32x16,
            Mask = Self::mask32x16,
        > + Wide<Half = Self::f32x8>;
    /// Sixteen lanes of `i32`.
    type i32x16: SimdI32<Simd = Self, Array = [i32; 16], U32 = Self::u32x16, Mask = Self::mask32x16>
        + Wide<Half = Self::i32x8>;
    /// Sixteen lanes of `u32`.
    type u32x16: SimdU32<Simd = Self, Array = [u32; 16], Mask = Self::mask32x16>
        + Wide<Half = Self::u32x8>;
    /// Sixteen lanes of truth, for the types of sixteen 32-bit lanes.
    type mask32x16: SimdMask<Simd = Self, Array = [bool; 16]>;

    /// As many lanes of `f32` as one register holds.
    type f32s: SimdF32<Simd = Self, I32 = Self::i32s, U32 = Self::u32s, Mask = Self::mask32s>;
    /// As many lanes of `i32` as one register holds.
    type i32s: SimdI32<Simd = Self, U32 = Self::u32s, Mask = Self::mask32s>;
    /// As many lanes of `u32` as one register holds.
    type u32s: SimdU32<Simd = Self, Mask = Self::mask32s>;
    /// Truth for as many 32-bit lanes as one register holds.
    type mask32s: SimdMask<Simd = Self>;

    /// The number of lanes of [`Simd::f32s`].
    const LANES: usize = <Self::f32s as Lanes>::LANES;

    /// Whether lanes are plain scalar code, in no register of its own.
    const EMULATED: bool = false;

    /// The level that this token proves.
    fn level(self) -> Level;

    /// Says that a `T` will be read soon, all of it. A hint: nothing changes but the time, and
    /// there need not be one.
    #[inline(always)]
    fn prefetch<T>(self, at: *const T) {
        let _ = at;
    }

    /// Calls `f` from a function that is compiled for this level.
    ///
    /// `f` must be inlined to profit: [`dispatch!`](crate::dispatch) sees to that.
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R;
}

/// A level that the build itself guarantees: its token needs no detection.
pub trait Guaranteed: Simd {
    /// The token.
    const TOKEN: Self;
}
