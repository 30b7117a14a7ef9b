//! What knows lanes by their number: masks, memory, moves and reductions.

use std::hint::black_box;

use simd4::prelude::*;
use simd4::{Element, LaneArray, spec, swizzle};

use crate::numbers::{in_lanes, same};

/// What two lanes become.
type Fold = fn(f32, f32) -> f32;

/// The mask of those bits.
fn mask_of<M: SimdMask>(s: M::Simd, bits: u32) -> M {
    M::from_array(s, LaneArray::from_fn(|i| bits >> i & 1 == 1))
}

/// Masks to try: all of few lanes, of many the regular ones and a scatter.
fn some_masks(lanes: usize) -> Vec<u32> {
    let full = u32::MAX >> (32 - lanes);
    if lanes <= 8 {
        return (0..=full).step_by(if cfg!(miri) { 23 } else { 1 }).collect();
    }
    let prefixes = (0..=lanes).map(|n| (1u64 << n) as u32 - 1);
    let singles = (0..lanes).map(|n| 1 << n);
    let scatter = (0..if cfg!(miri) { 4 } else { 64u32 }).map(|i| i.wrapping_mul(0x9e37_79b9) >> 7);
    let all = prefixes.chain(singles).flat_map(|m| [m, !m]).chain(scatter).map(|m| m & full);
    all.step_by(if cfg!(miri) { 7 } else { 1 }).collect()
}

pub(crate) fn masks<M: SimdMask>(s: M::Simd) {
    let full = u32::MAX >> (32 - M::LANES);
    let some = some_masks(M::LANES);
    for &a in &some {
        let mask: M = mask_of(s, a);
        assert_eq!(mask.bitmask(), a);
        assert!((0..M::LANES).all(|i| mask.to_array().as_ref()[i] == (a >> i & 1 == 1)));
        assert_eq!((!mask).bitmask(), full & !a);
        assert_eq!(mask.any(), a != 0);
        assert_eq!(mask.none(), a == 0);
        assert_eq!(mask.all(), a == full);
        assert_eq!(mask.count(), a.count_ones());
        assert_eq!(mask.first(), (0..M::LANES).find(|i| a >> i & 1 == 1));
        for &b in &some {
            let other: M = mask_of(s, b);
            assert_eq!((mask & other).bitmask(), a & b);
            assert_eq!((mask | other).bitmask(), a | b);
            assert_eq!((mask ^ other).bitmask(), a ^ b);
            assert_eq!(mask.and_not(other).bitmask(), a & !b);
        }
    }
    assert_eq!(M::splat(s, true).bitmask(), full);
    assert_eq!(M::splat(s, false).bitmask(), 0);
}

/// Loads and stores of every length and mask keep to the slice and to the order of lanes.
pub(crate) fn memory<V: Lanes>(s: V::Simd) {
    let elem = V::Elem::from_index;
    let (fill, old) = (elem(7), elem(9));
    let source: Vec<V::Elem> = (100..).map(elem).take(2 * V::LANES + 1).collect();
    let prefix_of = |n: usize| -> Vec<V::Elem> {
        (0..V::LANES).map(|i| if i < n { source[i] } else { fill }).collect()
    };
    for n in 0..=source.len() {
        let want = prefix_of(n);
        // A slice of its own, so that whoever reads past it can be caught.
        let from = source[..n].to_vec();
        let v = V::load_prefix(s, &from, fill);
        assert_eq!(v.to_array().as_ref(), want);
        assert_eq!(V::from_array(s, v.to_array()).to_array().as_ref(), want);

        let mut to = vec![old; n];
        v.store_prefix(&mut to);
        let kept = n.min(V::LANES);
        assert_eq!(to[..kept], want[..kept]);
        assert!(to[kept..].iter().all(|&x| x == old));
        if n >= V::LANES {
            assert_eq!(V::load(s, &from).to_array().as_ref(), want);
            let mut to = vec![old; n];
            v.store(&mut to);
            assert_eq!(to[..V::LANES], want[..]);
            assert!(to[V::LANES..].iter().all(|&x| x == old));
        }
    }
    assert!(V::splat(s, fill).to_array().as_ref().iter().all(|&x| x == fill));
    let iota = V::iota(s);
    assert!((0..V::LANES).all(|i| iota.lane(i) == elem(i)));

    let v = V::load(s, &source);
    for bits in some_masks(V::LANES) {
        let mask: V::Mask = mask_of(s, bits);
        let chosen: Vec<usize> = (0..V::LANES).filter(|i| bits >> i & 1 == 1).collect();
        // As short as the mask allows.
        let needed = chosen.last().map_or(0, |last| last + 1);
        let from = source[..needed].to_vec();
        let loaded = V::load_masked(s, &from, mask, fill).to_array();
        let mut to = vec![old; needed];
        v.store_masked(&mut to, mask);
        for (i, &got) in loaded.as_ref().iter().enumerate() {
            let wanted = chosen.contains(&i);
            assert_eq!(got, if wanted { source[i] } else { fill }, "load_masked {bits:b}");
            if i < needed {
                assert_eq!(to[i], if wanted { source[i] } else { old }, "store_masked {bits:b}");
            }
        }
        for room in [chosen.len(), chosen.len() + 1, V::LANES, V::LANES + 3] {
            let mut to = vec![old; room.max(chosen.len())];
            assert_eq!(v.compress_store(mask, &mut to), chosen.len());
            let want = chosen.iter().map(|&i| source[i]).chain(std::iter::repeat(old));
            assert!(to.iter().copied().eq(want.take(to.len())), "compress_store {bits:b}: {to:?}");
        }
    }
}

/// Every element of a slice, at lanes of every number.
pub(crate) fn gathers<V: SimdF32>(s: V::Simd) {
    let source: Vec<f32> = (0..37).map(|i| i as f32 * 1.5 - 3.0).collect();
    for start in 0..source.len() as u32 {
        let index = V::U32::from_array(
            s,
            LaneArray::from_fn(|i| (start + 11 * i as u32) % source.len() as u32),
        );
        let got = V::gather(&source, index).to_array();
        for (lane, &got) in got.as_ref().iter().enumerate() {
            assert_eq!(got, source[index.lane(lane) as usize]);
        }
    }
}

/// Everything that must panic does, and nothing is written before.
pub(crate) fn out_of_bounds<V: SimdF32>(s: V::Simd) {
    let panics = |f: &mut dyn FnMut()| {
        let hook = std::panic::take_hook();
        std::panic::set_hook(Box::new(|_| {}));
        let caught = std::panic::catch_unwind(std::panic::AssertUnwindSafe(f)).is_err();
        std::panic::set_hook(hook);
        caught
    };
    let short = vec![1.0; V::LANES - 1];
    let all = V::Mask::splat(s, true);
    let v = V::splat(s, 2.0);
    assert!(panics(&mut || _ = black_box(V::load(s, &short).to_array())));
    assert!(panics(&mut || v.store(&mut short.clone())));
    assert!(panics(&mut || _ = black_box(V::load_masked(s, &short, all, 0.0).to_array())));
    assert!(panics(&mut || v.store_masked(&mut short.clone(), all)));
    assert!(panics(&mut || _ = black_box(v.compress_store(all, &mut short.clone()))));
    assert!(panics(&mut || _ = black_box(v.lane(V::LANES))));
    for outside in [short.len() as u32, 1 << 31, u32::MAX] {
        let mut index = V::U32::splat(s, 0).to_array();
        index.as_mut()[V::LANES - 1] = outside;
        let index = V::U32::from_array(s, index);
        assert!(
            panics(&mut || _ = black_box(V::gather(&short, index).to_array())),
            "index {outside}"
        );
    }
}

/// Lanes of two vectors, told apart by their values, against the moves' indices in plain loops.
pub(crate) fn moves<V: Lanes>(s: V::Simd) {
    let n = V::LANES;
    let a = V::iota(s);
    let b = a + V::splat(s, V::Elem::from_index(n));
    let expect = |what: &str, got: V, want: &dyn Fn(usize) -> usize| {
        for i in 0..n {
            assert_eq!(got.lane(i), V::Elem::from_index(want(i)), "lane {i} of {what}");
        }
    };
    expect("reverse", a.reverse(), &|i| n - 1 - i);
    expect("rotate 0", a.rotate::<0>(), &|i| i);
    expect("rotate 1", a.rotate::<1>(), &|i| (i + 1) % n);
    expect("rotate 3", a.rotate::<3>(), &|i| (i + 3) % n);
    expect("rotate 6", a.rotate::<6>(), &|i| (i + 6) % n);
    let (low, high) = a.zip(b);
    let zipped = |i: usize| if i.is_multiple_of(2) { i / 2 } else { n + i / 2 };
    expect("zip, low", low, &zipped);
    expect("zip, high", high, &|i| zipped(i + n));
    let (even, odd) = a.unzip(b);
    expect("unzip, even", even, &|i| 2 * i);
    expect("unzip, odd", odd, &|i| 2 * i + 1);
}

/// Every lane to every place, in orders that name one lane several times, and lanes that there are not.
pub(crate) fn permutes<V: SimdF32>(s: V::Simd) {
    let n = V::LANES as u32;
    for (start, step) in
        (0..2 * n).flat_map(|start| [0, 1, 3, n - 1, 1 << 30].map(|step| (start, step)))
    {
        let want = |i: usize| start.wrapping_add((i as u32).wrapping_mul(step));
        let order = V::U32::from_array(s, LaneArray::from_fn(want));
        let floats = V::iota(s).permute(order);
        let ints = V::I32::iota(s).permute(order);
        let unsigned = V::U32::iota(s).permute(order);
        for i in 0..V::LANES {
            let want = want(i) % n;
            let got = (floats.lane(i), ints.lane(i), unsigned.lane(i));
            assert_eq!(got, (want as f32, want as i32, want), "lane {i}, from {start} by {step}");
        }
    }
}

/// Orders that stand in place, of four and of eight lanes.
pub(crate) fn swizzles<S: Simd>(s: S) {
    let (four, eight) = (S::f32x4::iota(s), S::u32x8::iota(s));
    assert_eq!(swizzle!(four, [3, 3, 0, 1]).to_array(), [3.0, 3.0, 0.0, 1.0]);
    assert_eq!(swizzle!(four, [0, 1, 2, 3]).to_array(), [0.0, 1.0, 2.0, 3.0]);
    assert_eq!(swizzle!(eight, [7, 0, 6, 1, 5, 2, 4, 4]).to_array(), [7, 0, 6, 1, 5, 2, 4, 4]);
    let sixteen = S::i32x16::iota(s);
    let order = [15, 0, 14, 1, 13, 2, 12, 3, 11, 4, 10, 5, 9, 6, 8, 8];
    let got = swizzle!(sixteen, [15, 0, 14, 1, 13, 2, 12, 3, 11, 4, 10, 5, 9, 6, 8, 8]);
    assert_eq!(got.to_array(), order);
}

/// Two halves make a whole and come out of it again.
pub(crate) fn halves<V: Wide>(s: V::Simd) {
    let v = V::iota(s);
    let (low, high) = v.halves();
    let n = V::Half::LANES;
    assert_eq!(2 * n, V::LANES);
    assert!((0..n).all(|i| low.lane(i) == v.lane(i) && high.lane(i) == v.lane(n + i)));
    let turned = V::concat(high, low);
    assert!((0..n).all(|i| turned.lane(i) == high.lane(i) && turned.lane(n + i) == low.lane(i)));
}

/// Sums, products, least and greatest of every row of lanes, in the order of the definition.
pub(crate) fn float_reductions<V: SimdF32>(s: V::Simd, floats: &[f32]) {
    in_lanes::<V, 1>(s, floats.iter().map(|&x| [x]), |[v], _| {
        let lanes = v.to_array();
        let lanes = lanes.as_ref();
        let cases: [(&str, f32, Fold); 4] = [
            ("sum", v.reduce_sum(), |a, b| a + b),
            ("product", v.reduce_product(), |a, b| a * b),
            ("min", v.reduce_min(), spec::min),
            ("max", v.reduce_max(), spec::max),
        ];
        for (name, got, model) in cases {
            let want = spec::reduce(lanes, model);
            assert!(same(got, want), "{name} of {lanes:?} = {got:e}, not {want:e}");
        }
        for bits in [u32::MAX, 0, 0b1010_1010_1010_1010, 0b110_0110, 1 << (V::LANES - 1)] {
            let mask: V::Mask = mask_of(s, bits);
            let allowed = mask.to_array();
            let exact = |x: Option<(usize, f32)>| x.map(|(lane, x)| (lane, x.to_bits()));
            let (least, greatest) = (v.argmin(mask), v.argmax(mask));
            let want = exact(spec::argmin(lanes, allowed.as_ref()));
            assert_eq!(exact(least), want, "argmin of {lanes:?} under {bits:b}");
            let want = exact(spec::argmax(lanes, allowed.as_ref()));
            assert_eq!(exact(greatest), want, "argmax of {lanes:?} under {bits:b}");
        }
    });
}

/// The same of integers.
pub(crate) fn int_reductions<V: Lanes>(s: V::Simd, ints: &[V::Elem]) {
    in_lanes::<V, 1>(s, ints.iter().map(|&x| [x]), |[v], _| {
        let lanes = v.to_array();
        let lanes = lanes.as_ref();
        assert_eq!(v.reduce_min(), spec::reduce(lanes, spec::min));
        assert_eq!(v.reduce_max(), spec::reduce(lanes, spec::max));
        for bits in [u32::MAX, 0, 0b1010_1010_1010_1010, 0b110_0110] {
            let mask: V::Mask = mask_of(s, bits);
            let allowed = mask.to_array();
            assert_eq!(v.argmin(mask), spec::argmin(lanes, allowed.as_ref()));
            assert_eq!(v.argmax(mask), spec::argmax(lanes, allowed.as_ref()));
        }
    });
}

/// Sums and products that wrap.
pub(crate) fn wrapping<V: SimdU32>(s: V::Simd, ints: &[u32]) {
    in_lanes::<V, 1>(s, ints.iter().map(|&x| [x]), |[v], _| {
        let lanes = v.to_array();
        assert_eq!(v.reduce_sum(), spec::reduce(lanes.as_ref(), u32::wrapping_add));
        assert_eq!(v.reduce_product(), spec::reduce(lanes.as_ref(), u32::wrapping_mul));
    });
}
