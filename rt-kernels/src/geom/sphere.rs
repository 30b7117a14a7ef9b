//! A sphere.

use glam::Vec3;

use super::Aabb;

/// A sphere's surface; rays hit it from outside and from inside.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Sphere {
    /// Centre, in world space.
    pub center: Vec3,
    /// Radius; greater than zero.
    pub radius: f32,
}

impl Sphere {
    /// The own box: the bounds, padded.
    #[inline(always)]
    pub fn own_box(&self) -> Aabb {
        let r = Vec3::splat(self.radius);
        Aabb::new(self.center - r, self.center + r).padded()
    }
}
