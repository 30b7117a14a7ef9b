//! The choices of arithmetic that kernels leave open: how a reciprocal is had, and how often a
//! product and a sum are rounded.

use simd4::SimdF32;
use simd4::math::Vec3;

/// How a kernel has the one reciprocal of each test.
pub trait Reciprocal: Send + Sync + 'static {
    /// In words.
    const NAME: &'static str;
    /// Whether the bits are the same on every level and machine.
    const EXACT: bool;

    /// About `1 / x`.
    fn of<V: SimdF32>(s: V::Simd, x: V) -> V;
}

/// A division, correctly rounded.
#[derive(Clone, Copy, Debug)]
pub struct Division;

impl Reciprocal for Division {
    const NAME: &'static str = "division";
    const EXACT: bool = true;

    #[inline(always)]
    fn of<V: SimdF32>(s: V::Simd, x: V) -> V {
        V::splat(s, 1.0) / x
    }
}

/// The machine's estimate, refined to 22 bits ([`SimdF32::rcp_fast`]).
#[derive(Clone, Copy, Debug)]
pub struct Refined;

impl Reciprocal for Refined {
    const NAME: &'static str = "refined";
    const EXACT: bool = false;

    #[inline(always)]
    fn of<V: SimdF32>(_: V::Simd, x: V) -> V {
        x.rcp_fast()
    }
}

/// The machine's estimate, of 11 bits ([`SimdF32::rcp_est`]).
#[derive(Clone, Copy, Debug)]
pub struct Estimate;

impl Reciprocal for Estimate {
    const NAME: &'static str = "estimate";
    const EXACT: bool = false;

    #[inline(always)]
    fn of<V: SimdF32>(_: V::Simd, x: V) -> V {
        x.rcp_est()
    }
}

/// How products and sums are rounded.
pub trait Rounding: Send + Sync + 'static {
    /// In words; empty if there is nothing to say.
    const NAME: &'static str;
    /// Whether anything is rounded once where it could be twice.
    const FUSED: bool;

    /// `a * b + c`.
    fn mul_add<V: SimdF32>(a: V, b: V, c: V) -> V;

    /// `c - a * b`.
    fn nmul_add<V: SimdF32>(a: V, b: V, c: V) -> V;

    /// `a * b - c * d`.
    fn difference<V: SimdF32>(a: V, b: V, c: V, d: V) -> V;

    /// The scalar product, x first and z last.
    #[inline(always)]
    fn dot<V: SimdF32>(a: Vec3<V>, b: Vec3<V>) -> V {
        Self::mul_add(a.z, b.z, Self::mul_add(a.y, b.y, a.x * b.x))
    }

    /// The vector product.
    #[inline(always)]
    fn cross<V: SimdF32>(a: Vec3<V>, b: Vec3<V>) -> Vec3<V> {
        Vec3::new(
            Self::difference(a.y, b.z, a.z, b.y),
            Self::difference(a.z, b.x, a.x, b.z),
            Self::difference(a.x, b.y, a.y, b.x),
        )
    }
}

/// Every product and every sum is rounded: what the formulas say.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

impl Rounding for Plain {
    const NAME: &'static str = "";
    const FUSED: bool = false;

    #[inline(always)]
    fn mul_add<V: SimdF32>(a: V, b: V, c: V) -> V {
        a.mul_add(b, c)
    }
    #[inline(always)]
    fn nmul_add<V: SimdF32>(a: V, b: V, c: V) -> V {
        a.nmul_add(b, c)
    }
    #[inline(always)]
    fn difference<V: SimdF32>(a: V, b: V, c: V, d: V) -> V {
        a * b - c * d
    }
}

/// Everything that can be is contracted, as compilers do when they are let: in a difference of two
/// products only one of them is rounded.
#[derive(Clone, Copy, Debug)]
pub struct Fused;

impl Rounding for Fused {
    const NAME: &'static str = "fused";
    const FUSED: bool = true;

    #[inline(always)]
    fn mul_add<V: SimdF32>(a: V, b: V, c: V) -> V {
        a.fused_mul_add(b, c)
    }
    #[inline(always)]
    fn nmul_add<V: SimdF32>(a: V, b: V, c: V) -> V {
        a.fused_nmul_add(b, c)
    }
    #[inline(always)]
    fn difference<V: SimdF32>(a: V, b: V, c: V, d: V) -> V {
        c.fused_nmul_add(d, a * b)
    }
}

/// As [`Fused`], but both products of a difference are rounded, so that it is antisymmetric and
/// never has the wrong sign.
#[derive(Clone, Copy, Debug)]
pub struct Split;

impl Rounding for Split {
    const NAME: &'static str = "fused, products compared";
    const FUSED: bool = true;

    #[inline(always)]
    fn mul_add<V: SimdF32>(a: V, b: V, c: V) -> V {
        Fused::mul_add(a, b, c)
    }
    #[inline(always)]
    fn nmul_add<V: SimdF32>(a: V, b: V, c: V) -> V {
        Fused::nmul_add(a, b, c)
    }
    #[inline(always)]
    fn difference<V: SimdF32>(a: V, b: V, c: V, d: V) -> V {
        Plain::difference(a, b, c, d)
    }
}

/// As [`Fused`], with differences of products by Kahan's algorithm, right to 1.5 units in the last
/// place (Jeannerod, Louvet, Muller 2013).
#[derive(Clone, Copy, Debug)]
pub struct Kahan;

impl Rounding for Kahan {
    const NAME: &'static str = "fused, Kahan";
    const FUSED: bool = true;

    #[inline(always)]
    fn mul_add<V: SimdF32>(a: V, b: V, c: V) -> V {
        Fused::mul_add(a, b, c)
    }
    #[inline(always)]
    fn nmul_add<V: SimdF32>(a: V, b: V, c: V) -> V {
        Fused::nmul_add(a, b, c)
    }
    #[inline(always)]
    fn difference<V: SimdF32>(a: V, b: V, c: V, d: V) -> V {
        let product = c * d;
        let error = c.fused_nmul_add(d, product);
        a.fused_mul_sub(b, product) + error
    }
}

/// The choices of a kernel in words.
pub(super) fn words<R: Reciprocal, A: Rounding>(more: &[&str]) -> String {
    let words = [&[R::NAME, A::NAME], more].concat();
    words.into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(", ")
}
