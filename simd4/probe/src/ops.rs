//! The operations: `ops::LEVEL::TYPE::OPERATION` is a function that does it once.
//!
//! Operands and results pass by value under the C calling convention, which puts a register type
//! in a register: what such a function has besides its operation are copies.
#![allow(
    improper_ctypes_definitions,
    clippy::missing_safety_doc,
    reason = "only the assembly is of interest"
)]

/// Lanes in no order that an instruction would have: `1, 4, 7, …`, counted round.
pub struct Mixed<V>(std::marker::PhantomData<V>);

impl<V: simd4::Lanes> simd4::Swizzle for Mixed<V> {
    const INDEX: &'static [usize] = {
        const fn mixed(lanes: usize) -> [usize; 16] {
            let mut index = [0; 16];
            let mut i = 0;
            while i < lanes {
                index[i] = (3 * i + 1) % lanes;
                i += 1;
            }
            index
        }
        (const { &mixed(V::LANES) }).split_at(V::LANES).0
    };
}

/// A function for each line of a table: `$how` is the attribute that compiles it for its level.
macro_rules! probes {
    ($how:meta; $($op:ident($($operands:tt)*) -> $Result:ty = $body:expr;)*) => {$(
        #[inline(never)]
        #[$how]
        pub extern "C-unwind" fn $op($($operands)*) -> $Result {
            $body
        }
    )*};
}

// The tables. S is the token, V the vector and E its element; A its array, M its mask; F, I and U
// are the vectors of f32, i32 and u32 that have as many lanes, and B the aligned block.

macro_rules! lanes {
    ($how:meta) => {
        probes! { $how;
            splat(s: S, x: E) -> V = V::splat(s, x);
            from_array(s: S, a: &A) -> V = V::from_array(s, *a);
            to_array(a: V, to: &mut A) -> () = *to = a.to_array();
            iota(s: S) -> V = V::iota(s);
            lane(a: V, i: usize) -> E = a.lane(i);

            load(s: S, from: &[E]) -> V = V::load(s, from);
            store(a: V, to: &mut [E]) -> () = a.store(to);
            load_aligned(s: S, from: &B) -> V = V::load_aligned(s, from);
            store_aligned(a: V, to: &mut B) -> () = a.store_aligned(to);
            load_prefix(s: S, from: &[E], fill: E) -> V = V::load_prefix(s, from, fill);
            store_prefix(a: V, to: &mut [E]) -> () = a.store_prefix(to);
            load_masked(s: S, from: &[E], m: M, fill: E) -> V = V::load_masked(s, from, m, fill);
            store_masked(a: V, to: &mut [E], m: M) -> () = a.store_masked(to, m);
            gather(from: &[E], i: U) -> V = V::gather(from, i);
            compress_store(a: V, m: M, to: &mut [E]) -> usize = a.compress_store(m, to);

            add(a: V, b: V) -> V = a + b;
            sub(a: V, b: V) -> V = a - b;
            mul(a: V, b: V) -> V = a * b;
            add_assign(a: &mut V, b: V) -> () = *a += b;
            sub_assign(a: &mut V, b: V) -> () = *a -= b;
            mul_assign(a: &mut V, b: V) -> () = *a *= b;

            min(a: V, b: V) -> V = a.min(b);
            max(a: V, b: V) -> V = a.max(b);
            eq(a: V, b: V) -> M = a.eq(b);
            ne(a: V, b: V) -> M = a.ne(b);
            lt(a: V, b: V) -> M = a.lt(b);
            le(a: V, b: V) -> M = a.le(b);
            gt(a: V, b: V) -> M = a.gt(b);
            ge(a: V, b: V) -> M = a.ge(b);
            select(m: M, a: V, b: V) -> V = V::select(m, a, b);

            swizzle(a: V) -> V = a.swizzle::<crate::ops::Mixed<V>>();
            rotate(a: V) -> V = a.rotate::<1>();
            reverse(a: V) -> V = a.reverse();
            zip(a: V, b: V) -> (V, V) = a.zip(b);
            unzip(a: V, b: V) -> (V, V) = a.unzip(b);

            reduce_sum(a: V) -> E = a.reduce_sum();
            reduce_product(a: V) -> E = a.reduce_product();
            reduce_min(a: V) -> E = a.reduce_min();
            reduce_max(a: V) -> E = a.reduce_max();
            argmin(a: V, m: M) -> Option<(usize, E)> = a.argmin(m);
            argmax(a: V, m: M) -> Option<(usize, E)> = a.argmax(m);
        }
    };
}

macro_rules! floats {
    ($how:meta) => {
        probes! { $how;
            div(a: V, b: V) -> V = a / b;
            div_assign(a: &mut V, b: V) -> () = *a /= b;
            neg(a: V) -> V = -a;
            sqrt(a: V) -> V = a.sqrt();
            abs(a: V) -> V = a.abs();
            copysign(a: V, b: V) -> V = a.copysign(b);

            mul_add(a: V, b: V, c: V) -> V = a.mul_add(b, c);
            mul_sub(a: V, b: V, c: V) -> V = a.mul_sub(b, c);
            nmul_add(a: V, b: V, c: V) -> V = a.nmul_add(b, c);
            nmul_sub(a: V, b: V, c: V) -> V = a.nmul_sub(b, c);
            fused_mul_add(a: V, b: V, c: V) -> V = a.fused_mul_add(b, c);
            fused_mul_sub(a: V, b: V, c: V) -> V = a.fused_mul_sub(b, c);
            fused_nmul_add(a: V, b: V, c: V) -> V = a.fused_nmul_add(b, c);
            fused_nmul_sub(a: V, b: V, c: V) -> V = a.fused_nmul_sub(b, c);
            mul_add_fast(a: V, b: V, c: V) -> V = a.mul_add_fast(b, c);
            mul_sub_fast(a: V, b: V, c: V) -> V = a.mul_sub_fast(b, c);
            nmul_add_fast(a: V, b: V, c: V) -> V = a.nmul_add_fast(b, c);
            nmul_sub_fast(a: V, b: V, c: V) -> V = a.nmul_sub_fast(b, c);

            min_num(a: V, b: V) -> V = a.min_num(b);
            max_num(a: V, b: V) -> V = a.max_num(b);

            round_ties_even(a: V) -> V = a.round_ties_even();
            floor(a: V) -> V = a.floor();
            floor_to_i32_fast(a: V) -> I = a.floor_to_i32_fast();
            ceil(a: V) -> V = a.ceil();
            trunc(a: V) -> V = a.trunc();

            rcp_est(a: V) -> V = a.rcp_est();
            rsqrt_est(a: V) -> V = a.rsqrt_est();
            rcp_fast(a: V) -> V = a.rcp_fast();
            rsqrt_fast(a: V) -> V = a.rsqrt_fast();

            exp2(a: V) -> V = a.exp2();
            log2(a: V) -> V = a.log2();
            pow(a: V, b: V) -> V = a.pow(b);

            permute(a: V, order: U) -> V = a.permute(order);
            to_bits(a: V) -> U = a.to_bits();
            from_bits(a: U) -> V = V::from_bits(a);
            from_i32(a: I) -> V = V::from_i32(a);
            from_u32(a: U) -> V = V::from_u32(a);
            to_i32(a: V) -> I = a.to_i32();
            to_u32(a: V) -> U = a.to_u32();
            to_i32_fast(a: V) -> I = a.to_i32_fast();
            to_u32_fast(a: V) -> U = a.to_u32_fast();

            vec3_dot(a: &Vec3<V>, b: &Vec3<V>) -> V = a.dot(*b);
            vec3_cross(a: &Vec3<V>, b: &Vec3<V>) -> Vec3<V> = a.cross(*b);
            vec3_dot_fast(a: &Vec3<V>, b: &Vec3<V>) -> V = a.dot_fast(*b);
            vec3_cross_fast(a: &Vec3<V>, b: &Vec3<V>) -> Vec3<V> = a.cross_fast(*b);
            vec3_length(a: &Vec3<V>) -> V = a.length();
            vec3_normalize(a: &Vec3<V>) -> Vec3<V> = a.normalize();
            vec3_normalize_fast(a: &Vec3<V>) -> Vec3<V> = a.normalize_fast();
            vec3_select(m: M, a: &Vec3<V>, b: &Vec3<V>) -> Vec3<V> = Vec3::select(m, *a, *b);
            vec3_splat(s: S, a: [f32; 3]) -> Vec3<V> = Vec3::splat(s, a);
            vec3_add(a: &Vec3<V>, b: &Vec3<V>) -> Vec3<V> = *a + *b;
            vec3_sub(a: &Vec3<V>, b: &Vec3<V>) -> Vec3<V> = *a - *b;
            vec3_scale(a: &Vec3<V>, b: V) -> Vec3<V> = *a * b;
        }
    };
}

macro_rules! integers {
    ($how:meta) => {
        probes! { $how;
            and(a: V, b: V) -> V = a & b;
            or(a: V, b: V) -> V = a | b;
            xor(a: V, b: V) -> V = a ^ b;
            not(a: V) -> V = !a;
            and_assign(a: &mut V, b: V) -> () = *a &= b;
            or_assign(a: &mut V, b: V) -> () = *a |= b;
            xor_assign(a: &mut V, b: V) -> () = *a ^= b;
            shl(a: V, n: u32) -> V = a.shl(n);
            shr(a: V, n: u32) -> V = a.shr(n);
            shl_by_3(a: V) -> V = a.shl(3);
            shr_by_3(a: V) -> V = a.shr(3);
            permute(a: V, order: U) -> V = a.permute(order);
        }
    };
}

macro_rules! signed {
    ($how:meta) => {
        probes! { $how;
            neg(a: V) -> V = -a;
            abs(a: V) -> V = a.abs();
            sar(a: V, n: u32) -> V = a.sar(n);
            sar_by_3(a: V) -> V = a.sar(3);
            to_u32(a: V) -> U = a.to_u32();
            from_u32(a: U) -> V = V::from_u32(a);
        }
    };
}

macro_rules! masks {
    ($how:meta) => {
        probes! { $how;
            splat(s: S, x: bool) -> M = M::splat(s, x);
            from_array(s: S, a: &A) -> M = M::from_array(s, *a);
            to_array(a: M, to: &mut A) -> () = *to = a.to_array();
            and(a: M, b: M) -> M = a & b;
            or(a: M, b: M) -> M = a | b;
            xor(a: M, b: M) -> M = a ^ b;
            not(a: M) -> M = !a;
            and_not(a: M, b: M) -> M = a.and_not(b);
            and_assign(a: &mut M, b: M) -> () = *a &= b;
            or_assign(a: &mut M, b: M) -> () = *a |= b;
            xor_assign(a: &mut M, b: M) -> () = *a ^= b;
            any(a: M) -> bool = a.any();
            all(a: M) -> bool = a.all();
            none(a: M) -> bool = a.none();
            bitmask(a: M) -> u32 = a.bitmask();
            count(a: M) -> u32 = a.count();
            first(a: M) -> Option<usize> = a.first();
            select(m: M, a: F, b: F) -> F = m.select(a, b);
        }
    };
}

macro_rules! four {
    ($how:meta) => {
        probes! { $how;
            transpose(rows: &[V; 4]) -> [V; 4] = simd4::math::transpose(*rows);
        }
    };
}

macro_rules! wide {
    ($how:meta) => {
        probes! { $how;
            concat(low: <V as Wide>::Half, high: <V as Wide>::Half) -> V = V::concat(low, high);
            halves(a: V) -> (<V as Wide>::Half, <V as Wide>::Half) = a.halves();
        }
    };
}

// What is probed.

/// The modules of the types of one width.
macro_rules! width {
    ($Token:ident, $how:meta, $F:ident $I:ident $U:ident $M:ident $B:ident, $of_width:ident) => {
        width! { @one $how, $Token $F $I $U $M $B, $F, $F f32, lanes floats $of_width }
        width! { @one $how, $Token $F $I $U $M $B, $I, $I i32, lanes integers signed $of_width }
        width! { @one $how, $Token $F $I $U $M $B, $U, $U u32, lanes integers $of_width }
        width! { @one $how, $Token $F $I $U $M $B, $M, $F bool, masks }
    };
    (
        @one $how:meta, $Token:ident $F:ident $I:ident $U:ident $M:ident $B:ident,
        $module:ident, $V:ident $E:ident, $($table:ident)+
    ) => {
        #[allow(dead_code, unused_imports, reason = "some types are for some tables")]
        pub mod $module {
            use simd4::math::Vec3;
            use simd4::prelude::*;

            type S = simd4::$Token;
            type F = <S as Simd>::$F;
            type I = <S as Simd>::$I;
            type U = <S as Simd>::$U;
            type M = <S as Simd>::$M;
            type V = <S as Simd>::$V;
            type E = $E;
            type A = [E; <V as Lanes>::LANES];
            type B = simd4::$B<E>;

            $($table! { $how })+
        }
    };
}

/// The module of a level.
macro_rules! level {
    ($level:ident, $Token:ident, $how:meta) => {
        pub mod $level {
            width! { $Token, $how, f32x4 i32x4 u32x4 mask32x4 Block4, four }
            width! { $Token, $how, f32x8 i32x8 u32x8 mask32x8 Block8, wide }
            width! { $Token, $how, f32x16 i32x16 u32x16 mask32x16 Block16, wide }
        }
    };
}

// Where a level needs no attribute, this one says nothing.
level!(scalar, Scalar, cfg(all()));

#[cfg(target_arch = "x86_64")]
level!(sse2, Sse2, target_feature(enable = "sse2"));
#[cfg(target_arch = "x86_64")]
level!(sse41, Sse41, target_feature(enable = "sse4.1"));
#[cfg(target_arch = "x86_64")]
level!(avx2, Avx2, target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt,f16c,movbe"));
#[cfg(target_arch = "x86_64")]
level!(
    avx512,
    Avx512,
    target_feature(
        enable = "avx512f,avx512bw,avx512cd,avx512dq,avx512vl,\
                  avx2,fma,bmi1,bmi2,lzcnt,popcnt,f16c,movbe"
    )
);

#[cfg(target_arch = "aarch64")]
level!(neon, Neon, target_feature(enable = "neon"));

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
level!(simd128, Simd128, cfg(all()));
