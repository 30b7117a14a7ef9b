//! The sample scenes, where they are there: counts that were made by other means.

use glam::Vec3;
use rt_scene::{Cone, Scene, nff, open, spd};

use crate::support::sample;

fn open_sample(name: &str) -> Option<Scene> {
    Some(open(sample(name)?.to_str()?).unwrap())
}

#[test]
fn obj_counts() {
    for (name, polygons, triangles, flat) in [
        ("obj/bunny.obj", 69_451, 69_451, 0),
        ("obj/dragon.obj", 871_414, 871_414, 108),
        ("obj/conference.obj", 331_179, 331_179, 53_627),
        ("obj/teapot.obj", 6_320, 6_320, 0),
        ("obj/spot/spot.obj", 5_856, 5_856, 0),
        ("obj/spot/spot_quads.obj", 2_928, 5_856, 0),
        ("obj/cornell/CornellBox-Original.obj", 18, 36, 0),
        ("obj/cornell/CornellBox-Empty-Squashed.obj", 6, 12, 0),
        ("obj/cornell/CornellBox-Water.obj", 7_088, 7_088, 0),
    ] {
        let Some(scene) = open_sample(name) else { continue };
        assert_eq!(scene.facts.stated["polygon"], polygons, "{name}");
        assert_eq!(scene.mesh.triangles.len(), triangles, "{name}");
        let warning = format!("{flat} triangles have no area");
        let warned = scene.facts.warnings.contains(&warning);
        assert_eq!(warned, flat > 0, "{name}: {:?}", scene.facts.warnings);
    }
}

#[test]
fn cornell_materials() {
    let Some(scene) = open_sample("obj/cornell/CornellBox-Mirror.obj") else { return };
    assert!(scene.facts.warnings.is_empty(), "{:?}", scene.facts.warnings);
    let named = |name: &str| scene.materials.iter().find(|m| m.name == name).unwrap();
    assert_eq!(named("leftWall").diffuse.to_array(), [0.63, 0.065, 0.05]);
    assert_eq!(named("leftWall").mirror.to_array(), [0.0; 3]);
    assert_eq!(named("tallBox").mirror.to_array(), [0.95; 3]);
    assert_eq!(named("tallBox").shininess, 1000.0);
    assert_eq!(named("light").emission.to_array(), [17.0, 12.0, 4.0]);
}

/// The samples have six digits.
#[test]
fn procedures_make_what_their_programs_print() {
    let samples: [(&str, &[u32]); 11] = [
        ("balls", &[1, 3, 4]),
        ("gears", &[1, 2, 4]),
        ("jacks", &[1, 3, 4]),
        ("lattice", &[1, 5, 12]),
        ("mount", &[1, 4, 6]),
        ("rings", &[1, 3, 7]),
        ("shells", &[1, 5]),
        ("sombrero", &[1]),
        ("teapot", &[2, 6, 12]),
        ("tetra", &[1, 3, 6]),
        ("tree", &[1, 8, 11]),
    ];
    for (name, sizes) in samples {
        for &size in sizes {
            let Some(path) = sample(&format!("spd/{name}_s{size}.nff")) else { continue };
            let expected = nff::read(&path).unwrap();
            let scene = spd::generate(name, Some(size)).unwrap();
            assert_eq!(scene.facts.stated, expected.facts.stated);
            assert_near(&numbers(&scene), &numbers(&expected), &scene.name);
            assert_eq!(scene.mesh.triangles, expected.mesh.triangles, "{}", scene.name);
            assert_eq!(indices(&scene), indices(&expected), "{}", scene.name);
            let size = |scene: &Scene| scene.view.unwrap().size;
            assert_eq!(size(&scene), size(&expected));
        }
    }
}

fn assert_near(found: &[Vec<f32>], expected: &[Vec<f32>], name: &str) {
    for (part, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_eq!(found.len(), expected.len(), "part {part} of {name}");
        for (at, (&a, &b)) in found.iter().zip(expected).enumerate() {
            let near = (a - b).abs() <= 1e-5 * b.abs().max(1.0);
            assert!(near, "number {at} of part {part} of {name}: {a} for {b}");
        }
    }
}

/// All numbers of a scene that a picture depends on, in parts.
fn numbers(scene: &Scene) -> Vec<Vec<f32>> {
    let (mesh, view) = (&scene.mesh, scene.view.unwrap());
    let spheres = scene.spheres.iter().flat_map(|s| [s.center, Vec3::splat(s.radius)]);
    let radii = |c: &Cone| Vec3::new(c.base_radius, c.apex_radius, 0.0);
    let cones = scene.cones.iter().flat_map(|cone| [cone.base, cone.apex, radii(cone)]);
    let materials = scene.materials.iter().flat_map(|m| {
        let numbers = Vec3::new(m.shininess, m.ior, 0.0);
        [m.diffuse, m.specular, m.mirror, m.transmission, m.emission, numbers]
    });
    let lights = scene.lights.iter().flat_map(|light| [light.position, light.color]);
    let view = [view.eye, view.target, view.up, Vec3::splat(view.fov_y), scene.background.unwrap()];
    [
        mesh.positions.clone(),
        mesh.normals.clone(),
        spheres.collect(),
        cones.collect(),
        materials.collect(),
        lights.collect(),
        view.to_vec(),
    ]
    .map(|part: Vec<Vec3>| part.iter().flat_map(Vec3::to_array).collect())
    .to_vec()
}

/// The materials that spheres and cones have.
fn indices(scene: &Scene) -> Vec<u32> {
    let spheres = scene.spheres.iter().map(|sphere| sphere.material);
    spheres.chain(scene.cones.iter().map(|cone| cone.material)).collect()
}

/// Primitives as the databases' documentation counts them.
#[test]
fn nff_counts() {
    for (name, stated) in [
        ("rings_s7", vec![("cylinder", 4200), ("polygon", 1), ("sphere", 4200)]),
        ("tree_s11", vec![("cone", 4095), ("polygon", 1), ("sphere", 4095)]),
        ("mount_s6", vec![("polygon", 8192), ("sphere", 4)]),
        ("tetra_s6", vec![("polygon", 4096)]),
        ("teapot_s12", vec![("patch", 9120), ("polygon", 144)]),
        ("gears_s4", vec![("polygon", 9345)]),
        ("shells_s5", vec![("sphere", 5761)]),
    ] {
        let Some(scene) = open_sample(&format!("spd/{name}.nff")) else { continue };
        let found: Vec<_> = scene.facts.stated.into_iter().collect();
        assert_eq!(found, stated, "{name}");
    }
}

/// A gear's two faces have 144 corners each and are concave: they must come out whole.
#[test]
fn gears_are_triangulated_neatly() {
    let Some(scene) = open_sample("spd/gears_s2.nff") else { return };
    let polygons = 8 * (2 * 142 + 144 * 2) + 2;
    assert_eq!(scene.mesh.triangles.len(), polygons);
    assert!(!scene.facts.warnings.iter().any(|warning| warning.contains("overlap")));
}

/// The museum says at its head what is in it.
#[test]
fn bart_counts() {
    for (size, polygons, animated) in [(3, 10_143, 64), (4, 10_143, 256), (5, 10_143, 1_024)] {
        let Some(scene) = open_sample(&format!("bart/museum/museum{size}.aff")) else { continue };
        let count = |kind| scene.facts.stated.get(kind).copied().unwrap_or(0);
        let flat = ["polygon", "patch", "mesh triangle", "textured triangle", "textured patch"];
        assert_eq!(flat.into_iter().map(count).sum::<u64>(), polygons, "{:?}", scene.facts.stated);
        assert_eq!(count("animated triangle"), animated);
        assert_eq!((count("cone") + count("cylinder"), scene.cones.len()), (8, 8));
    }
}

/// Matrices of the camera that another program computed.
#[test]
fn bart_cameras_stand_where_they_should() {
    let Some(path) = sample("bart/animation_vectors.tsv") else { return };
    let table = std::fs::read_to_string(path).unwrap();
    for (name, start) in [("kitchen/kitchen", "0"), ("museum/museum3", "-1")] {
        let Some(scene) = open_sample(&format!("bart/{name}.aff")) else { continue };
        let (folder, _) = name.split_once('/').unwrap();
        let line = format!("{folder}\tcamera\t{start}\t");
        let row = table.lines().find_map(|row| row.strip_prefix(&line)).expect("a camera");
        let m: Vec<f32> = row.split('\t').map(|number| number.parse().unwrap()).collect();
        let column = |i: usize| Vec3::new(m[i], m[4 + i], m[8 + i]);
        let view = scene.view.unwrap();
        assert!(view.eye.distance(column(3)) < 1e-5, "{name}: {}", view.eye);
        let forward = (view.target - view.eye).normalize();
        assert!(forward.distance(-column(2)) < 1e-5, "{name}: {forward}");
        assert!(view.up.distance(column(1)) < 1e-5, "{name}: {}", view.up);
        let bounds = scene.bounds().unwrap();
        assert!(bounds.0.is_finite() && bounds.1.is_finite());
    }
}
