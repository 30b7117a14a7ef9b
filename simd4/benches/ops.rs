//! Every group of operations, each op in a loop of its own over rows: the crate's side.

use simd4::prelude::*;
use simd4::{dispatch, swizzle};

use crate::io::{Io, N, difference};
use crate::twin::Twin;

/// What is timed, dispatched at run time as a user's code would be.
#[derive(Clone, Copy)]
pub(crate) struct Op {
    pub(crate) group: &'static str,
    pub(crate) name: &'static str,
    pub(crate) ours: fn(Level, &mut Io),
}

/// How far numbers of 32 bits go down to be indices of a row.
pub(crate) const INDEX_SHIFT: u32 = 32 - N.trailing_zeros();

/// What is open for values that have no such integer.
const IN_RANGE_ONLY: [&str; 3] = ["to_i32_fast", "to_u32_fast", "floor_to_int"];

impl Op {
    /// Stops the program if the two do not agree, on numbers of every kind.
    pub(crate) fn check(&self, level: Level, twin: Twin) {
        let special = (!IN_RANGE_ONLY.contains(&self.name)).then(Io::special);
        for mut io in [Io::ordinary()].into_iter().chain(special) {
            let ours = io.output(|io| (self.ours)(level, io));
            // SAFETY: the CPU has the level.
            let twin = io.output(|io| unsafe { twin(io) });
            if let Some(at) = difference(&ours, &twin) {
                let (name, ours, twin) = (self.name, ours[at], twin[at]);
                panic!("{name} on {level}, output {at}: {ours:#x}, its twin says {twin:#x}");
            }
        }
    }
}

/// One register of each operand. What an op does not use is not loaded.
struct Regs<S: Simd> {
    a: S::f32s,
    b: S::f32s,
    c: S::f32s,
    i: S::i32s,
    j: S::i32s,
    u: S::u32s,
    v: S::u32s,
    n: u32,
}

#[inline(always)]
fn regs<S: Simd>(s: S, io: &Io, at: usize) -> Regs<S> {
    Regs {
        a: S::f32s::load(s, &io.f[0].0[at..]),
        b: S::f32s::load(s, &io.f[1].0[at..]),
        c: S::f32s::load(s, &io.f[2].0[at..]),
        i: S::i32s::load(s, &io.i[0].0[at..]),
        j: S::i32s::load(s, &io.i[1].0[at..]),
        u: S::u32s::load(s, &io.u[0].0[at..]),
        v: S::u32s::load(s, &io.u[1].0[at..]),
        n: io.shift,
    }
}

/// A register to a register.
#[inline(always)]
fn map<S: Simd>(s: S, io: &mut Io, op: impl Fn(Regs<S>) -> S::u32s) {
    for k in 0..N / S::LANES {
        let at = k * S::LANES;
        op(regs(s, io, at)).store(&mut io.bits.0[at..]);
    }
}

/// A register to two.
#[inline(always)]
fn pair<S: Simd>(s: S, io: &mut Io, op: impl Fn(Regs<S>) -> (S::f32s, S::f32s)) {
    for k in 0..N / S::LANES {
        let at = k * S::LANES;
        let (x, y) = op(regs(s, io, at));
        x.store(&mut io.floats.0[at..]);
        y.store(&mut io.floats.0[N + at..]);
    }
}

/// Eight lanes at every level to eight lanes.
#[inline(always)]
fn eight<S: Simd>(s: S, io: &mut Io, op: impl Fn(S::f32x8) -> S::f32x8) {
    for k in 0..N / 8 {
        let at = k * 8;
        op(S::f32x8::load(s, &io.f[0].0[at..])).store(&mut io.floats.0[at..]);
    }
}

/// A register to a number.
#[inline(always)]
fn fold<S: Simd>(s: S, io: &mut Io, op: impl Fn(Regs<S>) -> u32) {
    for k in 0..N / S::LANES {
        io.bits.0[k] = op(regs(s, io, k * S::LANES));
    }
}

/// A register to a float.
#[inline(always)]
fn reduce<S: Simd>(s: S, io: &mut Io, op: impl Fn(Regs<S>) -> f32) {
    for k in 0..N / S::LANES {
        io.floats.0[k] = op(regs(s, io, k * S::LANES));
    }
}

/// The least under a mask and where it is.
#[inline(always)]
fn argmin<S: Simd>(s: S, io: &mut Io) {
    for k in 0..N / S::LANES {
        let Regs { a, b, c, .. } = regs(s, io, k * S::LANES);
        if let Some((lane, value)) = a.argmin(b.lt(c)) {
            io.bits.0[k] = lane as u32;
            io.floats.0[k] = value;
        }
    }
}

/// The nearest floats of signed integers.
#[inline(always)]
fn from_i32<S: Simd>(r: Regs<S>) -> S::u32s {
    S::f32s::from_i32(r.i).to_bits()
}

/// The nearest floats of unsigned integers.
#[inline(always)]
fn from_u32<S: Simd>(r: Regs<S>) -> S::u32s {
    S::f32s::from_u32(r.u).to_bits()
}

/// Reads and writes slices of up to `LANES - 1` elements.
#[inline(always)]
fn prefix<S: Simd>(s: S, io: &mut Io) {
    for k in 0..N / S::LANES {
        let at = k * S::LANES;
        let end = at + (io.u[0].0[k] as usize & (S::LANES - 1));
        S::f32s::load_prefix(s, &io.f[0].0[at..end], 0.0).store_prefix(&mut io.floats.0[at..end]);
    }
}

/// Reads under a mask.
#[inline(always)]
fn load_masked<S: Simd>(s: S, io: &mut Io) {
    for k in 0..N / S::LANES {
        let at = k * S::LANES;
        let Regs { a, b, .. } = regs(s, io, at);
        S::f32s::load_masked(s, &io.f[2].0[at..at + S::LANES], a.lt(b), 1.0)
            .store(&mut io.floats.0[at..]);
    }
}

/// Writes under a mask.
#[inline(always)]
fn store_masked<S: Simd>(s: S, io: &mut Io) {
    for k in 0..N / S::LANES {
        let at = k * S::LANES;
        let Regs { a, b, .. } = regs(s, io, at);
        a.store_masked(&mut io.floats.0[at..at + S::LANES], a.lt(b));
    }
}

/// Reads from anywhere in a row.
#[inline(always)]
fn gather<S: Simd>(s: S, io: &mut Io) {
    for k in 0..N / S::LANES {
        let at = k * S::LANES;
        let index = regs(s, io, at).u.shr(INDEX_SHIFT);
        S::f32s::gather(&io.f[0].0, index).store(&mut io.floats.0[at..]);
    }
}

/// What is less than its neighbour, without gaps.
#[inline(always)]
fn compress_store<S: Simd>(s: S, io: &mut Io) {
    let mut n = 0;
    for k in 0..N / S::LANES {
        let Regs { a, b, .. } = regs(s, io, k * S::LANES);
        n += a.compress_store(a.lt(b), &mut io.floats.0[n..]);
    }
    io.bits.0[0] = n as u32;
}

macro_rules! ops {
    ($($group:literal { $($name:ident = $shape:ident $(|$r:ident| $body:expr)?;)* })*) => {
        pub(crate) const OPS: &[Op] = &[$($(Op {
            group: $group,
            name: stringify!($name),
            ours: |level, io| dispatch!(
                level,
                s => $shape(s, io $(, #[inline(always)] |$r| $body)?)
            ),
        }),*),*];
    };
}

ops! {
    "arithmetic" {
        add = map |r| (r.a + r.b).to_bits();
        sub = map |r| (r.a - r.b).to_bits();
        mul = map |r| (r.a * r.b).to_bits();
        div = map |r| (r.a / r.b).to_bits();
        neg = map |r| (-r.a).to_bits();
        abs = map |r| r.a.abs().to_bits();
        sqrt = map |r| r.a.sqrt().to_bits();
        copysign = map |r| r.a.copysign(r.b).to_bits();
    }
    "fused" {
        mul_add = map |r| r.a.mul_add(r.b, r.c).to_bits();
        nmul_sub = map |r| r.a.nmul_sub(r.b, r.c).to_bits();
        fused_mul_add = map |r| r.a.fused_mul_add(r.b, r.c).to_bits();
        fused_nmul_sub = map |r| r.a.fused_nmul_sub(r.b, r.c).to_bits();
        mul_add_fast = map |r| r.a.mul_add_fast(r.b, r.c).to_bits();
    }
    "min_max" {
        min = map |r| r.a.min(r.b).to_bits();
        max = map |r| r.a.max(r.b).to_bits();
        min_num = map |r| r.a.min_num(r.b).to_bits();
        max_num = map |r| r.a.max_num(r.b).to_bits();
    }
    "round" {
        floor = map |r| r.a.floor().to_bits();
        ceil = map |r| r.a.ceil().to_bits();
        trunc = map |r| r.a.trunc().to_bits();
        round_ties_even = map |r| r.a.round_ties_even().to_bits();
    }
    "reciprocal" {
        rcp_est = map |r| r.a.rcp_est().to_bits();
        rsqrt_est = map |r| r.a.rsqrt_est().to_bits();
        rcp_fast = map |r| r.a.rcp_fast().to_bits();
        rsqrt_fast = map |r| r.a.rsqrt_fast().to_bits();
    }
    "compare" {
        lt = map |r| r.a.lt(r.b).select(r.a, r.c).to_bits();
        ne = map |r| r.a.ne(r.b).select(r.a, r.c).to_bits();
        lt_i32 = map |r| r.i.lt(r.j).select(r.i, r.j).to_u32();
        le_u32 = map |r| r.u.le(r.v).select(r.v, r.u);
        between = map |r| (r.a.le(r.b) & r.b.lt(r.c)).select(r.a, r.c).to_bits();
        and_not = map |r| r.a.le(r.b).and_not(r.b.lt(r.c)).select(r.a, r.c).to_bits();
        bitmask = fold |r| r.a.lt(r.b).bitmask();
        any = fold |r| u32::from(r.a.lt(r.b).any());
        all = fold |r| u32::from(r.a.lt(r.b).all());
        count = fold |r| r.a.lt(r.b).count();
        first = fold |r| r.a.lt(r.b).first().map_or(u32::MAX, |lane| lane as u32);
    }
    "convert" {
        to_i32 = map |r| r.a.to_i32().to_u32();
        to_u32 = map |r| r.a.to_u32();
        to_i32_fast = map |r| r.a.to_i32_fast().to_u32();
        to_u32_fast = map |r| r.a.to_u32_fast();
        from_i32 = map |r| from_i32(r);
        from_u32 = map |r| from_u32(r);
    }
    "integer" {
        add_i32 = map |r| (r.i + r.j).to_u32();
        mul_i32 = map |r| (r.i * r.j).to_u32();
        min_i32 = map |r| r.i.min(r.j).to_u32();
        max_u32 = map |r| r.u.max(r.v);
        abs_i32 = map |r| r.i.abs().to_u32();
        shl = map |r| r.u.shl(r.n);
        shr = map |r| r.u.shr(r.n);
        sar = map |r| r.i.sar(r.n).to_u32();
        logic = map |r| (r.u & r.v) ^ !r.u;
    }
    "move" {
        swizzle = eight |v| swizzle!(v, [7, 2, 5, 0, 3, 6, 1, 4]);
        permute = map |r| r.a.permute(r.u).to_bits();
        rotate = map |r| r.a.rotate::<1>().to_bits();
        reverse = map |r| r.a.reverse().to_bits();
        zip = pair |r| r.a.zip(r.b);
        unzip = pair |r| r.a.unzip(r.b);
        compress_store = compress_store;
    }
    "reduce" {
        reduce_sum = reduce |r| r.a.reduce_sum();
        reduce_product = reduce |r| r.a.reduce_product();
        reduce_min = reduce |r| r.a.reduce_min();
        reduce_max_u32 = fold |r| r.u.reduce_max();
        argmin = argmin;
    }
    "memory" {
        copy = map |r| r.a.to_bits();
        prefix = prefix;
        load_masked = load_masked;
        store_masked = store_masked;
        gather = gather;
    }
}
