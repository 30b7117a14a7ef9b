//! AVX2 with FMA and BMI, in registers of eight lanes.

use core::arch::x86_64::*;

use super::{Twin, twins};
use crate::io::{Io, N};
use crate::kernels::{BOXES, DIRECTION, INVERSE, ORIGIN, TRIANGLES};
use crate::ops::INDEX_SHIFT;

const LANES: usize = 8;

/// One register of each operand.
struct Regs {
    a: __m256,
    b: __m256,
    c: __m256,
    i: __m256i,
    j: __m256i,
    u: __m256i,
    v: __m256i,
    n: __m128i,
}

impl Regs {
    #[target_feature(enable = "avx2")]
    #[inline]
    fn load(io: &Io, at: usize) -> Regs {
        Regs {
            a: load(&io.f[0].0, at),
            b: load(&io.f[1].0, at),
            c: load(&io.f[2].0, at),
            i: load_epi32(&io.i[0].0, at),
            j: load_epi32(&io.i[1].0, at),
            u: load_epi32(&io.u[0].0, at),
            v: load_epi32(&io.u[1].0, at),
            n: _mm_cvtsi32_si128(io.shift as i32),
        }
    }
}

#[target_feature(enable = "avx2")]
#[inline]
fn load(row: &[f32], at: usize) -> __m256 {
    debug_assert!(at + LANES <= row.len());
    // SAFETY: the loops stay within their rows.
    unsafe { _mm256_loadu_ps(row.as_ptr().add(at)) }
}

#[target_feature(enable = "avx2")]
#[inline]
fn load_epi32<T>(row: &[T], at: usize) -> __m256i {
    debug_assert!(at + LANES <= row.len() && size_of::<T>() == 4);
    // SAFETY: the loops stay within their rows.
    unsafe { _mm256_loadu_si256(row.as_ptr().add(at).cast()) }
}

#[target_feature(enable = "avx2")]
#[inline]
fn store(row: &mut [f32], at: usize, x: __m256) {
    debug_assert!(at + LANES <= row.len());
    // SAFETY: the loops stay within their rows.
    unsafe { _mm256_storeu_ps(row.as_mut_ptr().add(at), x) }
}

#[target_feature(enable = "avx2")]
#[inline]
fn store_epi32(row: &mut [u32], at: usize, x: __m256i) {
    debug_assert!(at + LANES <= row.len());
    // SAFETY: the loops stay within their rows.
    unsafe { _mm256_storeu_si256(row.as_mut_ptr().add(at).cast(), x) }
}

#[target_feature(enable = "avx2")]
#[inline]
fn bits(x: __m256) -> __m256i {
    _mm256_castps_si256(x)
}

/// `m ? a : b`
#[target_feature(enable = "avx2")]
#[inline]
fn blend(m: __m256, a: __m256, b: __m256) -> __m256 {
    _mm256_blendv_ps(b, a, m)
}

/// `m ? a : b`
#[target_feature(enable = "avx2")]
#[inline]
fn blend_epi32(m: __m256i, a: __m256i, b: __m256i) -> __m256i {
    _mm256_blendv_epi8(b, a, m)
}

#[target_feature(enable = "avx2")]
#[inline]
fn lt_ps(a: __m256, b: __m256) -> __m256 {
    _mm256_cmp_ps::<_CMP_LT_OQ>(a, b)
}

#[target_feature(enable = "avx2")]
#[inline]
fn le_ps(a: __m256, b: __m256) -> __m256 {
    _mm256_cmp_ps::<_CMP_LE_OQ>(a, b)
}

#[target_feature(enable = "avx2")]
#[inline]
fn is_number(x: __m256) -> __m256 {
    _mm256_cmp_ps::<_CMP_ORD_Q>(x, x)
}

#[target_feature(enable = "avx2")]
#[inline]
fn sign() -> __m256 {
    _mm256_set1_ps(-0.0)
}

#[target_feature(enable = "avx2")]
#[inline]
fn iota() -> __m256i {
    _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0)
}

/// One Newton step; the estimate where that makes a NaN of 0 or ∞.
#[target_feature(enable = "avx2,fma")]
#[inline]
fn rcp(x: __m256) -> __m256 {
    let r = _mm256_rcp_ps(x);
    let better = _mm256_fmadd_ps(r, _mm256_fnmadd_ps(x, r, _mm256_set1_ps(1.0)), r);
    blend(is_number(better), better, r)
}

/// One Newton step; the estimate, 0 or ∞ and as good when halved, where that makes a NaN.
#[target_feature(enable = "avx2,fma")]
#[inline]
fn rsqrt(x: __m256) -> __m256 {
    let (r, half) = (_mm256_rsqrt_ps(x), _mm256_set1_ps(0.5));
    let halved = _mm256_mul_ps(r, half);
    let error = _mm256_fnmadd_ps(_mm256_mul_ps(x, halved), r, half);
    _mm256_max_ps(_mm256_fmadd_ps(r, error, r), halved)
}

/// Saturating.
#[target_feature(enable = "avx2")]
#[inline]
fn int(x: __m256) -> __m256i {
    let great = bits(le_ps(_mm256_set1_ps(2_147_483_648.0), x));
    let turned = _mm256_xor_si256(_mm256_cvttps_epi32(x), great);
    _mm256_and_si256(turned, bits(is_number(x)))
}

/// For what fits; 2^31 with anything from 2^32 on.
#[target_feature(enable = "avx2")]
#[inline]
fn uint_fast(x: __m256) -> __m256i {
    let low = _mm256_cvttps_epi32(x);
    let high = _mm256_cvttps_epi32(_mm256_sub_ps(x, _mm256_set1_ps(2_147_483_648.0)));
    _mm256_or_si256(low, _mm256_and_si256(high, _mm256_srai_epi32::<31>(low)))
}

/// Saturating.
#[target_feature(enable = "avx2")]
#[inline]
fn uint(x: __m256) -> __m256i {
    let x = _mm256_max_ps(x, _mm256_setzero_ps());
    _mm256_or_si256(uint_fast(x), bits(le_ps(_mm256_set1_ps(4_294_967_296.0), x)))
}

/// The halves beside the high words of 2^23 and 2^39.
#[target_feature(enable = "avx2")]
#[inline]
fn float(u: __m256i) -> __m256 {
    let low = _mm256_blend_epi16::<0xaa>(u, _mm256_set1_epi32(0x4b00_0000));
    let high = _mm256_srli_epi32::<16>(u);
    let high = _mm256_blend_epi16::<0xaa>(high, _mm256_set1_epi32(0x5300_0000));
    let high = _mm256_sub_ps(_mm256_castsi256_ps(high), _mm256_set1_ps(549_764_202_496.0));
    _mm256_add_ps(high, _mm256_castsi256_ps(low))
}

/// The lower half and the higher.
#[target_feature(enable = "avx2")]
#[inline]
fn halves(x: __m256) -> (__m128, __m128) {
    (_mm256_castps256_ps128(x), _mm256_extractf128_ps::<1>(x))
}

/// The least of eight, in the tree's order.
#[target_feature(enable = "avx2")]
#[inline]
fn hmin_ps(x: __m256) -> f32 {
    let (low, high) = halves(x);
    let x = _mm_min_ps(low, high);
    let x = _mm_min_ps(x, _mm_movehl_ps(x, x));
    _mm_cvtss_f32(_mm_min_ps(x, _mm_movehdup_ps(x)))
}

/// The least of the mask's lanes and where it is.
#[target_feature(enable = "avx2,bmi1")]
#[inline]
fn argmin_ps(x: __m256, mask: __m256) -> Option<(usize, f32)> {
    let allowed = _mm256_and_ps(mask, is_number(x));
    let masked = blend(allowed, x, _mm256_set1_ps(f32::INFINITY));
    let least = _mm256_min_ps(masked, _mm256_permute2f128_ps::<1>(masked, masked));
    let least = _mm256_min_ps(least, _mm256_permute_ps::<0b_01_00_11_10>(least));
    let least = _mm256_min_ps(least, _mm256_permute_ps::<0b_10_11_00_01>(least));
    let equal = _mm256_and_ps(allowed, _mm256_cmp_ps::<_CMP_EQ_OQ>(x, least));
    match _mm256_movemask_ps(equal) {
        0 => None,
        equal => {
            let lane = equal.trailing_zeros();
            let first = _mm256_castsi128_si256(_mm_cvtsi32_si128(lane as i32));
            let value = _mm256_cvtss_f32(_mm256_permutevar8x32_ps(x, first));
            Some((lane as usize, value))
        }
    }
}

twins! { "avx2,fma,bmi1,bmi2,lzcnt,popcnt";
    in_full: argmin swizzle compress_store prefix load_masked store_masked gather
        dot slab moller_trumbore argmin_all rsqrt_normalise floor_to_int transpose4x4 hmin;

    add = map |r| bits(_mm256_add_ps(r.a, r.b));
    sub = map |r| bits(_mm256_sub_ps(r.a, r.b));
    mul = map |r| bits(_mm256_mul_ps(r.a, r.b));
    div = map |r| bits(_mm256_div_ps(r.a, r.b));
    neg = map |r| bits(_mm256_xor_ps(r.a, sign()));
    abs = map |r| bits(_mm256_andnot_ps(sign(), r.a));
    sqrt = map |r| bits(_mm256_sqrt_ps(r.a));
    copysign = map |r| {
        bits(_mm256_or_ps(_mm256_and_ps(sign(), r.b), _mm256_andnot_ps(sign(), r.a)))
    };

    mul_add = map |r| bits(_mm256_add_ps(_mm256_mul_ps(r.a, r.b), r.c));
    nmul_sub = map |r| {
        bits(_mm256_sub_ps(_mm256_xor_ps(_mm256_mul_ps(r.a, r.b), sign()), r.c))
    };
    fused_mul_add = map |r| bits(_mm256_fmadd_ps(r.a, r.b, r.c));
    fused_nmul_sub = map |r| bits(_mm256_fnmsub_ps(r.a, r.b, r.c));
    mul_add_fast = map |r| bits(_mm256_fmadd_ps(r.a, r.b, r.c));

    min = map |r| bits(_mm256_min_ps(r.a, r.b));
    max = map |r| bits(_mm256_max_ps(r.a, r.b));
    // Of equals, a negative `a` and a positive `b` come second; a NaN that is second is replaced.
    min_num = map |r| {
        let (first, second) = (blend(r.a, r.b, r.a), blend(r.a, r.a, r.b));
        bits(blend(is_number(second), _mm256_min_ps(first, second), first))
    };
    max_num = map |r| {
        let (first, second) = (blend(r.a, r.a, r.b), blend(r.a, r.b, r.a));
        bits(blend(is_number(second), _mm256_max_ps(first, second), first))
    };

    floor = map |r| bits(_mm256_floor_ps(r.a));
    ceil = map |r| bits(_mm256_ceil_ps(r.a));
    trunc = map |r| bits(_mm256_round_ps::<{ _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC }>(r.a));
    round_ties_even = map |r| {
        bits(_mm256_round_ps::<{ _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC }>(r.a))
    };

    rcp_est = map |r| bits(_mm256_rcp_ps(r.a));
    rsqrt_est = map |r| bits(_mm256_rsqrt_ps(r.a));
    rcp_fast = map |r| bits(rcp(r.a));
    rsqrt_fast = map |r| bits(rsqrt(r.a));

    lt = map |r| bits(blend(lt_ps(r.a, r.b), r.a, r.c));
    ne = map |r| bits(blend(_mm256_cmp_ps::<_CMP_NEQ_UQ>(r.a, r.b), r.a, r.c));
    lt_i32 = map |r| blend_epi32(_mm256_cmpgt_epi32(r.j, r.i), r.i, r.j);
    le_u32 = map |r| blend_epi32(_mm256_cmpeq_epi32(_mm256_min_epu32(r.u, r.v), r.u), r.v, r.u);
    between = map |r| bits(blend(_mm256_and_ps(le_ps(r.a, r.b), lt_ps(r.b, r.c)), r.a, r.c));
    and_not = map |r| bits(blend(_mm256_andnot_ps(lt_ps(r.b, r.c), le_ps(r.a, r.b)), r.a, r.c));
    bitmask = fold |r| _mm256_movemask_ps(lt_ps(r.a, r.b)) as u32;
    any = fold |r| u32::from(_mm256_movemask_ps(lt_ps(r.a, r.b)) != 0);
    all = fold |r| u32::from(_mm256_movemask_ps(lt_ps(r.a, r.b)) == 0xff);
    count = fold |r| _mm256_movemask_ps(lt_ps(r.a, r.b)).count_ones();
    first = fold |r| match _mm256_movemask_ps(lt_ps(r.a, r.b)) {
        0 => u32::MAX,
        mask => mask.trailing_zeros(),
    };

    to_i32 = map |r| int(r.a);
    to_u32 = map |r| uint(r.a);
    to_i32_fast = map |r| _mm256_cvttps_epi32(r.a);
    to_u32_fast = map |r| uint_fast(r.a);
    from_i32 = map |r| bits(_mm256_cvtepi32_ps(r.i));
    from_u32 = map |r| bits(float(r.u));

    add_i32 = map |r| _mm256_add_epi32(r.i, r.j);
    mul_i32 = map |r| _mm256_mullo_epi32(r.i, r.j);
    min_i32 = map |r| _mm256_min_epi32(r.i, r.j);
    max_u32 = map |r| _mm256_max_epu32(r.u, r.v);
    abs_i32 = map |r| _mm256_abs_epi32(r.i);
    shl = map |r| _mm256_sll_epi32(r.u, r.n);
    shr = map |r| _mm256_srl_epi32(r.u, r.n);
    sar = map |r| _mm256_sra_epi32(r.i, r.n);
    logic = map |r| {
        let not = _mm256_xor_si256(r.u, _mm256_set1_epi32(-1));
        _mm256_xor_si256(_mm256_and_si256(r.u, r.v), not)
    };

    rotate = map |r| {
        let order = _mm256_set_epi32(0, 7, 6, 5, 4, 3, 2, 1);
        bits(_mm256_permutevar8x32_ps(r.a, order))
    };
    reverse = map |r| {
        let order = _mm256_set_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        bits(_mm256_permutevar8x32_ps(r.a, order))
    };
    zip = pair |r| {
        let (even, odd) = (_mm256_unpacklo_ps(r.a, r.b), _mm256_unpackhi_ps(r.a, r.b));
        (
            _mm256_permute2f128_ps::<0x20>(even, odd),
            _mm256_permute2f128_ps::<0x31>(even, odd),
        )
    };
    unzip = pair |r| {
        (
            _mm256_castpd_ps(_mm256_permute4x64_pd::<0b_11_01_10_00>(_mm256_castps_pd(
                _mm256_shuffle_ps::<0b_10_00_10_00>(r.a, r.b),
            ))),
            _mm256_castpd_ps(_mm256_permute4x64_pd::<0b_11_01_10_00>(_mm256_castps_pd(
                _mm256_shuffle_ps::<0b_11_01_11_01>(r.a, r.b),
            ))),
        )
    };

    reduce_sum = reduce |r| {
        let (low, high) = halves(r.a);
        let x = _mm_add_ps(low, high);
        let x = _mm_add_ps(x, _mm_movehl_ps(x, x));
        _mm_cvtss_f32(_mm_add_ss(x, _mm_movehdup_ps(x)))
    };
    reduce_product = reduce |r| {
        let (low, high) = halves(r.a);
        let x = _mm_mul_ps(low, high);
        let x = _mm_mul_ps(x, _mm_movehl_ps(x, x));
        _mm_cvtss_f32(_mm_mul_ss(x, _mm_movehdup_ps(x)))
    };
    reduce_min = reduce |r| hmin_ps(r.a);
    reduce_max_u32 = fold |r| hmax_epu32(r.u);

    permute = map |r| bits(_mm256_permutevar8x32_ps(r.a, r.u));

    copy = map |r| bits(r.a);
}

#[target_feature(enable = "avx2,bmi1")]
fn argmin(io: &mut Io) {
    for k in 0..N / LANES {
        let Regs { a, b, c, .. } = Regs::load(io, k * LANES);
        if let Some((lane, value)) = argmin_ps(a, lt_ps(b, c)) {
            io.bits.0[k] = lane as u32;
            io.floats.0[k] = value;
        }
    }
}

/// The greatest of eight.
#[target_feature(enable = "avx2")]
#[inline]
fn hmax_epu32(x: __m256i) -> u32 {
    let x = _mm_max_epu32(_mm256_castsi256_si128(x), _mm256_extracti128_si256::<1>(x));
    let x = _mm_max_epu32(x, _mm_shuffle_epi32::<0b_11_10_11_10>(x));
    _mm_cvtsi128_si32(_mm_max_epu32(x, _mm_shuffle_epi32::<1>(x))) as u32
}

#[target_feature(enable = "avx2")]
fn swizzle(io: &mut Io) {
    let order = _mm256_set_epi32(4, 1, 6, 3, 0, 5, 2, 7);
    for at in (0..N).step_by(LANES) {
        let x = _mm256_permutevar8x32_ps(load(&io.f[0].0, at), order);
        store(&mut io.floats.0, at, x);
    }
}

/// Every lane is written to where the next one of the mask goes; what the last of them wrote
/// behind the end is put right.
#[target_feature(enable = "avx2,bmi1,popcnt")]
fn compress_store(io: &mut Io) {
    let mut n = 0;
    for at in (0..N).step_by(LANES) {
        let Regs { a, b, .. } = Regs::load(io, at);
        let mask = _mm256_movemask_ps(lt_ps(a, b)) as usize;
        let mut lanes = [0.0; LANES];
        store(&mut lanes, 0, a);
        let count = mask.count_ones() as usize;
        let mut to = io.floats.0[n..].as_mut_ptr();
        // SAFETY: the row is twice as long as all that is written.
        unsafe {
            let end = to.add(count);
            let behind = *end;
            for (lane, x) in lanes.into_iter().enumerate() {
                *to = x;
                to = to.add(mask >> lane & 1);
            }
            *end = behind;
        }
        n += count;
    }
    io.bits.0[0] = n as u32;
}

#[target_feature(enable = "avx2")]
fn prefix(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let n = io.u[0].0[at / LANES] as usize % LANES;
        let (from, to) = (io.f[0].0[at..].as_ptr(), io.floats.0[at..].as_mut_ptr());
        let first = _mm256_cmpgt_epi32(_mm256_set1_epi32(n as i32), iota());
        // SAFETY: what is read and written are the first `n` of at least eight elements.
        unsafe { _mm256_maskstore_ps(to, first, _mm256_maskload_ps(from, first)) }
    }
}

#[target_feature(enable = "avx2")]
fn load_masked(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let Regs { a, b, c, .. } = Regs::load(io, at);
        let x = blend(lt_ps(a, b), c, _mm256_set1_ps(1.0));
        store(&mut io.floats.0, at, x);
    }
}

/// Not by the instruction for it, which is slow on half of the CPUs; `blend` before a store would
/// become that one.
#[target_feature(enable = "avx2")]
fn store_masked(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let Regs { a, b, .. } = Regs::load(io, at);
        let (mask, old) = (lt_ps(a, b), load(&io.floats.0, at));
        let x = _mm256_or_ps(_mm256_and_ps(mask, a), _mm256_andnot_ps(mask, old));
        store(&mut io.floats.0, at, x);
    }
}

#[target_feature(enable = "avx2")]
fn gather(io: &mut Io) {
    let last = _mm256_set1_epi32(N as i32 - 1);
    for at in (0..N).step_by(LANES) {
        let index = _mm256_srli_epi32::<{ INDEX_SHIFT as i32 }>(load_epi32(&io.u[0].0, at));
        let inside = _mm256_cmpeq_epi32(_mm256_min_epu32(index, last), index);
        assert!(_mm256_movemask_epi8(inside) == -1);
        // SAFETY: the indices are within the row.
        let x = unsafe { _mm256_i32gather_ps::<4>(io.f[0].0.as_ptr(), index) };
        store(&mut io.floats.0, at, x);
    }
}

/// The same in every lane, by component.
#[target_feature(enable = "avx2")]
#[inline]
fn splat3([x, y, z]: [f32; 3]) -> [__m256; 3] {
    [_mm256_set1_ps(x), _mm256_set1_ps(y), _mm256_set1_ps(z)]
}

/// Three rows from the given one on.
#[target_feature(enable = "avx2")]
#[inline]
fn load3(io: &Io, row: usize, at: usize) -> [__m256; 3] {
    [load(&io.f[row].0, at), load(&io.f[row + 1].0, at), load(&io.f[row + 2].0, at)]
}

#[target_feature(enable = "avx2")]
#[inline]
fn sub3([ax, ay, az]: [__m256; 3], [bx, by, bz]: [__m256; 3]) -> [__m256; 3] {
    [_mm256_sub_ps(ax, bx), _mm256_sub_ps(ay, by), _mm256_sub_ps(az, bz)]
}

#[target_feature(enable = "avx2")]
#[inline]
fn mul3([ax, ay, az]: [__m256; 3], [bx, by, bz]: [__m256; 3]) -> [__m256; 3] {
    [_mm256_mul_ps(ax, bx), _mm256_mul_ps(ay, by), _mm256_mul_ps(az, bz)]
}

#[target_feature(enable = "avx2")]
#[inline]
fn dot3(a: [__m256; 3], b: [__m256; 3]) -> __m256 {
    let [x, y, z] = mul3(a, b);
    _mm256_add_ps(_mm256_add_ps(x, y), z)
}

#[target_feature(enable = "avx2")]
#[inline]
fn cross3([ax, ay, az]: [__m256; 3], [bx, by, bz]: [__m256; 3]) -> [__m256; 3] {
    [
        _mm256_sub_ps(_mm256_mul_ps(ay, bz), _mm256_mul_ps(az, by)),
        _mm256_sub_ps(_mm256_mul_ps(az, bx), _mm256_mul_ps(ax, bz)),
        _mm256_sub_ps(_mm256_mul_ps(ax, by), _mm256_mul_ps(ay, bx)),
    ]
}

#[target_feature(enable = "avx2")]
fn dot(io: &mut Io) {
    for at in (0..BOXES).step_by(LANES) {
        let x = dot3(load3(io, 0, at), load3(io, 3, at));
        store(&mut io.floats.0, at, x);
    }
}

#[target_feature(enable = "avx2")]
fn slab(io: &mut Io) {
    let (origin, inverse) = (splat3(ORIGIN), splat3(INVERSE));
    let infinity = _mm256_set1_ps(f32::INFINITY);
    for at in (0..BOXES).step_by(LANES) {
        let [lx, ly, lz] = mul3(sub3(load3(io, 0, at), origin), inverse);
        let [hx, hy, hz] = mul3(sub3(load3(io, 3, at), origin), inverse);
        let enter = _mm256_max_ps(_mm256_min_ps(lx, hx), _mm256_setzero_ps());
        let enter = _mm256_max_ps(enter, _mm256_min_ps(ly, hy));
        let enter = _mm256_max_ps(enter, _mm256_min_ps(lz, hz));
        let exit = _mm256_min_ps(_mm256_max_ps(lx, hx), _mm256_max_ps(ly, hy));
        let exit = _mm256_min_ps(exit, _mm256_max_ps(lz, hz));
        store(&mut io.floats.0, at, blend(le_ps(enter, exit), enter, infinity));
    }
}

#[target_feature(enable = "avx2")]
fn moller_trumbore(io: &mut Io) {
    let (origin, direction) = (splat3(ORIGIN), splat3(DIRECTION));
    let (zero, one) = (_mm256_setzero_ps(), _mm256_set1_ps(1.0));
    let infinity = _mm256_set1_ps(f32::INFINITY);
    for at in (0..TRIANGLES).step_by(LANES) {
        let (e1, e2) = (load3(io, 3, at), load3(io, 6, at));
        let p = cross3(direction, e2);
        let inverse = _mm256_div_ps(one, dot3(e1, p));
        let from = sub3(origin, load3(io, 0, at));
        let u = _mm256_mul_ps(dot3(from, p), inverse);
        let q = cross3(from, e1);
        let v = _mm256_mul_ps(dot3(direction, q), inverse);
        let t = _mm256_mul_ps(dot3(e2, q), inverse);
        let inside = _mm256_and_ps(le_ps(zero, u), le_ps(zero, v));
        let inside = _mm256_and_ps(inside, le_ps(_mm256_add_ps(u, v), one));
        let inside = _mm256_and_ps(inside, lt_ps(zero, t));
        store(&mut io.floats.0, at, blend(inside, t, infinity));
    }
}

#[target_feature(enable = "avx2")]
fn argmin_all(io: &mut Io) {
    let mut least = _mm256_set1_ps(f32::INFINITY);
    let (mut place, mut here) = (_mm256_setzero_si256(), iota());
    for at in (0..N).step_by(LANES) {
        let x = load(&io.f[0].0, at);
        let less = lt_ps(x, least);
        // The lesser, and the old one of equals and for NaN.
        least = _mm256_min_ps(x, least);
        place = blend_epi32(bits(less), here, place);
        here = _mm256_add_epi32(here, _mm256_set1_epi32(LANES as i32));
    }
    let value = hmin_ps(least);
    let equal = bits(_mm256_cmp_ps::<_CMP_EQ_OQ>(least, _mm256_set1_ps(value)));
    let x = blend_epi32(equal, place, _mm256_set1_epi32(-1));
    let x = _mm_min_epu32(_mm256_castsi256_si128(x), _mm256_extracti128_si256::<1>(x));
    let x = _mm_min_epu32(x, _mm_shuffle_epi32::<0b_11_10_11_10>(x));
    io.bits.0[0] = _mm_cvtsi128_si32(_mm_min_epu32(x, _mm_shuffle_epi32::<1>(x))) as u32;
    io.floats.0[0] = value;
}

#[target_feature(enable = "avx2,fma")]
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

#[target_feature(enable = "avx2")]
fn floor_to_int(io: &mut Io) {
    for at in (0..N).step_by(LANES) {
        let x = _mm256_cvttps_epi32(_mm256_floor_ps(load(&io.f[0].0, at)));
        store_epi32(&mut io.bits.0, at, x);
    }
}

/// In registers of four lanes: two matrices at a time in eight take longer to bring together.
#[target_feature(enable = "avx2")]
fn transpose4x4(io: &mut Io) {
    for at in (0..N).step_by(16) {
        let (from, to) = (io.f[0].0[at..].as_ptr(), io.floats.0[at..].as_mut_ptr());
        // SAFETY: 16 elements are read and written.
        unsafe {
            let (mut a, mut b) = (_mm_loadu_ps(from), _mm_loadu_ps(from.add(4)));
            let (mut c, mut d) = (_mm_loadu_ps(from.add(8)), _mm_loadu_ps(from.add(12)));
            _MM_TRANSPOSE4_PS(&mut a, &mut b, &mut c, &mut d);
            _mm_storeu_ps(to, a);
            _mm_storeu_ps(to.add(4), b);
            _mm_storeu_ps(to.add(8), c);
            _mm_storeu_ps(to.add(12), d);
        }
    }
}

#[target_feature(enable = "avx2")]
fn hmin(io: &mut Io) {
    for k in 0..N / LANES {
        io.floats.0[k] = hmin_ps(load(&io.f[0].0, LANES * k));
    }
}
