//! Procedural scenes.

use std::collections::HashSet;

use glam::{DVec3, Vec3};
use rt_scene::{Cone, Scene, Sphere, Triangle, spd};

use crate::support::nff;

/// What the databases' documentation says of a size.
fn counts(name: &str, size: u32) -> Vec<(&'static str, u64)> {
    let n = u64::from(size);
    match name {
        "balls" => vec![("polygon", 1), ("sphere", (9_u64.pow(size + 1) - 1) / 8)],
        "gears" => vec![("polygon", 146 * n.pow(3) + 1)],
        "jacks" => {
            let jacks = (8_u64.pow(size) - 1) / 7;
            vec![("cylinder", 3 * jacks), ("sphere", 6 * jacks)]
        }
        "lattice" => vec![("cylinder", 3 * n * (n + 1).pow(2)), ("sphere", (n + 1).pow(3))],
        "mount" => vec![("polygon", 2 * 4_u64.pow(size)), ("sphere", 4)],
        "rings" => {
            let pieces = 5 * n * (n + 1) * (2 * n + 1);
            vec![("cylinder", pieces), ("polygon", 1), ("sphere", pieces)]
        }
        "shells" => vec![("sphere", 180 * 2_u64.pow(size) + 1)],
        "sombrero" => vec![("polygon", 2 * (32 * 2_u64.pow(size - 1) - 1).pow(2))],
        "teapot" => vec![("patch", 64 * n * n - 8 * n), ("polygon", n * n)],
        "tetra" => vec![("polygon", 4_u64.pow(size))],
        "tree" => {
            let branches = 2_u64.pow(size + 1) - 1;
            vec![("cone", branches), ("polygon", 1), ("sphere", branches)]
        }
        "near" | "far" => vec![("polygon", 12 * n * n)],
        "slivers" => vec![("polygon", 100 * n)],
        _ => panic!("{name} has no counts"),
    }
}

#[test]
fn scenes_come_in_sizes() {
    for procedure in spd::PROCEDURES {
        let least = procedure.sizes.0;
        for size in [least + 1, least + 2, procedure.default_size, least] {
            let scene = spd::generate(procedure.name, Some(size)).unwrap();
            assert_eq!(scene.name, format!("spd:{}:{size}", procedure.name));
            let stated: Vec<_> = scene.facts.stated.into_iter().collect();
            assert_eq!(stated, counts(procedure.name, size), "{}", scene.name);
            // One of so few patches is not for use.
            let warned = scene.name == "spd:teapot:1";
            assert_eq!(!scene.facts.warnings.is_empty(), warned, "{}", scene.name);
        }
        let scene = spd::generate(procedure.name, None).unwrap();
        let stated: Vec<_> = scene.facts.stated.into_iter().collect();
        assert_eq!(stated, counts(procedure.name, procedure.default_size), "{}", scene.name);
    }
}

/// Children touch their parent, and no sphere is larger than it should be.
#[test]
fn balls_touch() {
    let scene = spd::generate("balls", Some(2)).unwrap();
    let gap = |a: usize, b: usize| {
        let (a, b) = (scene.spheres[a], scene.spheres[b]);
        a.center.distance(b.center) - a.radius - b.radius
    };
    for child in 0..9 {
        let child = 1 + child * 10;
        assert!(gap(0, child).abs() < 1e-6);
        for grandchild in 1..=9 {
            assert!(gap(child, child + grandchild).abs() < 1e-6);
        }
    }
}

/// What is looked at.
#[derive(Clone, Copy)]
enum Point {
    Vertex(usize),
    /// Its centre.
    Sphere(usize),
    /// Its ends.
    Cone(usize),
}

/// Some places in each database as its own program prints them.
#[test]
fn primitives_in_the_order_of_the_databases() {
    use Point::{Cone, Sphere, Vertex};
    let places: [(&str, u32, Point, &[[f32; 3]]); 30] = [
        ("balls", 3, Sphere(1), &[[0.272166, 0.272166, 0.544331]]),
        ("balls", 3, Sphere(2), &[[0.420314, 0.420314, 0.618405]]),
        ("balls", 3, Sphere(4), &[[0.461623, 0.409245, 0.557924]]),
        ("balls", 3, Sphere(12), &[[0.461844, 0.304709, 0.43322]]),
        ("balls", 3, Sphere(13), &[[0.492085, 0.33495, 0.372739]]),
        ("balls", 3, Sphere(274), &[[-0.371785, 0.0996195, 0.544331]]),
        ("balls", 3, Sphere(729), &[[0.471405, -0.471405, 0.0]]),
        ("gears", 2, Vertex(1000), &[[0.942225, -0.718037, 1.0]]),
        ("gears", 2, Vertex(5000), &[[0.93729, -0.727516, 0.5]]),
        ("jacks", 3, Sphere(100), &[[-0.491438, -0.502267, 1.00505]]),
        ("jacks", 3, Sphere(400), &[[-0.021592, 0.449264, 0.653148]]),
        (
            "jacks",
            3,
            Cone(40),
            &[[-0.790275, -0.389682, 0.200051], [-0.790275, -0.0649226, 0.0125508]],
        ),
        (
            "jacks",
            3,
            Cone(200),
            &[[0.0425368, 0.523547, 0.406811], [-0.0857207, 0.69974, 0.711985]],
        ),
        ("lattice", 5, Sphere(100), &[[0.4, 0.8, 0.8]]),
        ("lattice", 5, Cone(77), &[[0.02475, 0.8, 0.6], [0.17525, 0.8, 0.6]]),
        ("lattice", 5, Cone(500), &[[1.0, 0.2, 0.82475], [1.0, 0.2, 0.97525]]),
        ("mount", 4, Vertex(100), &[[-0.5, -0.875, -0.286223]]),
        ("mount", 4, Vertex(1400), &[[0.0, 0.875, 0.0838817]]),
        ("mount", 4, Sphere(3), &[[-0.98961, 0.749194, 0.930598]]),
        ("rings", 3, Cone(166), &[[-2.28769, 7.4434, -1.20805], [-2.93099, 7.83938, -2.0]]),
        ("shells", 1, Sphere(0), &[[0.0, 0.00350044, -0.00700088]]),
        ("shells", 1, Sphere(300), &[[0.0, -4.11121, -8.22241]]),
        ("sombrero", 1, Vertex(100), &[[0.129032, -3.0, -3.74194]]),
        ("sombrero", 1, Vertex(4000), &[[-0.129032, -3.21672, 1.67742]]),
        ("teapot", 2, Vertex(100), &[[0.0, 1.40312, 2.49844]]),
        ("teapot", 2, Vertex(700), &[[-0.911906, -0.911906, 0.046875]]),
        ("tetra", 3, Vertex(150), &[[0.5, 0.0, 0.5]]),
        ("tree", 8, Cone(3), &[[0.625853, 0.271578, 1.74586], [0.594216, 0.406804, 1.98278]]),
        ("tree", 8, Cone(166), &[[0.951713, -0.727962, 2.11686], [0.957196, -0.759444, 2.13542]]),
        ("tree", 8, Sphere(419), &[[-0.0082508, 0.986386, 2.39319]]),
    ];
    for (name, size, point, expected) in places {
        let scene = spd::generate(name, Some(size)).unwrap();
        let found = match point {
            Vertex(nth) => vec![scene.mesh.positions[nth]],
            Sphere(nth) => vec![scene.spheres[nth].center],
            Cone(nth) => vec![scene.cones[nth].base, scene.cones[nth].apex],
        };
        for (found, &expected) in found.iter().zip(expected) {
            assert!(found.abs_diff_eq(expected.into(), 1e-5), "{}: {found}", scene.name);
        }
    }
}

/// The same of radii.
#[test]
fn radii_of_the_databases() {
    for (name, size, sphere, radius) in [
        ("balls", 2, 90, 0.0555556),
        ("jacks", 3, 100, 0.0375),
        ("lattice", 5, 100, 0.05),
        ("mount", 4, 3, 0.17),
        ("rings", 3, 7, 0.07412),
        ("shells", 1, 300, 4.11121),
        ("tree", 8, 419, 0.00909107),
    ] {
        let found = spd::generate(name, Some(size)).unwrap().spheres[sphere].radius;
        assert!((found - radius).abs() < 1e-5, "spd:{name}:{size}: {found}");
    }
    for (name, size, cone, radii) in [
        ("jacks", 3, 40, [0.01875, 0.01875]),
        ("lattice", 5, 77, [0.0125, 0.0125]),
        ("rings", 3, 166, [0.07412, 0.07412]),
        ("tree", 8, 166, [0.00609102, 0.00408098]),
    ] {
        let cone = spd::generate(name, Some(size)).unwrap().cones[cone];
        for (found, radius) in [cone.base_radius, cone.apex_radius].into_iter().zip(radii) {
            assert!((found - radius).abs() < 1e-6, "spd:{name}:{size}: {cone:?}");
        }
    }
}

/// Where patches of the pot are neighbours, their vertices are the same bits.
#[test]
fn the_teapot_has_no_cracks() {
    let scene = spd::generate("teapot", Some(5)).unwrap();
    let mesh = &scene.mesh;
    let pot: Vec<_> = mesh.triangles.iter().filter(|t| t.normal.is_some()).collect();
    // Bits, but for zeros, which have two.
    let bits = |i: u32| mesh.positions[i as usize].to_array().map(|x| (x + 0.0).to_bits());
    let mut edges = std::collections::HashMap::new();
    for triangle in &pot {
        let corners = triangle.position.map(bits);
        for nth in 0..3 {
            let mut edge = [corners[nth], corners[(nth + 1) % 3]];
            edge.sort_unstable();
            *edges.entry(edge).or_insert(0) += 1;
        }
    }
    // Open are the upper edges of the pot, of the lid, and both ends of handle and spout: four times
    // five edges for each ring, twice five for each end.
    let open = edges.values().filter(|&&count| count == 1).count();
    assert_eq!(open, 2 * 20 + 4 * 10);
    assert!(edges.values().all(|&count| count <= 2));
}

/// What there is, each with its material: a polygon may come back in parts, whose corners are not
/// shared, and materials in another order.
fn shapes(scene: &Scene) -> impl PartialEq {
    let material = |index: u32| &scene.materials[index as usize];
    let at = |i: u32| scene.mesh.positions[i as usize];
    let flat = |t: &Triangle| (t.position.map(at), material(t.material));
    let sphere = |s: &Sphere| (s.center, s.radius, material(s.material));
    let cone = |c: &Cone| (Cone { material: 0, ..*c }, material(c.material));
    (
        scene.mesh.triangles.iter().map(flat).collect::<Vec<_>>(),
        scene.spheres.iter().map(sphere).collect::<Vec<_>>(),
        scene.cones.iter().map(cone).collect::<Vec<_>>(),
    )
}

#[test]
fn written_and_read_back() {
    for procedure in spd::PROCEDURES {
        let scene = spd::generate(procedure.name, Some(2)).unwrap();
        let mut written = Vec::new();
        rt_scene::nff::write(&scene, &mut written).unwrap();
        let again = nff(&written).unwrap();
        let name = &scene.name;
        assert!(shapes(&again) == shapes(&scene), "{name}");
        assert!(again.mesh.normals == scene.mesh.normals, "{name}");
        assert_eq!((again.view, again.background), (scene.view, scene.background), "{name}");
        assert_eq!(again.lights, scene.lights, "{name}");
    }
    let scene = spd::generate("balls", Some(2)).unwrap();
    let mut written = Vec::new();
    rt_scene::nff::write(&scene, &mut written).unwrap();
    let text = String::from_utf8(written).unwrap();
    let floor = "f 1 0.75 0.33 0.8 0 100000 0 1";
    let balls = "f 1 0.9 0.7 0.5 0.5 3.0827 0 1";
    for line in ["l 4 3 2", floor, "p 4", "12 12 -0.5", balls, "s 0 0 0 0.5"] {
        assert!(text.lines().any(|found| found == line), "no line {line}");
    }
}

#[test]
fn the_list_of_procedures_is_good() {
    for procedure in spd::PROCEDURES {
        assert!(procedure.sizes.0 <= procedure.default_size);
        assert!(procedure.default_size <= procedure.sizes.1);
        let scene = spd::generate(procedure.name, Some(procedure.sizes.0)).unwrap();
        assert!(scene.bounds().is_some(), "{}", procedure.about);
    }
}

fn corners(scene: &Scene) -> impl Iterator<Item = [DVec3; 3]> {
    let at = |i: u32| scene.mesh.positions[i as usize].as_dvec3();
    scene.mesh.triangles.iter().map(move |triangle| triangle.position.map(at))
}

#[test]
fn near_and_far_are_closed_and_face_outward() {
    for (name, size) in [("near", 1), ("near", 5), ("far", 5), ("near", 8)] {
        let scene = spd::generate(name, Some(size)).unwrap();
        assert_eq!(scene.mesh.triangles.len() as u32, 12 * size * size);
        let edges = scene.mesh.triangles.iter().flat_map(|triangle| {
            let [a, b, c] = triangle.position;
            [[a, b], [b, c], [c, a]]
        });
        let edges: HashSet<_> = edges.collect();
        assert_eq!(edges.len(), 3 * scene.mesh.triangles.len(), "an edge runs the same way twice");
        assert!(edges.iter().all(|&[a, b]| edges.contains(&[b, a])), "{name}: not closed");
        let (low, high) = scene.bounds().unwrap();
        let center = (low.as_dvec3() + high.as_dvec3()) / 2.0;
        for [a, b, c] in corners(&scene) {
            assert!((b - a).cross(c - a).dot(a - center) > 0.0, "{name}: inside out");
        }
        assert_eq!(center.length() > 2e5, name == "far");
    }
}

#[test]
fn slivers_are_needles_all_around() {
    let scene = spd::generate("slivers", Some(2)).unwrap();
    let mut area = 0.0;
    for [a, b, c] in corners(&scene) {
        let twice = (b - a).cross(c - a);
        assert!(twice.z > 0.0 && b.distance(c) < 0.05 * a.distance(b), "{a} {b} {c}");
        area += twice.z / 2.0;
    }
    assert!((area - std::f64::consts::PI).abs() < 1e-2, "{area}");
    assert_eq!(scene.bounds(), Some((Vec3::new(-1.0, -1.0, 0.125), Vec3::new(1.0, 1.0, 0.125))));
}
