//! Boxes in lanes.

use simd4::SimdF32;

use crate::geom::{Aabb, PADDING};

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

impl<V: SimdF32> OwnBoxes<V> {
    /// The boxes of primitives with these bounds: the same bits as [`Aabb::padded`].
    #[inline(always)]
    pub(crate) fn padded(s: V::Simd, [x, y, z]: [[V; 2]; 3]) -> Self {
        let extent = (x[1] - x[0]).max(y[1] - y[0]).max(z[1] - z[0]) * V::splat(s, PADDING);
        OwnBoxes([padded(s, x, extent), padded(s, y, extent), padded(s, z, extent)])
    }
}

#[inline(always)]
fn padded<V: SimdF32>(s: V::Simd, [min, max]: [V; 2], extent: V) -> [V; 2] {
    let pad = extent + min.abs().max(max.abs()) * V::splat(s, f32::EPSILON);
    [min - pad, max + pad]
}

impl<V: SimdF32> Boxes<V> for OwnBoxes<V> {
    #[inline(always)]
    fn side(&self, _: V::Simd, axis: usize, side: usize) -> V {
        self.0[axis][side & 1]
    }
}
