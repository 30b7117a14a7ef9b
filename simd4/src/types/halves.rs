//! Twice the lanes out of two registers, for levels whose registers are narrower.

use super::array::Lane;
use super::reduce::Fold;
use super::{
    LaneArray, Lanes, SimdF32, SimdI32, SimdInt, SimdMask, SimdU32, Wide, operators, unary_operator,
};
use crate::Guaranteed;
use crate::simd::sealed::Sealed;

/// Two vectors as one of twice the width: `.0` has the lower lanes.
#[derive(Clone, Copy)]
pub struct Halves<V>(V, V);

impl<V> Sealed for Halves<V> {}

/// Arrays that join to one of twice the length.
pub trait Join<T>: LaneArray<T> {
    /// The array of twice the length.
    type Joined: LaneArray<T>;
    /// `low` first.
    fn join(low: Self, high: Self) -> Self::Joined;
    /// The two halves.
    fn split(joined: Self::Joined) -> (Self, Self);
}

macro_rules! join {
    ($half:literal + $other:literal) => {
        impl<T: Lane> Join<T> for [T; $half] {
            type Joined = [T; $half + $other];
            #[inline(always)]
            fn join(low: Self, high: Self) -> Self::Joined {
                match [low, high].as_flattened().try_into() {
                    Ok(joined) => joined,
                    Err(_) => unreachable!(),
                }
            }
            #[inline(always)]
            fn split(joined: Self::Joined) -> (Self, Self) {
                match (joined.first_chunk(), joined.last_chunk()) {
                    (Some(low), Some(high)) => (*low, *high),
                    _ => unreachable!(),
                }
            }
        }
    };
}

join!(4 + 4);
join!(8 + 8);

/// Methods that do in each half what they do in the whole.
macro_rules! halved {
    ($($method:ident($($arg:ident),*);)*) => {$(
        #[inline(always)]
        fn $method(self, $($arg: Self),*) -> Self {
            Halves(self.0.$method($($arg.0),*), self.1.$method($($arg.1),*))
        }
    )*};
}

/// The same for comparisons.
macro_rules! halved_comparisons {
    ($($method:ident)*) => {$(
        #[inline(always)]
        fn $method(self, b: Self) -> Self::Mask {
            Halves(self.0.$method(b.0), self.1.$method(b.1))
        }
    )*};
}

impl<V: Lanes<Array: Join<V::Elem>>> Lanes for Halves<V>
where
    V::Mask: SimdMask<Array: Join<bool>>,
{
    type Simd = V::Simd;
    type Elem = V::Elem;
    type Array = <V::Array as Join<V::Elem>>::Joined;
    type Mask = Halves<V::Mask>;

    const LANES: usize = 2 * V::LANES;

    #[inline(always)]
    fn token(self) -> Self::Simd {
        self.0.token()
    }
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
    fn load(s: Self::Simd, from: &[Self::Elem]) -> Self {
        let (low, high) = from[..Self::LANES].split_at(V::LANES);
        Halves(V::load(s, low), V::load(s, high))
    }
    #[inline(always)]
    fn store(self, to: &mut [Self::Elem]) {
        let (low, high) = to[..Self::LANES].split_at_mut(V::LANES);
        self.0.store(low);
        self.1.store(high);
    }
    #[inline(always)]
    fn load_prefix(s: Self::Simd, from: &[Self::Elem], fill: Self::Elem) -> Self {
        super::load_prefix(s, from, fill)
    }

    halved! {
        min(b);
        max(b);
    }
    halved_comparisons!(eq ne lt le gt ge);

    #[inline(always)]
    fn select(m: Self::Mask, a: Self, b: Self) -> Self {
        Halves(V::select(m.0, a.0, b.0), V::select(m.1, a.1, b.1))
    }
    #[inline(always)]
    fn merge(m: Self::Mask, a: Self, b: Self) -> Self {
        Halves(V::merge(m.0, a.0, b.0), V::merge(m.1, a.1, b.1))
    }
    #[inline(always)]
    fn masked(self, m: Self::Mask) -> Self {
        Halves(self.0.masked(m.0), self.1.masked(m.1))
    }
    #[inline(always)]
    fn reverse(self) -> Self {
        Halves(self.1.reverse(), self.0.reverse())
    }
    #[inline(always)]
    fn zip(self, other: Self) -> (Self, Self) {
        let (low, high) = (self.0.zip(other.0), self.1.zip(other.1));
        (Halves(low.0, low.1), Halves(high.0, high.1))
    }
    #[inline(always)]
    fn unzip(self, other: Self) -> (Self, Self) {
        let (a, b) = (self.0.unzip(self.1), other.0.unzip(other.1));
        (Halves(a.0, b.0), Halves(a.1, b.1))
    }
    #[inline(always)]
    fn reduce<F: Fold>(self) -> Self::Elem {
        F::fold(self.0, self.1).reduce::<F>()
    }
    // A level may have its own way for one register.
    #[inline(always)]
    fn reduce_sum(self) -> Self::Elem {
        (self.0 + self.1).reduce_sum()
    }
    #[inline(always)]
    fn reduce_min(self) -> Self::Elem {
        self.0.min(self.1).reduce_min()
    }
    #[inline(always)]
    fn reduce_max(self) -> Self::Elem {
        self.0.max(self.1).reduce_max()
    }
}

impl<V: Lanes<Array: Join<V::Elem>>> Wide for Halves<V>
where
    V::Mask: SimdMask<Array: Join<bool>>,
{
    type Half = V;

    #[inline(always)]
    fn concat(low: V, high: V) -> Self {
        Halves(low, high)
    }
    #[inline(always)]
    fn halves(self) -> (V, V) {
        (self.0, self.1)
    }
}

impl<V: SimdF32> SimdF32 for Halves<V>
where
    Self: Lanes<Elem = f32, Simd = V::Simd, Mask = Halves<V::Mask>>,
    Halves<V::I32>: SimdI32<Simd = V::Simd, Mask = Halves<V::Mask>, U32 = Halves<V::U32>>,
    Halves<V::U32>: SimdU32<Simd = V::Simd, Mask = Halves<V::Mask>>,
{
    type I32 = Halves<V::I32>;
    type U32 = Halves<V::U32>;

    const FUSED: bool = V::FUSED;

    halved! {
        sqrt();
        abs();
        copysign(sign);
        fused_mul_add(b, c);
        fused_mul_sub(b, c);
        fused_nmul_add(b, c);
        fused_nmul_sub(b, c);
        min_num(b);
        max_num(b);
        floor();
        ceil();
        trunc();
        round_ties_even();
        rcp_est();
        rsqrt_est();
        rcp_fast();
        rsqrt_fast();
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
    #[inline(always)]
    fn from_u32(u: Self::U32) -> Self {
        Halves(V::from_u32(u.0), V::from_u32(u.1))
    }
    #[inline(always)]
    fn to_i32(self) -> Self::I32 {
        Halves(self.0.to_i32(), self.1.to_i32())
    }
    #[inline(always)]
    fn to_u32(self) -> Self::U32 {
        Halves(self.0.to_u32(), self.1.to_u32())
    }
    #[inline(always)]
    fn floor_to_i32_fast(self) -> Self::I32 {
        Halves(self.0.floor_to_i32_fast(), self.1.floor_to_i32_fast())
    }
    #[inline(always)]
    fn to_i32_fast(self) -> Self::I32 {
        Halves(self.0.to_i32_fast(), self.1.to_i32_fast())
    }
    #[inline(always)]
    fn to_u32_fast(self) -> Self::U32 {
        Halves(self.0.to_u32_fast(), self.1.to_u32_fast())
    }
}

impl<V: SimdInt> SimdInt for Halves<V>
where
    Self: Lanes,
{
    #[inline(always)]
    fn shl(self, n: u32) -> Self {
        Halves(self.0.shl(n), self.1.shl(n))
    }
    #[inline(always)]
    fn shr(self, n: u32) -> Self {
        Halves(self.0.shr(n), self.1.shr(n))
    }
}

impl<V: SimdI32> SimdI32 for Halves<V>
where
    Self: Lanes<Elem = i32, Simd = V::Simd, Mask = Halves<V::Mask>>,
    Halves<V::U32>: SimdU32<Simd = V::Simd, Mask = Halves<V::Mask>>,
{
    type U32 = Halves<V::U32>;

    halved! { abs(); }

    #[inline(always)]
    fn sar(self, n: u32) -> Self {
        Halves(self.0.sar(n), self.1.sar(n))
    }
    #[inline(always)]
    fn to_u32(self) -> Self::U32 {
        Halves(self.0.to_u32(), self.1.to_u32())
    }
    #[inline(always)]
    fn from_u32(u: Self::U32) -> Self {
        Halves(V::from_u32(u.0), V::from_u32(u.1))
    }
}

impl<V: SimdU32> SimdU32 for Halves<V>
where
    Self: Lanes<Elem = u32>,
{
    #[inline(always)]
    fn permute(self, order: Self) -> Self {
        Halves(half_permuted(self, order.0), half_permuted(self, order.1))
    }
}

/// Lanes of both halves, in the order of one.
#[inline(always)]
fn half_permuted<V: SimdU32>(Halves(low, high): Halves<V>, order: V) -> V {
    let upper = V::splat(order.token(), V::LANES as u32);
    let in_upper = (order & upper).eq(upper);
    V::select(in_upper, high.permute(order), low.permute(order))
}

impl<M: SimdMask<Array: Join<bool>>> SimdMask for Halves<M> {
    type Simd = M::Simd;
    type Array = <M::Array as Join<bool>>::Joined;

    const LANES: usize = 2 * M::LANES;

    #[inline(always)]
    fn token(self) -> Self::Simd {
        self.0.token()
    }
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
