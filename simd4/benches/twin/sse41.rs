//! SSE4.1: what it does better than SSE2.

use core::arch::x86_64::*;

use super::xmm::*;
use super::{Twin, twins};
use crate::io::{Io, N};
use crate::kernels::{BOXES, DIRECTION, INVERSE, ORIGIN, TRIANGLES};

/// `m ? a : b`
#[target_feature(enable = "sse4.1")]
#[inline]
fn blend(m: __m128, a: __m128, b: __m128) -> __m128 {
    _mm_blendv_ps(b, a, m)
}

/// `m ? a : b`
#[target_feature(enable = "sse4.1")]
#[inline]
fn blend_epi32(m: __m128i, a: __m128i, b: __m128i) -> __m128i {
    _mm_blendv_epi8(b, a, m)
}

/// `a > b` on unsigned lanes, turned round.
#[target_feature(enable = "sse4.1")]
#[inline]
fn le_epu32(a: __m128i, b: __m128i) -> __m128i {
    _mm_cmpeq_epi32(_mm_min_epu32(a, b), a)
}

/// As SSE2's.
#[target_feature(enable = "sse4.1")]
#[inline]
fn rcp(x: __m128) -> __m128 {
    let r = _mm_rcp_ps(x);
    let error = _mm_sub_ps(_mm_set1_ps(1.0), _mm_mul_ps(x, r));
    let better = _mm_add_ps(_mm_mul_ps(r, error), r);
    blend(_mm_cmpord_ps(better, better), better, r)
}

/// The least of the mask's lanes and where it is.
#[target_feature(enable = "sse4.1")]
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

twins! { "sse4.1";
    in_full: argmin load_masked store_masked
        slab moller_trumbore argmin_all floor_to_int;

    min_num = map |r| {
        let least = blend(_mm_cmpord_ps(r.b, r.b), _mm_min_ps(r.a, r.b), r.a);
        bits(_mm_or_ps(least, _mm_and_ps(_mm_cmpeq_ps(r.a, r.b), r.a)))
    };
    max_num = map |r| {
        let greatest = blend(_mm_cmpord_ps(r.b, r.b), _mm_max_ps(r.a, r.b), r.a);
        bits(_mm_and_ps(greatest, _mm_or_ps(_mm_cmpneq_ps(r.a, r.b), r.a)))
    };

    floor = map |r| bits(_mm_floor_ps(r.a));
    ceil = map |r| bits(_mm_ceil_ps(r.a));
    trunc = map |r| bits(_mm_round_ps::<{ _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC }>(r.a));
    round_ties_even = map |r| {
        bits(_mm_round_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(r.a))
    };

    rcp_fast = map |r| bits(rcp(r.a));

    lt = map |r| bits(blend(_mm_cmplt_ps(r.a, r.b), r.a, r.c));
    ne = map |r| bits(blend(_mm_cmpneq_ps(r.a, r.b), r.a, r.c));
    lt_i32 = map |r| blend_epi32(_mm_cmplt_epi32(r.i, r.j), r.i, r.j);
    le_u32 = map |r| blend_epi32(le_epu32(r.u, r.v), r.v, r.u);
    between = map |r| {
        let between = _mm_and_ps(_mm_cmple_ps(r.a, r.b), _mm_cmplt_ps(r.b, r.c));
        bits(blend(between, r.a, r.c))
    };
    and_not = map |r| {
        let mask = _mm_andnot_ps(_mm_cmplt_ps(r.b, r.c), _mm_cmple_ps(r.a, r.b));
        bits(blend(mask, r.a, r.c))
    };

    // The halves beside the high words of 2^23 and 2^39.
    from_u32 = map |r| {
        let low = _mm_blend_epi16::<0xaa>(r.u, _mm_set1_epi32(0x4b00_0000));
        let high = _mm_blend_epi16::<0xaa>(_mm_srli_epi32::<16>(r.u), _mm_set1_epi32(0x5300_0000));
        let high = _mm_sub_ps(_mm_castsi128_ps(high), _mm_set1_ps(549_764_202_496.0));
        bits(_mm_add_ps(high, _mm_castsi128_ps(low)))
    };

    mul_i32 = map |r| _mm_mullo_epi32(r.i, r.j);
    min_i32 = map |r| _mm_min_epi32(r.i, r.j);
    max_u32 = map |r| _mm_max_epu32(r.u, r.v);
    abs_i32 = map |r| _mm_abs_epi32(r.i);

    permute = map |r| {
        let lanes = _mm_and_si128(r.u, _mm_set1_epi32(3));
        let fours = _mm_set_epi8(12, 12, 12, 12, 8, 8, 8, 8, 4, 4, 4, 4, 0, 0, 0, 0);
        let bytes = _mm_slli_epi32::<2>(_mm_shuffle_epi8(lanes, fours));
        let bytes = _mm_or_si128(bytes, _mm_set1_epi32(0x0302_0100));
        _mm_shuffle_epi8(bits(r.a), bytes)
    };

    reduce_max_u32 = fold |r| {
        let x = _mm_max_epu32(r.u, _mm_shuffle_epi32::<0b_11_10_11_10>(r.u));
        _mm_cvtsi128_si32(_mm_max_epu32(x, _mm_shuffle_epi32::<1>(x))) as u32
    };
}

#[target_feature(enable = "sse4.1")]
fn argmin(io: &mut Io) {
    for k in 0..N / LANES {
        let Regs { a, b, c, .. } = Regs::load(io, k * LANES);
        if let Some((lane, value)) = argmin_ps(a, _mm_cmplt_ps(b, c)) {
            io.bits.0[k] = lane as u32;
            io.floats.0[k] = value;
        }
    }
}

#[target_feature(enable = "sse4.1")]
fn load_masked(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let Regs { a, b, c, .. } = Regs::load(io, at);
        let x = blend(_mm_cmplt_ps(a, b), c, _mm_set1_ps(1.0));
        store(&mut io.floats.0, at, x);
    }
}

#[target_feature(enable = "sse4.1")]
fn store_masked(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let Regs { a, b, .. } = Regs::load(io, at);
        let x = blend(_mm_cmplt_ps(a, b), a, load(&io.floats.0, at));
        store(&mut io.floats.0, at, x);
    }
}

#[target_feature(enable = "sse4.1")]
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

#[target_feature(enable = "sse4.1")]
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

#[target_feature(enable = "sse4.1")]
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
    let x = blend_epi32(equal, place, _mm_set1_epi32(-1));
    let x = _mm_min_epu32(x, _mm_shuffle_epi32::<0b_11_10_11_10>(x));
    io.bits.0[0] = _mm_cvtsi128_si32(_mm_min_epu32(x, _mm_shuffle_epi32::<1>(x))) as u32;
    io.floats.0[0] = value;
}

#[target_feature(enable = "sse4.1")]
fn floor_to_int(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let x = _mm_cvttps_epi32(_mm_floor_ps(load(&io.f[0].0, at)));
        store_epi32(&mut io.bits.0, at, x);
    }
}
