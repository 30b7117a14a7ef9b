//! The definition itself, against what others say: the standard library, and tables by hand.

use std::cell::RefCell;

use simd4::spec;

use crate::numbers::same;
use crate::values;

fn agrees(name: &str, ours: fn(f32) -> f32, theirs: fn(f32) -> f32) {
    let step = if cfg!(miri) { 9_973_001 } else { 9973 };
    let strided = (0..=u32::MAX).step_by(step).map(f32::from_bits);
    for x in strided.chain(values::floats()) {
        assert!(same(ours(x), theirs(x)), "{name}({x:e}) = {:e}, not {:e}", ours(x), theirs(x));
    }
}

#[test]
fn one_operand_as_the_standard_library() {
    agrees("sqrt", spec::sqrt, f32::sqrt);
    agrees("abs", spec::abs, f32::abs);
    agrees("floor", spec::floor, f32::floor);
    agrees("ceil", spec::ceil, f32::ceil);
    agrees("trunc", spec::trunc, f32::trunc);
    agrees("round_ties_even", spec::round_ties_even, f32::round_ties_even);
}

#[test]
fn fused_as_the_standard_library() {
    let check = |[a, b, c]: [f32; 3]| {
        let (ours, theirs) = (spec::fused_mul_add(a, b, c), a.mul_add(b, c));
        assert!(same(ours, theirs), "{a:e} * {b:e} + {c:e} = {ours:e}, not {theirs:e}");
    };
    values::triples(&values::fewer_floats()).for_each(check);
    // Sums near a tie of f32, where rounding twice errs: 1 + 2^-24 and a trace more or less.
    let e = f32::EPSILON;
    for trace in [0.0, 1e-30, -1e-30, f32::from_bits(1), -f32::from_bits(1), e * e, -e * e] {
        for (a, b) in [(1.0 + e, 1.0 - e / 2.0), (1.0 + e, 1.0 + e), (1.0 - e / 2.0, 0.5 + e)] {
            for scale in [1.0, 2f32.powi(-126), 2f32.powi(-140), 2f32.powi(100)] {
                check([a * scale, b, trace]);
                check([a, b * scale, trace * scale]);
                check([-a, b * scale, e / 2.0 * scale]);
            }
        }
    }
    let once = spec::fused_mul_add(1.0 + e, 1.0 + e, f32::from_bits(1));
    assert_eq!(once, 1.0 + 2.0 * e);
}

#[test]
fn copysign_and_shifts_as_the_standard_library() {
    for [a, b] in values::pairs(&values::floats()) {
        assert_eq!(spec::copysign(a, b).to_bits(), a.copysign(b).to_bits());
    }
    for x in values::ints() {
        for n in 0..70 {
            assert_eq!(spec::shl(x, n), x.checked_shl(n).unwrap_or(0));
            assert_eq!(spec::shr(x, n), x.checked_shr(n).unwrap_or(0));
            let sign = if (x as i32) < 0 { -1 } else { 0 };
            assert_eq!(spec::sar(x as i32, n), (x as i32).checked_shr(n).unwrap_or(sign));
        }
    }
}

#[test]
fn least_and_greatest_by_hand() {
    let nan = f32::NAN;
    let second = |f: fn(f32, f32) -> f32, a: f32, b: f32| same(f(a, b), b);
    for f in [spec::min, spec::max] {
        assert!(second(f, nan, 1.0) && second(f, 1.0, nan));
        assert!(second(f, 0.0, -0.0) && second(f, -0.0, 0.0));
    }
    assert_eq!((spec::min(1.0, 2.0), spec::max(1.0, 2.0)), (1.0, 2.0));
    for signalling in [nan, f32::from_bits(0x7f80_0001)] {
        for f in [spec::min_num, spec::max_num] {
            assert_eq!((f(signalling, 1.0), f(1.0, signalling)), (1.0, 1.0));
            assert!(f(signalling, nan).is_nan());
        }
    }
    for (a, b) in [(0.0, -0.0), (-0.0, 0.0)] {
        assert!(same(spec::min_num(a, b), -0.0) && same(spec::max_num(a, b), 0.0));
    }
    assert_eq!(spec::min_num(f32::NEG_INFINITY, -3.0), f32::NEG_INFINITY);
    assert_eq!(spec::max_num(f32::NEG_INFINITY, -3.0), -3.0);
}

#[test]
fn reductions_by_hand() {
    /// A fold written out: which lanes, in which order.
    fn written(n: usize) -> String {
        // What is folded must be `Copy`: numbers of texts.
        let texts: Vec<String> = "0123456789abcdef".chars().map(String::from).collect();
        let texts = RefCell::new(texts);
        let joined = |a: usize, b: usize| {
            let mut texts = texts.borrow_mut();
            let text = format!("({}{})", texts[a], texts[b]);
            texts.push(text);
            texts.len() - 1
        };
        let lanes: Vec<usize> = (0..n).collect();
        let whole = spec::reduce(&lanes, joined);
        texts.borrow()[whole].clone()
    }
    assert_eq!(written(1), "0");
    assert_eq!(written(4), "((02)(13))");
    assert_eq!(written(8), "(((04)(26))((15)(37)))");
    assert_eq!(written(16), "((((08)(4c))((2a)(6e)))(((19)(5d))((3b)(7f))))");

    let lanes = [3.0, f32::NAN, -0.0, 0.0];
    assert_eq!(spec::argmin(&lanes, &[true; 4]).map(|x| x.0), Some(2));
    assert_eq!(spec::argmin(&lanes, &[true, true, false, true]).map(|x| x.0), Some(3));
    assert_eq!(spec::argmax(&lanes, &[true; 4]), Some((0, 3.0)));
    assert_eq!(spec::argmax(&lanes, &[false, true, false, false]), None);
    assert_eq!(
        spec::argmin(&[f32::INFINITY; 4], &[false, true, true, true]),
        Some((1, f32::INFINITY))
    );
}
