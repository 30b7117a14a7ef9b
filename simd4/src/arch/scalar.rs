//! The level of every machine: arrays, lane by lane as [`spec`](crate::spec) says. Seed paper:
//! "FPU emulation" (Geimer and Müller 2003, Section 2).

use crate::simd::sealed::Sealed;
use crate::types::array::{Lane, each_lane, lanes};
use crate::types::reduce::Fold;
use crate::types::{Join, conversions, operators, unary_operator};
use crate::{
    Guaranteed, Lanes, Level, Simd, SimdF32, SimdI32, SimdInt, SimdMask, SimdU32, Wide, spec,
};

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
    type f32x16 = f32x16;
    type i32x16 = i32x16;
    type u32x16 = u32x16;
    type mask32x16 = mask32x16;
    type f32s = f32x4;
    type i32s = i32x4;
    type u32s = u32x4;
    type mask32s = mask32x4;

    const EMULATED: bool = true;

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
    /// Sixteen lanes of `f32`.
    pub type f32x16 = Vector<f32, 16>;
    /// Four lanes of `i32`.
    pub type i32x4 = Vector<i32, 4>;
    /// Eight lanes of `i32`.
    pub type i32x8 = Vector<i32, 8>;
    /// Sixteen lanes of `i32`.
    pub type i32x16 = Vector<i32, 16>;
    /// Four lanes of `u32`.
    pub type u32x4 = Vector<u32, 4>;
    /// Eight lanes of `u32`.
    pub type u32x8 = Vector<u32, 8>;
    /// Sixteen lanes of `u32`.
    pub type u32x16 = Vector<u32, 16>;
    /// Four lanes of truth.
    pub type mask32x4 = Mask<4>;
    /// Eight lanes of truth.
    pub type mask32x8 = Mask<8>;
    /// Sixteen lanes of truth.
    pub type mask32x16 = Mask<16>;
}
pub use names::*;

impl<T, const N: usize> Sealed for Vector<T, N> {}
impl<const N: usize> Sealed for Mask<N> {}

#[inline(always)]
fn map<A: Copy, R: Lane, const N: usize>(a: [A; N], f: impl Fn(A) -> R) -> [R; N] {
    lanes!(N, |i| f(a[i]))
}

#[inline(always)]
fn map2<A: Copy, R: Lane, const N: usize>(a: [A; N], b: [A; N], f: impl Fn(A, A) -> R) -> [R; N] {
    lanes!(N, |i| f(a[i], b[i]))
}

/// Folds the lanes from `n` on into those before, if there are so many.
#[inline(always)]
fn fold_at<F: Fold, T: Copy, const N: usize>(n: usize, a: &mut [T; N])
where
    Vector<T, 1>: Lanes,
{
    each_lane!(N, |i| if i < n && i + n < N {
        [a[i]] = F::fold(Vector([a[i]]), Vector([a[i + n]])).0;
    });
}

/// Methods that apply a function to every lane.
macro_rules! mapped {
    ($($method:ident($($arg:ident),*) = $f:expr;)*) => {$(
        #[inline(always)]
        fn $method(self, $($arg: Self),*) -> Self {
            Vector(lanes!(N, |i| $f(self.0[i], $($arg.0[i]),*)))
        }
    )*};
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
            fn token(self) -> Scalar {
                Scalar::new()
            }
            #[inline(always)]
            fn splat(_: Scalar, x: $elem) -> Self {
                // `[x; N]` would be a loop.
                Vector(lanes!(N, |_i| x))
            }
            #[inline(always)]
            fn from_array(_: Scalar, a: [$elem; N]) -> Self {
                Vector(a)
            }
            #[inline(always)]
            fn to_array(self) -> [$elem; N] {
                self.0
            }

            mapped! {
                min(b) = spec::min;
                max(b) = spec::max;
            }

            #[inline(always)]
            fn eq(self, b: Self) -> Mask<N> {
                Mask(map2(self.0, b.0, |a, b| a == b))
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
            fn select(m: Mask<N>, a: Self, b: Self) -> Self {
                Vector(lanes!(N, |i| spec::select(m.0[i], a.0[i], b.0[i])))
            }
            #[inline(always)]
            fn reduce<F: Fold>(self) -> $elem {
                let mut a = self.0;
                fold_at::<F, _, N>(8, &mut a);
                fold_at::<F, _, N>(4, &mut a);
                fold_at::<F, _, N>(2, &mut a);
                fold_at::<F, _, N>(1, &mut a);
                a[0]
            }
        }
        conversions! { [const N: usize] Vector<$elem, N>, Scalar }
        wide! { $elem, 4 + 4 = 8 }
        wide! { $elem, 8 + 8 = 16 }
    };
}

macro_rules! wide {
    ($elem:ty, $half:literal + $other:literal = $lanes:literal) => {
        impl Wide for Vector<$elem, $lanes> {
            type Half = Vector<$elem, $half>;
            #[inline(always)]
            fn concat(low: Self::Half, high: Self::Half) -> Self {
                Vector(Join::join(low.0, high.0))
            }
            #[inline(always)]
            fn halves(self) -> (Self::Half, Self::Half) {
                let (low, high) = Join::split(self.0);
                (Vector(low), Vector(high))
            }
        }
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
unary_operator! { [const N: usize] Vector<f32, N> { Neg neg |a| Vector(map(a.0, |a| -a)) } }

impl<const N: usize> SimdF32 for Vector<f32, N> {
    type I32 = Vector<i32, N>;
    type U32 = Vector<u32, N>;

    const FUSED: bool = false;

    mapped! {
        sqrt() = spec::sqrt;
        abs() = spec::abs;
        copysign(sign) = spec::copysign;
        fused_mul_add(b, c) = spec::fused_mul_add;
    }

    #[inline(always)]
    fn to_bits(self) -> Vector<u32, N> {
        Vector(map(self.0, f32::to_bits))
    }
    #[inline(always)]
    fn from_bits(bits: Vector<u32, N>) -> Self {
        Vector(map(bits.0, f32::from_bits))
    }
    #[inline(always)]
    fn from_i32(i: Vector<i32, N>) -> Self {
        Vector(map(i.0, |i| i as f32))
    }
    #[inline(always)]
    fn from_u32(u: Vector<u32, N>) -> Self {
        Vector(map(u.0, |u| u as f32))
    }
    #[inline(always)]
    fn to_i32(self) -> Vector<i32, N> {
        Vector(map(self.0, |x| x as i32))
    }
    #[inline(always)]
    fn to_u32(self) -> Vector<u32, N> {
        Vector(map(self.0, |x| x as u32))
    }
}

/// The integers' operations are the same text for both signs.
macro_rules! integers {
    ($elem:ty) => {
        operators! { [const N: usize] Vector<$elem, N> {
            Add add AddAssign add_assign |a, b| Vector(map2(a.0, b.0, <$elem>::wrapping_add));
            Sub sub SubAssign sub_assign |a, b| Vector(map2(a.0, b.0, <$elem>::wrapping_sub));
            Mul mul MulAssign mul_assign |a, b| Vector(map2(a.0, b.0, <$elem>::wrapping_mul));
            BitAnd bitand BitAndAssign bitand_assign |a, b| Vector(map2(a.0, b.0, |a, b| a & b));
            BitOr bitor BitOrAssign bitor_assign |a, b| Vector(map2(a.0, b.0, |a, b| a | b));
            BitXor bitxor BitXorAssign bitxor_assign |a, b| Vector(map2(a.0, b.0, |a, b| a ^ b));
        }}
        unary_operator! { [const N: usize] Vector<$elem, N> { Not not |a| Vector(map(a.0, |a| !a)) } }

        impl<const N: usize> SimdInt for Vector<$elem, N> {
            #[inline(always)]
            fn shl(self, n: u32) -> Self {
                Vector(map(self.0, |a| spec::shl(a as u32, n) as $elem))
            }
            #[inline(always)]
            fn shr(self, n: u32) -> Self {
                Vector(map(self.0, |a| spec::shr(a as u32, n) as $elem))
            }
        }
    };
}

integers!(i32);
integers!(u32);

unary_operator! { [const N: usize] Vector<i32, N> {
    Neg neg |a| Vector(map(a.0, i32::wrapping_neg))
}}

impl<const N: usize> SimdI32 for Vector<i32, N> {
    type U32 = Vector<u32, N>;

    #[inline(always)]
    fn sar(self, n: u32) -> Self {
        Vector(map(self.0, |a| spec::sar(a, n)))
    }
    #[inline(always)]
    fn to_u32(self) -> Vector<u32, N> {
        Vector(map(self.0, |a| a as u32))
    }
    #[inline(always)]
    fn from_u32(u: Vector<u32, N>) -> Self {
        Vector(map(u.0, |a| a as i32))
    }
}

impl<const N: usize> SimdU32 for Vector<u32, N> {}

operators! { [const N: usize] Mask<N> {
    BitAnd bitand BitAndAssign bitand_assign |a, b| Mask(map2(a.0, b.0, |a, b| a & b));
    BitOr bitor BitOrAssign bitor_assign |a, b| Mask(map2(a.0, b.0, |a, b| a | b));
    BitXor bitxor BitXorAssign bitxor_assign |a, b| Mask(map2(a.0, b.0, |a, b| a ^ b));
}}
unary_operator! { [const N: usize] Mask<N> { Not not |a| Mask(map(a.0, |a| !a)) } }

impl<const N: usize> SimdMask for Mask<N> {
    type Simd = Scalar;
    type Array = [bool; N];

    const LANES: usize = N;

    #[inline(always)]
    fn token(self) -> Scalar {
        Scalar::new()
    }
    #[inline(always)]
    fn splat(_: Scalar, b: bool) -> Self {
        Mask(lanes!(N, |_i| b))
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
        let mut bits = 0;
        each_lane!(N, |i| bits |= u32::from(self.0[i]) << i);
        bits
    }
}

impl<const N: usize> core::fmt::Debug for Mask<N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.0.fmt(f)
    }
}
