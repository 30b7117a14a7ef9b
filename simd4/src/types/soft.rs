//! Operations made of other operations, for levels that have no instruction for them.

use super::{Lanes, SimdF32, SimdI32, SimdInt};

/// [`spec::round_ties_even`](crate::spec::round_ties_even).
#[inline(always)]
pub(crate) fn round_ties_even<V: SimdF32>(x: V) -> V {
    // From 2^23 on there are no fractions; adding it leaves them to the addition's rounding.
    let magic = V::splat(x.token(), 8_388_608.0);
    let magnitude = x.abs();
    let rounded = ((magnitude + magic) - magic).copysign(x);
    V::select(magnitude.lt(magic), rounded, x)
}

/// [`spec::floor`](crate::spec::floor).
#[inline(always)]
pub(crate) fn floor<V: SimdF32>(x: V) -> V {
    let (zero, one) = (V::splat(x.token(), 0.0), V::splat(x.token(), 1.0));
    let rounded = round_ties_even(x);
    // Subtracting 0 keeps the sign of −0.
    rounded - V::select(rounded.gt(x), one, zero)
}

/// [`spec::ceil`](crate::spec::ceil).
#[inline(always)]
pub(crate) fn ceil<V: SimdF32>(x: V) -> V {
    -floor(-x)
}

/// [`spec::trunc`](crate::spec::trunc).
#[inline(always)]
pub(crate) fn trunc<V: SimdF32>(x: V) -> V {
    floor(x.abs()).copysign(x)
}

/// About `1 / x` by one Newton step from an estimate.
#[inline(always)]
pub(crate) fn rcp_step<V: SimdF32>(x: V, estimate: V) -> V {
    let one = V::splat(x.token(), 1.0);
    let error = x.nmul_add_fast(estimate, one);
    let better = estimate.mul_add_fast(error, estimate);
    // The error is NaN where one of 0 and ∞ is the estimate for the other, and −∞ where a
    // subnormal's is ∞: there the estimate stands.
    V::select(error.gt(-one), better, estimate)
}

/// About `1 / x.sqrt()` by one Newton step from an estimate.
#[inline(always)]
pub(crate) fn rsqrt_step<V: SimdF32>(x: V, estimate: V) -> V {
    let half = V::splat(x.token(), 0.5);
    let error = (x * estimate * half).nmul_add_fast(estimate, half);
    let better = estimate.mul_add_fast(error, estimate);
    V::select(error.gt(-half), better, estimate)
}

/// The nearest `f32` to each integer, ties to even.
#[inline(always)]
pub(crate) fn from_u32<V: SimdF32>(u: V::U32) -> V {
    let s = u.token();
    // Both halves as floats are exact: 2^23 + low, and 2^39 + high · 2^16.
    let low = V::from_bits(u & V::U32::splat(s, 0xffff) | V::U32::splat(s, 0x4b00_0000));
    let high = V::from_bits(u.shr(16) | V::U32::splat(s, 0x5300_0000));
    // Less 2^39 + 2^23, exactly; the sum is then the one rounding.
    (high - V::from_bits(V::U32::splat(s, 0x5300_0080))) + low
}

/// The integer toward zero, or the nearest that there is; 0 for NaN.
#[inline(always)]
pub(crate) fn to_u32<V: SimdF32>(x: V) -> V::U32 {
    let s = x.token();
    // What is not above zero, NaN too, becomes 0.
    let x = x.max(V::splat(s, 0.0));
    let fits = to_u32_fast(x);
    V::U32::select(x.lt(V::splat(s, 4_294_967_296.0)), fits, V::U32::splat(s, u32::MAX))
}

/// The same for values that have a `u32`.
#[inline(always)]
pub(crate) fn to_u32_fast<V: SimdF32>(x: V) -> V::U32 {
    let s = x.token();
    let half = V::splat(s, 2_147_483_648.0);
    // From 2^31 on: the rest above it, and its bit.
    let upper = (x - half).to_i32_fast().to_u32() ^ V::U32::splat(s, 1 << 31);
    V::U32::select(x.lt(half), x.to_i32_fast().to_u32(), upper)
}
