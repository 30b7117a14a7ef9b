//! `shells`: a sea shell of spheres on a logarithmic spiral, which overlap. Source: Pickover, "A Short
//! Recipe for Seashell Synthesis", IEEE Computer Graphics and Applications 9(6), 1989.

use std::f64::consts::PI;

use glam::DVec3;

use super::Procedure;
use super::stage::{Stage, view};
use crate::model::Scene;

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "shells",
    about: "sea shell of overlapping spheres: 5761 at size 5",
    default_size: 5,
    sizes: (1, 15),
    generate,
};

/// The logarithm of the radius grows by this for each radian.
const GROWTH: f64 = 0.15;

/// The height of the spiral by its radius.
const SLOPE: f64 = -2.0;

fn generate(size: u32) -> Scene {
    let view = view([-6.0, -60.0, 35.0], [0.0, 8.0, -15.0]);
    let mut stage = Stage::new(view, &[[-100.0, -100.0, 100.0]]);
    stage.surface([1.0, 0.8, 0.4, 0.8, 0.2, 45.2776, 0.0, 1.0]);
    let steps = 180 << size;
    // Nine turns, six of which are smaller than 1.
    for step in -steps * 2 / 3..=steps / 3 {
        let angle = 18.0 * PI * f64::from(step) / f64::from(steps);
        let radius = libm::exp(GROWTH * angle);
        let way = DVec3::new(libm::sin(angle), libm::cos(angle), SLOPE);
        stage.sphere(way * radius, radius);
    }
    stage.finish()
}
