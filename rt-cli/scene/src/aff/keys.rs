//! Key frames, as far as the first frame needs them.

use glam::{DAffine3, DMat3, DQuat, DVec3, Vec3};

use crate::model::View;

/// One kind of key of a name. The first and the last key are only neighbours of the others: until
/// the time of the second it is the second that holds.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Track<T> {
    /// The time and value of the second key.
    second: Option<(f32, T)>,
}

impl<T: Copy> Track<T> {
    /// Adds the key of that number.
    pub(super) fn add(&mut self, number: u64, time: f32, value: T) {
        if number == 1 {
            self.second = Some((time, value));
        }
    }

    fn value(&self) -> Option<T> {
        self.second.map(|(_, value)| value)
    }

    /// Whether it moves before a time.
    fn is_late(&self, time: f32) -> bool {
        self.second.is_some_and(|(second, _)| time > second)
    }
}

/// All keys of a name.
#[derive(Clone, Debug, Default)]
pub(super) struct Keys {
    pub(super) translation: Track<DVec3>,
    /// Axis, of any length, and angle in degrees.
    pub(super) rotation: Track<(DVec3, f64)>,
    pub(super) scale: Track<DVec3>,
    /// Times, and whether it is to be seen from then on.
    pub(super) visibility: Vec<(f32, bool)>,
}

impl Keys {
    /// Where it stands.
    pub(super) fn translation(&self) -> Option<DVec3> {
        self.translation.value()
    }

    /// How it is turned.
    pub(super) fn rotation(&self) -> Option<DMat3> {
        self.rotation.value().map(|(axis, degrees)| turn(axis, degrees))
    }

    /// Scaled, then turned, then moved.
    pub(super) fn pose(&self) -> DAffine3 {
        let scale = self.scale.value().unwrap_or(DVec3::ONE);
        let turned = self.rotation().unwrap_or(DMat3::IDENTITY);
        DAffine3 {
            matrix3: turned * DMat3::from_diagonal(scale),
            translation: self.translation().unwrap_or(DVec3::ZERO),
        }
    }

    /// Whether it is to be seen at a time: until the first key it is.
    pub(super) fn is_visible(&self, time: f32) -> bool {
        let until = self.visibility.iter().take_while(|(from, _)| *from <= time);
        until.last().is_none_or(|&(_, visible)| visible)
    }

    /// Whether it has moved before a time, so that its pose there is another.
    pub(super) fn is_late(&self, time: f32) -> bool {
        self.translation.is_late(time) || self.rotation.is_late(time) || self.scale.is_late(time)
    }
}

/// A rotation about an axis, which need not be of unit length; about none it is none.
pub(super) fn turn(axis: DVec3, degrees: f64) -> DMat3 {
    let Some(axis) = axis.try_normalize() else { return DMat3::IDENTITY };
    let (sin, cos) = libm::sincos((degrees % 360.0).to_radians() * 0.5);
    let v = axis * sin;
    DMat3::from_quat(DQuat::from_xyzw(v.x, v.y, v.z, cos))
}

/// A triangle with its times, and where its first corner is among the scene's positions and normals.
pub(super) struct MovingTriangle {
    pub(super) position: usize,
    pub(super) normal: usize,
    /// Positions and normals at each time.
    pub(super) keys: Vec<(f32, [[Vec3; 2]; 3])>,
}

/// The corners at a time: between two keys they go straight.
pub(super) fn at_time(keys: &[(f32, [[Vec3; 2]; 3])], time: f32) -> [[Vec3; 2]; 3] {
    let after = keys.iter().position(|(at, _)| *at > time);
    match after {
        Some(0) => keys[0].1,
        None => keys[keys.len() - 1].1,
        Some(after) => {
            let ((t0, from), (t1, to)) = (&keys[after - 1], &keys[after]);
            let share = (time - t0) / (t1 - t0);
            std::array::from_fn(|i| {
                std::array::from_fn(|j| from[i][j] + (to[i][j] - from[i][j]) * share)
            })
        }
    }
}

/// The view that the keys of a camera give: along −z of what they turn, with y up.
pub(super) fn film(keys: &Keys, view: &mut View) {
    let sight = (view.target - view.eye).as_dvec3();
    let mut forward = sight;
    if let Some(eye) = keys.translation() {
        view.eye = eye.as_vec3();
    }
    if let Some(turned) = keys.rotation() {
        let ahead = sight.length();
        forward = turned * DVec3::NEG_Z * if ahead > 0.0 { ahead } else { 1.0 };
        view.up = (turned * DVec3::Y).as_vec3();
    }
    view.target = (view.eye.as_dvec3() + forward).as_vec3();
}
