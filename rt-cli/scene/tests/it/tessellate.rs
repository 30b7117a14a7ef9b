//! Triangles for what is curved.

use std::collections::HashMap;

use glam::Vec3;
use rt_scene::{Cone, Mesh, SPD_RESOLUTION, Scene, Sphere, Triangle, spd, tessellate};

use crate::support::double_area;

/// As the databases' documentation counts them, with triangles for quadrilaterals.
#[test]
fn the_databases_have_so_many_triangles() {
    for (name, size, triangles) in [
        ("balls", 4, 7381 * 192 + 2),
        ("rings", 7, 4200 * (192 + 32) + 2),
        ("tree", 11, 4095 * (192 + 32) + 2),
        ("tree", 12, 8191 * (192 + 32) + 2),
    ] {
        let scene = spd::generate(name, Some(size)).unwrap();
        let stated = scene.facts.stated.clone();
        let scene = tessellate(scene, SPD_RESOLUTION).unwrap();
        assert_eq!(scene.mesh.triangles.len(), triangles, "{}", scene.name);
        assert_eq!((scene.spheres.len(), scene.cones.len()), (0, 0));
        assert_eq!(scene.facts.stated, stated, "what the scene states stays");
        assert!(scene.facts.skipped.is_empty());
    }
}

/// A scene with one more triangle, which must stay first.
fn scene(spheres: Vec<Sphere>, cones: Vec<Cone>) -> Scene {
    let mesh = Mesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        normals: vec![Vec3::Z],
        uvs: Vec::new(),
        triangles: vec![Triangle {
            position: [0, 1, 2],
            normal: Some([0; 3]),
            uv: None,
            material: 2,
        }],
    };
    Scene { mesh, spheres, cones, ..Scene::default() }
}

/// What was made: all but the first triangle.
fn made(spheres: Vec<Sphere>, cones: Vec<Cone>, resolution: u32) -> Scene {
    let before = scene(spheres, cones);
    let first = before.mesh.triangles[0];
    let mut scene = tessellate(before, resolution).unwrap();
    assert_eq!(scene.mesh.triangles.remove(0), first);
    scene
}

/// How often each edge is run along in each direction.
fn edges(triangles: &[Triangle]) -> HashMap<[u32; 2], usize> {
    let mut edges = HashMap::new();
    for Triangle { position: [a, b, c], .. } in triangles {
        for edge in [[*a, *b], [*b, *c], [*c, *a]] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    edges
}

fn corners(scene: &Scene, triangle: &Triangle) -> [(Vec3, Vec3); 3] {
    let normals = triangle.normal.unwrap();
    std::array::from_fn(|corner| {
        let position = scene.mesh.positions[triangle.position[corner] as usize];
        (position, scene.mesh.normals[normals[corner] as usize])
    })
}

/// Its front is where its corners' normals point.
fn faces_out(corners: [(Vec3, Vec3); 3]) -> bool {
    let [(a, n), (b, m), (c, o)] = corners;
    (b - a).cross(c - a).dot(n + m + o) > 0.0
}

#[test]
fn a_sphere_is_closed_and_round() {
    let center = Vec3::new(1.0, -20.0, 3.0);
    for resolution in [1, 2, 3, 4, 9] {
        let sphere = Sphere { center, radius: 2.5, material: 7 };
        let scene = made(vec![sphere], vec![], resolution);
        let triangles = &scene.mesh.triangles;
        assert_eq!(triangles.len(), 12 * resolution.pow(2) as usize);
        // Euler: the vertices of a closed surface without handles.
        assert_eq!(scene.mesh.positions.len() - 3, triangles.len() / 2 + 2);
        let edges = edges(triangles);
        for (&[from, to], &count) in &edges {
            assert_eq!((count, edges.get(&[to, from])), (1, Some(&1)), "{resolution}");
        }
        for triangle in triangles {
            let corners = corners(&scene, triangle);
            assert!(faces_out(corners) && triangle.material == 7);
            for (position, normal) in corners {
                assert!(position.abs_diff_eq(center + normal * 2.5, 2e-6), "{position}");
                assert!((normal.length() - 1.0).abs() < 1e-6);
            }
        }
    }
}

/// All spheres share their normals.
#[test]
fn normals_are_kept_once() {
    let sphere = Sphere { center: Vec3::ZERO, radius: 1.0, material: 0 };
    let scene = made(vec![sphere; 5], vec![], 4);
    assert_eq!(scene.mesh.normals.len(), 1 + 98);
    assert_eq!(scene.mesh.positions.len(), 3 + 5 * 98);
}

#[test]
fn a_cone_has_two_rims_and_no_gap() {
    let (base, apex) = (Vec3::new(3.0, 2.0, 1.0), Vec3::new(3.0, -1.0, 5.0));
    for (base_radius, apex_radius) in [(2.0, 2.0), (2.0, 0.5), (0.5, 2.0)] {
        for (base, apex) in [(base, apex), (Vec3::ZERO, Vec3::NEG_Z), (Vec3::Y, Vec3::ZERO)] {
            let cone = Cone { base, base_radius, apex, apex_radius, material: 1 };
            let scene = made(vec![], vec![cone], 4);
            let triangles = &scene.mesh.triangles;
            assert_eq!(triangles.len(), 32);
            let edges = edges(triangles);
            assert!(edges.values().all(|&count| count == 1));
            let rims = edges.keys().filter(|&&[from, to]| !edges.contains_key(&[to, from]));
            assert_eq!(rims.count(), 2 * 16);

            let axis = (apex - base).normalize();
            for corners in triangles.iter().map(|triangle| corners(&scene, triangle)) {
                assert!(faces_out(corners));
                for (position, normal) in corners {
                    // At right angles to the axis from one of the ends, as far as it is wide.
                    let ends = [(base, base_radius), (apex, apex_radius)];
                    let near = |&(end, _): &(Vec3, f32)| (position - end).dot(axis).abs();
                    let (end, radius) =
                        ends.into_iter().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap();
                    let out = position - end;
                    assert!(out.dot(axis).abs() < 1e-5 && (out.length() - radius).abs() < 1e-5);
                    let along =
                        (apex + out / radius * apex_radius) - (base + out / radius * base_radius);
                    assert!(normal.dot(along).abs() < 1e-5, "a normal is across the surface");
                    assert!((normal.length() - 1.0).abs() < 1e-6);
                }
            }
        }
    }
}

#[test]
fn a_pointed_cone_has_no_flat_triangles() {
    for (base_radius, apex_radius) in [(1.0, 0.0), (0.0, 1.0)] {
        let cone = Cone { base: Vec3::ZERO, base_radius, apex: Vec3::X, apex_radius, material: 0 };
        let scene = made(vec![], vec![cone], 4);
        assert_eq!(scene.mesh.triangles.len(), 16);
        for triangle in &scene.mesh.triangles {
            assert!(double_area(&scene.mesh, triangle) > 0.1);
            assert!(faces_out(corners(&scene, triangle)));
        }
        let edges = edges(&scene.mesh.triangles);
        let rim = edges.keys().filter(|&&[from, to]| !edges.contains_key(&[to, from]));
        assert_eq!(rim.count(), 16);
    }
}
