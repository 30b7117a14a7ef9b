//! `tetra`: a tetrahedron of tetrahedra of half its size, and so on. Source: Glassner, "Space
//! Subdivision for Fast Ray Tracing", IEEE Computer Graphics and Applications 4(10), 1984; view and
//! light are those of Kay and Kajiya, "Ray Tracing Complex Scenes", 1986.

use glam::{DVec3, Vec3};

use super::Procedure;
use super::stage::{Stage, view};
use crate::model::{Scene, View};

pub(super) const PROCEDURE: Procedure = Procedure {
    name: "tetra",
    about: "tetrahedron of tetrahedra: 4096 triangles at size 6",
    default_size: 6,
    sizes: (1, 12),
    generate,
};

/// Every second corner of a cube.
const CORNERS: [DVec3; 4] = [
    DVec3::new(-1.0, -1.0, 1.0),
    DVec3::new(-1.0, 1.0, -1.0),
    DVec3::new(1.0, -1.0, -1.0),
    DVec3::new(1.0, 1.0, 1.0),
];

const FACES: [[usize; 3]; 4] = [[0, 1, 2], [3, 2, 1], [2, 3, 0], [1, 0, 3]];

fn generate(size: u32) -> Scene {
    let view = view([1.022846, -3.177154, -2.174512], [-0.004103, -0.004103, 0.216539]);
    let view = View { up: Vec3::new(-0.816497, -0.816497, 0.816497), ..view };
    let mut stage = Stage::new(view, &[[2.0, -18.0, -5.0]]);
    stage.surface([1.0, 0.2, 0.2, 1.0, 0.0, 100_000.0, 0.0, 0.0]);
    grow(&mut stage, size, DVec3::ZERO, 1.0);
    stage.finish()
}

/// Adds what is in a cube of twice `half`.
fn grow(stage: &mut Stage, generations: u32, center: DVec3, half: f64) {
    if generations == 1 {
        for face in FACES {
            stage.polygon(&face.map(|corner| center + CORNERS[corner] * half));
        }
        return;
    }
    let half = half / 2.0;
    for corner in CORNERS {
        grow(stage, generations - 1, center + corner * half, half);
    }
}
