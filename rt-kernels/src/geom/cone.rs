//! Cones and cylinders.

use glam::{DVec3, Vec3};

use super::Aabb;

/// The mantle of a truncated cone, or of a cylinder if the radii are equal. It has no caps; rays hit
/// it from outside and from inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The centre of one end, in world space.
    pub base: Vec3,
    /// The radius there; at least zero.
    pub base_radius: f32,
    /// The centre of the other end; not the base.
    pub apex: Vec3,
    /// The radius there; at least zero, but not both are zero.
    pub apex_radius: f32,
}

impl Cone {
    /// The own box: the bounds, padded.
    pub fn own_box(&self) -> Aabb {
        let axis = self.axis();
        // How far a circle of radius 1 about the axis reaches along each coordinate.
        let reach = (DVec3::ONE - axis * axis).max(DVec3::ZERO).map(f64::sqrt);
        let end = |center: Vec3, radius: f32| {
            let reach = (reach * f64::from(radius)).as_vec3();
            Aabb::new(center - reach, center + reach)
        };
        let base = end(self.base, self.base_radius);
        base.union(&end(self.apex, self.apex_radius)).padded()
    }

    /// The direction from the base to the apex, of unit length.
    pub(crate) fn axis(&self) -> DVec3 {
        (self.apex.as_dvec3() - self.base.as_dvec3()).normalize()
    }
}
