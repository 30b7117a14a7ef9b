//! `rings`: a pyramid of knots, each of six pentagonal rings, before a wall.
//!
//! The rings' corners are the middles of the edges of a dodecahedron.

use std::f64::consts::{FRAC_PI_3, FRAC_PI_8, PI};

use glam::DVec3;

use super::Procedure;
use super::stage::{Stage, view};
use super::turn::turn;
use crate::model::Scene;

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "rings",
    about: "pyramid of knots of six rings: 4200 cylinders and as many spheres at size 7",
    default_size: 7,
    sizes: (1, 100),
    generate,
};

const COLORS: [[f32; 3]; 6] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
];

/// The radius of all spheres and cylinders: rings that are neighbours touch.
const RADIUS: f64 = 0.07412;

fn generate(size: u32) -> Scene {
    // The distance between layers: half the angle of view sees two units at it.
    let step = 1.0 / libm::sin(FRAC_PI_8);
    let front = -step as f32;
    let mut stage = Stage::new(
        view([-1.0, front, 0.5], [-1.0, (1.0 - step) as f32, 0.5]),
        &[[3.0, front, 3.0], [-4.0, front, 1.0], [2.0, front, -4.0]],
    );

    stage.surface([1.0, 1.0, 1.0, 1.0, 0.0, 100_000.0, 0.0, 0.0]);
    let wall = step * f64::from(size + 1);
    // One percent more than what is seen.
    let half = 1.01 * (wall + step) * libm::tan(FRAC_PI_8);
    let corner = |[x, z]: [f64; 2]| DVec3::new(x * half - 1.0, wall, z * half + 0.5);
    stage.polygon(&[[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(corner));

    let rings = rings();
    for layer in 0..size {
        let place = |nth: u32| 2.0 * f64::from(nth) - f64::from(layer);
        for z in 0..=layer {
            for x in 0..=layer {
                let middle = DVec3::new(place(x), step * f64::from(layer + 1), place(z));
                for (ring, [r, g, b]) in rings.iter().zip(COLORS) {
                    stage.surface([r, g, b, 0.5, 0.2, 3.0827, 0.0, 0.0]);
                    let corners = ring.map(|corner| middle + corner);
                    for (nth, &corner) in corners.iter().enumerate() {
                        stage.cone(corner, RADIUS, corners[(nth + 4) % 5], RADIUS);
                        stage.sphere(corner, RADIUS);
                    }
                }
            }
        }
    }
    stage.finish()
}

/// The corners of the rings of one knot, which is inside the unit sphere.
fn rings() -> [[DVec3; 5]; 6] {
    let scale = 1.0 / (1.0 + RADIUS);
    let fifth = 2.0 * PI / 5.0;
    let first = [0.0, 1.0, 2.0, 3.0, 4.0].map(|nth| turn(DVec3::Z, nth * fifth) * DVec3::X * scale);
    // The angle between neighbouring faces of a dodecahedron.
    let between = 2.0 * libm::acos(libm::cos(FRAC_PI_3) / libm::sin(PI / 5.0));
    let tilt = turn(DVec3::X, between);
    std::array::from_fn(|nth| match nth {
        0 => first,
        _ => {
            let around = turn(DVec3::Z, (nth as f64 - 0.5) * fifth) * tilt;
            first.map(|corner| around * corner)
        }
    })
}
