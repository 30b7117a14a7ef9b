//! The types' contracts, one trait a kind of element, and the pair of registers that makes a
//! type of twice the width.

mod f32;
mod halves;
mod i32;
mod mask;
mod u32;

pub use f32::SimdF32;
pub use halves::Halves;
pub use i32::SimdI32;
pub use mask::SimdMask;
pub use u32::SimdU32;

use crate::Simd;
use crate::simd::sealed::Sealed;

/// What all vectors of numbers have in common: lanes that come from memory and go back.
///
/// Nothing here reads or writes past a slice.
pub trait Lanes: Copy + Send + Sync + core::fmt::Debug + Sealed + 'static {
    /// The level's token.
    type Simd: Simd;
    /// One lane.
    type Elem: Copy;
    /// All lanes, lane 0 first.
    type Array: Copy
        + AsRef<[Self::Elem]>
        + AsMut<[Self::Elem]>
        + for<'a> TryFrom<&'a [Self::Elem], Error = core::array::TryFromSliceError>;
    /// The truth of a comparison, lane by lane.
    type Mask: SimdMask<Simd = Self::Simd>;

    /// The number of lanes.
    const LANES: usize;

    /// The same value in every lane.
    fn splat(s: Self::Simd, x: Self::Elem) -> Self;

    /// From an array, lane 0 first.
    fn from_array(s: Self::Simd, a: Self::Array) -> Self;

    /// To an array, lane 0 first.
    fn to_array(self) -> Self::Array;

    /// `mask ? a : b`, lane by lane.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;

    /// The first [`Lanes::LANES`] elements of a slice.
    ///
    /// # Panics
    /// If the slice is shorter.
    #[inline(always)]
    fn load(s: Self::Simd, from: &[Self::Elem]) -> Self {
        match Self::Array::try_from(&from[..Self::LANES]) {
            Ok(a) => Self::from_array(s, a),
            Err(_) => unreachable!(),
        }
    }

    /// Writes the first [`Lanes::LANES`] elements of a slice.
    ///
    /// # Panics
    /// If the slice is shorter.
    #[inline(always)]
    fn store(self, to: &mut [Self::Elem]) {
        to[..Self::LANES].copy_from_slice(self.to_array().as_ref());
    }

    /// The elements of a slice of any length, as many as there are lanes for; the lanes beyond
    /// get `fill`.
    #[inline(always)]
    fn load_prefix(s: Self::Simd, from: &[Self::Elem], fill: Self::Elem) -> Self {
        if from.len() >= Self::LANES {
            return Self::load(s, from);
        }
        let mut a = Self::splat(s, fill).to_array();
        a.as_mut()[..from.len()].copy_from_slice(from);
        Self::from_array(s, a)
    }

    /// Writes as many lanes as a slice of any length takes.
    #[inline(always)]
    fn store_prefix(self, to: &mut [Self::Elem]) {
        let n = to.len();
        if n >= Self::LANES {
            return self.store(to);
        }
        to.copy_from_slice(&self.to_array().as_ref()[..n]);
    }
}

/// Implements binary operators and their assigning forms: the seam where an operator meets its
/// instruction.
macro_rules! operators {
    (@one [$($generics:tt)*] $ty:ty,
        $Op:ident $op:ident $OpAssign:ident $op_assign:ident |$a:ident, $b:ident| $body:expr
    ) => {
        impl<$($generics)*> core::ops::$Op for $ty {
            type Output = Self;
            #[inline(always)]
            fn $op(self, rhs: Self) -> Self {
                let ($a, $b) = (self, rhs);
                $body
            }
        }
        impl<$($generics)*> core::ops::$OpAssign for $ty {
            #[inline(always)]
            fn $op_assign(&mut self, rhs: Self) {
                *self = core::ops::$Op::$op(*self, rhs);
            }
        }
    };
    ($generics:tt $ty:ty {
        $($Op:ident $op:ident $OpAssign:ident $op_assign:ident |$a:ident, $b:ident| $body:expr;)*
    }) => {$(
        $crate::types::operators! {
            @one $generics $ty, $Op $op $OpAssign $op_assign |$a, $b| $body
        }
    )*};
}

/// Implements a unary operator.
macro_rules! unary_operator {
    ([$($generics:tt)*] $ty:ty { $Op:ident $op:ident |$a:ident| $body:expr }) => {
        impl<$($generics)*> core::ops::$Op for $ty {
            type Output = Self;
            #[inline(always)]
            fn $op(self) -> Self {
                let $a = self;
                $body
            }
        }
    };
}

/// What the lanes of every type of numbers share: `Debug` and, where the build guarantees the
/// level, `From`.
macro_rules! conversions {
    ([$($generics:tt)*] $ty:ty, $token:ty) => {
        impl<$($generics)*> core::fmt::Debug for $ty {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                let lanes = self.to_array();
                f.debug_list().entries(AsRef::<[<Self as $crate::Lanes>::Elem]>::as_ref(&lanes)).finish()
            }
        }
        impl<$($generics)*> From<<$ty as $crate::Lanes>::Array> for $ty
        where
            $token: $crate::Guaranteed,
        {
            #[inline(always)]
            fn from(a: <$ty as $crate::Lanes>::Array) -> Self {
                <$ty as $crate::Lanes>::from_array(<$token as $crate::Guaranteed>::TOKEN, a)
            }
        }
        impl<$($generics)*> From<<$ty as $crate::Lanes>::Elem> for $ty
        where
            $token: $crate::Guaranteed,
        {
            /// The same value in every lane.
            #[inline(always)]
            fn from(x: <$ty as $crate::Lanes>::Elem) -> Self {
                <$ty as $crate::Lanes>::splat(<$token as $crate::Guaranteed>::TOKEN, x)
            }
        }
    };
}

pub(crate) use {conversions, operators, unary_operator};
