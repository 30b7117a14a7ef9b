//! `near`, `far` and `slivers`: not of the databases, but three scenes of triangles that need
//! different precision.
//!
//! Only square roots and quotients are taken, so the numbers are the same on every machine.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::Procedure;
use crate::model::{Mesh, Scene, Triangle};

pub(super) const NEAR: Procedure = Procedure {
    name: "near",
    about: "a closed surface with bumps about the origin: 768 triangles at size 8",
    default_size: 8,
    sizes: (1, 256),
    generate: |size| of_mesh(bumpy(size, Vec3::ZERO)),
};

pub(super) const FAR: Procedure = Procedure {
    name: "far",
    about: "the same, more than 200000 from the origin",
    generate: |size| of_mesh(bumpy(size, Vec3::new(100_000.0, -30_000.0, 200_000.0))),
    ..NEAR
};

pub(super) const SLIVERS: Procedure = Procedure {
    name: "slivers",
    about: "a disc of needles about the origin: 20000 triangles at size 200",
    default_size: 200,
    sizes: (1, 10_000),
    generate: |size| of_mesh(disc(size)),
};

fn of_mesh(mesh: Mesh) -> Scene {
    let mut scene = Scene { mesh, ..Scene::default() };
    scene.facts.stated.insert("polygon", scene.mesh.triangles.len() as u64);
    scene
}

fn triangle(position: [u32; 3]) -> Triangle {
    Triangle { position, normal: None, uv: None, material: 0 }
}

/// A cube blown up to a ball, each side a grid of so many squares, with bumps, and of a
/// radius of about 4.
fn bumpy(size: u32, place: Vec3) -> Mesh {
    let size = size as i32;
    let mut mesh = Mesh::default();
    let mut known = HashMap::new();
    // By their place on the cube, so that sides share the vertices of its edges.
    let mut vertex = |mesh: &mut Mesh, at: [i32; 3]| {
        *known.entry(at).or_insert_with(|| {
            let unit = DVec3::from_array(at.map(f64::from)).normalize();
            mesh.positions.push((unit * radius(unit)).as_vec3() + place);
            mesh.positions.len() as u32 - 1
        })
    };
    for (axis, side) in (0..3).flat_map(|axis| [(axis, 1), (axis, -1)]) {
        for (i, j) in (0..size).flat_map(|i| (0..size).map(move |j| (i, j))) {
            let square = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|[u, v]| {
                let mut at = [side * size; 3];
                // On the back the grid is mirrored, so that all triangles face outward.
                at[(axis + 1) % 3] = side * (2 * u - size);
                at[(axis + 2) % 3] = 2 * v - size;
                vertex(&mut mesh, at)
            });
            let [a, b, c, d] = square;
            mesh.triangles.extend([[a, b, c], [a, c, d]].map(triangle));
        }
    }
    mesh
}

/// How far from the centre the surface is in a direction: a sum of waves, each a parabola to and
/// fro.
fn radius(unit: DVec3) -> f64 {
    let wave = |x: f64| {
        let phase = x - x.floor() - 0.5;
        1.0 - 8.0 * phase * phase
    };
    let waves = wave(3.0 * unit.x + 2.0 * unit.z)
        + wave(4.0 * unit.y - unit.x)
        + wave(3.0 * unit.z + unit.y);
    4.0 + 0.1 * waves
}

/// A disc of radius 1: a hundred times `size` needles from its middle to its rim, in four quarters.
fn disc(size: u32) -> Mesh {
    let quarter = 25 * size;
    let mut positions = vec![Vec3::new(0.0, 0.0, 0.125)];
    for i in 0..4 * quarter {
        // The rational parametrisation of a quarter of the circle.
        let t = f64::from(i % quarter) / f64::from(quarter);
        let (cosine, sine) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
        let [x, y] = match i / quarter {
            0 => [cosine, sine],
            1 => [-sine, cosine],
            2 => [-cosine, -sine],
            _ => [sine, -cosine],
        };
        positions.push(Vec3::new(x as f32, y as f32, 0.125));
    }
    let rim = 4 * quarter;
    let triangles = (0..rim).map(|i| triangle([0, 1 + i, 1 + (i + 1) % rim])).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}
