//! `fearless_simd` dispatches at run time; without its macro crate, by inlining everything.

use fearless_simd::{Level, SimdInterleaved, dispatch, f32x4, f32x8, prelude::*};

use super::Kernel;
use crate::io::{Io, N};
use crate::kernels::{BOXES, DIRECTION, INVERSE, ORIGIN, TRIANGLES};

/// The level is asked for once and kept, as its documentation says.
static LEVEL: std::sync::LazyLock<Level> = std::sync::LazyLock::new(Level::new);

macro_rules! dispatched {
    ($($name:ident)*) => {
        pub(super) const KERNELS: &[Kernel] = &[$((
            stringify!($name),
            |io| dispatch!(*LEVEL, simd => $name(simd, io)),
        )),*];
    };
}

dispatched! { dot slab moller_trumbore argmin_all rsqrt_normalise floor_to_int transpose4x4 hmin }

#[inline(always)]
fn load<S: Simd>(s: S, io: &Io, row: usize, at: usize) -> S::f32s {
    S::f32s::from_slice(s, &io.f[row].0[at..at + S::f32s::LEN])
}

#[inline(always)]
fn load3<S: Simd>(s: S, io: &Io, row: usize, at: usize) -> [S::f32s; 3] {
    [load(s, io, row, at), load(s, io, row + 1, at), load(s, io, row + 2, at)]
}

#[inline(always)]
fn store<S: Simd>(io: &mut Io, at: usize, x: S::f32s) {
    x.store_slice(&mut io.floats.0[at..at + S::f32s::LEN]);
}

#[inline(always)]
fn splat3<S: Simd>(s: S, [x, y, z]: [f32; 3]) -> [S::f32s; 3] {
    [S::f32s::splat(s, x), S::f32s::splat(s, y), S::f32s::splat(s, z)]
}

#[inline(always)]
fn sub3<S: Simd>(a: [S::f32s; 3], b: [S::f32s; 3]) -> [S::f32s; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn mul3<S: Simd>(a: [S::f32s; 3], b: [S::f32s; 3]) -> [S::f32s; 3] {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

#[inline(always)]
fn dot3<S: Simd>(a: [S::f32s; 3], b: [S::f32s; 3]) -> S::f32s {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross3<S: Simd>(a: [S::f32s; 3], b: [S::f32s; 3]) -> [S::f32s; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot<S: Simd>(s: S, io: &mut Io) {
    for at in (0..BOXES).step_by(S::f32s::LEN) {
        let x = dot3::<S>(load3(s, io, 0, at), load3(s, io, 3, at));
        store::<S>(io, at, x);
    }
}

#[inline(always)]
fn slab<S: Simd>(s: S, io: &mut Io) {
    let (origin, inverse) = (splat3(s, ORIGIN), splat3(s, INVERSE));
    let (zero, infinity) = (S::f32s::splat(s, 0.0), S::f32s::splat(s, f32::INFINITY));
    for at in (0..BOXES).step_by(S::f32s::LEN) {
        let low = mul3::<S>(sub3::<S>(load3(s, io, 0, at), origin), inverse);
        let high = mul3::<S>(sub3::<S>(load3(s, io, 3, at), origin), inverse);
        let enter = low[0].min(high[0]).max(zero);
        let enter = enter.max(low[1].min(high[1])).max(low[2].min(high[2]));
        let exit = low[0].max(high[0]).min(low[1].max(high[1])).min(low[2].max(high[2]));
        store::<S>(io, at, enter.simd_le(exit).select(enter, infinity));
    }
}

#[inline(always)]
fn moller_trumbore<S: Simd>(s: S, io: &mut Io) {
    let (origin, direction) = (splat3(s, ORIGIN), splat3(s, DIRECTION));
    let (zero, one) = (S::f32s::splat(s, 0.0), S::f32s::splat(s, 1.0));
    let infinity = S::f32s::splat(s, f32::INFINITY);
    for at in (0..TRIANGLES).step_by(S::f32s::LEN) {
        let (e1, e2) = (load3(s, io, 3, at), load3(s, io, 6, at));
        let p = cross3::<S>(direction, e2);
        let inverse = one / dot3::<S>(e1, p);
        let from = sub3::<S>(origin, load3(s, io, 0, at));
        let u = dot3::<S>(from, p) * inverse;
        let q = cross3::<S>(from, e1);
        let v = dot3::<S>(direction, q) * inverse;
        let t = dot3::<S>(e2, q) * inverse;
        let inside = zero.simd_le(u) & zero.simd_le(v) & (u + v).simd_le(one) & zero.simd_lt(t);
        store::<S>(io, at, inside.select(t, infinity));
    }
}

#[inline(always)]
fn argmin_all<S: Simd>(s: S, io: &mut Io) {
    let mut least = S::f32s::splat(s, f32::INFINITY);
    let mut place = S::u32s::splat(s, 0);
    let mut here = S::u32s::from_fn(s, |lane| lane as u32);
    for at in (0..N).step_by(S::f32s::LEN) {
        let x = load(s, io, 0, at);
        let less = x.simd_lt(least);
        least = x.min(least);
        place = less.select(here, place);
        here += S::f32s::LEN as u32;
    }
    let value = least.reduce_min();
    let equal = least.simd_eq(S::f32s::splat(s, value));
    io.bits.0[0] = equal.select(place, S::u32s::splat(s, u32::MAX)).reduce_min();
    io.floats.0[0] = value;
}

#[inline(always)]
fn rsqrt_normalise<S: Simd>(s: S, io: &mut Io) {
    for at in (0..BOXES).step_by(S::f32s::LEN) {
        let v = load3(s, io, 0, at);
        // There is no reciprocal square root.
        let r = S::f32s::splat(s, 1.0) / dot3::<S>(v, v).sqrt();
        let [x, y, z] = mul3::<S>(v, [r, r, r]);
        store::<S>(io, at, x);
        store::<S>(io, BOXES + at, y);
        store::<S>(io, 2 * BOXES + at, z);
    }
}

#[inline(always)]
fn floor_to_int<S: Simd>(s: S, io: &mut Io) {
    for at in (0..N).step_by(S::f32s::LEN) {
        let cell: S::i32s = load(s, io, 0, at).floor().to_int();
        let cell: S::u32s = cell.bitcast();
        cell.store_slice(&mut io.bits.0[at..at + S::f32s::LEN]);
    }
}

#[inline(always)]
fn transpose4x4<S: Simd>(s: S, io: &mut Io) {
    for (from, to) in io.f[0].0.chunks_exact(16).zip(io.floats.0.chunks_exact_mut(16)) {
        let columns = f32x4::<S>::load_four_interleaved(s, from);
        for (column, to) in columns.iter().zip(to.chunks_exact_mut(4)) {
            column.store_slice(to);
        }
    }
}

#[inline(always)]
fn hmin<S: Simd>(s: S, io: &mut Io) {
    for (from, to) in io.f[0].0.chunks_exact(8).zip(&mut io.floats.0) {
        *to = f32x8::<S>::from_slice(s, from).reduce_min();
    }
}
