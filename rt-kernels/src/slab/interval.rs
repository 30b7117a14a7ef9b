//! Boxes against all rays of a large packet at once, wherever they start.
//!
//! **Decides** which of some boxes in lanes no ray passes, so that only the others are tested ray by
//! ray. Origins and reciprocals of directions are intervals, so distances to planes are: with
//! everything mirrored so that all directions are positive, no ray enters a box before its nearer
//! planes' least distance from an origin times the least reciprocal, and none leaves it after its
//! farther planes' greatest times the greatest. A box that is left before it is entered is missed.
//!
//! **Precision.** Conservative: what is left out here, [`robust`](super::robust) would reject for
//! every ray. Both bounds are had by the operations of its distances from numbers on the safe side, and
//! rounding is monotone.
//!
//! **Degenerate inputs.** 0 · ∞ is dropped, as there. A lane without a box has one from +∞ to −∞ and is
//! left out.
//!
//! **Operations**, for all boxes: 6 subtractions, 6 products for the mirror, 7 more, 3 maxima, 3 minima,
//! 1 comparison.
//!
//! Source: Boulos, Wald, Shirley, "Geometric and Arithmetic Culling Methods for Entire Ray Packets",
//! 2006.

use simd4::SimdF32;

use super::knobs::{Padded, Widening};
use crate::packet::{Beam, Boxes};

/// The boxes that some ray may pass with `t <= limit`, and where none enters before.
#[inline(always)]
pub(crate) fn candidates<B: SimdF32, X: Boxes<B>>(
    s: B::Simd,
    boxes: &X,
    beam: &Beam,
    limit: f32,
) -> (B::Mask, B) {
    let mut enter = B::splat(s, 0.0);
    let mut exit = B::splat(s, limit);
    for k in 0..3 {
        let (side, axis) = (usize::from(beam.negative[k]), beam.axes[k]);
        let mirror = B::splat(s, if beam.negative[k] { -1.0 } else { 1.0 });
        let (origin, [least, greatest]) = (beam.origin[k], beam.inv[k]);
        let near = (boxes.side(s, axis, side) - B::splat(s, origin[1 - side])) * mirror;
        let far = (boxes.side(s, axis, 1 - side) - B::splat(s, origin[side])) * mirror;
        // The order of operands drops NaNs.
        enter = (near * B::splat(s, least)).max(enter);
        exit = (far * B::splat(s, greatest)).min(exit);
    }
    (enter.le(Padded::widen(s, exit)), enter)
}
