//! The rays that are measured: batches of them, a tile of the picture each.

use glam::Vec3;
use rt_kernels::{Exec, Hits, Ray, Rays, Stats};

use crate::exec::{camera, tile};
use crate::shade::Surface;
use crate::{Job, RenderError, World};

/// Rays of one kind, batch by batch.
#[derive(Clone, Debug)]
pub struct Batches {
    /// What they are, in a word.
    pub kind: &'static str,
    pub(super) batches: Vec<Rays>,
}

/// A picture's rays from the eye: neighbours have much in common.
///
/// # Errors
/// If the camera looks nowhere.
pub fn primary(world: &World, job: &Job) -> Result<Batches, RenderError> {
    let camera = camera(world, job)?;
    let (width, height) = job.size;
    let batches = tile::tiles(width, height)
        .into_iter()
        .map(|origin| tile::rays(&camera, &tile::pixels(origin, width, height)).collect())
        .collect();
    Ok(Batches { kind: "primary", batches })
}

/// What light does that falls on a matt surface: from wherever these rays hit one goes on, as likely
/// in a direction as its cosine to the normal. Neighbours have little in common. They are the same on
/// every machine.
pub fn diffuse(world: &World, rays: &Batches, exec: Exec) -> Batches {
    let mut random = Random(1);
    let mut hits = Hits::new();
    let mut bounce = |rays: &Rays| {
        world.accel.closest(exec, rays, &mut hits, &mut Stats::default());
        let hits = (0..rays.len()).filter_map(|i| Some((rays.get(i), hits.get(i)?)));
        hits.map(|(ray, hit)| {
            let surface = Surface::at(world, &ray, &hit);
            // A point of the ball that touches the surface there.
            let dir = surface.true_normal + random.on_sphere();
            Ray::new(surface.leave, dir.normalize_or(surface.true_normal))
        })
        .collect()
    };
    Batches { kind: "diffuse", batches: rays.batches.iter().map(&mut bounce).collect() }
}

/// SplitMix64 (Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    /// From −1 to 1.
    fn signed(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1 << 23) as f32 - 1.0
    }

    /// Any direction, of unit length.
    fn on_sphere(&mut self) -> Vec3 {
        loop {
            let point = Vec3::new(self.signed(), self.signed(), self.signed());
            if (0.01..=1.0).contains(&point.length_squared()) {
                return point.normalize();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the cosine to the normal the mean is 2/3 and that of the square 1/2, and nothing leans to
    /// a side.
    #[test]
    fn directions_are_distributed_by_the_cosine() {
        let mut random = Random(1);
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
