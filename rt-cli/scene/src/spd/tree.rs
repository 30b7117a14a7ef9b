//! `tree`: branches that fork in two, on a meadow. Source: Aono and Kunii, "Botanical Tree Image
//! Generation", IEEE Computer Graphics and Applications 4(5), 1984.

use glam::{DAffine3, DMat3, DVec3};

use super::Procedure;
use super::stage::{Stage, view};
use super::turn::turn;
use crate::model::Scene;

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "tree",
    about: "tree of forking branches: 4095 cones and as many spheres at size 11",
    default_size: 11,
    sizes: (0, 22),
    generate,
};

/// A branch of a fork, by the one that forks.
struct Fork {
    /// Between the two, in degrees.
    angle: f64,
    /// About the one that forks, in degrees.
    divergence: f64,
    /// The length by its length.
    length: f64,
}

const FORKS: [Fork; 2] = [
    Fork { angle: 40.0, divergence: 90.0, length: 0.65 },
    Fork { angle: 25.0, divergence: 140.0 + 90.0, length: 0.7 },
];

/// The trunk's radius by its length.
const WIDTH: f64 = 0.15;

/// A branch's radius at the end by that where it begins.
const TAPER: f64 = 0.67;

fn generate(size: u32) -> Scene {
    let lights = [
        [-5.0, 5.0, 50.0],
        [30.0, -30.0, 30.0],
        [-40.0, -30.0, 20.0],
        [10.0, 30.0, 40.0],
        [-30.0, 40.0, 10.0],
        [50.0, 25.0, 20.0],
        [-10.0, -60.0, 30.0],
    ];
    let mut stage = Stage::new(view([4.5, 0.4, 2.0], [0.0, 0.0, 1.5]), &lights);
    stage.surface([0.2, 0.7, 0.2, 1.0, 0.0, 100_000.0, 0.0, 0.0]);
    stage.ground(50.0, 0.0);
    stage.surface([0.55, 0.4, 0.2, 1.0, 0.0, 100_000.0, 0.0, 0.0]);
    let forks = FORKS.map(|fork| {
        let tilt = turn(DVec3::X, fork.angle.to_radians());
        let around = turn(DVec3::Z, fork.divergence.to_radians());
        let turned = around * tilt * DMat3::from_diagonal(DVec3::splat(fork.length));
        DAffine3::from_mat3_translation(turned, DVec3::Z)
    });
    grow(&mut stage, &forks, size, DAffine3::IDENTITY, WIDTH);
    stage.finish()
}

/// Adds the branch that is the unit vector z of `place`, and what grows on it.
fn grow(stage: &mut Stage, forks: &[DAffine3; 2], forkings: u32, place: DAffine3, radius: f64) {
    let end = place.transform_point3(DVec3::Z);
    let end_radius = radius * TAPER;
    stage.cone(place.translation, radius, end, end_radius);
    stage.sphere(end, end_radius);
    if forkings > 0 {
        for &fork in forks {
            grow(stage, forks, forkings - 1, place * fork, end_radius);
        }
    }
}
