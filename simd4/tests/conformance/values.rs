//! Operands: those at which arithmetic changes its behaviour, and random ones.

use proptest::prelude::*;

/// About 300 floats: zeros, the ends of the subnormals and of all binades that matter to some
/// operation with their neighbours, halves, limits, infinities and NaNs; of both signs.
pub(crate) fn floats() -> Vec<f32> {
    let exponents = [
        -149, -148, -127, -126, -125, -100, -64, -25, -24, -23, -12, -2, -1, 0, 1, 2, 3, 15, 16,
        21, 22, 23, 24, 25, 30, 31, 32, 33, 62, 63, 64, 100, 126, 127,
    ];
    let powers = exponents.into_iter().flat_map(|e| {
        let bits = if e < -126 { 1 << (e + 149) } else { ((e + 127) as u32) << 23 };
        [bits - 1, bits, bits + 1]
    });
    let halves =
        [1.5f32, 2.5, 3.5, 4.5, 5.5, 3.0, 1e-20, 1e20, 1.0 / 3.0, 0.1, 8388607.5, 4194304.5];
    let ends = [f32::MAX, f32::INFINITY, f32::from_bits(0x0040_0000), 2147483500.0, 4294967000.0];
    // Quiet, signalling, and one with a payload.
    let nans = [0x7fc0_0000, 0x7f80_0001, 0x7fd2_3456];
    let positive = powers.chain(halves.map(f32::to_bits)).chain(ends.map(f32::to_bits)).chain(nans);
    let both = positive.flat_map(|bits| [bits, bits | 1 << 31]).map(f32::from_bits);
    both.step_by(if cfg!(miri) { 29 } else { 1 }).collect()
}

/// Every fifth of them, for operations of three operands.
pub(crate) fn fewer_floats() -> Vec<f32> {
    let step = if cfg!(miri) { 50 } else { 5 };
    let mut fewer: Vec<f32> = floats().into_iter().step_by(step).collect();
    fewer.extend([0.0, -0.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN]);
    fewer
}

/// Values at which integers change their behaviour.
pub(crate) fn ints() -> Vec<u32> {
    let ends = (0..32).flat_map(|bit| [1u32 << bit, (1 << bit) - 1, 1 << bit | 1]);
    let all = ends.flat_map(|x| [x, !x, x.wrapping_neg()]);
    all.step_by(if cfg!(miri) { 37 } else { 1 }).collect()
}

/// All pairs of two of them.
pub(crate) fn pairs<T: Copy>(values: &[T]) -> Vec<[T; 2]> {
    values.iter().flat_map(|&a| values.iter().map(move |&b| [a, b])).collect()
}

/// All triples of three of them, one after the other: of the full set there are too many to keep.
pub(crate) fn triples<T: Copy>(values: &[T]) -> impl Iterator<Item = [T; 3]> {
    values.iter().flat_map(move |&a| {
        values.iter().flat_map(move |&b| values.iter().map(move |&c| [a, b, c]))
    })
}

/// Bits of all kinds: uniform ones are rarely near each other, and seldom small.
pub(crate) fn word() -> impl Strategy<Value = u32> {
    let small = -1000i32..1000;
    prop_oneof![
        any::<u32>(),
        any::<f32>().prop_map(f32::to_bits),
        small.clone().prop_map(|i| (i as f32 / 8.0).to_bits()),
        small.prop_map(|i| i as u32),
    ]
}
