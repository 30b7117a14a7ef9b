//! What builders work on: primitives as boxes, in lanes.

use simd4::f32x4;
use simd4::prelude::*;

use crate::geom::Aabb;
use crate::primitives::Primitives;

/// A box in lanes: x, y and z in the first three. The fourth means nothing.
#[derive(Clone, Copy)]
pub(crate) struct Bounds {
    low: f32x4,
    high: f32x4,
}

impl Bounds {
    /// The box of nothing: its union with any box is that box.
    #[inline(always)]
    pub(super) fn empty() -> Bounds {
        Bounds { low: f32x4::from(f32::INFINITY), high: f32x4::from(f32::NEG_INFINITY) }
    }

    /// The box of one point.
    #[inline(always)]
    pub(super) fn point(point: f32x4) -> Bounds {
        Bounds { low: point, high: point }
    }

    /// All points between two values on one axis.
    #[inline(always)]
    pub(super) fn slab(axis: usize, [low, high]: [f32; 2]) -> Bounds {
        let (mut lows, mut highs) = ([f32::NEG_INFINITY; 4], [f32::INFINITY; 4]);
        (lows[axis], highs[axis]) = (low, high);
        Bounds { low: f32x4::from(lows), high: f32x4::from(highs) }
    }

    /// The least and the greatest corner.
    #[inline(always)]
    pub(super) fn corners(&self) -> [f32x4; 2] {
        [self.low, self.high]
    }

    /// The smallest box that contains both.
    #[inline(always)]
    pub(super) fn union(&self, other: &Bounds) -> Bounds {
        Bounds { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The largest box within both.
    #[inline(always)]
    pub(super) fn intersection(&self, other: &Bounds) -> Bounds {
        Bounds { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    /// The length along each axis; negative where it is empty.
    #[inline(always)]
    pub(super) fn extent(&self) -> [f32; 3] {
        let [x, y, z, _] = (self.high - self.low).to_array();
        [x, y, z]
    }

    /// Half the area of the surface; 0 for an empty box.
    #[inline(always)]
    pub(super) fn half_area(&self) -> f32 {
        let extent = (self.high - self.low).max(f32x4::from(0.0));
        let [x, y, z, _] = extent.to_array();
        x * y + y * z + z * x
    }

    /// The same box out of lanes.
    #[inline(always)]
    pub(crate) fn aabb(&self) -> Aabb {
        let ([x0, y0, z0, _], [x1, y1, z1, _]) = (self.low.to_array(), self.high.to_array());
        Aabb { axes: [[x0, x1], [y0, y1], [z0, z1]] }
    }
}

/// A primitive in a builder's hands: its own box, or a piece of it where the box was cut. 32 bytes.
#[derive(Clone, Copy)]
pub(crate) struct Reference {
    /// The free lane of its low corner has the primitive's number.
    bounds: Bounds,
}

/// Added to numbers, as bits of a float: arithmetic on a normal one is as quick as on any.
const NORMAL: u32 = 1 << 30;

impl Reference {
    /// A primitive with that box.
    #[inline(always)]
    pub(super) fn new(aabb: &Aabb, prim: u32) -> Reference {
        let [[x0, x1], [y0, y1], [z0, z1]] = aabb.axes;
        let number = f32::from_bits(prim | NORMAL);
        let low = f32x4::from([x0, y0, z0, number]);
        Reference { bounds: Bounds { low, high: f32x4::from([x1, y1, z1, 0.0]) } }
    }

    /// One for every primitive.
    pub(super) fn all(primitives: &Primitives) -> impl Iterator<Item = Reference> {
        primitives.own_boxes().zip(0..).map(|(aabb, prim)| Reference::new(&aabb, prim))
    }

    /// The primitive's number.
    #[inline(always)]
    pub(crate) fn prim(&self) -> u32 {
        let [_, _, _, number] = self.bounds.low.to_array();
        number.to_bits() ^ NORMAL
    }

    /// Its box, or the piece.
    #[inline(always)]
    pub(crate) fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// The piece of it within these bounds.
    #[inline(always)]
    pub(super) fn within(&self, bounds: &Bounds) -> Reference {
        Reference { bounds: self.bounds.intersection(bounds) }
    }

    /// Twice the centre of the box.
    #[inline(always)]
    pub(super) fn center(&self) -> f32x4 {
        self.bounds.low + self.bounds.high
    }
}
