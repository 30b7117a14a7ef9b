//! The special cases of IEEE 754 and C99 Annex F, each with the result that it must have, and the
//! exact results that the definitions promise.

use simd4::spec::{exp2, log2, pow};

use crate::numbers::same;

const INF: f32 = f32::INFINITY;
const NAN: f32 = f32::NAN;
const MAX: f32 = f32::MAX;
/// The least normal number.
const NORMAL: f32 = f32::MIN_POSITIVE;
/// The least subnormal number, 2^-149.
const LEAST: f32 = f32::from_bits(1);
/// The greatest subnormal number.
const SUBNORMAL: f32 = f32::from_bits(0x007f_ffff);
/// The neighbours of 1.
const BELOW_1: f32 = f32::from_bits(0x3f7f_ffff);
const ABOVE_1: f32 = f32::from_bits(0x3f80_0001);
/// The greatest odd integer and the least integer from which all floats are even.
const ODD: f32 = 16_777_215.0;
const EVEN: f32 = 16_777_216.0;

/// 2ⁿ, subnormal or normal.
fn two(n: i32) -> f32 {
    f32::from_bits(if n < -126 { 1 << (n + 149) } else { ((n + 127) as u32) << 23 })
}

fn one_argument(name: &str, f: impl Fn(f32) -> f32, cases: &[(f32, f32)]) {
    for &(x, want) in cases {
        let got = f(x);
        assert!(same(got, want), "{name}({x:e}) = {got:e}, not {want:e}");
    }
}

fn powers(cases: &[(f32, f32, f32)]) {
    for &(x, y, want) in cases {
        let got = pow(x, y);
        assert!(same(got, want), "pow({x:e}, {y:e}) = {got:e}, not {want:e}");
    }
}

#[test]
fn exp2_special_cases() {
    let cases = [
        (0.0, 1.0),
        (-0.0, 1.0),
        (INF, INF),
        (-INF, 0.0),
        (NAN, NAN),
        (-NAN, NAN),
        (f32::from_bits(0x7f80_0001), NAN),
        (f32::from_bits(0xffff_ffff), NAN),
        (LEAST, 1.0),
        (-LEAST, 1.0),
        (NORMAL, 1.0),
        (1.0, 2.0),
        (-1.0, 0.5),
        (127.0, two(127)),
        (128.0, INF),
        (129.0, INF),
        (1e10, INF),
        (MAX, INF),
        (-126.0, NORMAL),
        (-127.0, two(-127)),
        (-148.0, two(-148)),
        (-149.0, LEAST),
        // Between 0 and the least subnormal the nearer one, the even one from the middle.
        (f32::from_bits(0xc315_ffff), LEAST),
        (-150.0, 0.0),
        (f32::from_bits(0xc316_0001), 0.0),
        (-151.0, 0.0),
        (-152.0, 0.0),
        (-1e10, 0.0),
        (-MAX, 0.0),
    ];
    one_argument("exp2", exp2, &cases);
}

#[test]
fn exp2_of_an_integer_is_exact() {
    for n in -149..=127 {
        one_argument("exp2", exp2, &[(n as f32, two(n))]);
    }
}

#[test]
fn log2_special_cases() {
    let cases = [
        (1.0, 0.0),
        (0.0, -INF),
        (-0.0, -INF),
        (INF, INF),
        (-INF, NAN),
        (NAN, NAN),
        (-NAN, NAN),
        (f32::from_bits(0x7f80_0001), NAN),
        (f32::from_bits(0xffff_ffff), NAN),
        (-1.0, NAN),
        (-LEAST, NAN),
        (-SUBNORMAL, NAN),
        (-NORMAL, NAN),
        (-MAX, NAN),
        (2.0, 1.0),
        (0.5, -1.0),
        (LEAST, -149.0),
        (NORMAL, -126.0),
    ];
    one_argument("log2", log2, &cases);
}

#[test]
fn log2_of_a_power_of_two_is_exact() {
    for n in -149..=127 {
        one_argument("log2", log2, &[(two(n), n as f32)]);
    }
}

#[test]
fn pow_to_zero_and_of_one_is_one() {
    let all = [0.0, LEAST, SUBNORMAL, NORMAL, 0.5, BELOW_1, 1.0, ABOVE_1, 2.5, 3.0, MAX, INF, NAN];
    for v in all.into_iter().flat_map(|v| [v, -v]) {
        powers(&[(v, 0.0, 1.0), (v, -0.0, 1.0), (1.0, v, 1.0)]);
    }
}

#[test]
fn pow_of_nan_or_to_nan_is_nan() {
    for v in [0.0, LEAST, 0.5, 1.5, 2.0, 3.0, MAX, INF] {
        powers(&[(v, NAN, NAN), (-v, NAN, NAN), (-v, -NAN, NAN)]);
        if v != 0.0 {
            powers(&[(NAN, v, NAN), (NAN, -v, NAN), (-NAN, v, NAN)]);
        }
    }
    powers(&[(NAN, NAN, NAN), (-1.0, NAN, NAN), (NAN, 1.0, NAN), (NAN, 2.0, NAN)]);
}

#[test]
fn pow_to_infinity() {
    for small in [0.0, LEAST, NORMAL, 0.5, BELOW_1] {
        powers(&[(small, INF, 0.0), (-small, INF, 0.0)]);
        powers(&[(small, -INF, INF), (-small, -INF, INF)]);
    }
    for large in [ABOVE_1, 2.0, 3.0, MAX, INF] {
        powers(&[(large, INF, INF), (-large, INF, INF)]);
        powers(&[(large, -INF, 0.0), (-large, -INF, 0.0)]);
    }
    powers(&[(-1.0, INF, 1.0), (-1.0, -INF, 1.0), (1.0, INF, 1.0), (1.0, -INF, 1.0)]);
}

#[test]
fn pow_of_zero() {
    for odd in [1.0, 3.0, 5.0, 8_388_607.0, 8_388_609.0, ODD] {
        powers(&[(0.0, odd, 0.0), (-0.0, odd, -0.0)]);
        powers(&[(0.0, -odd, INF), (-0.0, -odd, -INF)]);
    }
    for other in [LEAST, NORMAL, 0.3, 0.5, 1.5, 2.0, 4.0, 8_388_608.0, EVEN, 1e30, MAX, INF] {
        powers(&[(0.0, other, 0.0), (-0.0, other, 0.0)]);
        powers(&[(0.0, -other, INF), (-0.0, -other, INF)]);
    }
}

#[test]
fn pow_of_infinity() {
    for odd in [1.0, 3.0, 5.0, 8_388_607.0, 8_388_609.0, ODD] {
        powers(&[(INF, odd, INF), (-INF, odd, -INF)]);
        powers(&[(INF, -odd, 0.0), (-INF, -odd, -0.0)]);
    }
    for other in [LEAST, NORMAL, 0.3, 0.5, 1.5, 2.0, 4.0, 8_388_608.0, EVEN, 1e30, MAX] {
        powers(&[(INF, other, INF), (-INF, other, INF)]);
        powers(&[(INF, -other, 0.0), (-INF, -other, 0.0)]);
    }
}

#[test]
fn pow_of_a_negative_base() {
    powers(&[
        (-1.0, 1.0, -1.0),
        (-1.0, 2.0, 1.0),
        (-1.0, -3.0, -1.0),
        (-1.0, 4_194_305.0, -1.0),
        (-1.0, 8_388_607.0, -1.0),
        (-1.0, 8_388_608.0, 1.0),
        (-1.0, 8_388_609.0, -1.0),
        (-1.0, ODD, -1.0),
        (-1.0, -ODD, -1.0),
        (-1.0, EVEN, 1.0),
        (-1.0, 16_777_218.0, 1.0),
        (-1.0, 1e20, 1.0),
        (-1.0, MAX, 1.0),
        (-1.0, -MAX, 1.0),
        (-2.0, 3.0, -8.0),
        (-2.0, 10.0, 1024.0),
        (-2.0, -1.0, -0.5),
        (-2.0, -149.0, -LEAST),
        (-2.0, -148.0, f32::from_bits(2)),
        (-LEAST, 1.0, -LEAST),
        (-LEAST, -1.0, -INF),
        (-LEAST, 2.0, 0.0),
        (-LEAST, 3.0, -0.0),
        // Too large and too small, with the sign of the parity.
        (-2.0, 128.0, INF),
        (-2.0, 129.0, -INF),
        (-2.0, -151.0, -0.0),
        (-2.0, -152.0, 0.0),
        (-2.0, ODD, -INF),
        (-2.0, -ODD, -0.0),
        (-2.0, EVEN, INF),
        (-0.5, ODD, -0.0),
        (-MAX, MAX, INF),
        (-MAX, -MAX, 0.0),
    ]);
    for fraction in [LEAST, SUBNORMAL, NORMAL, 1e-10, 0.3, 0.5, BELOW_1, ABOVE_1, 1.5, 2.5] {
        for x in [LEAST, NORMAL, 0.5, 1.0, 2.0, MAX] {
            powers(&[(-x, fraction, NAN), (-x, -fraction, NAN)]);
        }
    }
    for half in [4_194_303.5, 4_194_304.5, 8_388_606.5, 8_388_607.5] {
        powers(&[(-1.0, half, NAN), (-1.0, -half, NAN), (-2.0, half, NAN)]);
    }
}

#[test]
fn pow_of_a_power_of_two_is_exact() {
    powers(&[
        (4.0, 0.5, 2.0),
        (4.0, -0.5, 0.5),
        (0.25, 1.5, 0.125),
        (8.0, 41.0, two(123)),
        (2.0, 127.0, two(127)),
        (2.0, -126.0, NORMAL),
        (2.0, -127.0, two(-127)),
        (2.0, -149.0, LEAST),
        (2.0, -150.0, 0.0),
        (0.5, 149.0, LEAST),
        (two(127), -1.0, two(-127)),
        (two(-127), -1.0, two(127)),
        (LEAST, 1.0, LEAST),
        (two(-148), 0.5, two(-74)),
        (two(-148), -0.25, two(37)),
        (two(-148), -0.75, two(111)),
    ]);
}

#[test]
fn pow_overflows_and_vanishes() {
    powers(&[
        (2.0, 128.0, INF),
        (2.0, 1e10, INF),
        (2.0, MAX, INF),
        (2.0, -1e10, 0.0),
        (2.0, -MAX, 0.0),
        (0.5, 151.0, 0.0),
        (0.5, -128.0, INF),
        (MAX, 2.0, INF),
        (MAX, MAX, INF),
        (MAX, -MAX, 0.0),
        (LEAST, MAX, 0.0),
        (LEAST, -MAX, INF),
        (LEAST, 2.0, 0.0),
        (NORMAL, -1.1, INF),
        (10.0, 39.0, INF),
        (10.0, -46.0, 0.0),
        // Next to 1 only huge exponents leave the range.
        (ABOVE_1, MAX, INF),
        (ABOVE_1, -MAX, 0.0),
        (BELOW_1, MAX, 0.0),
        (BELOW_1, -MAX, INF),
        (ABOVE_1, 1e9, INF),
        (BELOW_1, 2e9, 0.0),
        (ABOVE_1, LEAST, 1.0),
        (BELOW_1, LEAST, 1.0),
        (MAX, LEAST, 1.0),
        (LEAST, LEAST, 1.0),
        (LEAST, -NORMAL, 1.0),
    ]);
}

/// Against `f64`, sparsely: the bounds that the definitions state.
#[test]
fn errors_are_within_the_stated_bounds() {
    fn check(name: &str, got: f32, real: f64, bound: f64) {
        let exponent = ((real.to_bits() >> 52 & 0x7ff) as i32 - 1023).max(-126);
        let ulp = 2f64.powi(exponent - 23);
        let error = (f64::from(got) - real).abs() / ulp;
        assert!(error <= bound, "{name}: {got:e}, not {real:e}, {error} ulp");
    }
    let in_range = |v: f64| v.abs() < f64::from(MAX);
    let edges =
        [1, 3, 0x007f_ffff, 0x0080_0000, 0x3f7f_ffff, 0x3f80_0001, 0x42ff_ffff, 0x7f7f_ffff];
    for bits in
        (1..0x7f80_0000u32).step_by(if cfg!(miri) { 40_009_001 } else { 40_009 }).chain(edges)
    {
        let x = f32::from_bits(bits);
        if x != 1.0 {
            check(&format!("log2({x:e})"), log2(x), f64::from(x).log2(), 2.17);
        }
        for x in [x, -x] {
            let real = f64::from(x).exp2();
            if in_range(real) {
                check(&format!("exp2({x:e})"), exp2(x), real, 1.11);
            }
        }
        for y in [-40.0, -2.4, -1.0, 1.0 / 3.0, 0.5, 1.0 / 2.4, 1.0, 2.0, 2.2, 3.0, 17.5, 300.0] {
            let real = f64::from(x).powf(f64::from(y));
            if in_range(real) {
                check(&format!("pow({x:e}, {y:e})"), pow(x, y), real, 2.5);
            }
        }
    }
}
