//! `mount`: a fractal mountain behind four spheres of glass.
//!
//! The middles of edges and of squares are raised or lowered at random, by a hash of where they are.
//! The hash is known to be poor, and repeats itself; all published pictures have it. Source: Fournier,
//! Fussell, Carpenter, "Computer Rendering of Stochastic Models", 1982.

use std::f64::consts::{LN_2, PI, SQRT_2};

use glam::DVec3;

use super::Procedure;
use super::stage::{Stage, view};
use super::turn::{rotation, turn};
use crate::model::Scene;

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "mount",
    about: "fractal mountain and four glass spheres: 8192 triangles at size 6",
    default_size: 6,
    sizes: (1, 11),
    generate,
};

const FRACTAL_DIMENSION: f64 = 2.2;

/// Another number is another mountain.
const MOUNTAIN: u64 = 21;

fn generate(size: u32) -> Scene {
    let mut stage = Stage::new(view([-1.6, 1.6, 1.7], [0.0; 3]), &[[-100.0, -100.0, 100.0]]);
    stage.surface([1.0, 1.0, 1.0, 0.1, 0.1, 101.148, 0.9, 1.5]);
    pyramid(&mut stage, DVec3::new(-0.8, 0.8, 1.0), 0.17);

    stage.surface([0.5, 0.45, 0.35, 1.0, 0.0, 100_000.0, 0.0, 0.0]);
    let ratio = 2.0 / libm::exp(LN_2 / (FRACTAL_DIMENSION - 1.0));
    let roughness = (ratio * ratio - 1.0).sqrt();
    let mut ground = Ground { stage, size, roughness };
    ground.grow([0, 0], 1 << size, [0.0; 4]);
    ground.stage.finish()
}

/// Four spheres that touch, at the corners of a tetrahedron.
fn pyramid(stage: &mut Stage, center: DVec3, radius: f64) {
    let up = DVec3::Z * (radius * 1.5_f64.sqrt());
    stage.sphere(center + up, radius);
    let cosine: f64 = -1.0 / 3.0;
    let axis = DVec3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0);
    let out = rotation(axis, cosine, (1.0 - cosine * cosine).sqrt()) * up;
    for nth in [0.0, 1.0, 2.0] {
        stage.sphere(center + turn(DVec3::Z, nth * 2.0 * PI / 3.0) * out, radius);
    }
}

struct Ground {
    stage: Stage,
    size: u32,
    roughness: f64,
}

impl Ground {
    /// A square from `x`, `y` on, with these heights at its corners, counterclockwise.
    fn grow(&mut self, [x, y]: [u32; 2], width: u32, heights: [f64; 4]) {
        let cell = 2.0 / f64::from(1_u32 << self.size);
        let [a, b, c, d] = heights;
        if width == 1 {
            let at = |x: u32, y: u32, z: f64| {
                DVec3::new(f64::from(x) * cell - 1.0, f64::from(y) * cell - 1.0, z)
            };
            let corners = [at(x, y, a), at(x + 1, y, b), at(x + 1, y + 1, c), at(x, y + 1, d)];
            self.stage.polygon(&[corners[0], corners[1], corners[2]]);
            self.stage.polygon(&[corners[2], corners[3], corners[0]]);
            return;
        }
        let half = width / 2;
        let rise = f64::from(half) * cell * self.roughness;
        let middle = |x, y, mean: f64, rise: f64| mean + rise * gauss(MOUNTAIN + self.hash(x, y));
        let below = middle(x + half, y, (a + b) / 2.0, rise);
        let right = middle(x + width, y + half, (b + c) / 2.0, rise);
        let above = middle(x + half, y + width, (c + d) / 2.0, rise);
        let left = middle(x, y + half, (d + a) / 2.0, rise);
        let inside = middle(x + half, y + half, (a + b + c + d) / 4.0, SQRT_2 * rise);
        self.grow([x, y], half, [a, below, inside, left]);
        self.grow([x + half, y], half, [below, b, right, inside]);
        self.grow([x + half, y + half], half, [inside, right, c, above]);
        self.grow([x, y + half], half, [left, inside, above, d]);
    }

    /// The poor hash, of 16 bits.
    fn hash(&self, x: u32, y: u32) -> u64 {
        // Beyond a size of 7 nothing is left of some.
        let shifted = |number: u32, bits: u32| match bits.checked_sub(self.size) {
            Some(by) => u64::from(number) << by,
            None => 0,
        };
        (shifted(x, 23) + shifted(y, 15) + shifted(x, 7)) & 0xFFFF
    }
}

/// A number of normal distribution, by the polar method on a linear congruential generator.
fn gauss(seed: u64) -> f64 {
    const MODULUS: u64 = 134_456;
    let next = |number: u64| (28_411 + number * 8_121) % MODULUS;
    let signed = |number: u64| number as f64 * 2.0 / MODULUS as f64 - 1.0;
    let mut second = seed;
    loop {
        let first = next(second);
        second = next(first);
        let [x, y] = [first, second].map(signed);
        let square = x * x + y * y;
        if square < 1.0 {
            return x * (-2.0 * libm::log(square) / square).sqrt();
        }
    }
}
