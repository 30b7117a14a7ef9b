//! `jacks`: three crossing rods with knobs, and in each of the eight corners between them a copy of
//! half the size, and so on.

use glam::{DAffine3, DVec3, Vec3};

use super::Procedure;
use super::stage::{Stage, view};
use super::turn::turn;
use crate::model::{Scene, View};

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "jacks",
    about: "crossed rods within crossed rods: 3 cylinders and 6 spheres at size 1",
    default_size: 1,
    sizes: (1, 7),
    generate,
};

/// Of a jack: the length of an arm, the radius of a rod and of a knob.
const ARM: f64 = 0.75;
const ROD: f64 = 0.075;
const KNOB: f64 = 0.15;

fn generate(size: u32) -> Scene {
    let view = view([0.0, 0.0, -8.0], [0.0; 3]);
    let view = View { up: Vec3::Y, fov_y: 25.0, size: Some((256, 256)), ..view };
    let mut stage = Stage::new(view, &[[-10.0, 3.0, -20.0]]);
    stage.background([0.2, 0.05, 0.2]);
    stage.surface([0.737, 0.561, 0.561, 0.7, 0.7, 11.1434, 0.0, 1.0]);
    let tilt = turn(DVec3::X, (-30.0_f64).to_radians()) * turn(DVec3::Y, (-20.0_f64).to_radians());
    grow(&mut stage, size, DAffine3::from_mat3(tilt), 1.0);
    stage.finish()
}

/// Adds the jack of a cube of that scale, and those within.
fn grow(stage: &mut Stage, generations: u32, place: DAffine3, scale: f64) {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let at = |axis: DVec3| place.transform_point3(axis * ARM);
    for axis in axes {
        stage.cone(at(-axis), ROD * scale, at(axis), ROD * scale);
    }
    for end in axes.into_iter().chain(axes.map(|axis| -axis)) {
        stage.sphere(at(end), KNOB * scale);
    }
    if generations == 1 {
        return;
    }
    let sides = [-0.5, 0.5];
    for x in sides {
        for y in sides {
            for z in sides {
                let within = DAffine3::from_scale(DVec3::splat(0.5));
                let within = DAffine3::from_translation(DVec3::new(x, y, z)) * within;
                grow(stage, generations - 1, place * within, scale * 0.5);
            }
        }
    }
}
