//! Sample kernels as a user writes them: generic, with loops over slices, dispatched.
//! `kernels::WIDTH::KERNEL` takes any level.

use simd4::math::Vec3;
use simd4::prelude::*;

/// An entry for each line of a table at each width, dispatched by level.
macro_rules! kernels {
    (@width $width:ident $V:ident, $(
        $kernel:ident($($arg:ident: $T:ty),*) -> $Result:ty;
    )*) => {
        pub mod $width {
            use simd4::{dispatch, Level, Simd};
            $(
                pub fn $kernel(level: Level, $($arg: $T),*) -> $Result {
                    #[inline(always)]
                    fn at<S: Simd>(s: S, $($arg: $T),*) -> $Result {
                        super::$kernel::<S::$V>(s, $($arg),*)
                    }
                    dispatch!(level, s => at(s, $($arg),*))
                }
            )*
        }
    };
    ($($table:tt)*) => {
        kernels! { @width x4 f32x4, $($table)* }
        kernels! { @width x8 f32x8, $($table)* }
        kernels! { @width x16 f32x16, $($table)* }
    };
}

kernels! {
    dot(a: [&[f32]; 3], b: [&[f32]; 3], out: &mut [f32]) -> ();
    slab(bounds: [&[f32]; 6], origin: [f32; 3], inverse: [f32; 3], entry: &mut [f32]) -> u32;
    moller_trumbore(
        triangles: [&[f32]; 9], origin: [f32; 3], direction: [f32; 3]
    ) -> Option<(usize, f32)>;
    argmin(xs: &[f32]) -> Option<(usize, f32)>;
    normalize(x: &mut [f32], y: &mut [f32], z: &mut [f32]) -> ();
    floor_to_int(xs: &[f32], out: &mut [i32]) -> ();
    transpose(rows: [&[f32]; 4], out: &mut [f32]) -> ();
    horizontal_min(xs: &[f32], out: &mut [f32]) -> ();
}

/// The vector at `i` of a vector stored by component.
#[inline(always)]
fn load<V: SimdF32>(s: V::Simd, [x, y, z]: [&[f32]; 3], i: usize) -> Vec3<V> {
    Vec3::new(V::load(s, &x[i..]), V::load(s, &y[i..]), V::load(s, &z[i..]))
}

/// The dot product of each pair.
#[inline(always)]
fn dot<V: SimdF32>(s: V::Simd, a: [&[f32]; 3], b: [&[f32]; 3], out: &mut [f32]) {
    for (i, out) in out.chunks_exact_mut(V::LANES).enumerate() {
        let at = i * V::LANES;
        load::<V>(s, a, at).dot(load(s, b, at)).store(out);
    }
}

/// Where a ray enters each box, infinite where it does not; how many it enters.
#[inline(always)]
fn slab<V: SimdF32>(
    s: V::Simd,
    bounds: [&[f32]; 6],
    origin: [f32; 3],
    inverse: [f32; 3],
    entry: &mut [f32],
) -> u32 {
    let (origin, inverse) = (Vec3::<V>::splat(s, origin), Vec3::<V>::splat(s, inverse));
    let [x0, y0, z0, x1, y1, z1] = bounds;
    let mut hits = 0;
    for (i, entry) in entry.chunks_exact_mut(V::LANES).enumerate() {
        let at = i * V::LANES;
        let low = load::<V>(s, [x0, y0, z0], at) - origin;
        let high = load::<V>(s, [x1, y1, z1], at) - origin;
        let (x0, x1) = (low.x * inverse.x, high.x * inverse.x);
        let (y0, y1) = (low.y * inverse.y, high.y * inverse.y);
        let (z0, z1) = (low.z * inverse.z, high.z * inverse.z);
        let near = x0.min(x1).max(y0.min(y1)).max(z0.min(z1)).max(V::splat(s, 0.0));
        let far = x0.max(x1).min(y0.max(y1)).min(z0.max(z1));
        let hit = near.le(far);
        hits += hit.count();
        V::select(hit, near, V::splat(s, f32::INFINITY)).store(entry);
    }
    hits
}

/// The triangle that a ray hits first, and where: a vertex and two edges each.
#[inline(always)]
fn moller_trumbore<V: SimdF32>(
    s: V::Simd,
    triangles: [&[f32]; 9],
    origin: [f32; 3],
    direction: [f32; 3],
) -> Option<(usize, f32)> {
    let (origin, direction) = (Vec3::<V>::splat(s, origin), Vec3::<V>::splat(s, direction));
    let [vx, vy, vz, ax, ay, az, bx, by, bz] = triangles;
    let (zero, one) = (V::splat(s, 0.0), V::splat(s, 1.0));
    let mut nearest = None;
    let mut limit = f32::INFINITY;
    let mut at = 0;
    while at + V::LANES <= vx.len() {
        let a = load::<V>(s, [ax, ay, az], at);
        let b = load::<V>(s, [bx, by, bz], at);
        let to_origin = origin - load(s, [vx, vy, vz], at);
        let p = direction.cross(b);
        let inverse = one / a.dot(p);
        let u = to_origin.dot(p) * inverse;
        let q = to_origin.cross(a);
        let v = direction.dot(q) * inverse;
        let t = b.dot(q) * inverse;
        let inside = u.ge(zero) & v.ge(zero) & (u + v).le(one);
        let hit = inside & t.gt(zero) & t.lt(V::splat(s, limit));
        if let Some((lane, t)) = t.argmin(hit) {
            limit = t;
            nearest = Some((at + lane, t));
        }
        at += V::LANES;
    }
    nearest
}

/// The least of all, and where it is.
#[inline(always)]
fn argmin<V: SimdF32>(s: V::Simd, xs: &[f32]) -> Option<(usize, f32)> {
    let mut least = V::splat(s, f32::INFINITY);
    let mut chunk = V::U32::splat(s, 0);
    for (i, xs) in xs.chunks_exact(V::LANES).enumerate() {
        let x = V::load(s, xs);
        let less = x.lt(least);
        least = V::select(less, x, least);
        chunk = V::U32::select(less, V::U32::splat(s, i as u32), chunk);
    }
    let (lane, x) = least.argmin(least.eq(least))?;
    Some((chunk.lane(lane) as usize * V::LANES + lane, x))
}

/// Vectors to their direction.
#[inline(always)]
fn normalize<V: SimdF32>(s: V::Simd, x: &mut [f32], y: &mut [f32], z: &mut [f32]) {
    let chunks = x.chunks_exact_mut(V::LANES).zip(y.chunks_exact_mut(V::LANES));
    for ((x, y), z) in chunks.zip(z.chunks_exact_mut(V::LANES)) {
        let v = load::<V>(s, [x, y, z], 0);
        let unit = v * v.dot(v).rsqrt_fast();
        unit.x.store(x);
        unit.y.store(y);
        unit.z.store(z);
    }
}

/// The integer below.
#[inline(always)]
fn floor_to_int<V: SimdF32>(s: V::Simd, xs: &[f32], out: &mut [i32]) {
    for (x, out) in xs.chunks_exact(V::LANES).zip(out.chunks_exact_mut(V::LANES)) {
        V::load(s, x).floor_to_i32_fast().store(out);
    }
}

/// Four components of their own to one after the other.
#[inline(always)]
fn transpose<V: SimdF32>(s: V::Simd, [a, b, c, d]: [&[f32]; 4], out: &mut [f32]) {
    for (i, out) in out.chunks_exact_mut(4 * V::LANES).enumerate() {
        let at = i * V::LANES;
        let (even, odd) = (load_pair::<V>(s, a, c, at), load_pair::<V>(s, b, d, at));
        let (low, high) = (even.0.zip(odd.0), even.1.zip(odd.1));
        let (first, second) = out.split_at_mut(2 * V::LANES);
        low.0.store(first);
        low.1.store(&mut first[V::LANES..]);
        high.0.store(second);
        high.1.store(&mut second[V::LANES..]);
    }
}

/// The elements of two streams in turn.
#[inline(always)]
fn load_pair<V: SimdF32>(s: V::Simd, a: &[f32], b: &[f32], i: usize) -> (V, V) {
    V::load(s, &a[i..]).zip(V::load(s, &b[i..]))
}

/// The least of each chunk.
#[inline(always)]
fn horizontal_min<V: SimdF32>(s: V::Simd, xs: &[f32], out: &mut [f32]) {
    for (xs, least) in xs.chunks_exact(V::LANES).zip(out) {
        *least = V::load(s, xs).reduce_min();
    }
}
