//! From what stands in transformations to one space.

use glam::{DAffine3, DMat3, Vec3};

use crate::diag::{Error, plural};
use crate::model::{Cone, Scene, Skipped, Sphere, Triangle};
use crate::tessellate::tessellate;

/// The resolution of what is stretched.
const RESOLUTION: u32 = 8;

/// Scales that differ by less than this, relative to themselves, are equal.
const EQUAL: f64 = 1e-5;

/// What was read within one transformation, or between two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Index of the transformation.
    pub(super) node: u32,
    /// Where it begins in the scene's positions, normals, triangles, spheres and cones.
    pub(super) first: [usize; 5],
}

/// Sizes of all that a scene has.
pub(super) fn sizes(scene: &Scene) -> [usize; 5] {
    let mesh = &scene.mesh;
    [
        mesh.positions.len(),
        mesh.normals.len(),
        mesh.triangles.len(),
        scene.spheres.len(),
        scene.cones.len(),
    ]
}

/// Brings all pieces to where their transformations say; those of none are invisible.
pub(super) fn place(
    scene: &mut Scene,
    pieces: &[Piece],
    nodes: &[Option<DAffine3>],
) -> Result<(), Error> {
    let spheres = std::mem::take(&mut scene.spheres);
    let cones = std::mem::take(&mut scene.cones);
    let triangles = std::mem::take(&mut scene.mesh.triangles);
    let mut ends = sizes(scene);
    (ends[2], ends[3], ends[4]) = (triangles.len(), spheres.len(), cones.len());
    let mut counts = Counts::default();
    for (nth, piece) in pieces.iter().enumerate() {
        let next = pieces.get(nth + 1).map_or(ends, |next| next.first);
        let range = |kind: usize| piece.first[kind]..next[kind];
        let Some(to_world) = nodes[piece.node as usize] else {
            counts.invisible += (range(2).len() + range(3).len() + range(4).len()) as u64;
            continue;
        };
        let matrix = to_world.matrix3;
        // What stands in no transformation keeps its bits.
        if to_world != DAffine3::IDENTITY {
            for position in &mut scene.mesh.positions[range(0)] {
                *position = to_world.transform_point3(position.as_dvec3()).as_vec3();
            }
            let of_normals = cofactors(matrix);
            for normal in &mut scene.mesh.normals[range(1)] {
                // Any length will do, but it has to be a number.
                *normal = (of_normals * normal.as_dvec3()).normalize_or_zero().as_vec3();
            }
        }
        let mirrors = matrix.determinant() < 0.0;
        scene.mesh.triangles.extend(triangles[range(2)].iter().map(|triangle| match mirrors {
            true => turned_over(triangle),
            false => *triangle,
        }));
        match uniform(matrix) {
            Some(scale) => {
                let scale = scale as f32;
                let point = |p: Vec3| to_world.transform_point3(p.as_dvec3()).as_vec3();
                scene.spheres.extend(spheres[range(3)].iter().map(|sphere| Sphere {
                    center: point(sphere.center),
                    radius: sphere.radius * scale,
                    ..*sphere
                }));
                scene.cones.extend(cones[range(4)].iter().map(|cone| Cone {
                    base: point(cone.base),
                    apex: point(cone.apex),
                    base_radius: cone.base_radius * scale,
                    apex_radius: cone.apex_radius * scale,
                    ..*cone
                }));
            }
            None => {
                let round = Scene {
                    name: scene.name.clone(),
                    spheres: spheres[range(3)].to_vec(),
                    cones: cones[range(4)].to_vec(),
                    ..Scene::default()
                };
                counts.stretched += (round.spheres.len() + round.cones.len()) as u64;
                stretch(scene, round, to_world)?;
            }
        }
    }
    // What no longer is one vanished or grew beyond all numbers.
    let good = |sphere: &Sphere| sphere.radius > 0.0 && sphere.radius.is_finite();
    scene.spheres.retain(|sphere| good(sphere) && sphere.center.is_finite());
    scene.cones.retain(|cone| {
        let radius = cone.base_radius.max(cone.apex_radius);
        let finite = cone.base.is_finite() && cone.apex.is_finite() && radius.is_finite();
        finite && radius > 0.0 && cone.base != cone.apex
    });
    if scene.mesh.positions.iter().any(|position| !position.is_finite()) {
        let message = format!("{}: transformed, it reaches beyond single precision", scene.name);
        return Err(Error::Inexpressible(message));
    }
    counts.tell(scene);
    Ok(())
}

#[derive(Default)]
struct Counts {
    invisible: u64,
    stretched: u64,
}

impl Counts {
    fn tell(&self, scene: &mut Scene) {
        if self.invisible > 0 {
            let (what, why) = ("primitive", "it is not visible in the first frame");
            let (what, why) = (what.to_owned(), why.to_owned());
            scene.facts.skipped.push(Skipped { what, why, count: self.invisible });
        }
        if self.stretched > 0 {
            let many = plural(self.stretched, "stretched primitive");
            scene.facts.warnings.push(format!("{many}: drawn as triangles"));
        }
    }
}

/// Adds the triangles of spheres and cones, stretched.
fn stretch(scene: &mut Scene, round: Scene, to_world: DAffine3) -> Result<(), Error> {
    let round = tessellate(round, RESOLUTION)?.mesh;
    let mesh = &mut scene.mesh;
    let (position, normal) = (mesh.positions.len() as u32, mesh.normals.len() as u32);
    let of_normals = cofactors(to_world.matrix3);
    mesh.positions
        .extend(round.positions.iter().map(|p| to_world.transform_point3(p.as_dvec3()).as_vec3()));
    mesh.normals.extend(
        round.normals.iter().map(|n| (of_normals * n.as_dvec3()).normalize_or_zero().as_vec3()),
    );
    let mirrors = to_world.matrix3.determinant() < 0.0;
    mesh.triangles.extend(round.triangles.iter().map(|triangle| {
        let moved = Triangle {
            position: triangle.position.map(|i| position + i),
            normal: triangle.normal.map(|n| n.map(|i| normal + i)),
            uv: triangle.uv,
            material: triangle.material,
        };
        if mirrors { turned_over(&moved) } else { moved }
    }));
    Ok(())
}

/// Counterclockwise again, after a reflection.
fn turned_over(triangle: &Triangle) -> Triangle {
    let swap = |[a, b, c]: [u32; 3]| [a, c, b];
    Triangle {
        position: swap(triangle.position),
        normal: triangle.normal.map(swap),
        uv: triangle.uv.map(swap),
        material: triangle.material,
    }
}

/// The factor of a matrix that turns, reflects and scales alike in all directions.
fn uniform(matrix: DMat3) -> Option<f64> {
    let (x, y, z) = (matrix.x_axis, matrix.y_axis, matrix.z_axis);
    let square = x.length_squared();
    let near = |a: f64, b: f64| (a - b).abs() <= EQUAL * square;
    let lengths = near(y.length_squared(), square) && near(z.length_squared(), square);
    let angles = near(x.dot(y), 0.0) && near(y.dot(z), 0.0) && near(z.dot(x), 0.0);
    (lengths && angles).then(|| square.sqrt())
}

/// What turns normals as a matrix turns surfaces: the inverse, transposed, but for its length; it is
/// there for every matrix.
fn cofactors(matrix: DMat3) -> DMat3 {
    let (x, y, z) = (matrix.x_axis, matrix.y_axis, matrix.z_axis);
    let sign = if matrix.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
}
