//! Rays that surfaces send on never meet their own surface again, and never skip one that is near.
//!
//! What is looked at lets all light through and bends none of it: so every ray has to be sent on as often as
//! it meets a surface, and the picture is that of the background, to the last bit.

use glam::Vec3;
use rt_scene::{Cone, Scene, Sphere, Triangle};

use crate::support::{invisible, job, picture, view, world};

/// Sizes, and how far from the origin things are in units of their size.
const PLACES: [(f32, f32); 7] =
    [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1e-15, 0.0), (1e15, 0.0), (1.0, 1e3), (1e-3, 2e4)];

/// A scene of nothing but what is invisible, seen from the front.
fn scene(center: Vec3, size: f32) -> Scene {
    Scene { materials: vec![invisible()], view: view(center, 5.0 * size, 30.0), ..Scene::default() }
}

/// How many rays are sent on, of a picture that shows the background alone.
fn sent(scene: &Scene, depth: u32) -> u64 {
    let (film, report) = picture(&world(scene), &job(scene, (64, 64), depth));
    let clear = film.pixels().iter().filter(|&&pixel| pixel == Vec3::ONE).count();
    assert_eq!(clear, 64 * 64, "pixels that show the background");
    assert_eq!(report.reflection.rays + report.shadow.rays, 0);
    report.refraction.rays
}

/// How many primary rays meet something.
fn met(scene: &Scene) -> u64 {
    let mut scene = scene.clone();
    scene.materials[0].transmission = Vec3::ZERO;
    let (film, _) = picture(&world(&scene), &job(&scene, (64, 64), 0));
    film.pixels().iter().filter(|&&pixel| pixel != Vec3::ONE).count() as u64
}

fn add_sheet(scene: &mut Scene, center: Vec3, half: f32, tilt: f32) {
    let first = scene.mesh.positions.len() as u32;
    for [x, y] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
        scene.mesh.positions.push(center + Vec3::new(x, y, tilt * x) * half);
    }
    for position in [[0, 1, 2], [0, 2, 3]] {
        let position = position.map(|i| first + i);
        scene.mesh.triangles.push(Triangle { position, normal: None, uv: None, material: 0 });
    }
}

#[test]
fn a_ball_is_entered_and_left() {
    for (size, away) in PLACES {
        let center = Vec3::new(0.3, -0.7, 0.2) * (size * away);
        let mut scene = scene(center, size);
        scene.spheres.push(Sphere { center, radius: size, material: 0 });
        let met = met(&scene);
        assert!(met > 1000, "{met}");
        // One more than twice would be sent on if there were anything left to meet.
        assert_eq!(sent(&scene, 9), 2 * met, "size {size:e}, {away:e} away");
    }
}

#[test]
fn a_tube_is_entered_and_left() {
    for (size, away) in PLACES {
        let center = Vec3::new(0.3, -0.7, 0.2) * (size * away);
        let mut scene = scene(center, size);
        // Longer than the picture is high: all that enters it through the mantle leaves it there.
        let half = Vec3::new(0.0, 8.0, 0.0) * size;
        for (radius, apex_radius) in [(0.75, 0.75), (0.5, 0.25)] {
            let [base_radius, apex_radius] = [radius, apex_radius].map(|radius: f32| radius * size);
            let (base, apex) = (center - half, center + half);
            scene.cones = vec![Cone { base, base_radius, apex, apex_radius, material: 0 }];
            let met = met(&scene);
            assert!(met > 500, "{met}");
            assert_eq!(sent(&scene, 9), 2 * met, "size {size:e}, {away:e} away, {radius}");
        }
    }
}

#[test]
fn sheets_are_passed_one_by_one() {
    const SHEETS: u64 = 8;
    for (size, away) in PLACES {
        for tilt in [0.0, 0.4] {
            let center = Vec3::new(0.3, -0.7, 0.2) * (size * away);
            let mut scene = scene(center, size);
            // Rays start off a surface by 64 roundoffs of lengths and coordinates. Three times that is
            // beyond what one ray may skip.
            let reach = center.abs().max_element() + 12.0 * size;
            let gap = 3.0 * 64.0 / (1 << 24) as f32 * reach;
            for sheet in 0..SHEETS {
                // All of the picture is full of them.
                add_sheet(&mut scene, center - Vec3::Z * (gap * sheet as f32), 4.0 * size, tilt);
            }
            let sent = sent(&scene, 20);
            assert_eq!(sent, SHEETS * 64 * 64, "size {size:e}, {away:e} away, tilted {tilt}");
        }
    }
}
