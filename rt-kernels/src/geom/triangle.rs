//! A triangle.

use glam::Vec3;

use super::Aabb;

/// Three corners. A triangle with two equal ones is never hit; one whose corners are merely in line
/// may be, by rays within rounding of that line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Triangle {
    /// The corners, in world space.
    pub corners: [Vec3; 3],
}

impl Triangle {
    /// The own box: the bounds, padded.
    #[inline(always)]
    pub fn own_box(&self) -> Aabb {
        let [a, b, c] = self.corners.map(Aabb::point);
        a.union(&b).union(&c).padded()
    }
}
