//! The pinhole camera.

use glam::Vec3;

use crate::Ray;

/// A pinhole camera: all rays start at the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pinhole {
    eye: Vec3,
    /// From the eye to the upper left corner of the image plane.
    corner: Vec3,
    /// One pixel to the right.
    right: Vec3,
    /// One pixel down.
    down: Vec3,
}

impl Pinhole {
    /// A camera at `eye` that looks at `target`, for a picture of `width` by `height` square
    /// pixels. `up` need not be perpendicular to the line of sight; `half_height` is the tangent
    /// of half the vertical angle of view.
    ///
    /// `None` if eye and target coincide, or if up is along the line of sight.
    pub fn new(
        eye: Vec3,
        target: Vec3,
        up: Vec3,
        half_height: f32,
        width: u32,
        height: u32,
    ) -> Option<Pinhole> {
        let forward = (target - eye).try_normalize()?;
        let right = forward.cross(up.try_normalize()?).try_normalize()?;
        let up = right.cross(forward);
        let pixel = 2.0 * half_height / height as f32;
        let corner = forward - right * (0.5 * pixel * width as f32) + up * half_height;
        Some(Pinhole { eye, corner, right: right * pixel, down: -up * pixel })
    }

    /// The ray through a point of the picture, in pixels from its upper left corner; the middle of
    /// the first pixel is (0.5, 0.5). Its direction has unit length, up to rounding.
    pub fn ray(&self, x: f32, y: f32) -> Ray {
        let dir = self.corner + self.right * x + self.down * y;
        Ray::new(self.eye, dir * (1.0 / dir.length()))
    }

    /// The centre of projection.
    pub fn eye(&self) -> Vec3 {
        self.eye
    }
}
