//! Scenes to take pictures of. All coordinates of [`bumpy`] and [`room`] are multiples of 2^-12, so
//! that a scene multiplied by any power of two is the same scene.

use glam::Vec3;
use rt_scene::{Light, Material, Scene, Sphere, Triangle, View};

use crate::mesh::Mesh;

/// The nearest multiple of 2^-12.
fn snap(v: Vec3) -> Vec3 {
    (v * 4096.0).round() / 4096.0
}

/// A material of that colour, matt.
fn matt(red: f32, green: f32, blue: f32) -> Material {
    Material { diffuse: Vec3::new(red, green, blue), ..Material::default() }
}

/// Adds a mesh to a scene, with its vertices' directions from `center` as normals, if it is to be
/// smooth.
fn add(scene: &mut Scene, mesh: &Mesh, material: u32, smooth_about: Option<Vec3>) {
    let first = scene.mesh.positions.len() as u32;
    let first_normal = scene.mesh.normals.len() as u32;
    scene.mesh.positions.extend(&mesh.vertices);
    if let Some(center) = smooth_about {
        scene.mesh.normals.extend(mesh.vertices.iter().map(|&vertex| vertex - center));
    }
    scene.mesh.triangles.extend(mesh.faces.iter().map(|face| Triangle {
        position: face.map(|i| i + first),
        normal: smooth_about.map(|_| face.map(|i| i + first_normal)),
        uv: None,
        material,
    }));
}

/// A closed mesh with bumps and normals, that floats over a small sphere. No lights, no view.
pub fn bumpy() -> Scene {
    let bump = |v: Vec3| v * (1.0 + 0.4 * (v.x * v.y + v.y * v.z * v.z - v.x * v.x * v.z));
    let mesh = Mesh::icosphere(2).map(|v| snap(bump(v)));
    let mut scene = Scene {
        name: "bumpy".to_owned(),
        materials: vec![
            Material { specular: Vec3::splat(0.5), shininess: 20.0, ..matt(0.8, 0.6, 0.3) },
            matt(0.2, 0.4, 0.9),
        ],
        ..Scene::default()
    };
    add(&mut scene, &mesh, 0, Some(Vec3::ZERO));
    scene.spheres.push(Sphere { center: Vec3::new(0.25, -1.5, 0.5), radius: 0.375, material: 1 });
    scene
}

/// A room with coloured walls, a lamp that glows, a turned block, a mirror and a mirror ball.
pub fn room() -> Scene {
    let glow = Material { emission: Vec3::new(1.0, 0.9, 0.7), ..matt(0.5, 0.5, 0.5) };
    let mirror = Material {
        mirror: Vec3::new(0.9, 0.8, 0.85),
        specular: Vec3::splat(0.4),
        shininess: 60.0,
        ..matt(0.05, 0.05, 0.05)
    };
    let mut scene = Scene {
        name: "room".to_owned(),
        materials: vec![
            matt(0.75, 0.75, 0.75),
            matt(0.7, 0.1, 0.1),
            matt(0.1, 0.6, 0.15),
            glow,
            mirror,
        ],
        lights: vec![
            Light { position: Vec3::new(0.0, 0.875, 0.0), color: Vec3::splat(0.8) },
            Light { position: Vec3::new(-0.5, 0.25, 2.5), color: Vec3::new(0.1, 0.2, 0.3) },
        ],
        background: Some(Vec3::new(0.01, 0.02, 0.05)),
        view: Some(View {
            eye: Vec3::new(0.125, 0.0625, 3.5),
            target: Vec3::new(0.0, -0.0625, 0.0),
            up: Vec3::Y,
            fov_y: 40.0,
            size: None,
        }),
        ..Scene::default()
    };
    for (material, axis, side) in
        [(1, 0, -1.0), (2, 0, 1.0), (0, 1, -1.0), (0, 1, 1.0), (0, 2, -1.0)]
    {
        quad(&mut scene, material, axis, side, Vec3::ZERO, 1.0);
    }
    quad(&mut scene, 3, 1, 1.0, Vec3::new(0.0, -1.0 / 64.0, 0.0), 0.25);
    quad(&mut scene, 4, 2, -1.0, Vec3::new(0.25, 0.125, 1.0 / 64.0), 0.5);
    let turned =
        |v: Vec3| Vec3::new(0.8 * v.x - 0.6 * v.z, 1.5 * v.y, 0.6 * v.x + 0.8 * v.z) * 0.25;
    let block = Mesh::cube(2).map(|v| snap(turned(v) + Vec3::new(-0.45, -0.625, -0.3)));
    add(&mut scene, &block, 0, None);
    scene.spheres.push(Sphere {
        center: Vec3::new(0.5, -0.6875, 0.25),
        radius: 0.3125,
        material: 4,
    });
    scene
}

/// The room with glass in it: balls that bend light by Fresnel's equations and without, one of air
/// within one of glass, a block of triangles and a coloured sheet that bends nothing.
pub fn glass() -> Scene {
    let clear = Material {
        transmission: Vec3::splat(0.9),
        mirror: Vec3::splat(0.9),
        specular: Vec3::splat(0.5),
        shininess: 80.0,
        ior: 1.5,
        fresnel: true,
        ..matt(0.02, 0.02, 0.02)
    };
    let plain = Material { mirror: Vec3::splat(0.1), fresnel: false, ..clear.clone() };
    let air = Material { ior: 1.0 / 1.5, specular: Vec3::ZERO, ..clear.clone() };
    let sheet = Material {
        transmission: Vec3::new(0.1, 0.3, 0.6),
        mirror: Vec3::ZERO,
        ior: 1.0,
        fresnel: false,
        ..matt(0.1, 0.05, 0.05)
    };
    let mut scene = room();
    scene.name = "glass".to_owned();
    let first = scene.materials.len() as u32;
    scene.materials.extend([clear, plain, air, sheet]);
    let ball = |[x, y, z]: [f32; 3], radius, material| Sphere {
        center: Vec3::new(x, y, z),
        radius,
        material: first + material,
    };
    scene.spheres = vec![
        ball([-0.5, 0.25, 0.5], 0.25, 0),
        ball([0.5, -0.6875, 0.75], 0.3125, 1),
        ball([0.25, 0.375, 0.75], 0.25, 0),
        ball([0.25, 0.375, 0.75], 0.125, 2),
    ];
    let block = Mesh::cube(1).map(|v| snap(v * 0.1875) + Vec3::new(-0.0625, -0.75, 0.875));
    add(&mut scene, &block, first, None);
    quad(&mut scene, first + 3, 2, 0.5, Vec3::new(-0.5, -0.5, 0.0), 0.375);
    scene
}

/// A square across an axis, at `side` of it, `half` from its middle to its sides.
fn quad(scene: &mut Scene, material: u32, axis: usize, side: f32, offset: Vec3, half: f32) {
    let first = scene.mesh.positions.len() as u32;
    for [u, v] in [[-half, -half], [half, -half], [half, half], [-half, half]] {
        let mut corner = Vec3::splat(side);
        (corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (u, v);
        scene.mesh.positions.push(corner + offset);
    }
    for face in [[0, 1, 2], [0, 2, 3]] {
        let position = face.map(|i| first + i);
        scene.mesh.triangles.push(Triangle { position, normal: None, uv: None, material });
    }
}

/// The scene with all lengths multiplied by `factor`, a power of two.
#[must_use]
pub fn scaled(mut scene: Scene, factor: f32) -> Scene {
    scene.mesh.positions.iter_mut().for_each(|position| *position *= factor);
    for sphere in &mut scene.spheres {
        sphere.center *= factor;
        sphere.radius *= factor;
    }
    for cone in &mut scene.cones {
        cone.base *= factor;
        cone.base_radius *= factor;
        cone.apex *= factor;
        cone.apex_radius *= factor;
    }
    scene.lights.iter_mut().for_each(|light| light.position *= factor);
    if let Some(view) = &mut scene.view {
        view.eye *= factor;
        view.target *= factor;
    }
    scene
}

/// A closed mesh with bumps, near the origin: nothing is hard about it.
pub fn near() -> Scene {
    procedural("near")
}

/// The same, far from the origin.
pub fn far() -> Scene {
    procedural("far")
}

/// A disc of needles, near the origin.
pub fn slivers() -> Scene {
    procedural("slivers")
}

fn procedural(name: &str) -> Scene {
    rt_scene::spd::generate(name, None).expect("it is one of the procedures")
}
