//! A user's crate: no unsafe code, and still every level.

#![forbid(unsafe_code)]

use simd4::prelude::*;
use simd4::{AlignedBuf, Block8, check, dispatch, math, swizzle};

/// The product of each row with a vector, rows padded to eight.
#[inline(always)]
fn rows<S: Simd>(s: S, rows: &[Block8<f32>], by: &Block8<f32>) -> Vec<f32> {
    let by = S::f32x8::load_aligned(s, by);
    let mut products = Vec::with_capacity(rows.len());
    for row in rows {
        products.push((S::f32x8::load_aligned(s, row) * by).reduce_sum());
    }
    products
}

/// All that is not exact left out, a kernel of many kinds of operations.
#[inline(always)]
fn mixed<S: Simd>(s: S, xs: &[f32], out: &mut [f32]) -> (u32, usize) {
    let (mut bits, mut kept) = (0, 0);
    for chunk in xs.chunks_exact(4) {
        let x = S::f32x4::load(s, chunk);
        let [a, b, c, d] = math::transpose([x, x.floor(), x.fused_mul_add(x, x), x.reverse()]);
        let sum = (a + b) * (c - d) + swizzle!(x, [1, 0, 3, 2]);
        let small = sum.abs().lt(S::f32x4::splat(s, 50.0));
        kept += sum.compress_store(small, &mut out[kept..]);
        bits ^= (sum.to_bits() ^ x.to_i32().to_u32().shl(3)).reduce_max();
    }
    (bits, kept)
}

#[test]
fn a_kernel_is_written_dispatched_and_the_same_on_every_level() {
    let matrix: Vec<Block8<f32>> = (0..9)
        .map(|i| Block8([0, 1, 2, 3, 4, 5, 6, 7].map(|j| 1.0 / (i * 8 + j + 1) as f32)))
        .collect();
    let by = Block8([0.1, 0.7, -0.3, 1e-8, 3.0, -2.5, 0.9, 1.1]);
    check::levels_agree(|level| dispatch!(level, s => rows(s, &matrix, &by)));

    let xs: AlignedBuf<f32> = (0..400).map(|i| (i as f32 - 200.0) * 0.37).collect();
    check::levels_agree(|level| {
        let mut out = vec![0.0; 400];
        let counts = dispatch!(level, s => mixed(s, &xs, &mut out));
        (out, counts)
    });
}

/// The best level that the build guarantees.
fn guaranteed() -> Level {
    fn of<V: SimdF32<Simd: Guaranteed>>() -> Level {
        V::Simd::TOKEN.level()
    }
    of::<simd4::f32x4>()
}

#[test]
fn a_build_has_the_definition_and_nothing_else_below_what_it_guarantees() {
    let scalar = simd4::Scalar::new().level();
    let mut levels = Level::available();
    assert_eq!(levels.next(), Some(scalar));
    if guaranteed() != scalar {
        assert_eq!(levels.next(), Some(guaranteed()));
    }
}

/// A token is good for its own level, whatever the build leaves out.
#[test]
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fn what_is_left_out_runs_as_what_the_build_guarantees() {
    let Some(token) = simd4::Sse2::detect() else { return };
    assert_eq!(rows(token, &[Block8([1.0; 8])], &Block8([2.0; 8])), [16.0]);
    let ran = dispatch!(token.level(), s => s.level());
    if Level::available().any(|level| level == token.level()) {
        assert_eq!(ran, token.level());
        return;
    }
    assert_eq!((ran, token.level().lanes()), (guaranteed(), guaranteed().lanes()));
    let error = Level::named("sse2").expect_err("it is left out").to_string();
    let better = guaranteed();
    let lead =
        format!("this build, for CPUs with {better}, leaves out sse2; there are scalar, {better}");
    assert!(error.starts_with(&lead), "{error}");
}

#[test]
fn blocks_are_plain_memory() {
    assert_eq!(size_of::<[Block8<f32>; 3]>(), 96);
    assert_eq!((align_of::<Block8<u32>>(), align_of::<simd4::Block16<i32>>()), (32, 64));
    let s = simd4::Scalar::new();
    let mut block = simd4::Block4([1, 2, 3, 4]);
    let v = simd4::scalar::i32x4::load_aligned(s, &block);
    (v + v).store_aligned(&mut block);
    assert_eq!(block, simd4::Block4([2, 4, 6, 8]));
}
