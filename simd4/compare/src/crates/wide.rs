//! `wide` has no dispatch at run time: its eight lanes are what the build guarantees.

use ::wide::{f32x4, f32x8, i32x8, u32x8};

use super::{Kernel, lanes};
use crate::io::{Io, N};
use crate::kernels::{BOXES, DIRECTION, INVERSE, ORIGIN, TRIANGLES};

pub(super) const KERNELS: &[Kernel] = &[
    ("dot", dot),
    ("slab", slab),
    ("moller_trumbore", moller_trumbore),
    ("argmin_all", argmin_all),
    ("rsqrt_normalise", rsqrt_normalise),
    ("floor_to_int", floor_to_int),
    ("transpose4x4", transpose4x4),
    ("hmin", hmin),
];

fn load(io: &Io, row: usize, at: usize) -> f32x8 {
    f32x8::new(lanes(&io.f[row].0, at))
}

fn load3(io: &Io, row: usize, at: usize) -> [f32x8; 3] {
    [load(io, row, at), load(io, row + 1, at), load(io, row + 2, at)]
}

fn store(io: &mut Io, at: usize, x: f32x8) {
    io.floats.0[at..at + 8].copy_from_slice(x.as_array());
}

fn splat3([x, y, z]: [f32; 3]) -> [f32x8; 3] {
    [f32x8::splat(x), f32x8::splat(y), f32x8::splat(z)]
}

fn sub3(a: [f32x8; 3], b: [f32x8; 3]) -> [f32x8; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn mul3(a: [f32x8; 3], b: [f32x8; 3]) -> [f32x8; 3] {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

fn dot3(a: [f32x8; 3], b: [f32x8; 3]) -> f32x8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross3(a: [f32x8; 3], b: [f32x8; 3]) -> [f32x8; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(io: &mut Io) {
    for at in (0..BOXES).step_by(8) {
        let x = dot3(load3(io, 0, at), load3(io, 3, at));
        store(io, at, x);
    }
}

fn slab(io: &mut Io) {
    let (origin, inverse) = (splat3(ORIGIN), splat3(INVERSE));
    let (zero, infinity) = (f32x8::splat(0.0), f32x8::splat(f32::INFINITY));
    for at in (0..BOXES).step_by(8) {
        let low = mul3(sub3(load3(io, 0, at), origin), inverse);
        let high = mul3(sub3(load3(io, 3, at), origin), inverse);
        // The fast ones do not care for NaN, as the others' do not.
        let enter = low[0].fast_min(high[0]).fast_max(zero);
        let enter = enter.fast_max(low[1].fast_min(high[1])).fast_max(low[2].fast_min(high[2]));
        let exit = low[0].fast_max(high[0]).fast_min(low[1].fast_max(high[1]));
        let exit = exit.fast_min(low[2].fast_max(high[2]));
        store(io, at, enter.simd_le(exit).select(enter, infinity));
    }
}

fn moller_trumbore(io: &mut Io) {
    let (origin, direction) = (splat3(ORIGIN), splat3(DIRECTION));
    let (zero, one) = (f32x8::splat(0.0), f32x8::splat(1.0));
    for at in (0..TRIANGLES).step_by(8) {
        let (e1, e2) = (load3(io, 3, at), load3(io, 6, at));
        let p = cross3(direction, e2);
        let inverse = one / dot3(e1, p);
        let from = sub3(origin, load3(io, 0, at));
        let u = dot3(from, p) * inverse;
        let q = cross3(from, e1);
        let v = dot3(direction, q) * inverse;
        let t = dot3(e2, q) * inverse;
        let inside = zero.simd_le(u) & zero.simd_le(v) & (u + v).simd_le(one) & zero.simd_lt(t);
        store(io, at, inside.select(t, f32x8::splat(f32::INFINITY)));
    }
}

fn argmin_all(io: &mut Io) {
    let mut least = f32x8::splat(f32::INFINITY);
    let (mut place, mut here) = (u32x8::splat(0), u32x8::new([0, 1, 2, 3, 4, 5, 6, 7]));
    for at in (0..N).step_by(8) {
        let x = load(io, 0, at);
        let less = x.simd_lt(least);
        least = x.fast_min(least);
        place = u32x8::from_ne_bytes(less.to_ne_bytes()).select(here, place);
        here += u32x8::splat(8);
    }
    let value = least.to_array().into_iter().fold(f32::INFINITY, f32::min);
    let equal = u32x8::from_ne_bytes(least.simd_eq(f32x8::splat(value)).to_ne_bytes());
    io.bits.0[0] = equal.select(place, u32x8::splat(u32::MAX)).reduce_min();
    io.floats.0[0] = value;
}

fn rsqrt_normalise(io: &mut Io) {
    for at in (0..BOXES).step_by(8) {
        let v = load3(io, 0, at);
        // `recip_sqrt` alone is an estimate of 12 bits.
        let square = dot3(v, v);
        let r = square.recip_sqrt();
        let half = f32x8::splat(0.5);
        let r = r + r * (half - square * half * r * r);
        let [x, y, z] = mul3(v, [r, r, r]);
        store(io, at, x);
        store(io, BOXES + at, y);
        store(io, 2 * BOXES + at, z);
    }
}

fn floor_to_int(io: &mut Io) {
    for at in (0..N).step_by(8) {
        let cell: i32x8 = load(io, 0, at).floor().fast_trunc_int();
        let cell = cell.cast_unsigned();
        io.bits.0[at..at + 8].copy_from_slice(cell.as_array());
    }
}

fn transpose4x4(io: &mut Io) {
    for at in (0..N).step_by(16) {
        let row = |row: usize| f32x4::new(lanes(&io.f[0].0, at + 4 * row));
        let columns = f32x4::transpose([row(0), row(1), row(2), row(3)]);
        for (column, to) in columns.iter().zip(io.floats.0[at..at + 16].chunks_exact_mut(4)) {
            to.copy_from_slice(column.as_array());
        }
    }
}

fn hmin(io: &mut Io) {
    for k in 0..N / 8 {
        // Floats have no reduction to the least.
        let [a, b]: [f32x4; 2] =
            [f32x4::new(lanes(&io.f[0].0, 8 * k)), f32x4::new(lanes(&io.f[0].0, 8 * k + 4))];
        let [a, b, c, d] = a.fast_min(b).to_array();
        io.floats.0[k] = a.min(c).min(b.min(d));
    }
}
