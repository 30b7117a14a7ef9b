//! Axis-aligned boxes.

use glam::Vec3;

/// An axis-aligned box with closed sides: `corners[0]` is its minimum, `corners[1]` its maximum.
///
/// The corners are an array so that a ray picks the nearer one of an axis by the sign of its
/// direction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Aabb {
    /// Minimum and maximum.
    pub corners: [[f32; 3]; 2],
}

/// The padding, relative to a primitive's extent and, in [`slab`](crate::slab), to `t`:
/// 32 times the unit roundoff 2^-24.
///
/// The kernels see a primitive as if each corner were moved by at most 6 roundoffs of its distance
/// to the ray's origin, axis by axis ([`watertight`](crate::tri::watertight) has the count). Of
/// that, what is proportional to `t` disappears in the slab test's factor, together with that
/// test's own three roundings a side; what is left is proportional to the extent of the primitive
/// and disappears in the padded box. The rest is reserve.
pub(crate) const PADDING: f32 = 1.0 / (1 << 19) as f32;

impl Aabb {
    /// The box of nothing: its union with any box is that box.
    pub const EMPTY: Aabb = Aabb { corners: [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]] };

    /// From its corners.
    pub fn new(min: Vec3, max: Vec3) -> Self {
        Aabb { corners: [min.to_array(), max.to_array()] }
    }

    /// The least corner.
    pub fn min(&self) -> Vec3 {
        Vec3::from_array(self.corners[0])
    }

    /// The greatest corner.
    pub fn max(&self) -> Vec3 {
        Vec3::from_array(self.corners[1])
    }

    /// The length along each axis.
    pub fn extent(&self) -> Vec3 {
        self.max() - self.min()
    }

    /// The smallest box that contains both.
    #[inline(always)]
    #[must_use]
    pub fn union(&self, other: &Aabb) -> Aabb {
        let [min, max] = &self.corners;
        let [other_min, other_max] = &other.corners;
        Aabb {
            corners: [
                [0, 1, 2].map(|k| if min[k] < other_min[k] { min[k] } else { other_min[k] }),
                [0, 1, 2].map(|k| if max[k] > other_max[k] { max[k] } else { other_max[k] }),
            ],
        }
    }

    /// Half the area of the surface; 0 for an empty box.
    #[inline(always)]
    pub fn half_area(&self) -> f32 {
        let [min, max] = &self.corners;
        let [x, y, z] = [0, 1, 2].map(|k| max[k] - min[k]);
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }

    /// The box of one primitive, padded by more than its kernel's error: a 2^-19 of its greatest
    /// extent and one unit in the last place of its coordinates.
    #[inline(always)]
    #[must_use]
    pub fn padded(&self) -> Aabb {
        let [min, max] = &self.corners;
        let [x, y, z] = [0, 1, 2].map(|k| max[k] - min[k]);
        let xy = if x > y { x } else { y };
        let extent = if xy > z { xy } else { z };
        let pad = [0, 1, 2].map(|k| {
            let (low, high) = (min[k].abs(), max[k].abs());
            extent * PADDING + (if low > high { low } else { high }) * f32::EPSILON
        });
        Aabb { corners: [[0, 1, 2].map(|k| min[k] - pad[k]), [0, 1, 2].map(|k| max[k] + pad[k])] }
    }

    /// Whether every coordinate is finite.
    pub fn is_finite(&self) -> bool {
        self.corners.iter().flatten().all(|x| x.is_finite())
    }
}
