//! `lattice`: shiny spheres on a cubic grid, and rods between neighbours.

use glam::{DVec3, Vec3};

use super::Procedure;
use super::stage::{Stage, view};
use crate::model::{Scene, View};

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "lattice",
    about: "grid of spheres and rods: 2197 spheres and 6084 cylinders at size 12",
    default_size: 12,
    sizes: (1, 100),
    generate,
};

/// The radius of spheres and rods, by the distance of neighbours.
const BALL: f64 = 1.0 / 4.0;
const ROD: f64 = 1.0 / 16.0;

const BALLS: [f32; 8] = [0.9, 0.9, 0.9, 0.5, 0.5, 3.0827, 0.0, 0.0];

/// Rods along each axis.
const RODS: [(DVec3, [f32; 3]); 3] =
    [(DVec3::X, [0.9, 0.1, 0.1]), (DVec3::Y, [0.1, 0.9, 0.1]), (DVec3::Z, [0.1, 0.1, 0.9])];

fn generate(size: u32) -> Scene {
    let lights = [
        [2.0, 0.5, 0.5],
        [-1.0, 0.5, 0.5],
        [0.5, 2.0, 0.5],
        [0.5, -1.0, 0.5],
        [0.5, 0.5, 2.0],
        [0.5, 0.5, -1.0],
    ];
    // In the middle of a gap.
    let step = 1.0 / f64::from(size);
    let x = ((f64::from(size / 2) + 0.5) * step) as f32;
    let z = |z: f64| (z - step / 2.0) as f32;
    let view = view([x, 1.0, z(1.0)], [x, -1.0, z(-1.0)]);
    let view = View { up: Vec3::new(0.2, 1.0, 0.0), fov_y: 60.0, ..view };
    let mut stage = Stage::new(view, &lights);

    // Rods begin a little within the spheres.
    let start = BALL * step * (1.0 - (ROD / BALL).sqrt()) * 0.99;
    for x in 0..=size {
        for y in 0..=size {
            for z in 0..=size {
                let index = DVec3::new(x.into(), y.into(), z.into());
                let center = index / f64::from(size);
                stage.surface(BALLS);
                stage.sphere(center, BALL * step);
                for (axis, [r, g, b]) in RODS {
                    if index.dot(axis) < size.into() {
                        stage.surface([r, g, b, 0.99, 0.0, 100_000.0, 0.0, 0.0]);
                        let radius = ROD * step;
                        let ends = [start, step - start].map(|along| center + axis * along);
                        stage.cone(ends[0], radius, ends[1], radius);
                    }
                }
            }
        }
    }
    stage.finish()
}
