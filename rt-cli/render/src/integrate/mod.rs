//! What is computed of the rays of a tile: one file an integrator.
//!
//! All rays of a kind go together: a tile's primary rays are one batch, their shadow rays to one
//! light the next part of another, their reflections the batch of the next round.

mod direct;
mod heat;
mod sample;
mod seen;
mod whitted;

use glam::Vec3;
use rt_kernels::{Hits, Rays};
use seen::Seen;

use crate::exec::{Tally, TileJob};

/// What is computed of a hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// Phong shading with shadows, reflection and refraction (Whitted 1980).
    #[default]
    Whitted,
    /// Diffuse colour times the cosine to the viewer.
    Eyelight,
    /// The normal as a colour: −1…1 as black to full.
    Normals,
    /// White at the nearest point of the scene's bounds, black at the farthest.
    Depth,
    /// What each ray from the eye costs, alone: from black over blue, green, yellow and red to white
    /// at 255 nodes and tests. The one picture that depends on the acceleration structure, which it
    /// shows.
    Heat,
}

impl Integrator {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Integrator::Whitted => "whitted",
            Integrator::Eyelight => "eyelight",
            Integrator::Normals => "normals",
            Integrator::Depth => "depth",
            Integrator::Heat => "heat",
        }
    }
}

/// What rays are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the eye.
    Primary,
    /// From a surface to a light.
    Shadow,
    /// From a mirror.
    Reflection,
    /// Through a surface.
    Refraction,
}

/// The memory of one thread, used again for every tile.
#[derive(Default)]
pub(crate) struct Scratch {
    rays: Rays,
    hits: Hits,
    seen: Seen,
    whitted: whitted::Scratch,
}

/// Computes the colours of a tile's pixels, in the order of [`TileJob::pixels`]. All pixels are done with
/// one sample before the next begins: so neighbours stay together.
pub(crate) fn integrate(
    job: &TileJob<'_>,
    scratch: &mut Scratch,
    colors: &mut Vec<Vec3>,
    tally: &mut Tally,
) {
    colors.clear();
    colors.resize(job.pixels.len(), Vec3::ZERO);
    let samples = job.job.samples.max(1);
    for sample in 0..samples {
        scratch.rays.clear();
        scratch.rays.extend(sample::rays(&job.camera, &job.pixels, sample, samples));
        match job.job.integrator {
            Integrator::Whitted => whitted::integrate(job, scratch, colors, tally),
            Integrator::Eyelight => {
                direct::integrate(job, scratch, colors, tally, direct::eyelight);
            }
            Integrator::Normals => direct::integrate(job, scratch, colors, tally, direct::normals),
            Integrator::Depth => direct::integrate(job, scratch, colors, tally, direct::depth),
            Integrator::Heat => heat::integrate(job, scratch, colors, tally),
        }
    }
    if samples > 1 {
        colors.iter_mut().for_each(|color| *color /= samples as f32);
    }
}
