//! Rotations, with angles from the same library on every machine.

use glam::{DMat3, DVec3};

/// Rodrigues' rotation about a unit axis, counterclockwise seen against it.
pub(super) fn rotation(axis: DVec3, cosine: f64, sine: f64) -> DMat3 {
    let column = |unit: DVec3| {
        unit * cosine + axis.cross(unit) * sine + axis * (axis.dot(unit) * (1.0 - cosine))
    };
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

/// The same by an angle in radians.
pub(super) fn turn(axis: DVec3, angle: f64) -> DMat3 {
    rotation(axis, libm::cos(angle), libm::sin(angle))
}
