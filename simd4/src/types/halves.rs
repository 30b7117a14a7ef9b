//! Twice the lanes out of two registers, for levels whose registers are narrower.

use super::{Lanes, SimdF32, SimdI32, SimdMask, SimdU32, operators, unary_operator};
use crate::Guaranteed;
use crate::simd::sealed::Sealed;

/// Two vectors as one of twice the width: `.0` has the lower lanes.
#[derive(Clone, Copy)]
pub struct Halves<V>(V, V);

impl<V> Sealed for Halves<V> {}

/// Arrays that join to one of twice the length.
pub trait Join: Copy {
    /// The array of twice the length.
    type Joined: Copy;
    /// `low` first.
    fn join(low: Self, high: Self) -> Self::Joined;
    /// The two halves.
    fn split(joined: Self::Joined) -> (Self, Self);
}

impl<T: Copy> Join for [T; 4] {
    type Joined = [T; 8];
    #[inline(always)]
    fn join(a: Self, b: Self) -> [T; 8] {
        [a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]]
    }
    #[inline(always)]
    fn split(j: [T; 8]) -> (Self, Self) {
        ([j[0], j[1], j[2], j[3]], [j[4], j[5], j[6], j[7]])
    }
}

impl<V: Lanes> Lanes for Halves<V>
where
    V::Array: Join<
        Joined: AsRef<[V::Elem]>
                    + AsMut<[V::Elem]>
                    + for<'a> TryFrom<&'a [V::Elem], Error = core::array::TryFromSliceError>,
    >,
    <V::Mask as SimdMask>::Array: Join<Joined: AsRef<[bool]> + AsMut<[bool]>>,
{
    type Simd = V::Simd;
    type Elem = V::Elem;
    type Array = <V::Array as Join>::Joined;
    type Mask = Halves<V::Mask>;

    const LANES: usize = 2 * V::LANES;

    #[inline(always)]
    fn splat(s: Self::Simd, x: Self::Elem) -> Self {
        Halves(V::splat(s, x), V::splat(s, x))
    }
    #[inline(always)]
    fn from_array(s: Self::Simd, a: Self::Array) -> Self {
        let (low, high) = Join::split(a);
        Halves(V::from_array(s, low), V::from_array(s, high))
    }
    #[inline(always)]
    fn to_array(self) -> Self::Array {
        Join::join(self.0.to_array(), self.1.to_array())
    }
    #[inline(always)]
    fn select(m: Self::Mask, a: Self, b: Self) -> Self {
        Halves(V::select(m.0, a.0, b.0), V::select(m.1, a.1, b.1))
    }
}

impl<V: SimdF32> SimdF32 for Halves<V>
where
    Self: Lanes<Elem = f32, Simd = V::Simd, Mask = Halves<V::Mask>>,
    Halves<V::I32>: SimdI32<Simd = V::Simd, Mask = Halves<V::Mask>>,
    Halves<V::U32>: SimdU32<Simd = V::Simd, Mask = Halves<V::Mask>>,
{
    type I32 = Halves<V::I32>;
    type U32 = Halves<V::U32>;

    #[inline(always)]
    fn sqrt(self) -> Self {
        Halves(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Halves(self.0.abs(), self.1.abs())
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        Halves(self.0.min(b.0), self.1.min(b.1))
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        Halves(self.0.max(b.0), self.1.max(b.1))
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Self::Mask {
        Halves(self.0.eq(b.0), self.1.eq(b.1))
    }
    #[inline(always)]
    fn ne(self, b: Self) -> Self::Mask {
        Halves(self.0.ne(b.0), self.1.ne(b.1))
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Self::Mask {
        Halves(self.0.lt(b.0), self.1.lt(b.1))
    }
    #[inline(always)]
    fn le(self, b: Self) -> Self::Mask {
        Halves(self.0.le(b.0), self.1.le(b.1))
    }
    #[inline(always)]
    fn to_bits(self) -> Self::U32 {
        Halves(self.0.to_bits(), self.1.to_bits())
    }
    #[inline(always)]
    fn from_bits(bits: Self::U32) -> Self {
        Halves(V::from_bits(bits.0), V::from_bits(bits.1))
    }
    #[inline(always)]
    fn from_i32(i: Self::I32) -> Self {
        Halves(V::from_i32(i.0), V::from_i32(i.1))
    }
}

/// The integers' methods are the same for both signs.
macro_rules! integer_halves {
    ($Trait:ident, $elem:ty) => {
        impl<V: $Trait> $Trait for Halves<V>
        where
            Self: Lanes<Elem = $elem, Simd = V::Simd, Mask = Halves<V::Mask>>,
        {
            #[inline(always)]
            fn min(self, b: Self) -> Self {
                Halves(self.0.min(b.0), self.1.min(b.1))
            }
            #[inline(always)]
            fn max(self, b: Self) -> Self {
                Halves(self.0.max(b.0), self.1.max(b.1))
            }
            #[inline(always)]
            fn eq(self, b: Self) -> Self::Mask {
                Halves(self.0.eq(b.0), self.1.eq(b.1))
            }
            #[inline(always)]
            fn lt(self, b: Self) -> Self::Mask {
                Halves(self.0.lt(b.0), self.1.lt(b.1))
            }
        }
    };
}

integer_halves!(SimdI32, i32);
integer_halves!(SimdU32, u32);

impl<M: SimdMask> SimdMask for Halves<M>
where
    M::Array: Join<Joined: AsRef<[bool]> + AsMut<[bool]>>,
{
    type Simd = M::Simd;
    type Array = <M::Array as Join>::Joined;

    const LANES: usize = 2 * M::LANES;

    #[inline(always)]
    fn splat(s: Self::Simd, b: bool) -> Self {
        Halves(M::splat(s, b), M::splat(s, b))
    }
    #[inline(always)]
    fn from_array(s: Self::Simd, a: Self::Array) -> Self {
        let (low, high) = Join::split(a);
        Halves(M::from_array(s, low), M::from_array(s, high))
    }
    #[inline(always)]
    fn to_array(self) -> Self::Array {
        Join::join(self.0.to_array(), self.1.to_array())
    }
    #[inline(always)]
    fn bitmask(self) -> u32 {
        self.0.bitmask() | self.1.bitmask() << M::LANES
    }
    #[inline(always)]
    fn any(self) -> bool {
        (self.0 | self.1).any()
    }
    #[inline(always)]
    fn all(self) -> bool {
        (self.0 & self.1).all()
    }
}

/// Operators work on each half.
macro_rules! halved_operators {
    ($($Op:ident $op:ident $OpAssign:ident $op_assign:ident)*) => {$(
        operators! { [V: Copy + core::ops::$Op<Output = V>] Halves<V> {
            $Op $op $OpAssign $op_assign |a, b| {
                Halves(core::ops::$Op::$op(a.0, b.0), core::ops::$Op::$op(a.1, b.1))
            };
        }}
    )*};
}

halved_operators! {
    Add add AddAssign add_assign
    Sub sub SubAssign sub_assign
    Mul mul MulAssign mul_assign
    Div div DivAssign div_assign
    BitAnd bitand BitAndAssign bitand_assign
    BitOr bitor BitOrAssign bitor_assign
    BitXor bitxor BitXorAssign bitxor_assign
}
unary_operator! { [V: core::ops::Neg<Output = V>] Halves<V> { Neg neg |a| Halves(-a.0, -a.1) } }
unary_operator! { [V: core::ops::Not<Output = V>] Halves<V> { Not not |a| Halves(!a.0, !a.1) } }

impl<V: core::fmt::Debug> core::fmt::Debug for Halves<V> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entry(&self.0).entry(&self.1).finish()
    }
}

/// Conversions without a token, where the build guarantees the level.
macro_rules! guaranteed_halves {
    ($Trait:ident, $elem:ty) => {
        impl<V: $Trait<Simd: Guaranteed>> From<$elem> for Halves<V>
        where
            Self: Lanes<Elem = $elem, Simd = V::Simd>,
        {
            #[inline(always)]
            fn from(x: $elem) -> Self {
                Self::splat(V::Simd::TOKEN, x)
            }
        }
        impl<V: $Trait<Simd: Guaranteed>, const N: usize> From<[$elem; N]> for Halves<V>
        where
            Self: Lanes<Array = [$elem; N], Simd = V::Simd>,
        {
            #[inline(always)]
            fn from(a: [$elem; N]) -> Self {
                Self::from_array(V::Simd::TOKEN, a)
            }
        }
    };
}

guaranteed_halves!(SimdF32, f32);
guaranteed_halves!(SimdI32, i32);
guaranteed_halves!(SimdU32, u32);
