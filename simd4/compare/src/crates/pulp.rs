//! `pulp` dispatches at run time and has vectors of the native width only; no floor, no
//! conversions to integers, no moves between lanes of fixed number.

#![allow(clippy::needless_range_loop, reason = "the number goes through several slices")]

use ::pulp::{Arch, Simd, WithSimd};

use super::Kernel;
use crate::io::{Io, N, Row};
use crate::kernels::{BOXES, DIRECTION, INVERSE, ORIGIN, TRIANGLES};

/// Detection is cached inside, but not for free.
static ARCH: std::sync::LazyLock<Arch> = std::sync::LazyLock::new(Arch::new);

macro_rules! dispatched {
    ($($name:ident)*) => {
        pub(super) const KERNELS: &[Kernel] = &[$((stringify!($name), {
            struct Call<'a>(&'a mut Io);
            impl WithSimd for Call<'_> {
                type Output = ();
                #[inline(always)]
                fn with_simd<S: Simd>(self, simd: S) {
                    $name(simd, self.0)
                }
            }
            |io| ARCH.dispatch(Call(io))
        })),*];
    };
}

dispatched! { dot slab moller_trumbore argmin_all rsqrt_normalise hmin }

/// Three rows from the given one on, up to an element.
#[inline(always)]
fn rows3<S: Simd>(rows: &[Row<f32, N>], row: usize, end: usize) -> [&[S::f32s]; 3] {
    [
        S::as_simd_f32s(&rows[row].0[..end]).0,
        S::as_simd_f32s(&rows[row + 1].0[..end]).0,
        S::as_simd_f32s(&rows[row + 2].0[..end]).0,
    ]
}

#[inline(always)]
fn at<S: Simd>(rows: [&[S::f32s]; 3], k: usize) -> [S::f32s; 3] {
    [rows[0][k], rows[1][k], rows[2][k]]
}

#[inline(always)]
fn splat3<S: Simd>(s: S, [x, y, z]: [f32; 3]) -> [S::f32s; 3] {
    [s.splat_f32s(x), s.splat_f32s(y), s.splat_f32s(z)]
}

#[inline(always)]
fn sub3<S: Simd>(s: S, a: [S::f32s; 3], b: [S::f32s; 3]) -> [S::f32s; 3] {
    [s.sub_f32s(a[0], b[0]), s.sub_f32s(a[1], b[1]), s.sub_f32s(a[2], b[2])]
}

#[inline(always)]
fn mul3<S: Simd>(s: S, a: [S::f32s; 3], b: [S::f32s; 3]) -> [S::f32s; 3] {
    [s.mul_f32s(a[0], b[0]), s.mul_f32s(a[1], b[1]), s.mul_f32s(a[2], b[2])]
}

#[inline(always)]
fn dot3<S: Simd>(s: S, a: [S::f32s; 3], b: [S::f32s; 3]) -> S::f32s {
    let [x, y, z] = mul3(s, a, b);
    s.add_f32s(s.add_f32s(x, y), z)
}

#[inline(always)]
fn cross3<S: Simd>(s: S, a: [S::f32s; 3], b: [S::f32s; 3]) -> [S::f32s; 3] {
    [
        s.sub_f32s(s.mul_f32s(a[1], b[2]), s.mul_f32s(a[2], b[1])),
        s.sub_f32s(s.mul_f32s(a[2], b[0]), s.mul_f32s(a[0], b[2])),
        s.sub_f32s(s.mul_f32s(a[0], b[1]), s.mul_f32s(a[1], b[0])),
    ]
}

#[inline(always)]
fn dot<S: Simd>(s: S, io: &mut Io) {
    let (a, b) = (rows3::<S>(&io.f, 0, BOXES), rows3::<S>(&io.f, 3, BOXES));
    let to = S::as_mut_simd_f32s(&mut io.floats.0[..BOXES]).0;
    for k in 0..BOXES / S::F32_LANES {
        to[k] = dot3(s, at::<S>(a, k), at::<S>(b, k));
    }
}

#[inline(always)]
fn slab<S: Simd>(s: S, io: &mut Io) {
    let (origin, inverse) = (splat3(s, ORIGIN), splat3(s, INVERSE));
    let (zero, infinity) = (s.splat_f32s(0.0), s.splat_f32s(f32::INFINITY));
    let (low, high) = (rows3::<S>(&io.f, 0, BOXES), rows3::<S>(&io.f, 3, BOXES));
    let to = S::as_mut_simd_f32s(&mut io.floats.0[..BOXES]).0;
    for k in 0..BOXES / S::F32_LANES {
        let low = mul3(s, sub3(s, at::<S>(low, k), origin), inverse);
        let high = mul3(s, sub3(s, at::<S>(high, k), origin), inverse);
        let enter = s.max_f32s(s.min_f32s(low[0], high[0]), zero);
        let enter = s.max_f32s(enter, s.min_f32s(low[1], high[1]));
        let enter = s.max_f32s(enter, s.min_f32s(low[2], high[2]));
        let exit = s.min_f32s(s.max_f32s(low[0], high[0]), s.max_f32s(low[1], high[1]));
        let exit = s.min_f32s(exit, s.max_f32s(low[2], high[2]));
        to[k] = s.select_f32s(s.less_than_or_equal_f32s(enter, exit), enter, infinity);
    }
}

#[inline(always)]
fn moller_trumbore<S: Simd>(s: S, io: &mut Io) {
    let (origin, direction) = (splat3(s, ORIGIN), splat3(s, DIRECTION));
    let (zero, one) = (s.splat_f32s(0.0), s.splat_f32s(1.0));
    let infinity = s.splat_f32s(f32::INFINITY);
    let (vertex, e1) = (rows3::<S>(&io.f, 0, TRIANGLES), rows3::<S>(&io.f, 3, TRIANGLES));
    let e2 = rows3::<S>(&io.f, 6, TRIANGLES);
    let to = S::as_mut_simd_f32s(&mut io.floats.0[..TRIANGLES]).0;
    for k in 0..TRIANGLES / S::F32_LANES {
        let (e1, e2) = (at::<S>(e1, k), at::<S>(e2, k));
        let p = cross3(s, direction, e2);
        let inverse = s.div_f32s(one, dot3(s, e1, p));
        let from = sub3(s, origin, at::<S>(vertex, k));
        let u = s.mul_f32s(dot3(s, from, p), inverse);
        let q = cross3(s, from, e1);
        let v = s.mul_f32s(dot3(s, direction, q), inverse);
        let t = s.mul_f32s(dot3(s, e2, q), inverse);
        let inside =
            s.and_m32s(s.less_than_or_equal_f32s(zero, u), s.less_than_or_equal_f32s(zero, v));
        let inside = s.and_m32s(inside, s.less_than_or_equal_f32s(s.add_f32s(u, v), one));
        let inside = s.and_m32s(inside, s.less_than_f32s(zero, t));
        to[k] = s.select_f32s(inside, t, infinity);
    }
}

#[inline(always)]
fn argmin_all<S: Simd>(s: S, io: &mut Io) {
    const IOTA: [u32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
    let mut least = s.splat_f32s(f32::INFINITY);
    let mut place = s.splat_u32s(0);
    let mut here = s.partial_load_u32s(&IOTA[..S::U32_LANES]);
    for &x in S::as_simd_f32s(&io.f[0].0).0 {
        let less = s.less_than_f32s(x, least);
        least = s.min_f32s(x, least);
        place = s.select_u32s(less, here, place);
        here = s.add_u32s(here, s.splat_u32s(S::U32_LANES as u32));
    }
    let value = s.reduce_min_f32s(least);
    let equal = s.equal_f32s(least, s.splat_f32s(value));
    // Integers have no reductions.
    let mut places = [u32::MAX; 16];
    s.partial_store_u32s(&mut places, s.select_u32s(equal, place, s.splat_u32s(u32::MAX)));
    io.bits.0[0] = places[..S::U32_LANES].iter().copied().fold(u32::MAX, u32::min);
    io.floats.0[0] = value;
}

#[inline(always)]
fn rsqrt_normalise<S: Simd>(s: S, io: &mut Io) {
    let v = rows3::<S>(&io.f, 0, BOXES);
    let (x, rest) = io.floats.0.split_at_mut(BOXES);
    let (y, z) = rest.split_at_mut(BOXES);
    let (x, y) = (S::as_mut_simd_f32s(x).0, S::as_mut_simd_f32s(y).0);
    let z = S::as_mut_simd_f32s(z).0;
    for k in 0..BOXES / S::F32_LANES {
        let v = at::<S>(v, k);
        // There is no reciprocal square root of `f32`.
        let r = s.div_f32s(s.splat_f32s(1.0), s.sqrt_f32s(dot3(s, v, v)));
        [x[k], y[k], z[k]] = mul3(s, v, [r, r, r]);
    }
}

#[inline(always)]
fn hmin<S: Simd>(s: S, io: &mut Io) {
    let row = S::as_simd_f32s(&io.f[0].0).0;
    for (eight, to) in row.chunks_exact(8 / S::F32_LANES).zip(&mut io.floats.0[..N / 8]) {
        let mut least = eight[0];
        for &x in &eight[1..] {
            least = s.min_f32s(least, x);
        }
        *to = s.reduce_min_f32s(least);
    }
}
