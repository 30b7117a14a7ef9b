//! Several rays through a pixel, and surfaces with one side.

use glam::Vec3;
use rt_render::{AccelKind, Exec, Integrator, Job, Level, PacketSize, World};
use rt_scene::{Light, Material, Scene, Sphere, Triangle};

use crate::support::{job, picture, view, world};

/// The upper half of the view is white, but for a slope of one in eight.
fn edge() -> Scene {
    let mut scene = Scene {
        materials: vec![Material { emission: Vec3::ONE, ..Material::default() }],
        view: view(Vec3::ZERO, 10.0, 20.0),
        background: Some(Vec3::ZERO),
        ..Scene::default()
    };
    let far = 1000.0;
    scene.mesh.positions = vec![
        Vec3::new(-far, -far / 8.0, 0.0),
        Vec3::new(far, far / 8.0, 0.0),
        Vec3::new(0.0, far, 0.0),
    ];
    let position = [0, 1, 2];
    scene.mesh.triangles = vec![Triangle { position, normal: None, uv: None, material: 0 }];
    scene
}

/// How far pixels are from what an area says: from the share of each pixel that is above the edge.
fn error(samples: u32) -> f32 {
    const SIDE: u32 = 32;
    /// As fine as to be the truth.
    const FINE: u32 = 64;
    let scene = edge();
    let job = Job { integrator: Integrator::Eyelight, samples, ..job(&scene, (SIDE, SIDE), 0) };
    let (film, _) = picture(&world(&scene), &job);
    let share = |x: u32, y: u32| {
        let places = (0..FINE * FINE).map(|i| (i % FINE, i / FINE));
        let place = |pixel: u32, part: u32| {
            (pixel as f32 + (part as f32 + 0.5) / FINE as f32) - SIDE as f32 / 2.0
        };
        let above = places.filter(|&(i, k)| -place(y, k) > place(x, i) / 8.0).count();
        above as f32 / (FINE * FINE) as f32
    };
    let white = film.pixels().iter().fold(0.0_f32, |white, pixel| white.max(pixel.x));
    let off = film.pixels().iter().enumerate().map(|(i, pixel)| {
        let (x, y) = (i as u32 % SIDE, i as u32 / SIDE);
        (pixel.x / white - share(x, y)).abs()
    });
    off.fold(0.0, f32::max)
}

#[test]
fn more_samples_are_nearer_to_the_area() {
    let errors = [1, 16, 256].map(error);
    assert!(errors[0] > 0.3, "{errors:?}");
    assert!(errors[1] < 0.15, "{errors:?}");
    assert!(errors[2] < 0.03, "{errors:?}");
}

#[test]
fn samples_are_the_same_however_they_are_computed() {
    let scene = rt_scene::open("spd:mount:2").expect("a scene that is computed");
    let scene =
        Scene { lights: vec![Light { position: Vec3::ONE * 5.0, color: Vec3::ONE }], ..scene };
    let world = world(&scene);
    let job = Job { samples: 5, ..job(&scene, (50, 40), 4) };
    let (want, report) = picture(&world, &job);
    assert_eq!(report.primary.rays, 5 * 50 * 40);
    let (one, _) = picture(&world, &Job { samples: 1, ..job.clone() });
    assert!(one != want, "it makes a difference");
    for threads in [1, 3] {
        for level in Level::available() {
            for packet in [PacketSize::Native, PacketSize::Single] {
                let exec = Exec { level, packet };
                let (got, _) = picture(&world, &Job { exec, threads, ..job.clone() });
                assert!(got == want, "{exec:?}, {threads} threads");
            }
        }
    }
    let brute = World::build(scene, AccelKind::Brute, 1).expect("a scene that can be rendered");
    assert!(picture(&brute, &job).0 == want, "without a hierarchy");
}

/// A lit ball within a closed room that is seen from outside.
fn room(one_sided: bool) -> Scene {
    let wall = Material { one_sided, ..Material::default() };
    let ball = Material { emission: Vec3::ONE, diffuse: Vec3::ZERO, ..Material::default() };
    let mut scene = Scene {
        materials: vec![wall, ball],
        spheres: vec![Sphere { center: Vec3::ZERO, radius: 0.5, material: 1 }],
        lights: vec![Light { position: Vec3::new(0.0, 0.9, 0.0), color: Vec3::ONE }],
        view: view(Vec3::ZERO, 8.0, 40.0),
        background: Some(Vec3::ZERO),
        ..Scene::default()
    };
    // Two nested cubes whose faces look inwards.
    for half in [1.0, 1.5] {
        let first = scene.mesh.positions.len() as u32;
        for i in 0..8 {
            let sign = |bit: u32| if i >> bit & 1 == 1 { half } else { -half };
            scene.mesh.positions.push(Vec3::new(sign(0), sign(1), sign(2)));
        }
        for [a, b, c, d] in
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]
        {
            let corners: [[u32; 3]; 2] = [[a, b, c], [a, c, d]];
            for position in corners {
                let inward = {
                    let [p, q, r] = position.map(|i| scene.mesh.positions[(first + i) as usize]);
                    (q - p).cross(r - p).dot(p) < 0.0
                };
                let [p, q, r] = position;
                let position = if inward { [p, q, r] } else { [p, r, q] }.map(|i| first + i);
                let triangle = Triangle { position, normal: None, uv: None, material: 0 };
                scene.mesh.triangles.push(triangle);
            }
        }
    }
    scene
}

#[test]
fn one_sided_walls_are_seen_from_inside_alone() {
    const MIDDLE: usize = 20 * 40 + 20;
    for integrator in [Integrator::Whitted, Integrator::Eyelight] {
        let pixels = |one_sided| {
            let scene = room(one_sided);
            let job = Job { integrator, ..job(&scene, (40, 40), 2) };
            picture(&world(&scene), &job)
        };
        let (closed, _) = pixels(false);
        let (open, report) = pixels(true);
        assert!(closed.pixels()[MIDDLE].x < 0.99, "the wall is in front");
        assert_eq!(open.pixels()[MIDDLE], Vec3::ONE, "the ball is seen");
        // Beside the ball the wall behind it is seen, from inside.
        let beside = open.pixels()[20 * 40 + 14];
        assert!(beside.x > 0.0 && beside.x < 0.99, "{beside}");
        assert!(report.primary.rays > 40 * 40, "rays that went on are counted");
    }
}

#[test]
fn depth_is_that_of_what_is_seen() {
    let scene = room(true);
    let job = Job { integrator: Integrator::Depth, ..job(&scene, (41, 41), 0) };
    let (film, _) = picture(&world(&scene), &job);
    // From 6.5 to the farthest corner, sqrt(9.5² + 2 · 1.5²), and the ball is 7.5 away.
    let (near, far) = (6.5, (9.5_f32 * 9.5 + 4.5).sqrt());
    let want = (far - 7.5) / (far - near);
    let got = film.pixels()[20 * 41 + 20].x;
    assert!((got - want).abs() < 1e-3, "{got}, not {want}");
}

#[test]
fn glass_has_two_sides_whatever_it_says() {
    let mut scene = room(true);
    scene.materials[0].transmission = Vec3::splat(0.5);
    let (film, _) = picture(&world(&scene), &job(&scene, (40, 40), 9));
    let middle = film.pixels()[20 * 40 + 20];
    assert!(middle.x < 0.99 && middle.x > 0.24, "two panes of glass: {middle}");
}
