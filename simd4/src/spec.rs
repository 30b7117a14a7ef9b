//! The definition of every operation, on one lane.
//!
//! Each level equals these functions bit for bit in every lane, except for the operations whose
//! names end in `_est` and `_fast`: those keep to a stated bound. What has no function here is
//! Rust's own: `+ - * /` and negation on `f32` (IEEE 754, round to nearest even), `+ - *` on
//! integers (they wrap), comparisons, `as` between numbers (truncating and saturating, NaN to 0;
//! to nearest even), bit casts.

use crate::math::elementary;
use crate::scalar::f32x1;
use crate::{Lanes, Scalar};

const SIGN: u32 = 1 << 31;

/// The square root, correctly rounded; −0 for −0, NaN below zero.
#[inline(always)]
pub fn sqrt(x: f32) -> f32 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(not(feature = "std"))]
    return soft_sqrt(x);
}

/// The value without its sign bit, NaN included.
#[inline(always)]
pub fn abs(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & !SIGN)
}

/// The magnitude of `x` with the sign bit of `sign`, NaN included.
#[inline(always)]
pub fn copysign(x: f32, sign: f32) -> f32 {
    f32::from_bits(x.to_bits() & !SIGN | sign.to_bits() & SIGN)
}

/// `a < b ? a : b`: `b` where either is NaN and for zeros of either sign.
#[inline(always)]
pub fn min<T: PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

/// `a > b ? a : b`: `b` where either is NaN and for zeros of either sign.
#[inline(always)]
pub fn max<T: PartialOrd>(a: T, b: T) -> T {
    if a > b { a } else { b }
}

/// The lesser number: IEEE 754-2019 `minimumNumber`. A NaN gives way to a number; −0 is less
/// than +0.
#[inline(always)]
pub fn min_num(a: f32, b: f32) -> f32 {
    if a == b {
        f32::from_bits(a.to_bits() | b.to_bits())
    } else if a < b || b.is_nan() {
        a
    } else {
        b
    }
}

/// The greater number: IEEE 754-2019 `maximumNumber`. A NaN gives way to a number; +0 is greater
/// than −0.
#[inline(always)]
pub fn max_num(a: f32, b: f32) -> f32 {
    if a == b {
        f32::from_bits(a.to_bits() & b.to_bits())
    } else if a > b || b.is_nan() {
        a
    } else {
        b
    }
}

/// The nearest integer that is no further from zero. The sign of zero is kept.
#[inline(always)]
pub fn trunc(x: f32) -> f32 {
    let exponent = (x.to_bits() >> 23 & 0xff) as i32 - 127;
    let fraction = match exponent {
        ..0 => !SIGN,
        0..23 => 0x7f_ffff >> exponent,
        23.. => 0,
    };
    f32::from_bits(x.to_bits() & !fraction)
}

/// The greatest integer that is not above. The sign of zero is kept.
#[inline(always)]
pub fn floor(x: f32) -> f32 {
    let t = trunc(x);
    if t > x { t - 1.0 } else { t }
}

/// The least integer that is not below. The sign of zero is kept: −0.5 gives −0.
#[inline(always)]
pub fn ceil(x: f32) -> f32 {
    let t = trunc(x);
    if t < x { t + 1.0 } else { t }
}

/// The nearest integer, the even one of two. The sign of zero is kept.
#[inline(always)]
pub fn round_ties_even(x: f32) -> f32 {
    let t = trunc(x);
    let part = abs(x - t);
    let odd = t * 0.5 != trunc(t * 0.5);
    if part > 0.5 || part == 0.5 && odd { t + copysign(1.0, x) } else { t }
}

/// `a * b + c` in two roundings.
#[inline(always)]
pub fn mul_add(a: f32, b: f32, c: f32) -> f32 {
    a * b + c
}

/// `a * b - c` in two roundings.
#[inline(always)]
pub fn mul_sub(a: f32, b: f32, c: f32) -> f32 {
    a * b - c
}

/// `c - a * b` in two roundings.
#[inline(always)]
pub fn nmul_add(a: f32, b: f32, c: f32) -> f32 {
    c - a * b
}

/// `-(a * b) - c` in two roundings.
#[inline(always)]
pub fn nmul_sub(a: f32, b: f32, c: f32) -> f32 {
    -(a * b) - c
}

/// `a * b + c` in one rounding.
///
/// The product of two `f32` is exact in `f64`; their sum with `c` is not. Rounding that to
/// nearest and then once more to `f32` would err on ties, so it is rounded to odd, which keeps
/// in the last bit whether anything was lost (Boldo and Melquiond 2008).
#[inline(always)]
pub fn fused_mul_add(a: f32, b: f32, c: f32) -> f32 {
    let (product, c) = (f64::from(a) * f64::from(b), f64::from(c));
    let sum = product + c;
    // What the addition lost, exactly (Knuth's two-sum). NaN beside infinities: nothing lost.
    let from_product = sum - c;
    let lost = (product - from_product) + (c - (sum - from_product));
    let bits = sum.to_bits();
    // Toward the lost part if that leaves an odd number; an odd one is right already.
    let toward = if (lost > 0.0) == (sum > 0.0) { bits + 1 } else { bits.wrapping_sub(1) };
    let inexact = lost.abs() > 0.0;
    f64::from_bits(if inexact && bits & 1 == 0 { toward } else { bits }) as f32
}

/// `a * b - c` in one rounding.
#[inline(always)]
pub fn fused_mul_sub(a: f32, b: f32, c: f32) -> f32 {
    fused_mul_add(a, b, -c)
}

/// `c - a * b` in one rounding.
#[inline(always)]
pub fn fused_nmul_add(a: f32, b: f32, c: f32) -> f32 {
    fused_mul_add(-a, b, c)
}

/// `-(a * b) - c` in one rounding.
#[inline(always)]
pub fn fused_nmul_sub(a: f32, b: f32, c: f32) -> f32 {
    fused_mul_add(-a, b, -c)
}

/// 2 to the power `x`: at most 1.11 ulp off; exact for integers, results that are subnormal
/// included.
///
/// 1 for ±0, +∞ from 128 on, +0 from −150 down, NaN for NaN.
#[inline]
pub fn exp2(x: f32) -> f32 {
    elementary::exp2(one_lane(x)).lane(0)
}

/// The logarithm of `x` to base 2: at most 2.17 ulp off; exact for powers of two.
///
/// −∞ for ±0, NaN below zero and for NaN.
#[inline]
pub fn log2(x: f32) -> f32 {
    elementary::log2(one_lane(x)).lane(0)
}

/// `x` to the power `y`.
///
/// At most 4 ulp off: 2.37 was the worst of 1.4·10⁹ pairs, 1.34 of those that shading has. Exact
/// where `x` is a power of two and the result one too.
///
/// Special cases, the upper ones first:
///
/// | x | y | result |
/// |---|---|---|
/// | any, NaN too | ±0 | 1 |
/// | 1 | any, NaN too | 1 |
/// | NaN | | NaN |
/// | | NaN | NaN |
/// | −1 | ±∞ | 1 |
/// | absolutely below 1 | −∞, +∞ | +∞, +0 |
/// | absolutely above 1 | −∞, +∞ | +0, +∞ |
/// | ±0 | odd integer below 0, above 0 | ±∞, ±0 |
/// | ±0 | other below 0, above 0 | +∞, +0 |
/// | −∞ | odd integer below 0, above 0 | −0, −∞ |
/// | ±∞ | other below 0, above 0 | +0, +∞ |
/// | finite below 0 | odd integer | −(−x)^y |
/// | finite below 0 | not an integer | NaN |
#[inline]
pub fn pow(x: f32, y: f32) -> f32 {
    elementary::pow(one_lane(x), one_lane(y)).lane(0)
}

#[inline(always)]
fn one_lane(x: f32) -> f32x1 {
    f32x1::splat(Scalar::new(), x)
}

/// The bits moved up by `n`, zeros below; 0 if `n` is 32 or more.
#[inline(always)]
pub fn shl(x: u32, n: u32) -> u32 {
    if n < 32 { x << n } else { 0 }
}

/// The bits moved down by `n`, zeros above; 0 if `n` is 32 or more.
#[inline(always)]
pub fn shr(x: u32, n: u32) -> u32 {
    if n < 32 { x >> n } else { 0 }
}

/// The bits moved down by `n`, copies of the sign above; only those if `n` is 32 or more.
#[inline(always)]
pub fn sar(x: i32, n: u32) -> i32 {
    x >> min(n, 31)
}

/// `m ? a : b`, on any element.
#[inline(always)]
pub fn select<T>(m: bool, a: T, b: T) -> T {
    if m { a } else { b }
}

/// All lanes as one, in the tree order of every reduction: lane `i` with lane `i + n / 2`, until
/// one is left. For four lanes that is `f(f(x0, x2), f(x1, x3))`.
///
/// # Panics
/// If there are no lanes.
pub fn reduce<T: Copy>(lanes: &[T], f: impl Fn(T, T) -> T) -> T {
    /// The lanes from `start` in steps of `step`. The last pair are the lanes' even and odd half.
    fn tree<T: Copy>(lanes: &[T], start: usize, step: usize, f: &impl Fn(T, T) -> T) -> T {
        if start + step >= lanes.len() {
            return lanes[start];
        }
        f(tree(lanes, start, 2 * step, f), tree(lanes, start + step, 2 * step, f))
    }
    tree(lanes, 0, 1, &f)
}

/// The lane of the least value among those that the mask allows, and that value; the lowest lane
/// of several. A NaN is never the least.
pub fn argmin<T: Copy + PartialOrd>(lanes: &[T], mask: &[bool]) -> Option<(usize, T)> {
    best(lanes, mask, |a, b| a < b)
}

/// The lane of the greatest value among those that the mask allows, and that value; the lowest
/// lane of several. A NaN is never the greatest.
pub fn argmax<T: Copy + PartialOrd>(lanes: &[T], mask: &[bool]) -> Option<(usize, T)> {
    best(lanes, mask, |a, b| a > b)
}

#[allow(clippy::eq_op, reason = "only a number equals itself")]
fn best<T: Copy + PartialOrd>(
    lanes: &[T],
    mask: &[bool],
    better: impl Fn(T, T) -> bool,
) -> Option<(usize, T)> {
    let mut best: Option<(usize, T)> = None;
    for (lane, (&x, _)) in lanes.iter().zip(mask).enumerate().filter(|(_, (_, allowed))| **allowed)
    {
        if x == x && best.is_none_or(|(_, least)| better(x, least)) {
            best = Some((lane, x));
        }
    }
    best
}

/// The square root by integers, for builds without `std`: `core` has none.
#[cfg(any(test, not(feature = "std")))]
fn soft_sqrt(x: f32) -> f32 {
    if x.is_nan() || x == 0.0 || x == f32::INFINITY {
        return x;
    }
    if x < 0.0 {
        return f32::NAN;
    }
    // x = mantissa · 2^exponent, with an even exponent and a mantissa of 24 or 25 bits.
    let bits = x.to_bits();
    let (mut mantissa, mut exponent) = match bits >> 23 {
        0 => (u64::from(bits), -149),
        biased => (u64::from(bits & 0x7f_ffff | 0x80_0000), biased as i32 - 150),
    };
    let shift = mantissa.leading_zeros() as i32 - 40;
    mantissa <<= shift;
    exponent -= shift;
    if exponent % 2 != 0 {
        mantissa <<= 1;
        exponent -= 1;
    }
    // 25 or more bits of the root, and a sticky bit below: the conversion then rounds once.
    let radicand = mantissa << 26;
    let root = radicand.isqrt();
    let sticky = u64::from(root * root != radicand);
    let scale = (exponent - 26) / 2 - 1;
    (root << 1 | sticky) as f32 * f32::from_bits(((scale + 127) as u32) << 23)
}

#[cfg(test)]
mod tests {
    use super::soft_sqrt;

    #[test]
    fn soft_sqrt_is_correctly_rounded() {
        let strided = (0..=u32::MAX).step_by(9973);
        let edges = [0, 1, 2, 3, 0x7f_ffff, 0x80_0000, 0x80_0001, 0x7f7f_ffff, 0x7f80_0000];
        let ones = (0x3f7f_ff00..0x3f80_0100).chain(0x4000_0000..0x4000_0100);
        for bits in strided.chain(edges).chain(edges.map(|b| b | 1 << 31)).chain(ones) {
            let x = f32::from_bits(bits);
            let (soft, hard) = (soft_sqrt(x), x.sqrt());
            assert!(
                soft.to_bits() == hard.to_bits() || soft.is_nan() && hard.is_nan(),
                "sqrt({x:e}): {soft:e}, not {hard:e}"
            );
        }
    }
}
