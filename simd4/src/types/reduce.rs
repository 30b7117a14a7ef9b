//! What reductions fold lanes with.

use crate::Lanes;

/// How two vectors become one.
pub trait Fold {
    /// Lane by lane.
    fn fold<V: Lanes>(a: V, b: V) -> V;
}

macro_rules! folds {
    ($($(#[$doc:meta])* $Fold:ident |$a:ident, $b:ident| $body:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $Fold;
        impl Fold for $Fold {
            #[inline(always)]
            fn fold<V: Lanes>($a: V, $b: V) -> V {
                $body
            }
        }
    )*};
}

folds! {
    /// `+`
    Sum |a, b| a + b;
    /// `*`
    Product |a, b| a * b;
    /// [`Lanes::min`]
    Min |a, b| a.min(b);
    /// [`Lanes::max`]
    Max |a, b| a.max(b);
}

/// Four lanes as one, by two folds of a vector with itself.
#[allow(dead_code, reason = "unused where there are no registers")]
#[inline(always)]
pub(crate) fn four<F: Fold, V: Lanes>(v: V) -> V::Elem {
    four_all::<F, V>(v).lane(0)
}

/// The same in every lane.
#[inline(always)]
pub(crate) fn four_all<F: Fold, V: Lanes>(v: V) -> V {
    let v = F::fold(v, crate::swizzle!(v, [2, 3, 0, 1]));
    F::fold(v, crate::swizzle!(v, [1, 0, 3, 2]))
}
