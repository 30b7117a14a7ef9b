//! The rays that are measured: batches of them, a tile of the picture each.

use glam::Vec3;
use rt_kernels::{Exec, Hits, Ray, Rays, Stats};

use super::random::Random;
use crate::exec::{Tiles, camera};
use crate::shade::Surface;
use crate::{Job, RenderError, World};

/// Rays of one kind, batch by batch.
#[derive(Clone, Debug)]
pub struct Batches {
    /// What they are, in a word.
    pub kind: &'static str,
    /// Whether it matters only if they hit anything.
    pub(super) any: bool,
    pub(super) batches: Vec<Rays>,
}

impl Batches {
    /// The number of rays.
    pub fn len(&self) -> usize {
        self.batches.iter().map(Rays::len).sum()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A picture's rays from the eye: neighbours have much in common.
///
/// # Errors
/// If the camera looks nowhere.
pub fn primary(world: &World, job: &Job) -> Result<Batches, RenderError> {
    let camera = camera(world, job)?;
    let tiles = Tiles::of(job).all();
    let ray = |(x, y)| camera.ray(x as f32 + 0.5, y as f32 + 0.5);
    let batches = tiles.map(|pixels| pixels.into_iter().map(ray).collect()).collect();
    Ok(Batches { kind: "primary", any: false, batches })
}

/// What light does that falls on a matt surface: from wherever these rays hit one goes on, as likely
/// in a direction as its cosine to the normal. Neighbours have little in common. They are the same on
/// every machine.
pub fn diffuse(world: &World, rays: &Batches, exec: Exec) -> Batches {
    let mut random = Random::new(1);
    let mut hits = Hits::new();
    let mut bounce = |rays: &Rays| {
        world.accel.closest(exec, rays, &mut hits, &mut Stats::default());
        let hits = (0..rays.len()).filter_map(|i| Some((rays.get(i), hits.get(i)?)));
        hits.map(|(ray, hit)| {
            let surface = Surface::at(world, &ray, &hit);
            // A point of the ball that touches the surface there.
            let dir = surface.point.true_normal + random.on_sphere();
            Ray::new(surface.leave, dir.normalize_or(surface.point.true_normal))
        })
        .collect()
    };
    Batches { kind: "diffuse", any: false, batches: rays.batches.iter().map(&mut bounce).collect() }
}

/// From wherever these rays hit to a light, in the units of the scene: neighbours end in one point.
pub fn shadow(world: &World, rays: &Batches, light: Vec3, exec: Exec) -> Batches {
    let light = light * world.scale;
    let mut hits = Hits::new();
    let mut to_light = |rays: &Rays| {
        world.accel.closest(exec, rays, &mut hits, &mut Stats::default());
        let hits = (0..rays.len()).filter_map(|i| Some((rays.get(i), hits.get(i)?)));
        hits.map(|(ray, hit)| {
            let from = Surface::at(world, &ray, &hit).leave;
            Ray { tmax: 1.0, ..Ray::new(from, light - from) }
        })
        .collect()
    };
    Batches { kind: "shadow", any: true, batches: rays.batches.iter().map(&mut to_light).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the cosine to the normal the mean is 2/3 and that of the square 1/2, and nothing leans to
    /// a side.
    #[test]
    fn directions_are_distributed_by_the_cosine() {
        let mut random = Random::new(1);
        let n = 40_000;
        let (mut sum, mut squares) = (Vec3::ZERO, 0.0);
        for _ in 0..n {
            let dir = (Vec3::Z + random.on_sphere()).normalize_or(Vec3::Z);
            sum += dir;
            squares += dir.z * dir.z;
        }
        let mean = sum / n as f32;
        assert!((mean - Vec3::new(0.0, 0.0, 2.0 / 3.0)).length() < 0.01, "{mean}");
        assert!((squares / n as f32 - 0.5).abs() < 0.01, "{squares}");
    }
}
