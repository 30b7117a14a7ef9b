//! A camera for scenes that have none.

use glam::Vec3;
use rt_kernels::geom::Aabb;
use rt_scene::View;

/// How much more than the scene fits into the picture.
const MARGIN: f32 = 1.04;

/// The least distance to the target, relative to its coordinates, at which the two differ.
const NEAREST: f32 = 1.0 / (1 << 20) as f32;

/// The greatest distance, within what a coordinate can be.
const FARTHEST: f32 = f32::MAX / 4.0;

/// A view from the front that has all of `bounds` in a picture of that size: from +z, or, where
/// `up` is nearest to the z axis, from −y. `fov_y` is in degrees.
pub fn fitted_view(bounds: &Aabb, (width, height): (u32, u32), up: Vec3, fov_y: f32) -> View {
    let z_up = up.z.abs() > up.x.abs().max(up.y.abs());
    let back = if z_up { Vec3::NEG_Y } else { Vec3::Z };
    // Halved first: the sum of large coordinates would overflow.
    let (min, max) = (bounds.min() * 0.5, bounds.max() * 0.5);
    let (target, half) = (min + max, max - min);
    // The reach of the box along a direction.
    let reach = |direction: Vec3| direction.abs().dot(half);
    let right = up.cross(back).normalize_or(Vec3::X);
    let half_height = half_height(fov_y);
    let half_width = half_height * width as f32 / height as f32;
    // The face of the box that is nearest to the eye looms largest.
    let across = (reach(back.cross(right)) / half_height).max(reach(right) / half_width);
    let distance = across * MARGIN + reach(back);
    // A point has no reach; the largest scenes have too much of it.
    let least = if distance > 0.0 { 0.0 } else { 1.0 };
    let distance = distance.max(least).max(target.abs().max_element() * NEAREST);
    View { eye: target + back * distance.min(FARTHEST), target, up, fov_y, size: None }
}

/// The tangent of half an angle in degrees: half the height of the image plane at distance 1.
pub(crate) fn half_height(fov_y: f32) -> f32 {
    libm::tan(f64::from(fov_y).to_radians() * 0.5) as f32
}
