//! SSE2.

use core::arch::x86_64::*;

use super::xmm::*;
use super::{Twin, twins};
use crate::io::{Io, N};
use crate::kernels::{BOXES, DIRECTION, INVERSE, ORIGIN, TRIANGLES};
use crate::ops::INDEX_SHIFT;

/// `m ? a : b`
#[target_feature(enable = "sse2")]
#[inline]
fn blend(m: __m128, a: __m128, b: __m128) -> __m128 {
    _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b))
}

/// `m ? a : b`
#[target_feature(enable = "sse2")]
#[inline]
fn blend_epi32(m: __m128i, a: __m128i, b: __m128i) -> __m128i {
    _mm_or_si128(_mm_and_si128(m, a), _mm_andnot_si128(m, b))
}

/// `a * b + c` in one rounding: in `f64`, rounded to odd, then to `f32`.
#[target_feature(enable = "sse2")]
#[inline]
fn fma(a: __m128, b: __m128, c: __m128) -> __m128 {
    let low = fma_pd(a, b, c);
    let high = fma_pd(_mm_movehl_ps(a, a), _mm_movehl_ps(b, b), _mm_movehl_ps(c, c));
    _mm_movelh_ps(low, high)
}

/// The same for the two low lanes.
#[target_feature(enable = "sse2")]
#[inline]
fn fma_pd(a: __m128, b: __m128, c: __m128) -> __m128 {
    let (c, product) = (_mm_cvtps_pd(c), _mm_mul_pd(_mm_cvtps_pd(a), _mm_cvtps_pd(b)));
    let sum = _mm_add_pd(product, c);
    let part = _mm_sub_pd(sum, c);
    let lost = _mm_add_pd(_mm_sub_pd(product, part), _mm_sub_pd(c, _mm_sub_pd(sum, part)));
    // One away from zero or toward it, to where the lost part is, if there is one and the sum is
    // even.
    let zero = _mm_setzero_pd();
    let one = _mm_set1_epi64x(1);
    let up = _mm_cmpgt_pd(lost, zero);
    let inexact = _mm_or_pd(up, _mm_cmplt_pd(lost, zero));
    let step = _mm_or_si128(_mm_castpd_si128(_mm_xor_pd(up, _mm_cmpgt_pd(sum, zero))), one);
    let sum = _mm_castpd_si128(sum);
    let even = _mm_sub_epi64(_mm_and_si128(sum, one), one);
    let step = _mm_and_si128(_mm_and_si128(step, even), _mm_castpd_si128(inexact));
    _mm_cvtpd_ps(_mm_castsi128_pd(_mm_add_epi64(sum, step)))
}

/// The magnitude rounded to even. From 2^23 on 0 is added and taken away again.
#[target_feature(enable = "sse2")]
#[inline]
fn round_magnitude(magnitude: __m128) -> __m128 {
    let magic = _mm_set1_ps(8_388_608.0);
    let magic = _mm_and_ps(_mm_cmplt_ps(magnitude, magic), magic);
    _mm_sub_ps(_mm_add_ps(magnitude, magic), magic)
}

#[target_feature(enable = "sse2")]
#[inline]
fn round(x: __m128) -> __m128 {
    _mm_or_ps(round_magnitude(_mm_andnot_ps(sign(), x)), _mm_and_ps(sign(), x))
}

#[target_feature(enable = "sse2")]
#[inline]
fn floor_ps(x: __m128) -> __m128 {
    let rounded = round(x);
    _mm_sub_ps(rounded, _mm_and_ps(_mm_cmplt_ps(x, rounded), _mm_set1_ps(1.0)))
}

#[target_feature(enable = "sse2")]
#[inline]
fn ceil_ps(x: __m128) -> __m128 {
    let rounded = round(x);
    let up = _mm_add_ps(rounded, _mm_and_ps(_mm_cmplt_ps(rounded, x), _mm_set1_ps(1.0)));
    _mm_or_ps(up, _mm_and_ps(sign(), x))
}

#[target_feature(enable = "sse2")]
#[inline]
fn trunc_ps(x: __m128) -> __m128 {
    let small = _mm_cmplt_ps(_mm_andnot_ps(sign(), x), _mm_set1_ps(8_388_608.0));
    let integer = _mm_and_ps(_mm_cvtepi32_ps(_mm_cvttps_epi32(x)), small);
    _mm_or_ps(integer, _mm_andnot_ps(_mm_andnot_ps(sign(), small), x))
}

/// One Newton step; the estimate where that makes a NaN of 0 or ∞.
#[target_feature(enable = "sse2")]
#[inline]
fn rcp(x: __m128) -> __m128 {
    let r = _mm_rcp_ps(x);
    let error = _mm_sub_ps(_mm_set1_ps(1.0), _mm_mul_ps(x, r));
    let better = _mm_add_ps(_mm_mul_ps(r, error), r);
    blend(_mm_cmpord_ps(better, better), better, r)
}

/// One Newton step; the estimate, 0 or ∞ and as good when halved, where that makes a NaN.
#[target_feature(enable = "sse2")]
#[inline]
fn rsqrt(x: __m128) -> __m128 {
    let (r, half) = (_mm_rsqrt_ps(x), _mm_set1_ps(0.5));
    let halved = _mm_mul_ps(r, half);
    let error = _mm_sub_ps(half, _mm_mul_ps(_mm_mul_ps(x, halved), r));
    _mm_max_ps(_mm_add_ps(_mm_mul_ps(r, error), r), halved)
}

/// Saturating.
#[target_feature(enable = "sse2")]
#[inline]
fn int(x: __m128) -> __m128i {
    let great = bits(_mm_cmpge_ps(x, _mm_set1_ps(2_147_483_648.0)));
    let turned = _mm_xor_si128(_mm_cvttps_epi32(x), great);
    _mm_and_si128(turned, bits(_mm_cmpord_ps(x, x)))
}

/// For what fits; 2^31 with anything from 2^32 on.
#[target_feature(enable = "sse2")]
#[inline]
fn uint_fast(x: __m128) -> __m128i {
    let low = _mm_cvttps_epi32(x);
    let high = _mm_cvttps_epi32(_mm_sub_ps(x, _mm_set1_ps(2_147_483_648.0)));
    _mm_or_si128(low, _mm_and_si128(high, _mm_srai_epi32::<31>(low)))
}

/// Saturating.
#[target_feature(enable = "sse2")]
#[inline]
fn uint(x: __m128) -> __m128i {
    let x = _mm_max_ps(x, _mm_setzero_ps());
    let great = bits(_mm_cmpge_ps(x, _mm_set1_ps(4_294_967_296.0)));
    _mm_or_si128(uint_fast(x), great)
}

/// From the halves, as floats with 2^23 and 2^39 added.
#[target_feature(enable = "sse2")]
#[inline]
fn float(u: __m128i) -> __m128 {
    let low = _mm_or_si128(_mm_and_si128(u, _mm_set1_epi32(0xffff)), _mm_set1_epi32(0x4b00_0000));
    let high = _mm_or_si128(_mm_srli_epi32::<16>(u), _mm_set1_epi32(0x5300_0000));
    let high = _mm_sub_ps(_mm_castsi128_ps(high), _mm_set1_ps(549_764_202_496.0));
    _mm_add_ps(high, _mm_castsi128_ps(low))
}

#[target_feature(enable = "sse2")]
#[inline]
fn mul_epi32(a: __m128i, b: __m128i) -> __m128i {
    let even = _mm_mul_epu32(a, b);
    let odd = _mm_mul_epu32(_mm_srli_epi64::<32>(a), _mm_srli_epi64::<32>(b));
    _mm_unpacklo_epi32(_mm_shuffle_epi32::<0b1000>(even), _mm_shuffle_epi32::<0b1000>(odd))
}

/// `a > b` on unsigned lanes.
#[target_feature(enable = "sse2")]
#[inline]
fn gt_epu32(a: __m128i, b: __m128i) -> __m128i {
    let bias = _mm_set1_epi32(i32::MIN);
    _mm_cmpgt_epi32(_mm_xor_si128(a, bias), _mm_xor_si128(b, bias))
}

#[target_feature(enable = "sse2")]
#[inline]
fn max_epu32(a: __m128i, b: __m128i) -> __m128i {
    blend_epi32(gt_epu32(a, b), a, b)
}

/// The least of the mask's lanes and where it is.
#[target_feature(enable = "sse2")]
#[inline]
fn argmin_ps(x: __m128, mask: __m128) -> Option<(usize, f32)> {
    let allowed = _mm_and_ps(mask, _mm_cmpord_ps(x, x));
    let masked = blend(allowed, x, _mm_set1_ps(f32::INFINITY));
    let least = _mm_min_ps(masked, _mm_shuffle_ps::<0b_01_00_11_10>(masked, masked));
    let least = _mm_min_ps(least, _mm_shuffle_ps::<0b_10_11_00_01>(least, least));
    match _mm_movemask_ps(_mm_and_ps(allowed, _mm_cmpeq_ps(x, least))) {
        0 => None,
        equal => {
            let lane = equal.trailing_zeros() as usize;
            let mut lanes = [0.0; LANES];
            store(&mut lanes, 0, x);
            Some((lane, lanes[lane % LANES]))
        }
    }
}

twins! { "sse2";
    in_full: argmin swizzle compress_store prefix load_masked store_masked gather
        dot slab moller_trumbore argmin_all rsqrt_normalise floor_to_int transpose4x4 hmin;

    add = map |r| bits(_mm_add_ps(r.a, r.b));
    sub = map |r| bits(_mm_sub_ps(r.a, r.b));
    mul = map |r| bits(_mm_mul_ps(r.a, r.b));
    div = map |r| bits(_mm_div_ps(r.a, r.b));
    neg = map |r| bits(_mm_xor_ps(r.a, sign()));
    abs = map |r| bits(_mm_andnot_ps(sign(), r.a));
    sqrt = map |r| bits(_mm_sqrt_ps(r.a));
    copysign = map |r| bits(blend(sign(), r.b, r.a));

    mul_add = map |r| bits(_mm_add_ps(_mm_mul_ps(r.a, r.b), r.c));
    nmul_sub = map |r| bits(_mm_sub_ps(_mm_xor_ps(_mm_mul_ps(r.a, r.b), sign()), r.c));
    fused_mul_add = map |r| bits(fma(r.a, r.b, r.c));
    fused_nmul_sub = map |r| bits(fma(_mm_xor_ps(r.a, sign()), r.b, _mm_xor_ps(r.c, sign())));
    mul_add_fast = map |r| bits(_mm_add_ps(_mm_mul_ps(r.a, r.b), r.c));

    min = map |r| bits(_mm_min_ps(r.a, r.b));
    max = map |r| bits(_mm_max_ps(r.a, r.b));
    min_num = map |r| {
        let least = blend(_mm_cmpord_ps(r.b, r.b), _mm_min_ps(r.a, r.b), r.a);
        bits(_mm_or_ps(least, _mm_and_ps(_mm_cmpeq_ps(r.a, r.b), r.a)))
    };
    max_num = map |r| {
        let greatest = blend(_mm_cmpord_ps(r.b, r.b), _mm_max_ps(r.a, r.b), r.a);
        bits(_mm_and_ps(greatest, _mm_or_ps(_mm_cmpneq_ps(r.a, r.b), r.a)))
    };

    floor = map |r| bits(floor_ps(r.a));
    ceil = map |r| bits(ceil_ps(r.a));
    trunc = map |r| bits(trunc_ps(r.a));
    round_ties_even = map |r| bits(round(r.a));

    rcp_est = map |r| bits(_mm_rcp_ps(r.a));
    rsqrt_est = map |r| bits(_mm_rsqrt_ps(r.a));
    rcp_fast = map |r| bits(rcp(r.a));
    rsqrt_fast = map |r| bits(rsqrt(r.a));

    lt = map |r| bits(blend(_mm_cmplt_ps(r.a, r.b), r.a, r.c));
    ne = map |r| bits(blend(_mm_cmpneq_ps(r.a, r.b), r.a, r.c));
    lt_i32 = map |r| blend_epi32(_mm_cmplt_epi32(r.i, r.j), r.i, r.j);
    le_u32 = map |r| blend_epi32(gt_epu32(r.u, r.v), r.u, r.v);
    between = map |r| {
        let between = _mm_and_ps(_mm_cmple_ps(r.a, r.b), _mm_cmplt_ps(r.b, r.c));
        bits(blend(between, r.a, r.c))
    };
    and_not = map |r| {
        let mask = _mm_andnot_ps(_mm_cmplt_ps(r.b, r.c), _mm_cmple_ps(r.a, r.b));
        bits(blend(mask, r.a, r.c))
    };
    bitmask = fold |r| _mm_movemask_ps(_mm_cmplt_ps(r.a, r.b)) as u32;
    any = fold |r| u32::from(_mm_movemask_ps(_mm_cmplt_ps(r.a, r.b)) != 0);
    all = fold |r| u32::from(_mm_movemask_ps(_mm_cmplt_ps(r.a, r.b)) == 0xf);
    // The counts of all sixteen masks.
    count = fold |r| {
        let mask = _mm_movemask_ps(_mm_cmplt_ps(r.a, r.b));
        (0x4332_3221_3221_2110_u64 >> (4 * mask)) as u32 & 0xf
    };
    first = fold |r| match _mm_movemask_ps(_mm_cmplt_ps(r.a, r.b)) {
        0 => u32::MAX,
        mask => mask.trailing_zeros(),
    };

    to_i32 = map |r| int(r.a);
    to_u32 = map |r| uint(r.a);
    to_i32_fast = map |r| _mm_cvttps_epi32(r.a);
    to_u32_fast = map |r| uint_fast(r.a);
    from_i32 = map |r| bits(_mm_cvtepi32_ps(r.i));
    from_u32 = map |r| bits(float(r.u));

    add_i32 = map |r| _mm_add_epi32(r.i, r.j);
    mul_i32 = map |r| mul_epi32(r.i, r.j);
    min_i32 = map |r| blend_epi32(_mm_cmplt_epi32(r.i, r.j), r.i, r.j);
    max_u32 = map |r| max_epu32(r.u, r.v);
    abs_i32 = map |r| {
        let sign = _mm_srai_epi32::<31>(r.i);
        _mm_sub_epi32(_mm_xor_si128(r.i, sign), sign)
    };
    shl = map |r| _mm_sll_epi32(r.u, r.n);
    shr = map |r| _mm_srl_epi32(r.u, r.n);
    sar = map |r| _mm_sra_epi32(r.i, r.n);
    logic = map |r| {
        let not = _mm_xor_si128(r.u, _mm_set1_epi32(-1));
        _mm_xor_si128(_mm_and_si128(r.u, r.v), not)
    };

    rotate = map |r| bits(_mm_shuffle_ps::<0b_00_11_10_01>(r.a, r.a));
    reverse = map |r| bits(_mm_shuffle_ps::<0b_00_01_10_11>(r.a, r.a));
    zip = pair |r| (_mm_unpacklo_ps(r.a, r.b), _mm_unpackhi_ps(r.a, r.b));
    unzip = pair |r| (
        _mm_shuffle_ps::<0b_10_00_10_00>(r.a, r.b),
        _mm_shuffle_ps::<0b_11_01_11_01>(r.a, r.b),
    );

    permute = map |r| {
        let (mut lanes, mut order) = ([0; LANES], [0; LANES]);
        store_epi32(&mut lanes, 0, bits(r.a));
        store_epi32(&mut order, 0, r.u);
        load_epi32(&order.map(|lane| lanes[lane as usize % LANES]), 0)
    };

    reduce_sum = reduce |r| {
        let x = _mm_add_ps(r.a, high(r.a));
        _mm_cvtss_f32(_mm_add_ss(x, second(x)))
    };
    reduce_product = reduce |r| {
        let x = _mm_mul_ps(r.a, high(r.a));
        _mm_cvtss_f32(_mm_mul_ss(x, second(x)))
    };
    reduce_min = reduce |r| hmin_ps(r.a);
    reduce_max_u32 = fold |r| {
        let x = max_epu32(r.u, _mm_shuffle_epi32::<0b_11_10_11_10>(r.u));
        _mm_cvtsi128_si32(max_epu32(x, _mm_shuffle_epi32::<1>(x))) as u32
    };

    copy = map |r| bits(r.a);
}

#[target_feature(enable = "sse2")]
fn argmin(io: &mut Io) {
    for k in 0..N / LANES {
        let Regs { a, b, c, .. } = Regs::load(io, k * LANES);
        if let Some((lane, value)) = argmin_ps(a, _mm_cmplt_ps(b, c)) {
            io.bits.0[k] = lane as u32;
            io.floats.0[k] = value;
        }
    }
}

#[target_feature(enable = "sse2")]
fn swizzle(io: &mut Io) {
    for at in (0..N).step_by(8) {
        let (low, high) = (load(&io.f[0].0, at), load(&io.f[0].0, at + 4));
        // 0 2 5 7 and 1 3 4 6, then 7 2 5 0 and 3 6 1 4.
        let even = _mm_shuffle_ps::<0b_11_01_10_00>(low, high);
        let odd = _mm_shuffle_ps::<0b_10_00_11_01>(low, high);
        store(&mut io.floats.0, at, _mm_shuffle_ps::<0b_00_10_01_11>(even, even));
        store(&mut io.floats.0, at + 4, _mm_shuffle_ps::<0b_10_00_11_01>(odd, odd));
    }
}

/// Every lane is written to where the next one of the mask goes; what the last of them wrote
/// behind the end is put right.
#[target_feature(enable = "sse2")]
fn compress_store(io: &mut Io) {
    let mut n = 0;
    for at in (0..N).step_by(LANES) {
        let Regs { a, b, .. } = Regs::load(io, at);
        let mask = _mm_movemask_ps(_mm_cmplt_ps(a, b)) as usize;
        let mut lanes = [0.0; LANES];
        store(&mut lanes, 0, a);
        let count = (0x4332_3221_3221_2110_u64 >> (4 * mask)) as usize & 0xf;
        let (to, end) = (io.floats.0[n..].as_mut_ptr(), n + count);
        // SAFETY: the row is twice as long as all that is written.
        unsafe {
            let behind = *to.add(count);
            *to = lanes[0];
            let to = to.add(mask & 1);
            *to = lanes[1];
            let to = to.add(mask >> 1 & 1);
            *to = lanes[2];
            let to = to.add(mask >> 2 & 1);
            *to = lanes[3];
            *to.add(mask >> 3) = behind;
        }
        n = end;
    }
    io.bits.0[0] = n as u32;
}

#[target_feature(enable = "sse2")]
fn prefix(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let n = io.u[0].0[at / LANES] as usize % LANES;
        let (from, to) = (io.f[0].0[at..].as_ptr(), io.floats.0[at..].as_mut_ptr());
        // SAFETY: what is read and written are the first `n` of at least four elements.
        unsafe {
            let x = match n {
                0 => _mm_setzero_ps(),
                1 => _mm_load_ss(from),
                2 => _mm_castpd_ps(_mm_load_sd(from.cast())),
                _ => {
                    _mm_movelh_ps(_mm_castpd_ps(_mm_load_sd(from.cast())), _mm_load_ss(from.add(2)))
                }
            };
            if n & 2 == 2 {
                _mm_store_sd(to.cast(), _mm_castps_pd(x));
                if n & 1 == 1 {
                    _mm_store_ss(to.add(2), high(x));
                }
            } else if n & 1 == 1 {
                _mm_store_ss(to, x);
            }
        }
    }
}

#[target_feature(enable = "sse2")]
fn load_masked(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let Regs { a, b, c, .. } = Regs::load(io, at);
        let x = blend(_mm_cmplt_ps(a, b), c, _mm_set1_ps(1.0));
        store(&mut io.floats.0, at, x);
    }
}

#[target_feature(enable = "sse2")]
fn store_masked(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let Regs { a, b, .. } = Regs::load(io, at);
        let x = blend(_mm_cmplt_ps(a, b), a, load(&io.floats.0, at));
        store(&mut io.floats.0, at, x);
    }
}

#[target_feature(enable = "sse2")]
fn gather(io: &mut Io) {
    let row = &io.f[0].0;
    for at in (0..N).step_by(LANES) {
        let index = _mm_srli_epi32::<{ INDEX_SHIFT as i32 }>(load_epi32(&io.u[0].0, at));
        let low = _mm_cvtsi128_si64(index) as u64;
        let high = _mm_cvtsi128_si64(_mm_unpackhi_epi64(index, index)) as u64;
        let x = _mm_setr_ps(
            row[low as u32 as usize],
            row[(low >> 32) as usize],
            row[high as u32 as usize],
            row[(high >> 32) as usize],
        );
        store(&mut io.floats.0, at, x);
    }
}

#[target_feature(enable = "sse2")]
fn dot(io: &mut Io) {
    for at in (0..BOXES).step_by(LANES) {
        let x = dot3(load3(io, 0, at), load3(io, 3, at));
        store(&mut io.floats.0, at, x);
    }
}

#[target_feature(enable = "sse2")]
fn slab(io: &mut Io) {
    let (origin, inverse) = (splat3(ORIGIN), splat3(INVERSE));
    let infinity = _mm_set1_ps(f32::INFINITY);
    for at in (0..BOXES).step_by(LANES) {
        let [lx, ly, lz] = mul3(sub3(load3(io, 0, at), origin), inverse);
        let [hx, hy, hz] = mul3(sub3(load3(io, 3, at), origin), inverse);
        let enter = _mm_max_ps(_mm_min_ps(lx, hx), _mm_setzero_ps());
        let enter = _mm_max_ps(enter, _mm_min_ps(ly, hy));
        let enter = _mm_max_ps(enter, _mm_min_ps(lz, hz));
        let exit = _mm_min_ps(_mm_max_ps(lx, hx), _mm_max_ps(ly, hy));
        let exit = _mm_min_ps(exit, _mm_max_ps(lz, hz));
        let x = blend(_mm_cmple_ps(enter, exit), enter, infinity);
        store(&mut io.floats.0, at, x);
    }
}

#[target_feature(enable = "sse2")]
fn moller_trumbore(io: &mut Io) {
    let (origin, direction) = (splat3(ORIGIN), splat3(DIRECTION));
    let (zero, one) = (_mm_setzero_ps(), _mm_set1_ps(1.0));
    let infinity = _mm_set1_ps(f32::INFINITY);
    for at in (0..TRIANGLES).step_by(LANES) {
        let (e1, e2) = (load3(io, 3, at), load3(io, 6, at));
        let p = cross3(direction, e2);
        let inverse = _mm_div_ps(one, dot3(e1, p));
        let from = sub3(origin, load3(io, 0, at));
        let u = _mm_mul_ps(dot3(from, p), inverse);
        let q = cross3(from, e1);
        let v = _mm_mul_ps(dot3(direction, q), inverse);
        let t = _mm_mul_ps(dot3(e2, q), inverse);
        let inside = _mm_and_ps(_mm_cmple_ps(zero, u), _mm_cmple_ps(zero, v));
        let inside = _mm_and_ps(inside, _mm_cmple_ps(_mm_add_ps(u, v), one));
        let inside = _mm_and_ps(inside, _mm_cmplt_ps(zero, t));
        store(&mut io.floats.0, at, blend(inside, t, infinity));
    }
}

#[target_feature(enable = "sse2")]
fn argmin_all(io: &mut Io) {
    let mut least = _mm_set1_ps(f32::INFINITY);
    let (mut place, mut here) = (_mm_setzero_si128(), _mm_set_epi32(3, 2, 1, 0));
    for at in (0..N).step_by(LANES) {
        let x = load(&io.f[0].0, at);
        let less = _mm_cmplt_ps(x, least);
        // The lesser, and the old one of equals and for NaN.
        least = _mm_min_ps(x, least);
        place = blend_epi32(bits(less), here, place);
        here = _mm_add_epi32(here, _mm_set1_epi32(LANES as i32));
    }
    let value = hmin_ps(least);
    let equal = bits(_mm_cmpeq_ps(least, _mm_set1_ps(value)));
    let mut places = [0; 4];
    store_epi32(&mut places, 0, blend_epi32(equal, place, _mm_set1_epi32(-1)));
    io.bits.0[0] = places.into_iter().fold(u32::MAX, u32::min);
    io.floats.0[0] = value;
}

#[target_feature(enable = "sse2")]
fn rsqrt_normalise(io: &mut Io) {
    for at in (0..BOXES).step_by(LANES) {
        let v = load3(io, 0, at);
        let r = rsqrt(dot3(v, v));
        let [x, y, z] = mul3(v, [r, r, r]);
        store(&mut io.floats.0, at, x);
        store(&mut io.floats.0, BOXES + at, y);
        store(&mut io.floats.0, 2 * BOXES + at, z);
    }
}

#[target_feature(enable = "sse2")]
fn floor_to_int(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let x = load(&io.f[0].0, at);
        // Toward zero, and one less where that is above.
        let integer = _mm_cvttps_epi32(x);
        let above = bits(_mm_cmplt_ps(x, _mm_cvtepi32_ps(integer)));
        store_epi32(&mut io.bits.0, at, _mm_add_epi32(integer, above));
    }
}

#[target_feature(enable = "sse2")]
fn transpose4x4(io: &mut Io) {
    for at in (0..N).step_by(16) {
        let (mut a, mut b) = (load(&io.f[0].0, at), load(&io.f[0].0, at + 4));
        let (mut c, mut d) = (load(&io.f[0].0, at + 8), load(&io.f[0].0, at + 12));
        _MM_TRANSPOSE4_PS(&mut a, &mut b, &mut c, &mut d);
        store(&mut io.floats.0, at, a);
        store(&mut io.floats.0, at + 4, b);
        store(&mut io.floats.0, at + 8, c);
        store(&mut io.floats.0, at + 12, d);
    }
}

#[target_feature(enable = "sse2")]
fn hmin(io: &mut Io) {
    for k in 0..N / 8 {
        let x = _mm_min_ps(load(&io.f[0].0, 8 * k), load(&io.f[0].0, 8 * k + 4));
        io.floats.0[k] = hmin_ps(x);
    }
}
