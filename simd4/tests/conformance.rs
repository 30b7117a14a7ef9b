//! Every operation on every level against the scalar definition, bit for bit, lane by lane.
//!
//! One suite, generic over the types; one module a level. A level that the CPU lacks is skipped,
//! and says so. Which NaN a NaN result is remains open, so all NaNs compare equal here.

#![allow(clippy::type_complexity, reason = "a table of functions reads best where it is used")]
#![allow(clippy::print_stderr, reason = "a skipped test says why")]

use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use simd4::prelude::*;
use simd4::{dispatch, spec};

/// Values at which floating point changes its behaviour.
const FLOATS: [f32; 46] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    2.0,
    -2.0,
    3.0,
    1.5,
    2.5,
    -2.5,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    f32::MAX,
    f32::MIN,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    f32::EPSILON,
    1e-45,
    -1e-45,
    1.1754942e-38,
    -1.1754942e-38, // the ends of the subnormals
    1.0000001,
    0.99999994,
    1e-20,
    -1e-20,
    1e20,
    1e38,
    -1e38,
    8388607.5,
    8388608.0,
    16777215.0,
    16777216.0,
    16777218.0, // where integers end
    2147483500.0,
    2147483600.0,
    -2147483600.0,
    4294967000.0,
    4294967300.0,
    9.223372e18,
    1.8446744e19,
    -9.223372e18,
    0.33333334,
    1.1920929e-7,
];

/// Values at which integers change theirs.
const INTS: [u32; 16] = [
    0,
    1,
    2,
    3,
    0x7fff,
    0x8000,
    0xffff,
    0x10000,
    0xff_ffff,
    0x100_0000,
    0x100_0001,
    0x3fff_ffff,
    0x7fff_ffff,
    0x8000_0000,
    0x8000_0001,
    0xffff_ffff,
];

/// Two NaNs are as good as each other; all else is compared by its bits.
fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Calls `check` with vectors of operands, full of neighbouring pairs and partly filled at the end.
fn in_lanes<V: Lanes>(
    s: V::Simd,
    pairs: &[(V::Elem, V::Elem)],
    mut check: impl FnMut(V, V, &[(V::Elem, V::Elem)]),
) where
    V::Elem: Default,
{
    for chunk in pairs.chunks(V::LANES) {
        let (a, b): (Vec<_>, Vec<_>) = chunk.iter().copied().unzip();
        let fill = V::Elem::default();
        check(V::load_prefix(s, &a, fill), V::load_prefix(s, &b, fill), chunk);
    }
}

type Case<A, R> = (&'static str, A, R);

fn floats<V: SimdF32<Array: AsRef<[f32]>>>(s: V::Simd, pairs: &[(f32, f32)]) {
    let values: [Case<fn(V, V) -> V, fn(f32, f32) -> f32>; 10] = [
        ("+", |a, b| a + b, |a, b| a + b),
        ("-", |a, b| a - b, |a, b| a - b),
        ("*", |a, b| a * b, |a, b| a * b),
        ("/", |a, b| a / b, |a, b| a / b),
        ("min", V::min, spec::min),
        ("max", V::max, spec::max),
        ("neg", |a, _| -a, |a, _| -a),
        ("abs", |a, _| a.abs(), |a, _| spec::abs(a)),
        ("sqrt", |a, _| a.sqrt(), |a, _| spec::sqrt(a)),
        ("bits", |a, _| V::from_bits(a.to_bits()), |a, _| a),
    ];
    let truths: [Case<fn(V, V) -> V::Mask, fn(f32, f32) -> bool>; 6] = [
        ("eq", V::eq, |a, b| a == b),
        ("ne", V::ne, |a, b| a != b),
        ("lt", V::lt, |a, b| a < b),
        ("le", V::le, |a, b| a <= b),
        ("gt", V::gt, |a, b| a > b),
        ("ge", V::ge, |a, b| a >= b),
    ];
    in_lanes::<V>(s, pairs, |a, b, lanes| {
        for (name, op, model) in values {
            let got = op(a, b).to_array();
            for (&got, &(a, b)) in got.as_ref().iter().zip(lanes) {
                let want = model(a, b);
                assert!(same(got, want), "{name}({a:e}, {b:e}) = {got:e}, not {want:e}");
            }
        }
        for (name, op, model) in truths {
            let mask = op(a, b);
            let (bits, array) = (mask.bitmask(), mask.to_array());
            let chosen = mask.select(a, b).to_array();
            for (i, &(a, b)) in lanes.iter().enumerate() {
                let want = model(a, b);
                assert_eq!(array.as_ref()[i], want, "{name}({a:e}, {b:e})");
                assert_eq!(bits >> i & 1 == 1, want, "bit {i} of {name}({a:e}, {b:e})");
                let kept = chosen.as_ref()[i].to_bits() == spec::select(want, a, b).to_bits();
                assert!(kept, "select({want}, {a:e}, {b:e})");
            }
        }
    });
}

/// The checks of one type of integers; the trait differs, the text does not.
macro_rules! integers {
    ($name:ident, $Trait:ident, $elem:ident) => {
        fn $name<V: $Trait>(s: V::Simd, pairs: &[($elem, $elem)]) {
            let values: [Case<fn(V, V) -> V, fn($elem, $elem) -> $elem>; 8] = [
                ("+", |a, b| a + b, $elem::wrapping_add),
                ("-", |a, b| a - b, $elem::wrapping_sub),
                ("*", |a, b| a * b, $elem::wrapping_mul),
                ("&", |a, b| a & b, |a, b| a & b),
                ("|", |a, b| a | b, |a, b| a | b),
                ("^", |a, b| a ^ b, |a, b| a ^ b),
                ("min", V::min, |a, b| if a < b { a } else { b }),
                ("max", V::max, |a, b| if a > b { a } else { b }),
            ];
            let truths: [Case<fn(V, V) -> V::Mask, fn($elem, $elem) -> bool>; 3] = [
                ("eq", V::eq, |a, b| a == b),
                ("lt", V::lt, |a, b| a < b),
                ("gt", V::gt, |a, b| a > b),
            ];
            in_lanes::<V>(s, pairs, |a, b, lanes| {
                for (name, op, model) in values {
                    for (&got, &(a, b)) in op(a, b).to_array().as_ref().iter().zip(lanes) {
                        assert_eq!(got, model(a, b), "{name}({a}, {b})");
                    }
                }
                for (name, op, model) in truths {
                    let mask = op(a, b);
                    let chosen = mask.select(a, b).to_array();
                    for (i, &(a, b)) in lanes.iter().enumerate() {
                        let want = model(a, b);
                        assert_eq!(mask.bitmask() >> i & 1 == 1, want, "{name}({a}, {b})");
                        assert_eq!(chosen.as_ref()[i], spec::select(want, a, b), "select");
                    }
                }
            });
        }
    };
}

integers!(signed, SimdI32, i32);
integers!(unsigned, SimdU32, u32);

fn from_i32<V: SimdF32>(s: V::Simd, ints: &[i32]) {
    for chunk in ints.chunks(V::LANES) {
        let got = V::from_i32(V::I32::load_prefix(s, chunk, 0)).to_array();
        for (got, &i) in got.as_ref().iter().zip(chunk) {
            assert_eq!(got.to_bits(), (i as f32).to_bits(), "{i} as f32");
        }
    }
}

/// All truths of all lanes, up to 256 masks against 256.
fn masks<M: SimdMask<Array: TryFrom<Vec<bool>>>>(s: M::Simd) {
    let make = |bits: u32| {
        let lanes: Vec<bool> = (0..M::LANES).map(|i| bits >> i & 1 == 1).collect();
        M::from_array(s, lanes.try_into().unwrap_or_else(|_| unreachable!()))
    };
    let full = (1 << M::LANES) - 1;
    for a in 0..=full {
        let mask = make(a);
        assert_eq!(mask.bitmask(), a);
        assert_eq!(make(mask.bitmask()).to_array().as_ref(), mask.to_array().as_ref());
        assert_eq!((!mask).bitmask(), full & !a);
        assert_eq!(mask.any(), a != 0);
        assert_eq!(mask.none(), a == 0);
        assert_eq!(mask.all(), a == full);
        assert_eq!(mask.count(), a.count_ones());
        assert_eq!(mask.first(), (0..M::LANES).find(|i| a >> i & 1 == 1));
        for b in 0..=full {
            assert_eq!((mask & make(b)).bitmask(), a & b);
            assert_eq!((mask | make(b)).bitmask(), a | b);
            assert_eq!((mask ^ make(b)).bitmask(), a ^ b);
        }
    }
    assert_eq!(M::splat(s, true).bitmask(), full);
    assert_eq!(M::splat(s, false).bitmask(), 0);
}

/// Loads and stores of every length keep to the slice and to the order of lanes.
fn memory<V: Lanes<Elem = u32>>(s: V::Simd) {
    let source: Vec<u32> = (100..).take(3 * V::LANES).collect();
    for n in 0..=source.len() {
        let mut want = vec![7; V::LANES];
        for (want, from) in want.iter_mut().zip(&source[..n]) {
            *want = *from;
        }
        let v = V::load_prefix(s, &source[..n], 7);
        assert_eq!(v.to_array().as_ref(), want);
        assert_eq!(V::from_array(s, v.to_array()).to_array().as_ref(), want);

        let mut target = vec![9; n];
        v.store_prefix(&mut target);
        let kept = n.min(V::LANES);
        assert_eq!(target[..kept], want[..kept]);
        assert!(target[kept..].iter().all(|&x| x == 9));
        if n >= V::LANES {
            assert_eq!(V::load(s, &source[..n]).to_array().as_ref(), want);
            let mut target = vec![9; n];
            v.store(&mut target);
            assert_eq!(target[..V::LANES], want[..]);
            assert!(target[V::LANES..].iter().all(|&x| x == 9));
        }
    }
    assert!(V::splat(s, 5).to_array().as_ref().iter().all(|&x| x == 5));
}

fn cross<T: Copy>(values: &[T]) -> Vec<(T, T)> {
    values.iter().flat_map(|&a| values.iter().map(move |&b| (a, b))).collect()
}

fn special<S: Simd>(s: S) {
    let pairs = cross(&FLOATS);
    floats::<S::f32x4>(s, &pairs);
    floats::<S::f32x8>(s, &pairs);
    let pairs = cross(&INTS);
    unsigned::<S::u32x4>(s, &pairs);
    unsigned::<S::u32x8>(s, &pairs);
    let ints = INTS.map(|i| i as i32);
    let pairs = cross(&ints);
    signed::<S::i32x4>(s, &pairs);
    signed::<S::i32x8>(s, &pairs);
    from_i32::<S::f32x4>(s, &ints);
    from_i32::<S::f32x8>(s, &ints);
}

fn random<S: Simd>(s: S, bits: &[(u32, u32)]) {
    let pairs: Vec<_> = bits.iter().map(|&(a, b)| (f32::from_bits(a), f32::from_bits(b))).collect();
    floats::<S::f32x4>(s, &pairs);
    floats::<S::f32x8>(s, &pairs);
    unsigned::<S::u32x4>(s, bits);
    unsigned::<S::u32x8>(s, bits);
    let ints: Vec<_> = bits.iter().map(|&(a, b)| (a as i32, b as i32)).collect();
    signed::<S::i32x4>(s, &ints);
    signed::<S::i32x8>(s, &ints);
    let ints: Vec<_> = ints.iter().map(|&(a, _)| a).collect();
    from_i32::<S::f32x4>(s, &ints);
    from_i32::<S::f32x8>(s, &ints);
}

/// Bits of all kinds: uniform ones are rarely near each other, and seldom small.
fn word() -> impl Strategy<Value = u32> {
    let small = -1000i32..1000;
    prop_oneof![
        any::<u32>(),
        any::<f32>().prop_map(f32::to_bits),
        small.clone().prop_map(|i| (i as f32 / 8.0).to_bits()),
        small.prop_map(|i| i as u32),
    ]
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
                dispatch!(level, s => special(s));
            }

            #[test]
            fn random_values() {
                let Some(level) = level($name) else { return };
                proptest!(config(), |(bits in prop::collection::vec((word(), word()), 1..40))| {
                    dispatch!(level, s => random(s, &bits));
                });
            }

            #[test]
            fn truths_and_memory() {
                fn check<S: Simd>(s: S) {
                    masks::<S::mask32x4>(s);
                    masks::<S::mask32x8>(s);
                    memory::<S::u32x4>(s);
                    memory::<S::u32x8>(s);
                }
                let Some(level) = level($name) else { return };
                dispatch!(level, s => check(s));
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
    neon = "neon"
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
