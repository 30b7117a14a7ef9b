//! The levels, one folder an architecture, one file a level. The only room that names
//! instructions.

pub mod scalar;

#[cfg(target_arch = "aarch64")]
mod aarch64;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod wasm32;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod x86;

/// The tokens of this architecture's levels.
pub(crate) mod tokens {
    #[cfg(target_arch = "aarch64")]
    pub use super::aarch64::Neon;
    pub use super::scalar::Scalar;
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    pub use super::wasm32::Simd128;
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    pub use super::x86::{Avx2, Avx512, Sse2, Sse41};
}

/// The types of the best level that the build guarantees.
#[allow(non_camel_case_types)]
pub(crate) mod native {
    use crate::Simd;

    #[cfg(target_arch = "aarch64")]
    pub(crate) type Best = super::aarch64::Neon;
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    pub(crate) type Best = super::wasm32::Simd128;
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    pub(crate) type Best = super::x86::Best;
    #[cfg(not(any(
        target_arch = "aarch64",
        all(target_arch = "wasm32", target_feature = "simd128"),
        target_arch = "x86",
        target_arch = "x86_64"
    )))]
    pub(crate) type Best = super::scalar::Scalar;

    /// Four lanes of `f32`, of the best level that the build guarantees.
    pub type f32x4 = <Best as Simd>::f32x4;
    /// Four lanes of `i32`, of the best level that the build guarantees.
    pub type i32x4 = <Best as Simd>::i32x4;
    /// Four lanes of `u32`, of the best level that the build guarantees.
    pub type u32x4 = <Best as Simd>::u32x4;
    /// Four lanes of truth, of the best level that the build guarantees.
    pub type mask32x4 = <Best as Simd>::mask32x4;
    /// Eight lanes of `f32`, of the best level that the build guarantees.
    pub type f32x8 = <Best as Simd>::f32x8;
    /// Eight lanes of `i32`, of the best level that the build guarantees.
    pub type i32x8 = <Best as Simd>::i32x8;
    /// Eight lanes of `u32`, of the best level that the build guarantees.
    pub type u32x8 = <Best as Simd>::u32x8;
    /// Eight lanes of truth, of the best level that the build guarantees.
    pub type mask32x8 = <Best as Simd>::mask32x8;
    /// Sixteen lanes of `f32`, of the best level that the build guarantees.
    pub type f32x16 = <Best as Simd>::f32x16;
    /// Sixteen lanes of `i32`, of the best level that the build guarantees.
    pub type i32x16 = <Best as Simd>::i32x16;
    /// Sixteen lanes of `u32`, of the best level that the build guarantees.
    pub type u32x16 = <Best as Simd>::u32x16;
    /// Sixteen lanes of truth, of the best level that the build guarantees.
    pub type mask32x16 = <Best as Simd>::mask32x16;
}

/// Runs intrinsics of the level whose token is at hand.
#[cfg(any(
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128"),
    target_arch = "x86",
    target_arch = "x86_64"
))]
macro_rules! proven {
    ($intrinsics:expr) => {{
        // SAFETY: the value or the argument of the surrounding function holds its level's token,
        // which only detection and the build's own guarantee hand out. The intrinsics used this
        // way touch no memory, and a `transmute` is between types of one size without padding
        // for which any bits are a value.
        #[allow(unused_unsafe)]
        unsafe {
            $intrinsics
        }
    }};
}

/// Defines a level's token: its proof by detection, and by the build where it guarantees it.
#[cfg(any(target_arch = "aarch64", target_arch = "x86", target_arch = "x86_64"))]
macro_rules! token {
    ($(#[$doc:meta])* $Token:ident, $detected:ident, [$($feature:tt),*]) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $Token {
            _private: (),
        }

        impl $Token {
            /// Whether every CPU that the build is for has the level.
            #[allow(dead_code)]
            pub(crate) const GUARANTEED: bool = cfg!(all($(target_feature = $feature),*));

            /// The token, if this CPU has the level. Without the feature `std`: if the build
            /// guarantees it.
            #[inline]
            pub fn detect() -> Option<Self> {
                #[cfg(feature = "std")]
                let has = true $(&& std::arch::$detected!($feature))*;
                #[cfg(not(feature = "std"))]
                let has = Self::GUARANTEED;
                has.then_some($Token { _private: () })
            }
        }

        impl crate::simd::sealed::Sealed for $Token {}

        #[cfg(all($(target_feature = $feature),*))]
        impl crate::Guaranteed for $Token {
            const TOKEN: Self = $Token { _private: () };
        }
    };
}

#[cfg(any(
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128"),
    target_arch = "x86",
    target_arch = "x86_64"
))]
use proven;
#[cfg(any(target_arch = "aarch64", target_arch = "x86", target_arch = "x86_64"))]
use token;
