//! What builders work on: primitives as boxes, in lanes.

use simd4::prelude::*;
use simd4::{Block8, f32x4, f32x8};

use super::Join;
use crate::collect::collect;
use crate::geom::Aabb;
use crate::primitives::Primitives;

/// A box. In memory it is x, y and z of the least corner, a number of no account, and the opposites of x, y
/// and z of the greatest, and another: so the union is the least of all, in one register where one is large
/// enough.
#[derive(Clone, Copy)]
pub(crate) struct Bounds(Block8<f32>);

impl Bounds {
    /// From its [lanes](Bounds::lanes).
    #[inline(always)]
    pub(super) fn new<V: SimdF32<Array = [f32; 8]>>(lanes: V) -> Bounds {
        Bounds(lanes.to_array().into())
    }

    /// Its lanes, for the loops that a level is chosen for. All else is for any.
    #[inline(always)]
    pub(super) fn lanes<S: Simd>(&self, s: S) -> S::f32x8 {
        S::f32x8::load(s, &self.0.0)
    }

    #[inline(always)]
    fn fixed(&self) -> f32x8 {
        f32x8::from(self.0.0)
    }

    /// The box of nothing: its union with any box is that box.
    #[inline(always)]
    pub(super) fn empty() -> Bounds {
        Bounds::new(f32x8::from(f32::INFINITY))
    }

    /// All points between two values on one axis.
    #[inline(always)]
    pub(super) fn slab(axis: usize, [low, high]: [f32; 2]) -> Bounds {
        let mut sides = [f32::NEG_INFINITY; 8];
        (sides[axis], sides[axis + 4]) = (low, -high);
        Bounds(sides.into())
    }

    /// The least and the greatest corner.
    #[inline(always)]
    pub(super) fn corners(&self) -> [f32x4; 2] {
        let (low, high) = self.fixed().halves();
        [low, -high]
    }

    /// The smallest box that contains both.
    #[inline(always)]
    pub(super) fn union(&self, other: &Bounds) -> Bounds {
        Bounds::new(self.fixed().min(other.fixed()))
    }

    /// The largest box within both.
    #[inline(always)]
    pub(super) fn intersection(&self, other: &Bounds) -> Bounds {
        Bounds::new(self.fixed().max(other.fixed()))
    }

    /// The length along each axis; negative where it is empty.
    #[inline(always)]
    pub(super) fn extent(&self) -> [f32; 3] {
        let [low, high] = self.corners();
        let [x, y, z, _] = (high - low).to_array();
        [x, y, z]
    }

    /// Half the area of the surface; 0 for an empty box.
    #[inline(always)]
    pub(super) fn half_area(&self) -> f32 {
        let [low, high] = self.corners();
        let [x, y, z, _] = (high - low).max(f32x4::from(0.0)).to_array();
        x * y + y * z + z * x
    }

    /// The same box out of lanes.
    #[inline(always)]
    pub(crate) fn aabb(&self) -> Aabb {
        let [[x0, y0, z0, _], [x1, y1, z1, _]] = self.corners().map(|corner| corner.to_array());
        Aabb { axes: [[x0, x1], [y0, y1], [z0, z1]] }
    }
}

/// A primitive in a builder's hands: its own box, or a piece of it where the box was cut. 32 bytes.
#[derive(Clone, Copy)]
pub(crate) struct Reference {
    /// The number beside its least corner has the primitive's.
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
        Reference { bounds: Bounds([x0, y0, z0, number, -x1, -y1, -z1, 0.0].into()) }
    }

    /// One for every primitive.
    pub(super) fn all(primitives: &Primitives, join: &impl Join) -> Vec<Reference> {
        collect(primitives.len(), join, |i| Reference::new(&primitives.own_box(i as u32), i as u32))
    }

    /// The primitive's number.
    #[inline(always)]
    pub(crate) fn prim(&self) -> u32 {
        self.bounds.0[3].to_bits() ^ NORMAL
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
        let [low, high] = self.bounds.corners();
        low + high
    }
}
