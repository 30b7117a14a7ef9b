//! A kernel that has fallen into the pit, for the gate to find: it stays here so that the gate
//! stays one.

use simd4::prelude::*;
use simd4::{Level, dispatch};

/// Sums a polynomial of two streams.
pub fn fallen(level: Level, xs: &[f32], ys: &[f32]) -> f32 {
    dispatch!(level, s => kernel(s, xs, ys))
}

#[inline(always)]
fn kernel<S: Simd>(s: S, xs: &[f32], ys: &[f32]) -> f32 {
    // The fault: no attribute. As it is called twice it is a function of its own, and as that
    // compiled for the baseline.
    let polynomial = |x: S::f32s| {
        let mut sum = x;
        for i in 0..16 {
            sum = sum * x + S::f32s::splat(s, i as f32);
        }
        sum.sqrt()
    };
    let mut sum = S::f32s::splat(s, 0.0);
    for (x, y) in xs.chunks_exact(S::LANES).zip(ys.chunks_exact(S::LANES)) {
        sum += polynomial(S::f32s::load(s, x));
        sum += polynomial(S::f32s::load(s, y));
    }
    sum.reduce_sum()
}
