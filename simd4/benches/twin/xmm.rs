//! Registers of four lanes: what the twins of SSE2 and SSE4.1 are made of.

use core::arch::x86_64::*;

use crate::io::Io;

pub(super) const LANES: usize = 4;

/// One register of each operand.
pub(super) struct Regs {
    pub(super) a: __m128,
    pub(super) b: __m128,
    pub(super) c: __m128,
    pub(super) i: __m128i,
    pub(super) j: __m128i,
    pub(super) u: __m128i,
    pub(super) v: __m128i,
    pub(super) n: __m128i,
}

impl Regs {
    #[target_feature(enable = "sse2")]
    #[inline]
    pub(super) fn load(io: &Io, at: usize) -> Regs {
        Regs {
            a: load(&io.f[0].0, at),
            b: load(&io.f[1].0, at),
            c: load(&io.f[2].0, at),
            i: load_epi32(&io.i[0].0, at),
            j: load_epi32(&io.i[1].0, at),
            u: load_epi32(&io.u[0].0, at),
            v: load_epi32(&io.u[1].0, at),
            n: _mm_cvtsi32_si128(io.shift as i32),
        }
    }
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn load(row: &[f32], at: usize) -> __m128 {
    debug_assert!(at + LANES <= row.len());
    // SAFETY: the loops stay within their rows.
    unsafe { _mm_loadu_ps(row.as_ptr().add(at)) }
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn load_epi32<T>(row: &[T], at: usize) -> __m128i {
    debug_assert!(at + LANES <= row.len() && size_of::<T>() == 4);
    // SAFETY: the loops stay within their rows.
    unsafe { _mm_loadu_si128(row.as_ptr().add(at).cast()) }
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn store(row: &mut [f32], at: usize, x: __m128) {
    debug_assert!(at + LANES <= row.len());
    // SAFETY: the loops stay within their rows.
    unsafe { _mm_storeu_ps(row.as_mut_ptr().add(at), x) }
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn store_epi32(row: &mut [u32], at: usize, x: __m128i) {
    debug_assert!(at + LANES <= row.len());
    // SAFETY: the loops stay within their rows.
    unsafe { _mm_storeu_si128(row.as_mut_ptr().add(at).cast(), x) }
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn bits(x: __m128) -> __m128i {
    _mm_castps_si128(x)
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn sign() -> __m128 {
    _mm_set1_ps(-0.0)
}

/// The higher lanes to the lower.
#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn high(x: __m128) -> __m128 {
    _mm_movehl_ps(x, x)
}

/// The second lane to the lowest.
#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn second(x: __m128) -> __m128 {
    _mm_shuffle_ps::<1>(x, x)
}

/// The least of four, in the tree's order.
#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn hmin_ps(x: __m128) -> f32 {
    let x = _mm_min_ps(x, high(x));
    _mm_cvtss_f32(_mm_min_ps(x, second(x)))
}

/// The same in every lane, by component.
#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn splat3([x, y, z]: [f32; 3]) -> [__m128; 3] {
    [_mm_set1_ps(x), _mm_set1_ps(y), _mm_set1_ps(z)]
}

/// Three rows from the given one on.
#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn load3(io: &Io, row: usize, at: usize) -> [__m128; 3] {
    [load(&io.f[row].0, at), load(&io.f[row + 1].0, at), load(&io.f[row + 2].0, at)]
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn sub3([ax, ay, az]: [__m128; 3], [bx, by, bz]: [__m128; 3]) -> [__m128; 3] {
    [_mm_sub_ps(ax, bx), _mm_sub_ps(ay, by), _mm_sub_ps(az, bz)]
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn mul3([ax, ay, az]: [__m128; 3], [bx, by, bz]: [__m128; 3]) -> [__m128; 3] {
    [_mm_mul_ps(ax, bx), _mm_mul_ps(ay, by), _mm_mul_ps(az, bz)]
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn dot3(a: [__m128; 3], b: [__m128; 3]) -> __m128 {
    let [x, y, z] = mul3(a, b);
    _mm_add_ps(_mm_add_ps(x, y), z)
}

#[target_feature(enable = "sse2")]
#[inline]
pub(super) fn cross3([ax, ay, az]: [__m128; 3], [bx, by, bz]: [__m128; 3]) -> [__m128; 3] {
    [
        _mm_sub_ps(_mm_mul_ps(ay, bz), _mm_mul_ps(az, by)),
        _mm_sub_ps(_mm_mul_ps(az, bx), _mm_mul_ps(ax, bz)),
        _mm_sub_ps(_mm_mul_ps(ax, by), _mm_mul_ps(ay, bx)),
    ]
}
