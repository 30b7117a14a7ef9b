//! A kernel that has fallen into the pit, for the gate to find: it stays here so that the gate
//! stays one.

use simd4::prelude::*;
use simd4::{Level, dispatch};

/// The sum of the sines of two streams.
pub fn fallen(level: Level, xs: &[f32], ys: &[f32]) -> f32 {
    dispatch!(level, s => kernel(s, xs, ys))
}

#[inline(always)]
fn kernel<S: Simd>(s: S, xs: &[f32], ys: &[f32]) -> f32 {
    // The fault: no attribute. It is called twice and too long to be inlined twice, so it is a
    // function of its own, and as that compiled for the baseline.
    let sine = |x: S::f32s| {
        let turn = S::f32s::splat(s, std::f32::consts::TAU);
        let x = x - (x / turn).round_ties_even() * turn;
        let square = x * x;
        let [c3, c5, c7, c9, c11] =
            [-1.0 / 6.0, 8.333_333e-3, -1.984_127e-4, 2.755_732e-6, -2.505_211e-8]
                .map(|c| S::f32s::splat(s, c));
        x + x * square * (c3 + square * (c5 + square * (c7 + square * (c9 + square * c11))))
    };
    let mut sum = S::f32s::splat(s, 0.0);
    for (x, y) in xs.chunks_exact(S::LANES).zip(ys.chunks_exact(S::LANES)) {
        sum += sine(S::f32s::load(s, x));
        sum += sine(S::f32s::load(s, y));
    }
    sum.reduce_sum()
}
