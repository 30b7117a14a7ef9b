//! `balls`, the sphereflake: a sphere with nine of a third of its radius around it, and so on.
//!
//! Every rotation of the original is given by sines and cosines that square roots express, so no
//! angle is ever computed and the numbers are the same on every machine.

use glam::{DMat3, DVec3};

use super::Procedure;
use super::stage::{Stage, view};
use super::turn::rotation;
use crate::model::Scene;

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "balls",
    about: "sphereflake on a square, nine spheres around each: 7381 at size 4",
    default_size: 4,
    sizes: (0, 7),
    generate,
};

/// A child's radius by its parent's.
const SHRINK: f64 = 1.0 / 3.0;

fn generate(size: u32) -> Scene {
    let lights = [[4.0, 3.0, 2.0], [1.0, -4.0, 4.0], [-3.0, 1.0, 5.0]];
    let mut stage = Stage::new(view([2.1, 1.3, 1.7], [0.0; 3]), &lights);
    stage.surface([1.0, 0.75, 0.33, 0.8, 0.0, 100_000.0, 0.0, 1.0]);
    stage.ground(12.0, -0.5);
    stage.surface([1.0, 0.9, 0.7, 0.5, 0.5, 3.0827, 0.0, 1.0]);
    grow(&mut stage, &directions(), size, DVec3::ZERO, 0.5, DVec3::Z);
    stage.finish()
}

/// Adds a sphere that grew in some direction, and its descendants.
fn grow(
    stage: &mut Stage,
    directions: &[DVec3; 9],
    generations: u32,
    center: DVec3,
    radius: f64,
    direction: DVec3,
) {
    stage.sphere(center, radius);
    if generations == 0 {
        return;
    }
    let turn = from_z_to(direction);
    let distance = radius * (1.0 + SHRINK);
    for &way in directions {
        let child = center + turn * way * distance;
        let direction = (child - center) / distance;
        grow(stage, directions, generations - 1, child, radius * SHRINK, direction);
    }
}

/// Where the nine children of a sphere touch it that itself grew in direction z: three around the
/// top and six around the equator.
fn directions() -> [DVec3; 9] {
    let d = 0.5_f64.sqrt();
    let tilt = rotation(DVec3::new(d, -d, 0.0), (1.0_f64 / 3.0).sqrt(), 2.0 / 6.0_f64.sqrt());
    let trio = [[d, d, 0.0], [d, 0.0, -d], [0.0, d, -d]].map(|way| tilt * DVec3::from(way));
    // The sine of a third of a turn.
    let sine = 0.75_f64.sqrt();
    let turns = [(1.0, 0.0), (-0.5, sine), (-0.5, -sine)];
    std::array::from_fn(|nth| {
        let (cosine, sine) = turns[nth / 3];
        rotation(DVec3::Z, cosine, sine) * trio[nth % 3]
    })
}

/// The shortest rotation from z to a direction. Near the poles, where the axis is uncertain, the
/// database has fixed ones.
fn from_z_to(direction: DVec3) -> DMat3 {
    let cosine: f64 = direction.z;
    if cosine >= 0.9999 {
        DMat3::IDENTITY
    } else if cosine <= -0.9999 {
        DMat3::from_diagonal(DVec3::new(-1.0, 1.0, -1.0))
    } else {
        let axis = DVec3::new(-direction.y, direction.x, 0.0);
        rotation(axis / axis.length(), cosine, (1.0 - cosine * cosine).sqrt())
    }
}
