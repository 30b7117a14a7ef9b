//! Recursive ray tracing, without recursion: round after round, all rays of a tile that bounced
//! equally often go together. Source: Whitted 1980.

use glam::Vec3;
use rt_kernels::{Ray, Rays};

use super::RayKind;
use crate::exec::{Tally, TileJob};
use crate::shade::{Surface, phong};

/// A ray's pixel, and what it adds to it.
#[derive(Clone, Copy)]
struct Path {
    pixel: usize,
    weight: Vec3,
}

/// A surface that a path met.
struct Met {
    path: Path,
    dir: Vec3,
    surface: Surface,
}

/// Memory for one tile.
#[derive(Default)]
pub(super) struct Scratch {
    paths: Vec<Path>,
    met: Vec<Met>,
    shadows: Rays,
    /// For each shadow ray, its pixel and what the light adds if nothing is in the way.
    lit: Vec<Path>,
    occluded: Vec<bool>,
}

/// What changes a pixel by less than this is not followed: far less than half a code of 8 bits.
const LEAST_WEIGHT: f32 = 1.0 / 4096.0;

pub(super) fn integrate(
    job: &TileJob<'_>,
    scratch: &mut super::Scratch,
    colors: &mut [Vec3],
    tally: &mut Tally,
) {
    let super::Scratch { rays, hits, whitted: scratch } = scratch;
    let start = |pixel| Path { pixel, weight: Vec3::ONE };
    scratch.paths.clear();
    scratch.paths.extend((0..rays.len()).map(start));

    let mut kind = RayKind::Primary;
    for bounce in 0..=job.job.depth {
        tally.closest(job, kind, rays, hits);
        tally.shading(|| {
            scratch.met.clear();
            for (i, &path) in scratch.paths.iter().enumerate() {
                match hits.get(i) {
                    Some(hit) => {
                        let ray = rays.get(i);
                        let surface = Surface::at(job.world, &ray, &hit);
                        let material = &job.world.scene.materials[surface.material as usize];
                        colors[path.pixel] += path.weight * material.emission;
                        scratch.met.push(Met { path, dir: ray.dir, surface });
                    }
                    None => colors[path.pixel] += path.weight * job.job.background,
                }
            }
        });
        scratch.light(job, colors, tally);
        if bounce == job.job.depth {
            break;
        }
        tally.shading(|| scratch.reflect(job, rays));
        if rays.is_empty() {
            break;
        }
        kind = RayKind::Reflection;
    }
}

/// The direction of a reflected ray.
fn mirror(dir: Vec3, normal: Vec3) -> Vec3 {
    dir - normal * (2.0 * dir.dot(normal))
}

impl Scratch {
    /// Adds the light of every light to the surfaces met, where no shadow falls.
    fn light(&mut self, job: &TileJob<'_>, colors: &mut [Vec3], tally: &mut Tally) {
        tally.shading(|| {
            self.shadows.clear();
            self.lit.clear();
            for light in job.lights {
                for Met { path, dir, surface } in &self.met {
                    let to_light = light.position - surface.leave;
                    let distance = to_light.length();
                    let to_light = to_light * (1.0 / distance);
                    // Also false for the NaN of a light on the very spot.
                    let faces_light = surface.true_normal.dot(to_light) > 0.0;
                    if !faces_light {
                        continue;
                    }
                    let material = &job.world.scene.materials[surface.material as usize];
                    let sent = phong(material, surface.normal, to_light, *dir);
                    let weight = path.weight * light.color * sent;
                    if weight == Vec3::ZERO {
                        continue;
                    }
                    if light.casts_shadows {
                        let ray = Ray::new(surface.leave, to_light);
                        self.shadows.push(Ray { tmax: distance, ..ray });
                        self.lit.push(Path { pixel: path.pixel, weight });
                    } else {
                        colors[path.pixel] += weight;
                    }
                }
            }
        });
        tally.any(job, &self.shadows, &mut self.occluded);
        tally.shading(|| {
            for (lit, _) in self.lit.iter().zip(&self.occluded).filter(|(_, occluded)| !**occluded)
            {
                colors[lit.pixel] += lit.weight;
            }
        });
    }

    /// Makes the rays and paths of the next round: those that mirrors send on.
    fn reflect(&mut self, job: &TileJob<'_>, rays: &mut Rays) {
        rays.clear();
        self.paths.clear();
        for Met { path, dir, surface } in &self.met {
            let material = &job.world.scene.materials[surface.material as usize];
            let weight = path.weight * material.mirror;
            if weight.max_element() < LEAST_WEIGHT {
                continue;
            }
            let mirrored = mirror(*dir, surface.normal);
            // A bent normal may send the ray into the surface, where there is nothing to see.
            let leaves = mirrored.dot(surface.true_normal) > 0.0;
            let mirrored = if leaves { mirrored } else { mirror(*dir, surface.true_normal) };
            rays.push(Ray::new(surface.leave, mirrored));
            self.paths.push(Path { pixel: path.pixel, weight });
        }
    }
}
