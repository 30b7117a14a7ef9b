//! `glam` has four lanes of what the build guarantees, and no integers in lanes.

use ::glam::{Mat4, Vec4};

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

fn load(io: &Io, row: usize, at: usize) -> Vec4 {
    Vec4::from_array(lanes(&io.f[row].0, at))
}

fn load3(io: &Io, row: usize, at: usize) -> [Vec4; 3] {
    [load(io, row, at), load(io, row + 1, at), load(io, row + 2, at)]
}

fn store(io: &mut Io, at: usize, x: Vec4) {
    x.write_to_slice(&mut io.floats.0[at..at + 4]);
}

fn splat3([x, y, z]: [f32; 3]) -> [Vec4; 3] {
    [Vec4::splat(x), Vec4::splat(y), Vec4::splat(z)]
}

fn sub3(a: [Vec4; 3], b: [Vec4; 3]) -> [Vec4; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn mul3(a: [Vec4; 3], b: [Vec4; 3]) -> [Vec4; 3] {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

fn dot3(a: [Vec4; 3], b: [Vec4; 3]) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross3(a: [Vec4; 3], b: [Vec4; 3]) -> [Vec4; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(io: &mut Io) {
    for at in (0..BOXES).step_by(4) {
        let x = dot3(load3(io, 0, at), load3(io, 3, at));
        store(io, at, x);
    }
}

fn slab(io: &mut Io) {
    let (origin, inverse) = (splat3(ORIGIN), splat3(INVERSE));
    for at in (0..BOXES).step_by(4) {
        let low = mul3(sub3(load3(io, 0, at), origin), inverse);
        let high = mul3(sub3(load3(io, 3, at), origin), inverse);
        let enter = low[0].min(high[0]).max(Vec4::ZERO);
        let enter = enter.max(low[1].min(high[1])).max(low[2].min(high[2]));
        let exit = low[0].max(high[0]).min(low[1].max(high[1])).min(low[2].max(high[2]));
        store(io, at, Vec4::select(enter.cmple(exit), enter, Vec4::INFINITY));
    }
}

fn moller_trumbore(io: &mut Io) {
    let (origin, direction) = (splat3(ORIGIN), splat3(DIRECTION));
    for at in (0..TRIANGLES).step_by(4) {
        let (e1, e2) = (load3(io, 3, at), load3(io, 6, at));
        let p = cross3(direction, e2);
        let inverse = Vec4::ONE / dot3(e1, p);
        let from = sub3(origin, load3(io, 0, at));
        let u = dot3(from, p) * inverse;
        let q = cross3(from, e1);
        let v = dot3(direction, q) * inverse;
        let t = dot3(e2, q) * inverse;
        let inside = Vec4::ZERO.cmple(u)
            & Vec4::ZERO.cmple(v)
            & (u + v).cmple(Vec4::ONE)
            & Vec4::ZERO.cmplt(t);
        store(io, at, Vec4::select(inside, t, Vec4::INFINITY));
    }
}

fn argmin_all(io: &mut Io) {
    // Places as floats, which hold them exactly.
    let (mut least, mut place) = (Vec4::INFINITY, Vec4::ZERO);
    let mut here = Vec4::new(0.0, 1.0, 2.0, 3.0);
    for at in (0..N).step_by(4) {
        let x = load(io, 0, at);
        let less = x.cmplt(least);
        least = x.min(least);
        place = Vec4::select(less, here, place);
        here += 4.0;
    }
    let value = least.min_element();
    let equal = least.cmpeq(Vec4::splat(value));
    io.bits.0[0] = Vec4::select(equal, place, Vec4::INFINITY).min_element() as u32;
    io.floats.0[0] = value;
}

fn rsqrt_normalise(io: &mut Io) {
    for at in (0..BOXES).step_by(4) {
        let v = load3(io, 0, at);
        let r = dot3(v, v).sqrt().recip();
        let [x, y, z] = mul3(v, [r, r, r]);
        store(io, at, x);
        store(io, BOXES + at, y);
        store(io, 2 * BOXES + at, z);
    }
}

fn floor_to_int(io: &mut Io) {
    for at in (0..N).step_by(4) {
        let cell = load(io, 0, at).floor().as_ivec4().as_uvec4();
        cell.write_to_slice(&mut io.bits.0[at..at + 4]);
    }
}

fn transpose4x4(io: &mut Io) {
    for (from, to) in io.f[0].0.chunks_exact(16).zip(io.floats.0.chunks_exact_mut(16)) {
        Mat4::from_cols_slice(from).transpose().write_cols_to_slice(to);
    }
}

fn hmin(io: &mut Io) {
    for k in 0..N / 8 {
        io.floats.0[k] = load(io, 0, 8 * k).min(load(io, 0, 8 * k + 4)).min_element();
    }
}
