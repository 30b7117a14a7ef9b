//! A ray.

use glam::Vec3;

/// The points `origin + t · dir` with `tmin <= t <= tmax`, both ends included.
///
/// A ray with a component that is not finite, with a zero direction, with `tmin < 0` or an empty
/// interval hits nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where `t` is 0, in world space.
    pub origin: Vec3,
    /// The direction; need not be of unit length, and `t` is in units of its length.
    pub dir: Vec3,
    /// The least `t` of a hit; not negative.
    pub tmin: f32,
    /// The greatest `t` of a hit; may be infinite.
    pub tmax: f32,
}

impl Ray {
    /// The ray from `origin` to infinity.
    pub fn new(origin: Vec3, dir: Vec3) -> Self {
        Ray { origin, dir, tmin: 0.0, tmax: f32::INFINITY }
    }

    /// The point at `t`.
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.dir * t
    }
}
