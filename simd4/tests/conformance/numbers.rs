//! Arithmetic, comparisons, conversions: lane by lane what the definition says.

use simd4::prelude::*;
use simd4::spec;

/// An operation's name, itself, and its definition.
type Case<Op, Model> = (&'static str, Op, Model);

type Unary<V, T> = Case<fn(V) -> V, fn(T) -> T>;
type Binary<V, T> = Case<fn(V, V) -> V, fn(T, T) -> T>;
type Ternary<V> = Case<fn(V, V, V) -> V, fn(f32, f32, f32) -> f32>;
type Truth<V, T> = Case<fn(V, V) -> <V as Lanes>::Mask, fn(T, T) -> bool>;

/// Two NaNs are as good as each other; all else is compared by its bits.
pub(crate) fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Calls `check` with vectors of operands, the last ones filled up.
pub(crate) fn in_lanes<V: Lanes, const K: usize>(
    s: V::Simd,
    rows: impl IntoIterator<Item = [V::Elem; K]>,
    mut check: impl FnMut([V; K], &[[V::Elem; K]]),
) {
    let mut rows = rows.into_iter().peekable();
    while rows.peek().is_some() {
        let lanes: Vec<[V::Elem; K]> = rows.by_ref().take(V::LANES).collect();
        let operands = std::array::from_fn(|k| {
            let operand: Vec<V::Elem> = lanes.iter().map(|row| row[k]).collect();
            V::load_prefix(s, &operand, V::Elem::default())
        });
        check(operands, &lanes);
    }
}

fn float_unary<V: SimdF32>() -> [Unary<V, f32>; 10] {
    [
        ("neg", |a| -a, |a| -a),
        ("abs", V::abs, spec::abs),
        ("sqrt", V::sqrt, spec::sqrt),
        ("floor", V::floor, spec::floor),
        ("ceil", V::ceil, spec::ceil),
        ("trunc", V::trunc, spec::trunc),
        ("round_ties_even", V::round_ties_even, spec::round_ties_even),
        ("exp2", V::exp2, spec::exp2),
        ("log2", V::log2, spec::log2),
        ("bits", |a| V::from_bits(a.to_bits()), |a| a),
    ]
}

fn float_binary<V: SimdF32>() -> [Binary<V, f32>; 10] {
    [
        ("+", |a, b| a + b, |a, b| a + b),
        ("-", |a, b| a - b, |a, b| a - b),
        ("*", |a, b| a * b, |a, b| a * b),
        ("/", |a, b| a / b, |a, b| a / b),
        ("min", V::min, spec::min),
        ("max", V::max, spec::max),
        ("min_num", V::min_num, spec::min_num),
        ("max_num", V::max_num, spec::max_num),
        ("copysign", V::copysign, spec::copysign),
        ("pow", V::pow, spec::pow),
    ]
}

fn float_ternary<V: SimdF32>() -> [Ternary<V>; 8] {
    [
        ("mul_add", V::mul_add, spec::mul_add),
        ("mul_sub", V::mul_sub, spec::mul_sub),
        ("nmul_add", V::nmul_add, spec::nmul_add),
        ("nmul_sub", V::nmul_sub, spec::nmul_sub),
        ("fused_mul_add", V::fused_mul_add, spec::fused_mul_add),
        ("fused_mul_sub", V::fused_mul_sub, spec::fused_mul_sub),
        ("fused_nmul_add", V::fused_nmul_add, spec::fused_nmul_add),
        ("fused_nmul_sub", V::fused_nmul_sub, spec::fused_nmul_sub),
    ]
}

fn truths<V: Lanes>() -> [Truth<V, V::Elem>; 6] {
    [
        ("eq", V::eq, |a, b| a == b),
        ("ne", V::ne, |a, b| a != b),
        ("lt", V::lt, |a, b| a < b),
        ("le", V::le, |a, b| a <= b),
        ("gt", V::gt, |a, b| a > b),
        ("ge", V::ge, |a, b| a >= b),
    ]
}

/// What comparisons and `select` say of pairs; floats are told apart by their bits.
fn compare<V: Lanes>(s: V::Simd, pairs: &[[V::Elem; 2]], bits: fn(V::Elem) -> u32) {
    in_lanes::<V, 2>(s, pairs.iter().copied(), |[a, b], lanes| {
        for (name, op, model) in truths::<V>() {
            let mask = op(a, b);
            let (mask_bits, array) = (mask.bitmask(), mask.to_array());
            let chosen = mask.select(a, b).to_array();
            for (i, &[a, b]) in lanes.iter().enumerate() {
                let want = model(a, b);
                assert_eq!(array.as_ref()[i], want, "{name}({a:?}, {b:?})");
                assert_eq!(mask_bits >> i & 1 == 1, want, "bit {i} of {name}({a:?}, {b:?})");
                let kept = bits(chosen.as_ref()[i]) == bits(spec::select(want, a, b));
                assert!(kept, "select({want}, {a:?}, {b:?})");
            }
        }
    });
}

pub(crate) fn floats<V: SimdF32>(s: V::Simd, pairs: &[[f32; 2]]) {
    in_lanes::<V, 2>(s, pairs.iter().copied(), |[a, b], lanes| {
        for (name, op, model) in float_unary() {
            for (&got, &[a, _]) in op(a).to_array().as_ref().iter().zip(lanes) {
                assert!(same(got, model(a)), "{name}({a:e}) = {got:e}, not {:e}", model(a));
            }
        }
        for (name, op, model) in float_binary() {
            for (&got, &[a, b]) in op(a, b).to_array().as_ref().iter().zip(lanes) {
                let want = model(a, b);
                assert!(same(got, want), "{name}({a:e}, {b:e}) = {got:e}, not {want:e}");
            }
        }
    });
    compare::<V>(s, pairs, f32::to_bits);
}

pub(crate) fn three_floats<V: SimdF32>(s: V::Simd, triples: impl Iterator<Item = [f32; 3]>) {
    in_lanes::<V, 3>(s, triples, |[a, b, c], lanes| {
        let cases = float_ternary();
        let exact = cases.map(|(name, op, model)| {
            let got = op(a, b, c).to_array();
            for (&got, &[a, b, c]) in got.as_ref().iter().zip(lanes) {
                let want = model(a, b, c);
                assert!(same(got, want), "{name}({a:e}, {b:e}, {c:e}) = {got:e}, not {want:e}");
            }
            got
        });
        let fast: [fn(V, V, V) -> V; 4] =
            [V::mul_add_fast, V::mul_sub_fast, V::nmul_add_fast, V::nmul_sub_fast];
        for (op, i) in fast.into_iter().zip(0..) {
            let one_of_both = op(a, b, c).to_array();
            let (twice, once) = (exact[i].as_ref(), exact[i + 4].as_ref());
            for (lane, &got) in one_of_both.as_ref().iter().enumerate().take(lanes.len()) {
                let right = same(got, twice[lane]) || same(got, once[lane]);
                assert!(right, "{}_fast of {:?} = {got:e}", float_ternary::<V>()[i].0, lanes[lane]);
            }
        }
    });
}

/// Floats to integers; `_fast` where the value has one.
pub(crate) fn to_ints<V: SimdF32>(s: V::Simd, floats: &[f32]) {
    in_lanes::<V, 1>(s, floats.iter().map(|&x| [x]), |[x], lanes| {
        let (i32s, u32s) = (x.to_i32().to_array(), x.to_u32().to_array());
        let (fast_i32s, fast_u32s) = (x.to_i32_fast().to_array(), x.to_u32_fast().to_array());
        let floors = x.floor_to_i32_fast().to_array();
        for (i, &[x]) in lanes.iter().enumerate() {
            assert_eq!(i32s.as_ref()[i], x as i32, "{x:e} as i32");
            assert_eq!(u32s.as_ref()[i], x as u32, "{x:e} as u32");
            if (-2147483648.0..2147483648.0).contains(&x) {
                assert_eq!(fast_i32s.as_ref()[i], x as i32, "{x:e} as i32, fast");
                assert_eq!(floors.as_ref()[i], spec::floor(x) as i32, "floor of {x:e}, fast");
            }
            if x > -1.0 && x < 4294967296.0 {
                assert_eq!(fast_u32s.as_ref()[i], x as u32, "{x:e} as u32, fast");
            }
        }
    });
}

/// Integers to floats, and from one sign to the other.
pub(crate) fn from_ints<V: SimdF32>(s: V::Simd, ints: &[u32]) {
    in_lanes::<V::U32, 1>(s, ints.iter().map(|&x| [x]), |[u], lanes| {
        let i = V::I32::from_u32(u);
        assert_eq!(i.to_u32().to_array().as_ref(), u.to_array().as_ref());
        let (from_i32, from_u32) = (V::from_i32(i).to_array(), V::from_u32(u).to_array());
        for (lane, &[u]) in lanes.iter().enumerate() {
            assert_eq!(i.lane(lane), u as i32);
            assert_eq!(
                from_i32.as_ref()[lane].to_bits(),
                (u as i32 as f32).to_bits(),
                "{}",
                u as i32
            );
            assert_eq!(from_u32.as_ref()[lane].to_bits(), (u as f32).to_bits(), "{u}");
        }
    });
}

/// The checks of one type of integers; the trait differs, the text does not.
macro_rules! integers {
    ($name:ident, $Trait:ident, $elem:ident, [$($more:expr),*]) => {
        pub(crate) fn $name<V: $Trait>(s: V::Simd, words: &[[u32; 2]]) {
            let pairs: Vec<_> = words.iter().map(|&[a, b]| [a as $elem, b as $elem]).collect();
            let unary: &[Unary<V, $elem>] = &[("not", |a| !a, |a| !a), $($more),*];
            let binary: [Binary<V, $elem>; 8] = [
                ("+", |a, b| a + b, $elem::wrapping_add),
                ("-", |a, b| a - b, $elem::wrapping_sub),
                ("*", |a, b| a * b, $elem::wrapping_mul),
                ("&", |a, b| a & b, |a, b| a & b),
                ("|", |a, b| a | b, |a, b| a | b),
                ("^", |a, b| a ^ b, |a, b| a ^ b),
                ("min", V::min, |a, b| if a < b { a } else { b }),
                ("max", V::max, |a, b| if a > b { a } else { b }),
            ];
            let shifts: [Case<fn(V, u32) -> V, fn(u32, u32) -> u32>; 2] =
                [("shl", V::shl, spec::shl), ("shr", V::shr, spec::shr)];
            in_lanes::<V, 2>(s, pairs.iter().copied(), |[a, b], lanes| {
                for &(name, op, model) in unary {
                    for (&got, &[a, _]) in op(a).to_array().as_ref().iter().zip(lanes) {
                        assert_eq!(got, model(a), "{name}({a})");
                    }
                }
                for (name, op, model) in binary {
                    for (&got, &[a, b]) in op(a, b).to_array().as_ref().iter().zip(lanes) {
                        assert_eq!(got, model(a, b), "{name}({a}, {b})");
                    }
                }
                // Counts in and out of range.
                let count = lanes[0][1] as u32;
                for n in [count, count % 32, count % 40] {
                    for (name, op, model) in shifts {
                        for (&got, &[a, _]) in op(a, n).to_array().as_ref().iter().zip(lanes) {
                            assert_eq!(got, model(a as u32, n) as $elem, "{name}({a}, {n})");
                        }
                    }
                }
            });
            compare::<V>(s, &pairs, |x| x as u32);
        }
    };
}

integers!(unsigned, SimdU32, u32, []);
integers!(
    signed,
    SimdI32,
    i32,
    [
        ("neg", |a| -a, i32::wrapping_neg),
        ("abs", V::abs, i32::wrapping_abs),
        ("sar 1", |a| a.sar(1), |a| spec::sar(a, 1)),
        ("sar 31", |a| a.sar(31), |a| spec::sar(a, 31)),
        ("sar 32", |a| a.sar(32), |a| spec::sar(a, 32)),
        ("sar max", |a| a.sar(u32::MAX), |a| spec::sar(a, u32::MAX))
    ]
);
