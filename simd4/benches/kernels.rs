//! The sample kernels, written once for every level: the crate's side.

use simd4::dispatch;
use simd4::math::{Vec3, transpose};
use simd4::prelude::*;

use crate::io::{Io, N};
use crate::ops::Op;

/// The ray of the slab test and of the triangle test.
pub(crate) const ORIGIN: [f32; 3] = [0.25, -0.5, -20.0];
/// Where it goes.
pub(crate) const DIRECTION: [f32; 3] = [0.0625, 0.125, 1.0];
/// Of each component.
pub(crate) const INVERSE: [f32; 3] = [16.0, 8.0, 1.0];

/// Vectors and boxes: six rows and the output fit in 32 KiB.
pub(crate) const BOXES: usize = N / 2;
/// Nine rows and the output do.
pub(crate) const TRIANGLES: usize = N / 4;

macro_rules! kernels {
    ($($name:ident)*) => {
        pub(crate) const KERNELS: &[Op] = &[$(Op {
            group: "kernel",
            name: stringify!($name),
            ours: |level, io| dispatch!(level, s => $name(s, io)),
        }),*];
    };
}

kernels! { dot slab moller_trumbore argmin_all rsqrt_normalise floor_to_int transpose4x4 hmin }

/// Three rows from the given one on.
#[inline(always)]
fn load3<S: Simd>(s: S, io: &Io, row: usize, at: usize) -> Vec3<S::f32s> {
    Vec3::new(
        S::f32s::load(s, &io.f[row].0[at..]),
        S::f32s::load(s, &io.f[row + 1].0[at..]),
        S::f32s::load(s, &io.f[row + 2].0[at..]),
    )
}

/// Scalar products of vectors by component.
#[inline(always)]
fn dot<S: Simd>(s: S, io: &mut Io) {
    for k in 0..BOXES / S::LANES {
        let at = k * S::LANES;
        load3(s, io, 0, at).dot(load3(s, io, 3, at)).store(&mut io.floats.0[at..]);
    }
}

/// Where a ray enters each box; ∞ where it misses.
#[inline(always)]
fn slab<S: Simd>(s: S, io: &mut Io) {
    let (origin, inverse) = (Vec3::splat(s, ORIGIN), Vec3::splat(s, INVERSE));
    let (zero, infinity) = (S::f32s::splat(s, 0.0), S::f32s::splat(s, f32::INFINITY));
    for k in 0..BOXES / S::LANES {
        let at = k * S::LANES;
        let (low, high) = (load3(s, io, 0, at) - origin, load3(s, io, 3, at) - origin);
        let low = Vec3::new(low.x * inverse.x, low.y * inverse.y, low.z * inverse.z);
        let high = Vec3::new(high.x * inverse.x, high.y * inverse.y, high.z * inverse.z);
        let enter = low.x.min(high.x).max(zero).max(low.y.min(high.y)).max(low.z.min(high.z));
        let exit = low.x.max(high.x).min(low.y.max(high.y)).min(low.z.max(high.z));
        enter.le(exit).select(enter, infinity).store(&mut io.floats.0[at..]);
    }
}

/// Where a ray hits each triangle, given as a vertex and two edges; ∞ where it misses (Möller and
/// Trumbore 1997, both sides).
#[inline(always)]
fn moller_trumbore<S: Simd>(s: S, io: &mut Io) {
    let (origin, direction) = (Vec3::splat(s, ORIGIN), Vec3::splat(s, DIRECTION));
    let (zero, one) = (S::f32s::splat(s, 0.0), S::f32s::splat(s, 1.0));
    let infinity = S::f32s::splat(s, f32::INFINITY);
    for k in 0..TRIANGLES / S::LANES {
        let at = k * S::LANES;
        let (e1, e2) = (load3(s, io, 3, at), load3(s, io, 6, at));
        let p = direction.cross(e2);
        let inverse = one / e1.dot(p);
        let from = origin - load3(s, io, 0, at);
        let u = from.dot(p) * inverse;
        let q = from.cross(e1);
        let v = direction.dot(q) * inverse;
        let t = e2.dot(q) * inverse;
        let inside = zero.le(u) & zero.le(v) & (u + v).le(one) & zero.lt(t);
        inside.select(t, infinity).store(&mut io.floats.0[at..]);
    }
}

/// The place and the value of a row's least element; the first of several.
#[inline(always)]
fn argmin_all<S: Simd>(s: S, io: &mut Io) {
    let mut least = S::f32s::splat(s, f32::INFINITY);
    let (mut place, mut here) = (S::u32s::splat(s, 0), S::u32s::iota(s));
    let step = S::u32s::splat(s, S::LANES as u32);
    for x in io.f[0].0.chunks_exact(S::LANES) {
        let x = S::f32s::load(s, x);
        let less = x.lt(least);
        // The old one of equals, and for NaN.
        least = x.min(least);
        place = less.select(here, place);
        here += step;
    }
    // Of equals, the lane that came to its value first.
    let value = least.reduce_min();
    let equal = least.eq(S::f32s::splat(s, value));
    io.bits.0[0] = equal.select(place, S::u32s::splat(s, u32::MAX)).reduce_min();
    io.floats.0[0] = value;
}

/// Vectors of length 1.
#[inline(always)]
fn rsqrt_normalise<S: Simd>(s: S, io: &mut Io) {
    for k in 0..BOXES / S::LANES {
        let at = k * S::LANES;
        let v = load3(s, io, 0, at);
        let unit = v * v.dot(v).rsqrt_fast();
        unit.x.store(&mut io.floats.0[at..]);
        unit.y.store(&mut io.floats.0[BOXES + at..]);
        unit.z.store(&mut io.floats.0[2 * BOXES + at..]);
    }
}

/// The cells that coordinates fall in.
#[inline(always)]
fn floor_to_int<S: Simd>(s: S, io: &mut Io) {
    for k in 0..N / S::LANES {
        let at = k * S::LANES;
        let cell = S::f32s::load(s, &io.f[0].0[at..]).floor_to_i32_fast();
        cell.to_u32().store(&mut io.bits.0[at..]);
    }
}

/// Matrices of 4×4, rows to columns.
#[inline(always)]
fn transpose4x4<S: Simd>(s: S, io: &mut Io) {
    for (from, to) in io.f[0].0.chunks_exact(16).zip(io.floats.0.chunks_exact_mut(16)) {
        let (a, b) = (S::f32x4::load(s, &from[0..4]), S::f32x4::load(s, &from[4..8]));
        let (c, d) = (S::f32x4::load(s, &from[8..12]), S::f32x4::load(s, &from[12..16]));
        for (column, to) in transpose([a, b, c, d]).into_iter().zip(to.chunks_exact_mut(4)) {
            column.store(to);
        }
    }
}

/// The least of every eight neighbours.
#[inline(always)]
fn hmin<S: Simd>(s: S, io: &mut Io) {
    for (eight, least) in io.f[0].0.chunks_exact(8).zip(&mut io.floats.0) {
        *least = S::f32x8::load(s, eight).reduce_min();
    }
}
