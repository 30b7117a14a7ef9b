//! From a [`Level`](crate::Level) to a kernel compiled for it.

/// Compiles an expression once for each level and runs the one that a [`Level`](crate::Level)
/// names.
///
/// `dispatch!(level, s => kernel(s, …))` binds `s` to the level's token and evaluates to the value
/// of the expression. Dispatch once, outside the loop: hand the kernel a batch. The expression
/// is the body of a closure: `return` and `?` leave it alone and not the function around it.
///
/// For a level that [the build leaves out](crate#the-levels), the one that the build guarantees runs.
#[macro_export]
macro_rules! dispatch {
    ($level:expr, $s:ident => $body:expr) => {
        match $level.in_this_build() {
            $crate::Level::Scalar($s) => $crate::__vectorize!($s, $body),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            $crate::Level::Sse2($s) => $crate::__vectorize!($s, $body, unless $crate::Sse2::LEFT_OUT),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            $crate::Level::Sse41($s) => $crate::__vectorize!($s, $body, unless $crate::Sse41::LEFT_OUT),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            $crate::Level::Avx2($s) => $crate::__vectorize!($s, $body, unless $crate::Avx2::LEFT_OUT),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            $crate::Level::Avx512($s) => $crate::__vectorize!($s, $body),
            #[cfg(target_arch = "aarch64")]
            $crate::Level::Neon($s) => $crate::__vectorize!($s, $body),
            #[cfg(target_arch = "wasm32")]
            #[allow(unreachable_patterns)]
            level => $crate::__dispatch_wasm32!(level, $s => $body),
            // `Level` may grow; this macro grows with it.
            #[allow(unreachable_patterns)]
            _ => unreachable!("a level without an arm in dispatch!"),
        }
    };
}

/// One arm of [`dispatch!`]. The attribute on the closure is what keeps it out of the pit.
#[doc(hidden)]
#[macro_export]
macro_rules! __vectorize {
    // A constant condition: what it excludes is never compiled.
    ($s:ident, $body:expr, unless $left_out:expr) => {
        if $left_out {
            unreachable!("a level that the build leaves out")
        } else {
            $crate::__vectorize!($s, $body)
        }
    };
    ($s:ident, $body:expr) => {
        $crate::Simd::vectorize(
            $s,
            #[inline(always)]
            || $body,
        )
    };
}

/// The arm of [`dispatch!`] for a level that exists in some builds only. It is this crate that
/// tells; a `cfg` in the arm would ask the crate that dispatches, which may be built with other
/// flags, as documentation tests are.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __dispatch_wasm32 {
    ($level:ident, $s:ident => $body:expr) => {
        match $level {
            $crate::Level::Simd128($s) => $crate::__vectorize!($s, $body),
            _ => unreachable!("a level without an arm in dispatch!"),
        }
    };
}

/// The same where there is no such level.
#[cfg(all(target_arch = "wasm32", not(target_feature = "simd128")))]
#[doc(hidden)]
#[macro_export]
macro_rules! __dispatch_wasm32 {
    ($level:ident, $s:ident => $body:expr) => {{
        let _ = $level;
        unreachable!("a level without an arm in dispatch!")
    }};
}
