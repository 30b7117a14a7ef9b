//! `gears`: a block of gears that mesh, some of glass, on a shiny square.
//!
//! The faces are concave polygons of 144 corners.

use std::f64::consts::PI;

use glam::DVec3;

use super::Procedure;
use super::stage::{Stage, view};
use crate::model::Scene;

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "gears",
    about: "block of gears, some of glass: 9345 polygons at size 4",
    default_size: 4,
    sizes: (1, 20),
    generate,
};

const TEETH: u32 = 36;

/// Where a tooth has corners: the angle in teeth, and the radius in gears. The outer one is a little
/// less than 1, so that gears that mesh do not touch.
const TOOTH: [(f64, f64); 4] = [(-0.19, 0.995), (0.19, 0.995), (0.3, INNER), (0.7, INNER)];

/// The radius between teeth.
const INNER: f64 = 0.9;

fn generate(size: u32) -> Scene {
    let lights = [
        [2.0, 4.0, 4.0],
        [-2.0, 4.0, 3.0],
        [2.0, -2.5, 2.5],
        [-1.0, -4.0, 2.0],
        [-1.111, -2.121, 2.626],
    ];
    let mut stage = Stage::new(view([-1.1, -2.1, 2.6], [0.0; 3]), &lights);
    stage.surface([1.0, 0.85, 0.7, 0.3, 0.6, 3.0827, 0.0, 0.0]);
    stage.ground(2.0, 0.0);

    let count = f64::from(size);
    let overlap = 1.0 - INNER;
    let radius = 1.0 / (count - (count - 1.0) * overlap / 2.0);
    let thickness = (1.0 / (2.0 * count)).min(0.1);
    let step = radius * (2.0 - overlap);
    for z in 0..size {
        for y in 0..size {
            for x in 0..size {
                stage.surface(surface(x, y, z));
                let place = |nth: u32| radius - 1.0 + f64::from(nth) * step;
                let center = DVec3::new(place(x), place(y), 1.0 - f64::from(z) / count);
                let turned = f64::from((x + y + z) % 2) * PI / f64::from(TEETH);
                gear(&mut stage, center, turned, radius, thickness);
            }
        }
    }
    stage.finish()
}

/// A colour that looks random, opaque or of glass.
fn surface(x: u32, y: u32, z: u32) -> [f32; 8] {
    let part = |number: u32, factor: f64| 0.01 + (f64::from(number) * factor / 7.0).fract();
    let color = DVec3::new(
        part(x * 3 + y * 2 + z + 1, 5.0),
        part(y * 3 + z * 2 + x + 1, 3.0),
        part(z * 3 + x * 2 + y + 1, 2.0),
    );
    let [r, g, b] = (color / color.max_element()).as_vec3().to_array();
    if (x * 4 + y * 2 + z).is_multiple_of(5) {
        [r, g, b, 0.2, 0.0, 100_000.0, 0.8, 1.1]
    } else {
        [r, g, b, 1.0, 0.0, 100_000.0, 0.0, 0.0]
    }
}

fn gear(stage: &mut Stage, top: DVec3, turned: f64, radius: f64, thickness: f64) {
    let down = DVec3::new(0.0, 0.0, -thickness);
    let face = rim(top, turned, radius, 1.0);
    stage.polygon(&face);
    for (nth, &corner) in face.iter().enumerate() {
        let next = face[(nth + 1) % face.len()];
        stage.polygon(&[corner, corner + down, next + down, next]);
    }
    stage.polygon(&rim(top + down, turned, radius, -1.0));
}

/// The corners around, counterclockwise or, with a sense of −1, the other way.
fn rim(center: DVec3, turned: f64, radius: f64, sense: f64) -> Vec<DVec3> {
    let tooth = 2.0 * PI / f64::from(TEETH) * sense;
    let corner = |nth: u32, (within, share): (f64, f64)| {
        let angle = turned + (f64::from(nth) + within) * tooth;
        let way = DVec3::new(libm::cos(angle), libm::sin(angle), 0.0);
        center + way * (share * radius)
    };
    (0..TEETH).flat_map(|nth| TOOTH.map(|place| corner(nth, place))).collect()
}
