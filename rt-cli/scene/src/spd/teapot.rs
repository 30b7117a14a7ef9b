//! `teapot`: Newell's, of 32 bicubic Bézier patches with the bottom, on a chessboard of as many
//! squares as each patch is cut into. Source: Crow, "The Origins of the Teapot", IEEE Computer
//! Graphics and Applications 7(1), 1987.
//!
//! Patches that are neighbours have the same control points along their edge. A point of an edge
//! depends on nothing else, and is the same from both ends: so the mesh has no cracks where the patches
//! have none.

use glam::DVec3;

use super::Procedure;
use super::stage::{Stage, view};
use crate::model::Scene;

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "teapot",
    about: "Newell's teapot on a chessboard: 2256 patches at size 6",
    default_size: 6,
    sizes: (1, 100),
    generate,
};

/// Control points, row by row.
type Patch = [[DVec3; 4]; 4];

/// A control point of a profile that is turned about the z axis: radius, height, and the share of the
/// radius at which a quarter circle has its inner control points.
type Turned = (f64, f64, f64);

const RIM: [Turned; 4] =
    [(1.4, 2.4, 0.56), (1.3375, 2.53125, 0.56), (1.4375, 2.53125, 0.56), (1.5, 2.4, 0.56)];
const BODY: [Turned; 4] =
    [(1.5, 2.4, 0.56), (1.75, 1.875, 0.56), (2.0, 1.35, 0.56), (2.0, 0.9, 0.56)];
const FOOT: [Turned; 4] =
    [(2.0, 0.9, 0.56), (2.0, 0.45, 0.56), (1.5, 0.225, 0.56), (1.5, 0.15, 0.56)];
const KNOB: [Turned; 4] =
    [(0.0, 3.15, 0.56), (0.8, 3.15, 0.5625), (0.0, 2.85, 0.56), (0.2, 2.7, 0.56)];
const LID: [Turned; 4] = [(0.2, 2.7, 0.56), (0.4, 2.55, 0.56), (1.3, 2.55, 0.56), (1.3, 2.4, 0.56)];
const BOTTOM: [Turned; 4] =
    [(0.0, 0.0, 0.56), (1.425, 0.0, 0.56), (1.5, 0.075, 0.56), (1.5, 0.15, 0.56)];

/// A ring of a pipe that is its own mirror image: x and z of the inner and the outer side, and half
/// the width.
type Ring = ([f64; 2], [f64; 2], f64);

const HANDLE: [[Ring; 4]; 2] = [
    [
        ([-1.6, 2.025], [-1.5, 2.25], 0.3),
        ([-2.3, 2.025], [-2.5, 2.25], 0.3),
        ([-2.7, 2.025], [-3.0, 2.25], 0.3),
        ([-2.7, 1.8], [-3.0, 1.8], 0.3),
    ],
    [
        ([-2.7, 1.8], [-3.0, 1.8], 0.3),
        ([-2.7, 1.575], [-3.0, 1.35], 0.3),
        ([-2.5, 1.125], [-2.65, 0.9375], 0.3),
        ([-2.0, 0.9], [-1.9, 0.6], 0.3),
    ],
];
const SPOUT: [[Ring; 4]; 2] = [
    [
        ([1.7, 1.425], [1.7, 0.6], 0.66),
        ([2.6, 1.425], [3.1, 0.825], 0.66),
        ([2.3, 2.1], [2.4, 2.025], 0.25),
        ([2.7, 2.4], [3.3, 2.4], 0.25),
    ],
    [
        ([2.7, 2.4], [3.3, 2.4], 0.25),
        ([2.8, 2.475], [3.525, 2.49375], 0.25),
        ([2.9, 2.475], [3.45, 2.5125], 0.15),
        ([2.8, 2.4], [3.2, 2.4], 0.15),
    ],
];

fn generate(size: u32) -> Scene {
    let lights = [[-3.1, 9.8, 12.1], [11.3, 5.1, 8.8]];
    let mut stage = Stage::new(view([4.86, 7.2, 5.4], [0.0; 3]), &lights);
    for (color, odd) in [(1.0, 1), (0.5, 0)] {
        stage.surface([color, color, color, 0.5, 0.5, 4.81884, 0.0, 0.0]);
        for x in 0..size {
            for y in (0..size).filter(|y| (x + y) % 2 == odd) {
                let line = |nth: u32| 4.0 * (2.0 * f64::from(nth) / f64::from(size) - 1.0);
                let corner = |x, y| DVec3::new(line(x), line(y), 0.0);
                stage.polygon(&[
                    corner(x, y),
                    corner(x + 1, y),
                    corner(x + 1, y + 1),
                    corner(x, y + 1),
                ]);
            }
        }
    }
    stage.surface([1.0, 0.5, 0.1, 0.75, 0.25, 3.0827, 0.0, 0.0]);
    for patch in patches() {
        add(&mut stage, &patch, size);
    }
    stage.finish()
}

fn patches() -> impl Iterator<Item = Patch> {
    let outside = [RIM, BODY, FOOT].into_iter().flat_map(|profile| turned(profile, -1.0));
    let pipes = [HANDLE, SPOUT].into_iter().flatten().flat_map(halves);
    let lid = [KNOB, LID].into_iter().flat_map(|profile| turned(profile, -1.0));
    outside.chain(pipes).chain(lid).chain(turned(BOTTOM, 1.0))
}

/// The four quarters of a profile that is turned from x towards y, or towards −y.
fn turned(profile: [Turned; 4], sense: f64) -> [Patch; 4] {
    let first = profile.map(|(radius, z, share)| {
        let inner = share * radius;
        [[radius, 0.0], [radius, inner], [inner, radius], [0.0, radius]]
            .map(|[x, y]| DVec3::new(x, y * sense, z))
    });
    let next = |point: DVec3| DVec3::new(-point.y * sense, point.x * sense, point.z);
    let mut quarters = [first; 4];
    for nth in 1..4 {
        quarters[nth] = quarters[nth - 1].map(|row| row.map(next));
    }
    quarters
}

/// The half of a pipe at negative y, and the other half, in which rows go the other way.
fn halves(rings: [Ring; 4]) -> [Patch; 2] {
    let half = rings.map(|([inner_x, inner_z], [outer_x, outer_z], width)| {
        [
            DVec3::new(inner_x, 0.0, inner_z),
            DVec3::new(inner_x, -width, inner_z),
            DVec3::new(outer_x, -width, outer_z),
            DVec3::new(outer_x, 0.0, outer_z),
        ]
    });
    let mirrored =
        |[a, b, c, d]: [DVec3; 4]| [d, c, b, a].map(|point| DVec3::new(point.x, -point.y, point.z));
    [half, half.map(mirrored)]
}

/// Two triangles for each of `size`² cells of a patch, but those without area at the tips of lid and
/// bottom.
fn add(stage: &mut Stage, patch: &Patch, size: u32) {
    let share = |line: u32| [line, size - line].map(|n| f64::from(n) / f64::from(size));
    let corner = |s: u32, t: u32| point(patch, share(s), share(t));
    for s in 0..size {
        for t in 0..size {
            let [a, b] = [corner(s, t), corner(s, t + 1)];
            let [d, c] = [corner(s + 1, t), corner(s + 1, t + 1)];
            for triangle in [[a, b, c], [c, d, a]] {
                if triangle.iter().filter(|(position, _)| is_tip(*position)).count() < 2 {
                    stage.patch(triangle);
                }
            }
        }
    }
}

/// Where a patch's edge has shrunk to a point.
fn is_tip(position: DVec3) -> bool {
    position.x.abs() < 1e-4 && position.y.abs() < 1e-4
}

/// A point of a patch and its normal, by shares of the far end and of the near end.
fn point(patch: &Patch, s: [f64; 2], t: [f64; 2]) -> (DVec3, DVec3) {
    let (s, ds, t, dt) = (bernstein(s), slopes(s), bernstein(t), slopes(t));
    let blend = |s: [f64; 4], t: [f64; 4]| {
        let column = |nth| sum([0, 1, 2, 3].map(|row: usize| patch[row][nth] * s[row]));
        sum([0, 1, 2, 3].map(|nth: usize| column(nth) * t[nth]))
    };
    let position = blend(s, t);
    let normal = if is_tip(position) {
        DVec3::Z * if position.z > 1.5 { 1.0 } else { -1.0 }
    } else {
        blend(s, dt).cross(blend(ds, t)).normalize_or_zero()
    };
    (position, normal)
}

/// The same from both ends.
fn sum([a, b, c, d]: [DVec3; 4]) -> DVec3 {
    (a + d) + (b + c)
}

/// The Bernstein polynomials of degree 3: the same from both ends, and there exactly 0 and 1.
fn bernstein([x, y]: [f64; 2]) -> [f64; 4] {
    [y * y * y, 3.0 * (x * y) * y, 3.0 * (x * y) * x, x * x * x]
}

/// Their derivatives.
fn slopes([x, y]: [f64; 2]) -> [f64; 4] {
    [-3.0 * y * y, 3.0 * y * y - 6.0 * x * y, 6.0 * x * y - 3.0 * x * x, 3.0 * x * x]
}
