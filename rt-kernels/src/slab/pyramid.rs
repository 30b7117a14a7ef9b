//! Boxes against all rays of one origin at once.
//!
//! **Decides** which of some boxes in lanes no ray passes, so that only the others are tested ray by
//! ray. The rays fill a pyramid, whose sides are planes through its apex, their origin. With
//! everything mirrored so that all directions are positive, and z the dominant axis, x is at most z
//! times the greatest slope of a ray and at least z times the least, and likewise y. A box beyond one
//! of these planes is missed; so is one behind the apex, and one that no ray enters before what still
//! matters to any: not before the greatest, over the axes, of its near plane's distance times the
//! least reciprocal of a direction. And which of them all rays pass: the last enters before the first
//! leaves. Nothing depends on these but time, and so rounding does not matter.
//!
//! **Precision.** Conservative: what is left out here, [`robust`](super::robust) would reject for
//! every ray. The bound of the entry is a product of the same numbers as there or of a lesser one, and
//! rounding is monotone. For the planes, with u = 2^-24: by the errors of two distances (2u each), the
//! padding of one (33u) and a slope (u), a ray can pass only where `near.x <= far.z · slope · (1 + 42u)`;
//! here is 64u. What is subtracted for the inner planes keeps products of subnormal numbers from
//! deciding.
//!
//! **Degenerate inputs.** A direction of ±0 has the slope 0 and the reciprocal ∞; 0 · ∞ is dropped, as
//! there. A lane without a box has one from +∞ to −∞ and is left out.
//!
//! **Operations**, for all boxes: 6 subtractions and 6 products for the mirror; 3 products and 3 maxima
//! for the entry; 6 products, 5 extremes and a comparison for what all pass; 4 products and 6 comparisons for
//! the planes.
//!
//! Source: Reshetov, Soupikov, Hurley, "Multi-Level Ray Tracing Algorithm", 2005; Boulos, Wald,
//! Shirley, "Geometric and Arithmetic Culling Methods for Entire Ray Packets", 2006.

use simd4::SimdF32;
use simd4::math::Vec3;

use super::knobs::{Padded, Widening};
use crate::packet::{Beam, Boxes, Reach};

/// What is the same for all boxes.
#[derive(Clone, Copy)]
pub(crate) struct Culling<'a> {
    pub(crate) beam: &'a Beam,
    /// 1 or −1: makes all directions positive.
    mirror: [f32; 3],
    /// The least and the greatest magnitude of a slope, moved apart.
    slopes: [[f32; 2]; 2],
}

impl<'a> Culling<'a> {
    #[inline(always)]
    pub(crate) fn new(beam: &'a Beam) -> Self {
        let ([nx, ny, nz], [x, y]) = (beam.negative, beam.slopes);
        Culling { beam, mirror: [sign(nx), sign(ny), sign(nz)], slopes: [apart(x), apart(y)] }
    }

    /// The origin of all rays, in the order of the axes.
    #[inline(always)]
    pub(crate) fn apex(&self) -> [f32; 3] {
        let [[x, _], [y, _], [z, _]] = self.beam.origin;
        [x, y, z]
    }

    /// The boxes that some ray may pass with `t <= limit`.
    #[inline(always)]
    pub(crate) fn candidates<B: SimdF32, X: Boxes<B>>(
        &self,
        s: B::Simd,
        boxes: &X,
        limit: f32,
    ) -> Candidates<B> {
        let Beam { axes, negative, inv, .. } = *self.beam;
        let apex = self.apex();
        let zero = B::splat(s, 0.0);
        let (mut near, mut far) = ([zero; 3], [zero; 3]);
        let mut enter = zero;
        let (mut last_enter, mut first_exit) = (zero, B::splat(s, f32::INFINITY));
        for k in 0..3 {
            let side = usize::from(negative[k]);
            let mirror = B::splat(s, self.mirror[k]);
            let near_plane = boxes.side(s, axes[k], side);
            let far_plane = boxes.side(s, axes[k], 1 - side);
            let origin = B::splat(s, apex[k]);
            near[k] = (near_plane - origin) * mirror;
            far[k] = (far_plane - origin) * mirror;
            // The order of operands drops NaNs.
            let [least, greatest] = inv[k].map(|inv| B::splat(s, inv));
            enter = (near[k] * least).max(enter);
            last_enter = last_enter.max(near[k] * greatest);
            first_exit = first_exit.min(far[k] * least);
        }
        let tiny = B::splat(s, TINY);
        let mut mask = enter.le(B::splat(s, limit)) & far[2].ge(zero);
        for k in 0..2 {
            let [least, greatest] = self.slopes[k];
            let outer = far[2] * B::splat(s, greatest);
            let inner = near[2].mul_sub_fast(B::splat(s, least), tiny);
            mask &= near[k].le(outer) & inner.le(far[k]);
        }
        Candidates { mask, all: last_enter.le(first_exit), enter, near, far }
    }
}

/// How much the slopes are moved apart: see "Precision" above.
const MARGIN: f32 = 1.0 / (1 << 18) as f32;

/// What no product may be below that leaves a box out.
const TINY: f32 = 1.0 / (1u128 << 100) as f32;

#[inline(always)]
fn sign(negative: bool) -> f32 {
    if negative { -1.0 } else { 1.0 }
}

/// Of slopes that all have the same sign.
#[inline(always)]
fn apart([a, b]: [f32; 2]) -> [f32; 2] {
    let (a, b) = (a.abs(), b.abs());
    let (least, greatest) = if a < b { (a, b) } else { (b, a) };
    [least * (1.0 - MARGIN), greatest * (1.0 + MARGIN) + f32::MIN_POSITIVE]
}

/// Boxes that some ray may pass.
pub(crate) struct Candidates<B: SimdF32> {
    /// Their lanes.
    pub(crate) mask: B::Mask,
    /// Those that all rays pass.
    pub(crate) all: B::Mask,
    /// No ray enters before.
    pub(crate) enter: B,
    /// The mirrored planes, seen from the apex.
    near: [B; 3],
    far: [B; 3],
}

/// The planes of [`Candidates`], to be spread over rays.
pub(crate) struct Sides<B: SimdF32> {
    near: [B::Array; 3],
    far: [B::Array; 3],
}

impl<B: SimdF32> Sides<B> {
    #[inline(always)]
    pub(crate) fn new(of: &Candidates<B>) -> Self {
        let ([nx, ny, nz], [fx, fy, fz]) = (of.near, of.far);
        Sides {
            near: [nx.to_array(), ny.to_array(), nz.to_array()],
            far: [fx.to_array(), fy.to_array(), fz.to_array()],
        }
    }

    /// Those of the box in that lane.
    #[inline(always)]
    pub(crate) fn one<V: SimdF32<Simd = B::Simd>>(&self, s: V::Simd, lane: usize) -> BoxSides<V> {
        let lane = lane & (B::LANES - 1);
        let [nx, ny, nz] = &self.near;
        let [fx, fy, fz] = &self.far;
        let of = |side: &B::Array| V::splat(s, side.as_ref()[lane]);
        BoxSides { near: Vec3::new(of(nx), of(ny), of(nz)), far: Vec3::new(of(fx), of(fy), of(fz)) }
    }
}

/// The mirrored planes of one box, seen from the apex, in all lanes.
pub(crate) struct BoxSides<V> {
    near: Vec3<V>,
    far: Vec3<V>,
}

impl<V: SimdF32> BoxSides<V> {
    /// The rays, with one origin, that may pass the box: those of which [`robust`](super::robust) says so, by
    /// the same operations.
    #[inline(always)]
    pub(crate) fn may_hit(&self, s: V::Simd, rays: Reach<V>) -> V::Mask {
        let (inv, near, far) = (rays.inv, &self.near, &self.far);
        let enter = (near.z * inv.z).max((near.y * inv.y).max((near.x * inv.x).max(rays.tmin)));
        let exit = (far.z * inv.z).min((far.y * inv.y).min((far.x * inv.x).min(rays.limit)));
        enter.le(Padded::widen(s, exit))
    }
}

#[cfg(test)]
mod tests {
    use simd4::{Level, Simd, SimdMask, dispatch};

    use super::*;
    use crate::geom::Aabb;

    /// Rays from the origin along z, with slopes from 0.1 to 0.2 on x and from -0.2 to -0.1 on y.
    fn beam() -> Beam {
        let [steep, flat] = [1.0 / 0.2, 1.0 / 0.1];
        Beam {
            axes: [0, 1, 2],
            negative: [false, true, false],
            origin: [[0.0; 2]; 3],
            inv: [[steep, flat], [steep, flat], [1.0, 1.0]],
            slopes: [[0.1, 0.2], [-0.2, -0.1]],
        }
    }

    #[inline(always)]
    fn masks<S: Simd>(s: S, aabb: &Aabb) -> [bool; 2] {
        let beam = beam();
        let found = Culling::new(&beam).candidates::<S::f32x4, _>(s, aabb, f32::INFINITY);
        assert!(found.mask.all() == found.mask.any() && found.all.all() == found.all.any());
        [found.mask.any(), found.mask.any() && found.all.any()]
    }

    #[test]
    fn boxes_are_passed_by_none_by_some_or_by_all() {
        let slab = |x: [f32; 2]| Aabb { axes: [x, [-0.3, 0.0], [0.5, 1.0]] };
        let cases = [
            (slab([0.0, 0.3]), [true, true]),
            (slab([0.15, 0.3]), [true, false]),
            (slab([-0.3, 0.08]), [true, false]),
            (slab([0.21, 0.3]), [false, false]),
            (slab([-0.3, 0.04]), [false, false]),
        ];
        for (aabb, expected) in cases {
            for level in Level::available() {
                let found = dispatch!(level, s => masks(s, &aabb));
                assert_eq!(found, expected, "{aabb:?} at {level}");
            }
        }
    }
}
