//! `exp2`, `log2` and `pow`.
//!
//! Straight-line code of operations that are exact on every level: `+ − × ÷` without fusing,
//! comparisons, selections, bits, integers and shifts by constants; no table, no `f64`. So all
//! levels give the same bits. Changing the order of any sum changes the definition.
//!
//! The coefficients are minimax in relative error: Lawson's iteration (weighted least squares) in
//! 40 digits on 160 Chebyshev nodes, then rounded to `f32` from the lowest power up, the rest
//! fitted anew after each.
//!
//! Errors are in ulps of the real value; in the subnormal range the ulp is the spacing there.

use core::f32::consts::{LN_2, LOG2_E};

use crate::{Lanes, SimdF32, SimdInt, SimdMask};

/// The same in every lane.
#[inline(always)]
fn splat<V: SimdF32>(s: V::Simd, x: f32) -> V {
    V::splat(s, x)
}

/// A polynomial's coefficients, each in every lane.
#[inline(always)]
fn splats<V: SimdF32, const N: usize>(s: V::Simd, c: [f32; N]) -> [V; N] {
    let mut lanes = [V::splat(s, 0.0); N];
    let mut i = 0;
    while i < N {
        lanes[i] = V::splat(s, c[i]);
        i += 1;
    }
    lanes
}

/// 2ˣ.
///
/// Method: x = n + f with an integer n and |f| ≤ ½; 2^f by a polynomial of degree 6 (error 2^-28.3)
/// whose constant term is exactly 1; 2ⁿ by two factors.
///
/// Precision: at most 1.101 ulp over all inputs, 0.792 where the result is subnormal. Exact for integers.
///
/// Special cases: exp2(±0) = 1, exp2(+∞) = +∞, exp2(−∞) = +0, NaN for NaN; +∞ from 128 on, +0 from
/// −150 down.
///
/// Operations: 24, of which 9 multiplications and no division.
#[inline(always)]
pub(crate) fn exp2<V: SimdF32>(x: V) -> V {
    let s = x.token();
    // In this order of operands a NaN passes through.
    let x = splat::<V>(s, 128.0).min(splat::<V>(s, -150.0).max(x));
    let round = splat(s, ROUND);
    let t = x + round;
    exp2_parts(t, x - (t - round))
}

/// Adding it rounds to an integer n, to nearest even, and leaves n + 2·127 in the low bits: half of
/// that, and the rest of it, are biased exponents.
const ROUND: f32 = 12_582_912.0 + 254.0;

/// 2^(n + f), where t = n + [`ROUND`], n in −151..=129 and |f| ≤ ½, where the result is neither 0
/// nor infinite.
///
/// One factor 2ⁿ would do for normal results only. Two lose nothing on the way: the first product
/// is exact, the second rounds once, to a subnormal or to infinity.
#[inline(always)]
fn exp2_parts<V: SimdF32>(t: V, f: V) -> V {
    const C: [f32; 6] =
        [LN_2, 0.240_226_48, 0.055_503_596, 0.009_618_499, 0.001_339_097, 0.000_153_292_79];
    let c: [V; 6] = splats(t.token(), C);
    let n = t.to_bits();
    let half = n.shr(1);
    let a = V::from_bits(half.shl(23));
    let b = V::from_bits((n - half).shl(23));
    let f2 = f * f;
    let q = c[0] + f * ((c[1] + f * c[2]) + f2 * ((c[3] + f * c[4]) + f2 * c[5]));
    // a(1 + fq), with a·f ready before q is.
    (a + (a * f) * q) * b
}

/// The logarithm to base 2.
///
/// Method: x = 2ᵉ·m with m in [√½, √2); log2 m = f·P(f) with f = m − 1, which is exact, and P of
/// degree 8 (error 2^-25.1).
///
/// Precision: at most 2.167 ulp over all inputs, also next to 1 where the result vanishes. Exact
/// for powers of two.
///
/// Special cases: log2(1) = +0, log2(±0) = −∞, log2(+∞) = +∞, NaN below zero and for NaN.
///
/// Operations: 37, of which 12 multiplications and no division.
#[inline(always)]
pub(crate) fn log2<V: SimdF32>(x: V) -> V {
    const C: [f32; 9] = [
        LOG2_E,
        -0.721_347_4,
        0.480_909,
        -0.360_700_5,
        0.287_952_42,
        -0.239_017,
        0.215_493_38,
        -0.206_775_16,
        0.125_793_3,
    ];
    let s = x.token();
    let c: [V; 9] = splats(s, C);
    let (e, m) = split::<V, 0x3f35_04f3>(x);
    let f = m - splat(s, 1.0);
    let f2 = f * f;
    let q = ((c[1] + f * c[2]) + f2 * (c[3] + f * c[4]))
        + (f2 * f2) * ((c[5] + f * c[6]) + f2 * (c[7] + f * c[8]));
    let r = e + f * (c[0] + f * q);

    let (zero, infinity) = (splat(s, 0.0), splat(s, f32::INFINITY));
    let r = V::select(x.lt(infinity), r, x);
    V::select(x.gt(zero), r, V::select(x.eq(zero), -infinity, splat(s, f32::NAN)))
}

/// e and m with x = 2ᵉ·m and m at least the float of bits `LOW` and less than twice that; for +0
/// e = −150 and m = 1, for infinity e = 128 and m = 1. No meaning below zero.
#[inline(always)]
fn split<V: SimdF32, const LOW: u32>(x: V) -> (V, V) {
    // 2^23 in the exponent's place turns the integer below it into a float, without a conversion.
    const TO_FLOAT: f32 = 8_388_608.0;
    let s = x.token();
    let word = <V::U32 as Lanes>::splat;
    let tiny = x.lt(splat(s, f32::MIN_POSITIVE));
    let scaled = V::select(tiny, x * splat(s, 8_388_608.0), x);
    let bits = scaled.to_bits() + word(s, 0x3f80_0000 - LOW);
    let bias = V::select(tiny, splat(s, TO_FLOAT + (127.0 + 23.0)), splat(s, TO_FLOAT + 127.0));
    let e = V::from_bits(bits.shr(23) | word(s, TO_FLOAT.to_bits())) - bias;
    (e, V::from_bits((bits & word(s, 0x007f_ffff)) + word(s, LOW)))
}

/// x to the power y.
///
/// Method: log2 |x| as a sum h + l, good to 29.5 bits and more, of which h has 12; y in two halves
/// of 12 bits; so the products with h are exact, and 2^(y·h + y·l) is as for [`exp2`]. The logarithm
/// is that of fdlibm's `e_powf.c` (Sun Microsystems, 1993) with other sums: x = 2ᵉ·m, m in
/// [√¾, 2√¾), c = 1 or 3/2, s = (m − c)/(m + c), |s| ≤ 0.101, log2(m/c) = s·(C₀ + C₁s² + …).
/// Splitting by masking the low bits is Veltkamp's and Dekker's idea (Dekker 1971).
///
/// Precision: 2.37 ulp at most in 1.4·10⁹ pairs, among them 24 for every x in [½, 2); by the bounds
/// of its parts below 3.6. The worst lie where |log2 x| is near 0.29 and the result near the limits
/// of the range; for x and y as in shading it is 1.34. Exact where |x| is a power of two and
/// y·log2 |x| an integer. Subnormal x, y and results are as good as the others.
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
///
/// Operations: 109, of which 26 multiplications and one division.
#[inline(always)]
pub(crate) fn pow<V: SimdF32>(x: V, y: V) -> V {
    let s = x.token();
    let (zero, one) = (splat::<V>(s, 0.0), splat::<V>(s, 1.0));
    let magnitude = x.abs();
    let (h, l) = log2_parts(magnitude);

    // 0 and ∞, which alone are their own doubles, are powers of two here; with |y| too large for
    // any finite x they give 0 and ∞. So does a large y, and it is even, so pow(−1, ±∞) = 1. A NaN
    // passes through.
    let rail = (magnitude + magnitude).eq(magnitude);
    let large = splat::<V>(s, LARGE);
    let stretched = y * V::select(rail, splat(s, f32::INFINITY), one);
    let bounded = large.min((-large).max(stretched));
    let y_high = high(bounded);
    let y_low = bounded - y_high;
    let p = y_high * h;
    let rest = y_low * h + bounded * l;
    let round = splat::<V>(s, ROUND);
    let t = splat::<V>(s, 129.0).min(splat::<V>(s, -151.0).max(p + rest)) + round;
    // Above the range the polynomial grows as it should; below it would turn upwards.
    let f = (-one).max((p - (t - round)) + rest);
    let r = exp2_parts(t, f);

    // The distance of y from the nearest even integer. All floats from 2^24 on are even.
    let whole = splat::<V>(s, 16_777_216.0);
    let size = y.abs().min(whole);
    let distance = (size - ((size + whole) - whole)).abs();
    let odd = distance.eq(one);
    let even = distance.eq(zero);
    let r = r.copysign(V::select(odd, x, one));
    let undefined = x.lt(zero).and_not(odd | even | rail) | x.ne(x);
    let r = V::select(undefined, splat(s, f32::NAN), r);
    V::select(x.eq(one) | y.eq(zero), one, r)
}

/// 2^32: large enough that for any finite x but 0 and ±1 the power overflows or vanishes.
const LARGE: f32 = 4_294_967_296.0;

/// log2 x = h + l for x ≥ 0, h of 12 bits; for 0 and infinity as `split` has them.
#[inline(always)]
fn log2_parts<V: SimdF32>(x: V) -> (V, V) {
    // The first two are one number, 2/ln 2. The first has 12 bits and is too large by as much as
    // makes what is added to it least over the whole interval.
    const C: [f32; 5] = [2.890_625, -0.005_234_918, 0.961_796_8, 0.577_023_3, 0.419_728_25];
    const LOG2_3_2: [f32; 2] = [0.584_960_94, 1.563_221_2e-6];
    let s = x.token();
    let c: [V; 5] = splats(s, C);
    let (zero, one) = (splat::<V>(s, 0.0), splat::<V>(s, 1.0));

    let (e, m) = split::<V, 0x3f5d_b3d7>(x);
    // √(3/2) and more is nearer to 3/2 than to 1.
    let upper = m.gt(splat(s, 1.224_744_9));
    let centre = V::select(upper, splat(s, 1.5), one);

    // s = f/d as s_high + s_low, by the exact remainder of the division.
    let f = m - centre;
    let d = m + centre;
    let reciprocal = one / d;
    let quotient = f * reciprocal;
    let s_high = high(quotient);
    let d_high = high(d);
    let d_low = m - (d_high - centre);
    let s_low = ((f - s_high * d_high) - s_high * d_low) * reciprocal;

    // The bare quotient is good enough for the small terms, and ready earlier.
    let z = quotient * quotient;
    let q = (c[1] + z * c[2]) + (z * z) * (c[3] + z * c[4]);
    let big = s_high * c[0];
    let small =
        (s_low * c[0] + (s_high + s_low) * q) + V::select(upper, splat(s, LOG2_3_2[1]), zero);

    // 12 bits of log2(3/2) leave room for e: the sum is exact.
    let whole = e + V::select(upper, splat(s, LOG2_3_2[0]), zero);
    let h = high(whole + big);
    (h, (big - (h - whole)) + small)
}

/// x with 12 bits of significand: products of two such are exact.
#[inline(always)]
fn high<V: SimdF32>(x: V) -> V {
    V::from_bits(x.to_bits() & <V::U32 as Lanes>::splat(x.token(), 0xffff_f000))
}

#[cfg(test)]
mod tests {
    use super::log2_parts;
    use crate::{Lanes, Scalar, scalar::f32x1};

    /// 1.87 ulp of a result at 2^±128; `exp2`'s 1.11 and the three sums between, 0.52, stay below
    /// 4 with it.
    #[test]
    #[cfg(not(miri))]
    fn the_logarithm_inside_pow_is_good_to_29_bits_and_a_half() {
        for bits in (0x3f00_0000..0x4000_0000).filter(|&bits| bits != 1f32.to_bits()) {
            let x = f32::from_bits(bits);
            let (h, l) = log2_parts(f32x1::splat(Scalar::new(), x));
            let real = f64::from(x).log2();
            let error = ((f64::from(h.lane(0)) + f64::from(l.lane(0)) - real) / real).abs();
            assert!(error < 2f64.powf(-29.56), "log2 {x:e} = {h:?} + {l:?}, off by {error:e}");
        }
    }
}
