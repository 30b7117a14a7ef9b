//! `sombrero`: a height field of ripples that fade outwards.

use std::f64::consts::PI;

use glam::DVec3;

use super::Procedure;
use super::stage::{Stage, view};
use crate::model::{Scene, View};

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "sombrero",
    about: "height field of ripples: 1922 triangles at size 1",
    default_size: 1,
    sizes: (1, 8),
    generate,
};

fn generate(size: u32) -> Scene {
    let view = View { fov_y: 40.0, ..view([0.0, 5.0, -8.0], [0.0; 3]) };
    let mut stage = Stage::new(view, &[[10.0, 10.0, -10.0]]);
    stage.surface([1.0, 0.1, 0.1, 0.8, 0.0, 2.60078, 0.0, 1.0]);
    let width = 16_u32 << size;
    // What is sampled up to, but not at, the far end is stretched to reach it.
    let sampled = |line: u32| 8.0 * f64::from(line) / f64::from(width) - 4.0;
    let placed = |line: u32| 8.0 * f64::from(line) / f64::from(width - 1) - 4.0;
    let point = |row: u32, column: u32| {
        let height = f64::from(ripple(sampled(column), sampled(row)) as f32);
        DVec3::new(placed(column), height - 3.0, placed(row))
    };
    for row in 0..width - 1 {
        for column in 0..width - 1 {
            let [a, b] = [0, 1].map(|next| point(row, column + next));
            let [d, c] = [0, 1].map(|next| point(row + 1, column + next));
            stage.polygon(&[a, c, b]);
            stage.polygon(&[a, d, c]);
        }
    }
    stage.finish()
}

fn ripple(x: f64, y: f64) -> f64 {
    let distance = (x * x + y * y).sqrt();
    libm::cos(2.0 * PI * distance) * libm::exp(-distance)
}
