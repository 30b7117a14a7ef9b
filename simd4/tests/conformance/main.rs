//! Every operation on every level against the scalar definition, bit for bit, lane by lane.
//!
//! One suite, generic over the types; one module a level. A level that the CPU lacks is skipped,
//! and says so. Which NaN a NaN result is remains open, so all NaNs compare equal here.
//!
//! All 2^32 inputs of the operations of one operand, and all triples of special values, take
//! minutes: `cargo test --release -p simd4 --test conformance -- --ignored`.

#![allow(clippy::print_stderr, reason = "a skipped test says why")]

mod definition;
mod elementary;
mod lanes;
mod numbers;
mod sweeps;
mod values;

use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use simd4::dispatch;
use simd4::prelude::*;

/// Calls a check with the level's types of four, eight and sixteen lanes.
macro_rules! at_every_width {
    ($s:ident, $module:ident::$check:ident, $x4:ident $x8:ident $x16:ident $(, $arg:expr)*) => {
        $module::$check::<S::$x4>($s $(, $arg)*);
        $module::$check::<S::$x8>($s $(, $arg)*);
        $module::$check::<S::$x16>($s $(, $arg)*);
    };
}

fn numbers<S: Simd>(s: S, floats: &[[f32; 2]], words: &[[u32; 2]]) {
    at_every_width!(s, numbers::floats, f32x4 f32x8 f32x16, floats);
    at_every_width!(s, numbers::unsigned, u32x4 u32x8 u32x16, words);
    at_every_width!(s, numbers::signed, i32x4 i32x8 i32x16, words);
    let floats = floats.as_flattened();
    at_every_width!(s, numbers::to_ints, f32x4 f32x8 f32x16, floats);
    at_every_width!(s, lanes::float_reductions, f32x4 f32x8 f32x16, floats);
    let words = words.as_flattened();
    at_every_width!(s, numbers::from_ints, f32x4 f32x8 f32x16, words);
    at_every_width!(s, lanes::int_reductions, u32x4 u32x8 u32x16, words);
    at_every_width!(s, lanes::wrapping, u32x4 u32x8 u32x16, words);
    let ints: Vec<i32> = words.iter().map(|&x| x as i32).collect();
    at_every_width!(s, lanes::int_reductions, i32x4 i32x8 i32x16, &ints);
}

fn special<S: Simd>(s: S) {
    // Neighbours in a vector differ: every pair once, in an order without a pattern.
    let floats = values::pairs(&values::floats());
    let words = values::pairs(&values::ints());
    numbers(s, &floats, &words);
    let fewer = values::fewer_floats();
    at_every_width!(s, numbers::three_floats, f32x4 f32x8 f32x16, values::triples(&fewer));
}

fn all_triples<S: Simd>(s: S) {
    numbers::three_floats::<S::f32s>(s, values::triples(&values::floats()));
}

fn random<S: Simd>(s: S, rows: &[[u32; 3]]) {
    let words: Vec<_> = rows.iter().map(|&[a, b, _]| [a, b]).collect();
    let floats: Vec<_> = words.iter().map(|row| row.map(f32::from_bits)).collect();
    numbers(s, &floats, &words);
    let triples = || rows.iter().map(|row| row.map(f32::from_bits));
    at_every_width!(s, numbers::three_floats, f32x4 f32x8 f32x16, triples());
}

fn lanes<S: Simd>(s: S) {
    at_every_width!(s, lanes::masks, mask32x4 mask32x8 mask32x16);
    at_every_width!(s, lanes::memory, f32x4 f32x8 f32x16);
    at_every_width!(s, lanes::memory, i32x4 i32x8 i32x16);
    at_every_width!(s, lanes::memory, u32x4 u32x8 u32x16);
    at_every_width!(s, lanes::gathers, f32x4 f32x8 f32x16);
    at_every_width!(s, lanes::permutes, f32x4 f32x8 f32x16);
    at_every_width!(s, lanes::moves, f32x4 f32x8 f32x16);
    at_every_width!(s, lanes::moves, i32x4 i32x8 i32x16);
    at_every_width!(s, lanes::moves, u32x4 u32x8 u32x16);
    lanes::swizzles(s);
    lanes::halves::<S::f32x8>(s);
    lanes::halves::<S::i32x8>(s);
    lanes::halves::<S::u32x8>(s);
    lanes::halves::<S::f32x16>(s);
    lanes::halves::<S::i32x16>(s);
    lanes::halves::<S::u32x16>(s);
}

fn panics<S: Simd>(s: S) {
    at_every_width!(s, lanes::out_of_bounds, f32x4 f32x8 f32x16);
}

// Inlined into code of the level, as users have it, and so costly to compile: on one register.
// Wider types are several of them, and are held to the definition by the tests above.

#[inline(always)]
fn estimates<S: Simd>(s: S) {
    sweeps::estimates::<S::f32s>(s, sweeps::stride());
    at_every_width!(s, sweeps::rails, f32x4 f32x8 f32x16);
}

#[inline(always)]
fn one_operand<S: Simd>(s: S, step: u32) {
    sweeps::one_operand::<S::f32s>(s, step);
}

/// The checks, each compiled once for each level.
mod on {
    use super::*;

    pub(super) fn special(level: Level) {
        dispatch!(level, s => super::special(s));
    }
    pub(super) fn all_triples(level: Level) {
        dispatch!(level, s => super::all_triples(s));
    }
    pub(super) fn random(level: Level, rows: &[[u32; 3]]) {
        dispatch!(level, s => super::random(s, rows));
    }
    pub(super) fn lanes(level: Level) {
        dispatch!(level, s => super::lanes(s));
    }
    pub(super) fn panics(level: Level) {
        dispatch!(level, s => super::panics(s));
    }
    pub(super) fn estimates(level: Level) {
        dispatch!(level, s => super::estimates(s));
    }
    pub(super) fn one_operand(level: Level, step: u32) {
        dispatch!(level, s => super::one_operand(s, step));
    }
}

/// Failures are saved beside this file and tried first from then on.
fn config() -> ProptestConfig {
    let saved = FileFailurePersistence::WithSource("regressions");
    ProptestConfig { failure_persistence: Some(Box::new(saved)), ..ProptestConfig::default() }
}

/// The level of that name, or `None` and a word about it.
fn level(name: &str) -> Option<Level> {
    Level::named(name).map_err(|why| eprintln!("skipped: {why}")).ok()
}

macro_rules! stamp {
    ($($module:ident = $name:literal)*) => {$(
        mod $module {
            use super::*;

            #[test]
            fn special_values() {
                let Some(level) = level($name) else { return };
                on::special(level);
            }

            #[test]
            fn random_values() {
                let Some(level) = level($name) else { return };
                let row = prop::array::uniform3(values::word());
                proptest!(config(), |(rows in prop::collection::vec(row, 1..40))| {
                    on::random(level, &rows);
                });
            }

            #[test]
            fn masks_memory_and_moves() {
                let Some(level) = level($name) else { return };
                on::lanes(level);
            }

            #[test]
            #[cfg_attr(not(panic = "unwind"), ignore = "without unwinding there is nothing to catch")]
            fn whatever_is_out_of_bounds_panics() {
                let Some(level) = level($name) else { return };
                on::panics(level);
            }

            #[test]
            fn estimates_keep_their_bounds() {
                let Some(level) = level($name) else { return };
                on::estimates(level);
            }

            #[test]
            fn a_stride_of_all_inputs() {
                let Some(level) = level($name) else { return };
                on::one_operand(level, 12_007_u32.saturating_mul(sweeps::stride()));
            }

            #[test]
            #[ignore = "all 2^32 inputs: minutes"]
            fn all_inputs() {
                let Some(level) = level($name) else { return };
                on::one_operand(level, 1);
            }

            #[test]
            #[ignore = "27 million triples: minutes"]
            fn all_triples_of_special_values() {
                let Some(level) = level($name) else { return };
                on::all_triples(level);
            }

            #[test]
            fn token_and_level_agree() {
                let Some(level) = level($name) else { return };
                assert_eq!(level.name(), $name);
                assert_eq!(dispatch!(level, s => s.level()), level);
            }
        }
    )*};
}

stamp! {
    scalar = "scalar"
    sse2 = "sse2"
    sse41 = "sse4.1"
    avx2 = "avx2"
    avx512 = "avx512"
    neon = "neon"
    simd128 = "simd128"
}

#[test]
fn names_that_are_no_level_are_refused_with_a_list() {
    let error = Level::named("avx9000").unwrap_err().to_string();
    assert!(error.starts_with("there is no such level; this CPU has scalar"), "{error}");
    let other = if cfg!(target_arch = "aarch64") { "sse2" } else { "neon" };
    let error = Level::named(other).unwrap_err().to_string();
    assert!(
        error.starts_with(&format!("this CPU lacks the level {other}; it has scalar")),
        "{error}"
    );
}

#[test]
fn levels_come_weakest_first() {
    let names: Vec<_> = Level::available().map(Level::name).collect();
    assert_eq!(names[0], "scalar");
    if std::env::var_os("SIMD4_LEVEL").is_none() {
        assert_eq!(Level::best().unwrap().name(), *names.last().unwrap());
    }
}

#[test]
fn the_types_at_the_root_need_no_token() {
    use simd4::{f32x4, f32x8, i32x8, u32x4};
    let a = f32x4::from([1.0, 2.0, 3.0, 4.0]) / f32x4::from(2.0);
    assert_eq!(a.to_array(), [0.5, 1.0, 1.5, 2.0]);
    assert_eq!(format!("{a:?}"), "[0.5, 1.0, 1.5, 2.0]");
    assert_eq!((f32x8::from([2.0; 8]) * f32x8::from(3.0)).to_array(), [6.0; 8]);
    assert_eq!((i32x8::from(-1) + i32x8::from(1)).to_array(), [0; 8]);
    assert_eq!(u32x4::from(u32::MAX).min(u32x4::from(3)).to_array(), [3; 4]);
}
