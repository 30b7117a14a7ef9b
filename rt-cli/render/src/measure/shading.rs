//! What shading costs (Wald, Slusallek, Benthin and Wagner 2001, Sections 5 and 6.2).

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{Vec2, Vec3};
use rt_kernels::Exec;
use rt_scene::{ColorMap, Light, Material, Scene, Texture};

use super::terrain;
use crate::exec::PointLight;
use crate::shade::{self, Finish, Lit, Point, Points, Surface};
use crate::{Film, Job, RenderError, Report, Silent, World, render};

/// The time that Phong's model takes for a point and a light, each way in turn, also
/// [relaxed](Job::relaxed): the least of all rounds. The points are of many materials.
///
/// # Panics
/// If two ways that are not relaxed differ in a bit.
pub fn phong(ways: &[(Exec, bool)], rounds: usize) -> Vec<Duration> {
    /// As many as a tile has.
    const POINTS: usize = 1024;
    const REPEAT: u32 = 20;
    let light = light();
    let mut points = Points::default();
    for i in 0..POINTS {
        let (surface, finish) = point(i);
        points.push(&surface, &finish, Vec3::ONE);
    }
    points.pad();
    let mut lit = Lit::default();
    let mut first = None;
    let mut least = vec![Duration::MAX; ways.len()];
    for round in 0..=rounds {
        for (&(exec, relaxed), least) in ways.iter().zip(&mut least) {
            let start = Instant::now();
            for _ in 0..REPEAT {
                shade::light(exec, relaxed, &points, &light, &mut lit);
            }
            if round > 0 {
                *least = start.elapsed().min(*least);
                continue;
            }
            if relaxed {
                continue;
            }
            let bits: Vec<_> =
                (0..POINTS).map(|i| lit.added(i).to_array().map(f32::to_bits)).collect();
            let same = first.get_or_insert_with(|| bits.clone()) == &bits;
            assert!(same, "one answer: {exec:?}");
        }
    }
    least.into_iter().map(|time| time / (REPEAT * POINTS as u32)).collect()
}

fn light() -> PointLight {
    PointLight {
        position: Vec3::new(3.0, 5.0, 2.0),
        color: Vec3::new(0.5, 0.6, 0.7),
        casts_shadows: true,
    }
}

/// A point of a hilly plane that is looked at from above.
fn point(i: usize) -> (Surface, Finish) {
    let at = |factor: usize| (i * factor % 101) as f32 / 50.0 - 1.0;
    let normal = Vec3::new(at(7) * 0.4, 1.0, at(13) * 0.4).normalize();
    let position = Vec3::new(at(3), 0.0, at(5));
    let point = Point {
        position,
        dir: (position - Vec3::new(0.0, 2.0, 3.0)).normalize(),
        normal,
        true_normal: Vec3::Y,
        uv: Vec2::ZERO,
        front: true,
        material: 0,
    };
    let finish = Finish {
        normal,
        specular: Vec3::splat(0.5),
        shininess: 1.0 + (i % 40) as f32,
        ..Finish::default()
    };
    (Surface { point, leave: position, enter: position }, finish)
}

/// About that many triangles of hills, matt and lit, with a picture of 1024×1024 pixels on them, so many
/// times along each side.
pub fn textured_terrain(triangles: usize, repeats: u32) -> Scene {
    /// Pixels along a side.
    const SIDE: u32 = 1024;
    let mut scene = terrain(triangles);
    let pixels = (0..SIDE * SIDE).map(|i| {
        let (x, y) = (i % SIDE, i / SIDE);
        let tile = 40 * (((x / 16) ^ (y / 16)) & 1) as u8;
        [150 + tile, 120 + (x % 64) as u8, 80 + (y % 64) as u8]
    });
    scene.textures = vec![Arc::new(Texture::new(SIDE, pixels.collect()))];
    // The hills go from −1 to 1.
    let scale = Vec2::splat(repeats as f32 / 2.0);
    let map = ColorMap { texture: 0, scale, offset: Vec2::ZERO };
    scene.materials = vec![Material { diffuse_map: Some(map), ..Material::default() }];
    scene.mesh.uvs = scene.mesh.positions.iter().map(|at| Vec2::new(at.x, at.z)).collect();
    for triangle in &mut scene.mesh.triangles {
        triangle.uv = Some(triangle.position);
    }
    scene.lights = vec![Light { position: Vec3::new(2.0, 4.0, 1.0), color: Vec3::ONE }];
    scene
}

/// Renders each picture once a round in turn, on the job's own threads: the report of the fastest.
///
/// # Errors
/// As [`render`].
pub fn pictures(jobs: &[(&World, Job)], rounds: usize) -> Result<Vec<(Film, Report)>, RenderError> {
    let mut best: Vec<Option<(Film, Report)>> = jobs.iter().map(|_| None).collect();
    for _ in 0..rounds.max(1) {
        for ((world, job), best) in jobs.iter().zip(&mut best) {
            let made = render(world, job, &Silent)?;
            if best.as_ref().is_none_or(|(_, report)| made.1.total < report.total) {
                *best = Some(made);
            }
        }
    }
    Ok(best.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use simd4::Level;

    use super::*;

    /// Of all kinds of surfaces, as far as it is promised.
    #[test]
    fn relaxed_light_is_almost_the_same() {
        const POINTS: usize = 1000;
        let light = light();
        let mut differ = 0;
        for shininess in [0.0, 0.5, 1.0, 7.0, 40.0, 300.0, 1e4] {
            let mut points = Points::default();
            for i in 0..POINTS {
                let (surface, finish) = point(i);
                points.push(&surface, &Finish { shininess, ..finish }, Vec3::ONE);
            }
            points.pad();
            let mut lit = [Lit::default(), Lit::default()];
            for level in Level::available() {
                for (lit, relaxed) in lit.iter_mut().zip([false, true]) {
                    shade::light(Exec::at(level), relaxed, &points, &light, lit);
                }
                let [exact, relaxed] = &lit;
                let all = Finish::default().diffuse + Vec3::splat(0.5);
                let most = all * light.color * ((shininess + 4.0) / (1 << 21) as f32);
                let mut shining = 0;
                for i in 0..POINTS {
                    let wrong = (exact.added(i) - relaxed.added(i)).abs();
                    assert!(wrong.cmple(most).all(), "{level}, {shininess}: {wrong} over {most}");
                    let far = (exact.distance(i) / relaxed.distance(i) - 1.0).abs();
                    assert!(far < 1e-6, "{level}: {far}");
                    shining += usize::from(exact.added(i).max_element() > 0.1);
                    differ += usize::from(wrong != Vec3::ZERO);
                }
                assert!(shining > 200, "{level}, {shininess}: {shining} points are lit");
            }
        }
        assert!(differ > POINTS, "estimates are used");
    }
}
