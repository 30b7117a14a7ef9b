//! Where a type's operators meet its instructions.

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
