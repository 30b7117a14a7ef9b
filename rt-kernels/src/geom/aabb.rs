//! Axis-aligned boxes.

use glam::Vec3;

/// An axis-aligned box with closed sides: for each axis its minimum and its maximum.
///
/// An axis is an array so that a ray picks the nearer side by the sign of its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Aabb {
    /// Minimum and maximum on x, y and z.
    pub axes: [[f32; 2]; 3],
}

/// The padding, relative to a primitive's extent and, in [`slab`](crate::slab), to `t`:
/// 32 times the unit roundoff u = 2^-24.
///
/// A kernel sees a primitive as if each of its points, at `x` from the ray's origin on one axis and
/// at the time `t` of the ray, were moved by 2u |x| + 4u |dx t| along that axis
/// ([`Watertight`](crate::tri::Watertight), "Precision"). Within one primitive `t` varies by its
/// extent along the dominant axis over that axis' speed, and no axis is faster. So each side of a
/// slab is off by at most 6u of the hit's own `t` and 6u of the extent; with the three roundings of
/// each distance the two sides are off by 18u of `t` together. The rest is reserve.
pub(crate) const PADDING: f32 = 1.0 / (1 << 19) as f32;

impl Aabb {
    /// The box of nothing: its union with any box is that box.
    pub const EMPTY: Aabb = Aabb { axes: [[f32::INFINITY, f32::NEG_INFINITY]; 3] };

    /// From its corners.
    #[inline(always)]
    pub fn new(min: Vec3, max: Vec3) -> Self {
        Aabb { axes: [[min.x, max.x], [min.y, max.y], [min.z, max.z]] }
    }

    /// The box of one point.
    #[inline(always)]
    pub fn point(point: Vec3) -> Self {
        Aabb::new(point, point)
    }

    /// The least corner.
    pub fn min(&self) -> Vec3 {
        Vec3::from_array(self.axes.map(|[min, _]| min))
    }

    /// The greatest corner.
    pub fn max(&self) -> Vec3 {
        Vec3::from_array(self.axes.map(|[_, max]| max))
    }

    /// The length along each axis; negative for an empty box.
    pub fn extent(&self) -> Vec3 {
        self.max() - self.min()
    }

    #[inline(always)]
    fn lengths(&self) -> [f32; 3] {
        let [[x0, x1], [y0, y1], [z0, z1]] = self.axes;
        [x1 - x0, y1 - y0, z1 - z0]
    }

    /// The smallest box that contains both.
    #[inline(always)]
    #[must_use]
    pub fn union(&self, other: &Aabb) -> Aabb {
        let mut both = *self;
        for ([min, max], [other_min, other_max]) in both.axes.iter_mut().zip(other.axes) {
            *min = if *min < other_min { *min } else { other_min };
            *max = if *max > other_max { *max } else { other_max };
        }
        both
    }

    /// Half the area of the surface; 0 for an empty box.
    #[inline(always)]
    pub fn half_area(&self) -> f32 {
        let [x, y, z] = self.lengths();
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }

    /// The box of one primitive, padded by more than its kernel's error: a 2^-19 of its greatest
    /// extent and one unit in the last place of its coordinates.
    #[inline(always)]
    #[must_use]
    pub fn padded(&self) -> Aabb {
        let [x, y, z] = self.lengths();
        let xy = if x > y { x } else { y };
        let extent = if xy > z { xy } else { z };
        let mut padded = *self;
        for [min, max] in &mut padded.axes {
            let (low, high) = (min.abs(), max.abs());
            let magnitude = if low > high { low } else { high };
            let pad = extent * PADDING + magnitude * f32::EPSILON;
            *min -= pad;
            *max += pad;
        }
        padded
    }
}
