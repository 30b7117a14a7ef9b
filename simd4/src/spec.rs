//! The definition of every operation, on one lane.
//!
//! Each level equals these functions bit for bit in every lane. `+ - * /` and negation on `f32`
//! are Rust's own (IEEE 754, round to nearest even); on integers they wrap.

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
    f32::from_bits(x.to_bits() & 0x7fff_ffff)
}

/// `a < b ? a : b`: `b` where either is NaN and for zeros of either sign.
#[inline(always)]
pub fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// `a > b ? a : b`: `b` where either is NaN and for zeros of either sign.
#[inline(always)]
pub fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// `m ? a : b`, on any element.
#[inline(always)]
pub fn select<T>(m: bool, a: T, b: T) -> T {
    if m { a } else { b }
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
