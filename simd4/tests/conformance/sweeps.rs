//! Operations of one operand over every input, or a stride of them, in inlined code as users have
//! it; and the bounds of those that are not exact.

use simd4::prelude::*;
use simd4::{LaneArray, spec};

use crate::numbers::same;

/// A native machine tries all of what an emulator tries a part of, and an interpreter a few.
pub(crate) fn stride() -> u32 {
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok());
    match cases.unwrap_or(256) {
        _ if cfg!(miri) => 60_013,
        ..256 => 61,
        256.. => 1,
    }
}

/// Calls `check` with vectors of bits from `range`, every `step`th.
#[inline(always)]
fn sweep<U: SimdU32>(
    s: U::Simd,
    range: core::ops::RangeInclusive<u32>,
    step: u32,
    mut check: impl FnMut(U),
) {
    let (mut at, end) = (u64::from(*range.start()), u64::from(*range.end()));
    while at <= end {
        // What lies beyond the end wraps round: inputs like any others.
        check(U::from_array(
            s,
            LaneArray::from_fn(
                #[inline(always)]
                |i| (at + i as u64 * u64::from(step)) as u32,
            ),
        ));
        at += U::LANES as u64 * u64::from(step);
    }
}

/// One operation against its model.
#[inline(always)]
fn exact<V: SimdF32>(
    s: V::Simd,
    step: u32,
    name: &str,
    op: impl Fn(V) -> V,
    model: impl Fn(f32) -> f32,
) {
    sweep::<V::U32>(
        s,
        0..=u32::MAX,
        step,
        #[inline(always)]
        |bits| {
            let x = V::from_bits(bits);
            let (x, got) = (x.to_array(), op(x).to_array());
            for (&x, &got) in x.as_ref().iter().zip(got.as_ref()) {
                let want = model(x);
                assert!(same(got, want), "{name}({x:e}) = {got:e}, not {want:e}");
            }
        },
    );
}

/// All operations of one operand on every `step`th input.
#[inline(always)]
pub(crate) fn one_operand<V: SimdF32>(s: V::Simd, step: u32) {
    exact::<V>(
        s,
        step,
        "neg",
        #[inline(always)]
        |x| -x,
        |x| -x,
    );
    exact::<V>(s, step, "abs", V::abs, spec::abs);
    exact::<V>(s, step, "sqrt", V::sqrt, spec::sqrt);
    exact::<V>(s, step, "floor", V::floor, spec::floor);
    exact::<V>(s, step, "ceil", V::ceil, spec::ceil);
    exact::<V>(s, step, "trunc", V::trunc, spec::trunc);
    exact::<V>(s, step, "round_ties_even", V::round_ties_even, spec::round_ties_even);
    exact::<V>(s, step, "exp2", V::exp2, spec::exp2);
    exact::<V>(s, step, "log2", V::log2, spec::log2);
    sweep::<V::U32>(
        s,
        0..=u32::MAX,
        step,
        #[inline(always)]
        |bits| {
            let x = V::from_bits(bits);
            let (i32s, u32s) = (x.to_i32().to_array(), x.to_u32().to_array());
            let from_u32 = V::from_u32(bits).to_array();
            let from_i32 = V::from_i32(V::I32::from_u32(bits)).to_array();
            let bits = bits.to_array();
            for (i, &bits) in bits.as_ref().iter().enumerate() {
                let x = f32::from_bits(bits);
                assert_eq!(i32s.as_ref()[i], x as i32, "{x:e} as i32");
                assert_eq!(u32s.as_ref()[i], x as u32, "{x:e} as u32");
                assert_eq!(
                    from_u32.as_ref()[i].to_bits(),
                    (bits as f32).to_bits(),
                    "{bits} as f32"
                );
                let i = (bits as i32, from_i32.as_ref()[i]);
                assert_eq!(i.1.to_bits(), (i.0 as f32).to_bits(), "{} as f32", i.0);
            }
        },
    );
}

/// The greatest relative error of a reciprocal or a reciprocal square root over a range of bits,
/// as the distance of `got * divisor` from 1.
#[inline(always)]
fn error<V: SimdF32>(
    s: V::Simd,
    range: core::ops::RangeInclusive<u32>,
    step: u32,
    op: impl Fn(V) -> V,
    divisor: impl Fn(f64) -> f64,
) -> f64 {
    let mut worst = 0.0f64;
    sweep::<V::U32>(
        s,
        range.clone(),
        step,
        #[inline(always)]
        |bits| {
            let x = V::from_bits(bits);
            let (x, got) = (x.to_array(), op(x).to_array());
            for (&x, &got) in x.as_ref().iter().zip(got.as_ref()) {
                if range.contains(&x.to_bits()) {
                    // Written so that a NaN is the worst of all.
                    let off = (f64::from(got) * divisor(f64::from(x)) - 1.0).abs();
                    worst = if off <= worst { worst } else { off };
                }
            }
        },
    );
    worst
}

/// The estimates' bounds: all values of two binades, and a sample of all normal ones whose
/// reciprocal is above the least normal number.
#[inline(always)]
pub(crate) fn estimates<V: SimdF32>(s: V::Simd, step: u32) {
    let (one, four) = (1f32.to_bits(), 4f32.to_bits());
    let (least, greatest) = (f32::MIN_POSITIVE.to_bits(), 2f32.powi(126).to_bits() - 1);
    for (range, step) in [(one..=four, step), (least..=greatest, 997 * step)] {
        let cases = [
            ("rcp_est", error::<V>(s, range.clone(), step, V::rcp_est, |x| x), 11),
            ("rcp_fast", error::<V>(s, range.clone(), step, V::rcp_fast, |x| x), 21),
            ("rsqrt_est", error::<V>(s, range.clone(), step, V::rsqrt_est, f64::sqrt), 11),
            ("rsqrt_fast", error::<V>(s, range.clone(), step, V::rsqrt_fast, f64::sqrt), 21),
        ];
        for (name, error, bound) in cases {
            assert!(
                error <= 2f64.powi(-bound),
                "{name}: error 2^{:.2} in {range:x?}",
                error.log2()
            );
        }
    }
}

/// What the estimates make of the values that have no reciprocal, or none that is normal.
pub(crate) fn rails<V: SimdF32>(s: V::Simd) {
    let inf = f32::INFINITY;
    let of = |op: fn(V) -> V, x: f32| op(V::splat(s, x)).lane(0);
    let is = |got: f32, want: f32| same(got, want);
    for (name, rcp) in [("rcp_est", V::rcp_est as fn(V) -> V), ("rcp_fast", V::rcp_fast)] {
        for (x, want) in [(0.0, inf), (-0.0, -inf), (inf, 0.0), (-inf, -0.0), (f32::NAN, f32::NAN)]
        {
            assert!(is(of(rcp, x), want), "{name}({x}) = {}", of(rcp, x));
        }
        // Each sign by itself: an estimate need not be odd to the last bit.
        let near = |x: f32, got: f32| (f64::from(got) * f64::from(x) - 1.0).abs() < 2f64.powi(-11);
        for x in [1, 0x1f_ffff, 0x20_0001, 0x7f_ffff].map(f32::from_bits) {
            for x in [x, -x] {
                let got = of(rcp, x);
                assert!(got == inf.copysign(x) || near(x, got), "{name}({x:e}) = {got:e}");
            }
        }
        for x in [2f32.powi(126), 2f32.powi(126) * 1.01, 2f32.powi(127), f32::MAX] {
            for x in [x, -x] {
                let got = of(rcp, x);
                let zero = same(got, 0f32.copysign(x));
                assert!(zero || near(x, got), "{name}({x:e}) = {got:e}");
            }
        }
    }
    for (name, rsqrt) in [("rsqrt_est", V::rsqrt_est as fn(V) -> V), ("rsqrt_fast", V::rsqrt_fast)]
    {
        let nan = f32::NAN;
        for (x, want) in
            [(0.0, inf), (-0.0, -inf), (inf, 0.0), (-inf, nan), (-1.0, nan), (nan, nan)]
        {
            assert!(is(of(rsqrt, x), want), "{name}({x}) = {}", of(rsqrt, x));
        }
        for x in [1, 0x1f_ffff, 0x7f_ffff].map(f32::from_bits) {
            let got = of(rsqrt, x);
            let near = (f64::from(got) * f64::from(x).sqrt() - 1.0).abs() < 2f64.powi(-11);
            assert!(got == inf || near, "{name}({x:e}) = {got:e}");
            let of_negative = of(rsqrt, -x);
            assert!(of_negative.is_nan() || of_negative == -inf, "{name}(-{x:e}) = {of_negative}");
        }
        for x in [2f32.powi(126), f32::MAX] {
            let near = f64::from(of(rsqrt, x)) * f64::from(x).sqrt() - 1.0;
            assert!(near.abs() < 2f64.powi(-11), "{name}({x:e})");
        }
    }
}
