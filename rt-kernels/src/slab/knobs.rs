//! The choices of arithmetic that slab tests leave open: how the distance to a plane is had, in
//! which order minima and maxima are taken, and how much an interval is widened.

use simd4::SimdF32;

/// How the distance along a ray to a plane across an axis is had.
pub trait Distance: Send + Sync + 'static {
    /// In words; empty if there is nothing to say.
    const NAME: &'static str;
    /// Whether a product and a sum are rounded once.
    const FUSED: bool;

    /// About `(plane - origin) / dir`, where `inv` is about `1 / dir`.
    fn to<V: SimdF32>(plane: V, origin: V, inv: V) -> V;
}

/// `(plane − origin) · inv`: right to three roundings, wherever the plane is.
#[derive(Clone, Copy, Debug)]
pub struct Relative;

impl Distance for Relative {
    const NAME: &'static str = "";
    const FUSED: bool = false;

    #[inline(always)]
    fn to<V: SimdF32>(plane: V, origin: V, inv: V) -> V {
        (plane - origin) * inv
    }
}

/// `plane · inv − origin · inv` with the second product made once a ray and the rest fused: one
/// operation. The error is that of the products, however near the plane is, and of an infinite
/// reciprocal there remains ∞ − ∞.
#[derive(Clone, Copy, Debug)]
pub struct Scaled;

impl Distance for Scaled {
    const NAME: &'static str = "b·r − o·r";
    const FUSED: bool = true;

    #[inline(always)]
    fn to<V: SimdF32>(plane: V, origin: V, inv: V) -> V {
        plane.fused_mul_sub(inv, origin * inv)
    }
}

/// How the two distances of an axis narrow an interval, where nobody knows which is the nearer.
///
/// `min` and `max` give their second operand where either is NaN, as SSE does: the order of
/// operands decides what becomes of 0 · ∞.
pub trait Order: Send + Sync + 'static {
    /// In words.
    const NAME: &'static str;

    /// What `enter..=exit` and the interval between `a` and `b` have in common.
    fn narrow<V: SimdF32>(interval: [V; 2], a: V, b: V) -> [V; 2];
}

/// `max(enter, min(a, b))`: a NaN that comes out of the inner minimum becomes the whole interval's,
/// and the next axis makes it forget all axes before. Loses rays in a plane, and hits what they miss.
#[derive(Clone, Copy, Debug)]
pub struct IntervalFirst;

impl Order for IntervalFirst {
    const NAME: &'static str = "interval first";

    #[inline(always)]
    fn narrow<V: SimdF32>([enter, exit]: [V; 2], a: V, b: V) -> [V; 2] {
        [enter.max(a.min(b)), exit.min(a.max(b))]
    }
}

/// `max(min(a, b), enter)`: a NaN from the upper plane is dropped; one from the lower plane makes
/// the upper one both ends of the slab. Loses half of the rays in a plane.
#[derive(Clone, Copy, Debug)]
pub struct IntervalLast;

impl Order for IntervalLast {
    const NAME: &'static str = "interval last";

    #[inline(always)]
    fn narrow<V: SimdF32>([enter, exit]: [V; 2], a: V, b: V) -> [V; 2] {
        [a.min(b).max(enter), a.max(b).min(exit)]
    }
}

/// `min(max(a, enter), max(b, enter))`: each distance is clipped alone, so that a NaN is dropped and
/// the slab has no end there (Barnes 2022). Two operations more.
#[derive(Clone, Copy, Debug)]
pub struct EachClipped;

impl Order for EachClipped {
    const NAME: &'static str = "each clipped";

    #[inline(always)]
    fn narrow<V: SimdF32>([enter, exit]: [V; 2], a: V, b: V) -> [V; 2] {
        [a.max(enter).min(b.max(enter)), a.min(exit).max(b.min(exit))]
    }
}

/// By how much the end of an interval is moved out, so that rounding never loses a ray.
pub trait Widening: Send + Sync + 'static {
    /// In words; empty if there is nothing to say.
    const NAME: &'static str;

    /// The end, moved out.
    fn widen<V: SimdF32>(s: V::Simd, exit: V) -> V;
}

/// Not at all.
#[derive(Clone, Copy, Debug)]
pub struct Bare;

impl Widening for Bare {
    const NAME: &'static str = "";

    #[inline(always)]
    fn widen<V: SimdF32>(_: V::Simd, exit: V) -> V {
        exit
    }
}

/// By the factor 1 + 2γ₃, γ₃ = 3u / (1 − 3u), which is what three roundings of either end may
/// amount to (Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013).
#[derive(Clone, Copy, Debug)]
pub struct Ize;

impl Widening for Ize {
    const NAME: &'static str = "Ize";

    #[inline(always)]
    fn widen<V: SimdF32>(s: V::Simd, exit: V) -> V {
        exit * V::splat(s, 1.0 + 3.0 * f32::EPSILON)
    }
}

/// By the factor 1 + 2^-19, for the errors of what is in the box as well (`geom::aabb`).
#[derive(Clone, Copy, Debug)]
pub struct Padded;

impl Widening for Padded {
    const NAME: &'static str = "padded";

    #[inline(always)]
    fn widen<V: SimdF32>(s: V::Simd, exit: V) -> V {
        exit * V::splat(s, 1.0 + crate::geom::PADDING)
    }
}

/// The choices of a kernel in words.
pub(super) fn words(words: &[&str]) -> String {
    words.iter().copied().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(", ")
}
