//! Boxes in lanes.

use simd4::SimdF32;

use crate::geom::Aabb;

/// What rays are tested against: one box in all lanes ([`Aabb`]), or each lane its own.
pub trait Boxes<V: SimdF32> {
    /// The least coordinate on an axis (`side` 0) or the greatest (1).
    fn side(&self, s: V::Simd, axis: usize, side: usize) -> V;
}

impl<V: SimdF32> Boxes<V> for Aabb {
    #[inline(always)]
    fn side(&self, s: V::Simd, axis: usize, side: usize) -> V {
        // The mask tells the compiler that there are but two sides.
        V::splat(s, self.axes[axis][side & 1])
    }
}

/// A box for each lane: for each axis the minima and the maxima.
#[derive(Clone, Copy, Debug)]
pub struct OwnBoxes<V>(pub [[V; 2]; 3]);

impl<V: SimdF32> Boxes<V> for OwnBoxes<V> {
    #[inline(always)]
    fn side(&self, _: V::Simd, axis: usize, side: usize) -> V {
        self.0[axis][side & 1]
    }
}
