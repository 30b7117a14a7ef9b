//! Operations made of other operations, for levels that have no instruction for them.

use super::{LaneArray, Lanes, SimdF32, SimdI32, SimdInt, SimdU32};

/// [`spec::round_ties_even`](crate::spec::round_ties_even).
#[inline(always)]
pub(crate) fn round_ties_even<V: SimdF32>(x: V) -> V {
    // From 2^23 on there are no fractions; adding it leaves them to the addition's rounding. What
    // has none, and NaN, gets 0 added.
    let magnitude = x.abs();
    let magic = V::splat(x.token(), 8_388_608.0);
    let magic = magic.masked(magnitude.lt(magic));
    with_sign((magnitude + magic) - magic, x)
}

/// [`spec::floor`](crate::spec::floor).
#[inline(always)]
pub(crate) fn floor<V: SimdF32>(x: V) -> V {
    let rounded = round_ties_even(x);
    // Subtracting 0 keeps the sign of −0.
    rounded - V::splat(x.token(), 1.0).masked(rounded.gt(x))
}

/// [`spec::ceil`](crate::spec::ceil).
#[inline(always)]
pub(crate) fn ceil<V: SimdF32>(x: V) -> V {
    let rounded = round_ties_even(x);
    with_sign(rounded + V::splat(x.token(), 1.0).masked(rounded.lt(x)), x)
}

/// [`spec::trunc`](crate::spec::trunc).
#[inline(always)]
pub(crate) fn trunc<V: SimdF32>(x: V) -> V {
    let rounded = round_ties_even(x.abs());
    with_sign(rounded - V::splat(x.token(), 1.0).masked(rounded.gt(x.abs())), x)
}

/// A value that is not of the opposite sign, or a zero, with the sign of another.
#[inline(always)]
fn with_sign<V: SimdF32>(x: V, sign: V) -> V {
    let sign_bit = V::U32::splat(x.token(), 1 << 31);
    V::from_bits(x.to_bits() | sign.to_bits() & sign_bit)
}

/// About `1 / x` by one Newton step from an estimate.
#[inline(always)]
pub(crate) fn rcp_step<V: SimdF32>(x: V, estimate: V) -> V {
    let one = V::splat(x.token(), 1.0);
    let error = x.nmul_add_fast(estimate, one);
    let better = estimate.mul_add_fast(error, estimate);
    // Where 0 or ∞ is the estimate the step gives NaN: there the estimate stands.
    V::select(better.eq(better), better, estimate)
}

/// About `1 / x.sqrt()` by one Newton step from an estimate.
#[inline(always)]
pub(crate) fn rsqrt_step<V: SimdF32>(x: V, estimate: V) -> V {
    let half = V::splat(x.token(), 0.5);
    let halved = estimate * half;
    let error = (x * halved).nmul_add_fast(estimate, half);
    // Where 0 or ∞ is the estimate the step gives NaN, and `max` its other operand: the estimate,
    // which half of it is too. Elsewhere half of it is the lesser.
    estimate.mul_add_fast(error, estimate).max(halved)
}

/// 2^39 + 2^23, as [`from_u32`] needs it.
pub(crate) const TWO_39_AND_23: f32 = 549_764_202_496.0;

/// The nearest `f32` to each integer, ties to even.
#[inline(always)]
pub(crate) fn from_u32<V: SimdF32>(u: V::U32) -> V {
    let s = u.token();
    // Both halves as floats are exact: 2^23 + low, and 2^39 + high · 2^16.
    let low = V::from_bits(u & V::U32::splat(s, 0xffff) | V::U32::splat(s, 0x4b00_0000));
    let high = V::from_bits(u.shr(16) | V::U32::splat(s, 0x5300_0000));
    // Less 2^39 + 2^23, exactly; the sum is then the one rounding.
    (high - V::splat(s, TWO_39_AND_23)) + low
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

/// [`SimdU32::permute`], by way of memory.
#[inline(always)]
pub(crate) fn permute<V: SimdU32>(u: V, order: V) -> V {
    let (lanes, order) = (u.to_array(), order.to_array());
    V::from_array(
        u.token(),
        LaneArray::from_fn(
            #[inline(always)]
            |i| lanes.as_ref()[order.as_ref()[i] as usize % V::LANES],
        ),
    )
}
