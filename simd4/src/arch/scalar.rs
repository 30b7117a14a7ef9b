//! The level of every machine: arrays, lane by lane as [`spec`](crate::spec) says. Seed paper:
//! "FPU emulation" (Geimer and Müller 2003, Section 2).

use core::array;

use crate::simd::sealed::Sealed;
use crate::types::{conversions, operators, unary_operator};
use crate::{Guaranteed, Lanes, Level, Simd, SimdF32, SimdI32, SimdMask, SimdU32, spec};

/// The token of the level `scalar`, which every CPU has.
#[derive(Clone, Copy, Debug)]
pub struct Scalar {
    _private: (),
}

impl Scalar {
    /// The token: there is nothing to prove.
    pub const fn new() -> Self {
        Scalar { _private: () }
    }
}

impl Default for Scalar {
    fn default() -> Self {
        Scalar::new()
    }
}

impl Sealed for Scalar {}

impl Guaranteed for Scalar {
    const TOKEN: Self = Scalar::new();
}

impl Simd for Scalar {
    type f32x4 = f32x4;
    type i32x4 = i32x4;
    type u32x4 = u32x4;
    type mask32x4 = mask32x4;
    type f32x8 = f32x8;
    type i32x8 = i32x8;
    type u32x8 = u32x8;
    type mask32x8 = mask32x8;
    type f32s = f32x4;

    #[inline(always)]
    fn level(self) -> Level {
        Level::Scalar(self)
    }

    #[inline(always)]
    fn vectorize<R>(self, f: impl FnOnce() -> R) -> R {
        f()
    }
}

/// `N` lanes of numbers in an array.
#[derive(Clone, Copy)]
pub struct Vector<T, const N: usize>([T; N]);

/// `N` lanes of truth in an array.
#[derive(Clone, Copy)]
pub struct Mask<const N: usize>([bool; N]);

/// The types of this level by the names they have on every level. One lane is for code that has
/// but one value at hand: the same kernel, the same bits.
#[allow(non_camel_case_types)]
mod names {
    use super::{Mask, Vector};
    /// One lane of `f32`.
    pub type f32x1 = Vector<f32, 1>;
    /// Four lanes of `f32`.
    pub type f32x4 = Vector<f32, 4>;
    /// Eight lanes of `f32`.
    pub type f32x8 = Vector<f32, 8>;
    /// Four lanes of `i32`.
    pub type i32x4 = Vector<i32, 4>;
    /// Eight lanes of `i32`.
    pub type i32x8 = Vector<i32, 8>;
    /// Four lanes of `u32`.
    pub type u32x4 = Vector<u32, 4>;
    /// Eight lanes of `u32`.
    pub type u32x8 = Vector<u32, 8>;
    /// Four lanes of truth.
    pub type mask32x4 = Mask<4>;
    /// Eight lanes of truth.
    pub type mask32x8 = Mask<8>;
}
pub use names::*;

impl<T, const N: usize> Sealed for Vector<T, N> {}
impl<const N: usize> Sealed for Mask<N> {}

#[inline(always)]
fn map2<A: Copy, B: Copy, R, const N: usize>(
    a: [A; N],
    b: [B; N],
    f: impl Fn(A, B) -> R,
) -> [R; N] {
    array::from_fn(
        #[inline(always)]
        |i| f(a[i], b[i]),
    )
}

/// A type of numbers: its lanes, its operators and the trait of its element.
macro_rules! numbers {
    ($elem:ty) => {
        impl<const N: usize> Lanes for Vector<$elem, N> {
            type Simd = Scalar;
            type Elem = $elem;
            type Array = [$elem; N];
            type Mask = Mask<N>;

            const LANES: usize = N;

            #[inline(always)]
            fn splat(_: Scalar, x: $elem) -> Self {
                Vector([x; N])
            }
            #[inline(always)]
            fn from_array(_: Scalar, a: [$elem; N]) -> Self {
                Vector(a)
            }
            #[inline(always)]
            fn to_array(self) -> [$elem; N] {
                self.0
            }
            #[inline(always)]
            fn select(m: Mask<N>, a: Self, b: Self) -> Self {
                Vector(array::from_fn(
                    #[inline(always)]
                    |i| spec::select(m.0[i], a.0[i], b.0[i]),
                ))
            }
        }
        conversions! { [const N: usize] Vector<$elem, N>, Scalar }
    };
}

numbers!(f32);
numbers!(i32);
numbers!(u32);

operators! { [const N: usize] Vector<f32, N> {
    Add add AddAssign add_assign |a, b| Vector(map2(a.0, b.0, |a, b| a + b));
    Sub sub SubAssign sub_assign |a, b| Vector(map2(a.0, b.0, |a, b| a - b));
    Mul mul MulAssign mul_assign |a, b| Vector(map2(a.0, b.0, |a, b| a * b));
    Div div DivAssign div_assign |a, b| Vector(map2(a.0, b.0, |a, b| a / b));
}}
unary_operator! { [const N: usize] Vector<f32, N> { Neg neg |a| Vector(a.0.map(|a| -a)) } }

impl<const N: usize> SimdF32 for Vector<f32, N> {
    type I32 = Vector<i32, N>;
    type U32 = Vector<u32, N>;

    #[inline(always)]
    fn sqrt(self) -> Self {
        Vector(self.0.map(spec::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Vector(self.0.map(spec::abs))
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        Vector(map2(self.0, b.0, spec::min))
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        Vector(map2(self.0, b.0, spec::max))
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Mask<N> {
        Mask(map2(self.0, b.0, |a, b| a == b))
    }
    #[inline(always)]
    fn ne(self, b: Self) -> Mask<N> {
        Mask(map2(self.0, b.0, |a, b| a != b))
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Mask<N> {
        Mask(map2(self.0, b.0, |a, b| a < b))
    }
    #[inline(always)]
    fn le(self, b: Self) -> Mask<N> {
        Mask(map2(self.0, b.0, |a, b| a <= b))
    }
    #[inline(always)]
    fn to_bits(self) -> Vector<u32, N> {
        Vector(self.0.map(f32::to_bits))
    }
    #[inline(always)]
    fn from_bits(bits: Vector<u32, N>) -> Self {
        Vector(bits.0.map(f32::from_bits))
    }
    #[inline(always)]
    fn from_i32(i: Vector<i32, N>) -> Self {
        Vector(i.0.map(|i| i as f32))
    }
}

/// The integers' operations are the same text for both signs.
macro_rules! integers {
    ($Trait:ident, $elem:ty) => {
        operators! { [const N: usize] Vector<$elem, N> {
            Add add AddAssign add_assign |a, b| Vector(map2(a.0, b.0, <$elem>::wrapping_add));
            Sub sub SubAssign sub_assign |a, b| Vector(map2(a.0, b.0, <$elem>::wrapping_sub));
            Mul mul MulAssign mul_assign |a, b| Vector(map2(a.0, b.0, <$elem>::wrapping_mul));
            BitAnd bitand BitAndAssign bitand_assign |a, b| Vector(map2(a.0, b.0, |a, b| a & b));
            BitOr bitor BitOrAssign bitor_assign |a, b| Vector(map2(a.0, b.0, |a, b| a | b));
            BitXor bitxor BitXorAssign bitxor_assign |a, b| Vector(map2(a.0, b.0, |a, b| a ^ b));
        }}

        impl<const N: usize> $Trait for Vector<$elem, N> {
            #[inline(always)]
            fn min(self, b: Self) -> Self {
                Vector(map2(self.0, b.0, Ord::min))
            }
            #[inline(always)]
            fn max(self, b: Self) -> Self {
                Vector(map2(self.0, b.0, Ord::max))
            }
            #[inline(always)]
            fn eq(self, b: Self) -> Mask<N> {
                Mask(map2(self.0, b.0, |a, b| a == b))
            }
            #[inline(always)]
            fn lt(self, b: Self) -> Mask<N> {
                Mask(map2(self.0, b.0, |a, b| a < b))
            }
        }
    };
}

integers!(SimdI32, i32);
integers!(SimdU32, u32);

operators! { [const N: usize] Mask<N> {
    BitAnd bitand BitAndAssign bitand_assign |a, b| Mask(map2(a.0, b.0, |a, b| a & b));
    BitOr bitor BitOrAssign bitor_assign |a, b| Mask(map2(a.0, b.0, |a, b| a | b));
    BitXor bitxor BitXorAssign bitxor_assign |a, b| Mask(map2(a.0, b.0, |a, b| a ^ b));
}}
unary_operator! { [const N: usize] Mask<N> { Not not |a| Mask(a.0.map(|a| !a)) } }

impl<const N: usize> SimdMask for Mask<N> {
    type Simd = Scalar;
    type Array = [bool; N];

    const LANES: usize = N;

    #[inline(always)]
    fn splat(_: Scalar, b: bool) -> Self {
        Mask([b; N])
    }
    #[inline(always)]
    fn from_array(_: Scalar, a: [bool; N]) -> Self {
        Mask(a)
    }
    #[inline(always)]
    fn to_array(self) -> [bool; N] {
        self.0
    }
    #[inline(always)]
    fn bitmask(self) -> u32 {
        (0..N).fold(0, |bits, i| bits | u32::from(self.0[i]) << i)
    }
}

impl<const N: usize> core::fmt::Debug for Mask<N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.0.fmt(f)
    }
}
