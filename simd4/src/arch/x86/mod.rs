//! SSE2, SSE4.1, AVX2 and AVX-512. The types of each width are one text for all levels that have
//! such registers (`xmm`, `ymm`, `zmm`); what differs between the levels stands in the level's own
//! file.

mod avx2;
mod avx512;
mod sse2;
mod sse41;
mod xmm;
mod ymm;
mod zmm;

pub use avx2::Avx2;
pub use avx512::Avx512;
pub use sse2::Sse2;
pub use sse41::Sse41;

/// See [`Simd::prefetch`](crate::Simd::prefetch).
#[inline(always)]
fn prefetch<T>(at: *const T) {
    #[cfg(target_arch = "x86")]
    use core::arch::x86::{_MM_HINT_T0, _mm_prefetch};
    #[cfg(target_arch = "x86_64")]
    use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};

    const LINE: usize = 64;
    let first = at.cast::<i8>();
    let mut offset = 0;
    while offset < size_of::<T>() {
        // SAFETY: whoever calls has the token of a level with SSE, and the hint takes any
        // address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(first.wrapping_add(offset)) };
        offset += LINE;
    }
}

impl Sse2 {
    /// Whether the build leaves the level out of what it dispatches to.
    #[doc(hidden)]
    pub const LEFT_OUT: bool = Sse41::GUARANTEED;
}

impl Sse41 {
    /// Whether the build leaves the level out of what it dispatches to.
    #[doc(hidden)]
    pub const LEFT_OUT: bool = Avx2::GUARANTEED;
}

impl Avx2 {
    /// Whether the build leaves the level out of what it dispatches to.
    #[doc(hidden)]
    pub const LEFT_OUT: bool = Avx512::GUARANTEED;
}

/// The best level that the build guarantees.
pub(super) type Best = best::Best;

#[cfg(all(
    target_feature = "avx2",
    target_feature = "fma",
    target_feature = "bmi1",
    target_feature = "bmi2",
    target_feature = "lzcnt",
    target_feature = "popcnt",
    target_feature = "f16c",
    target_feature = "movbe"
))]
mod best {
    #[cfg(not(all(
        target_feature = "avx512f",
        target_feature = "avx512bw",
        target_feature = "avx512cd",
        target_feature = "avx512dq",
        target_feature = "avx512vl"
    )))]
    pub(in super::super) use super::Avx2 as Best;
    #[cfg(all(
        target_feature = "avx512f",
        target_feature = "avx512bw",
        target_feature = "avx512cd",
        target_feature = "avx512dq",
        target_feature = "avx512vl"
    ))]
    pub(in super::super) use super::Avx512 as Best;
}
#[cfg(not(all(
    target_feature = "avx2",
    target_feature = "fma",
    target_feature = "bmi1",
    target_feature = "bmi2",
    target_feature = "lzcnt",
    target_feature = "popcnt",
    target_feature = "f16c",
    target_feature = "movbe"
)))]
mod best {
    #[cfg(not(target_feature = "sse2"))]
    pub(in super::super) use super::super::scalar::Scalar as Best;
    #[cfg(all(target_feature = "sse2", not(target_feature = "sse4.1")))]
    pub(in super::super) use super::Sse2 as Best;
    #[cfg(target_feature = "sse4.1")]
    pub(in super::super) use super::Sse41 as Best;
}
