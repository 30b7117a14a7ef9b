//! Recursive ray tracing, without recursion: round after round, all rays of a tile that bounced
//! equally often go together, reflected ones first. Source: Whitted 1980.

use glam::Vec3;
use rt_kernels::{Ray, Rays};

use super::RayKind;
use super::seen::Seen;
use crate::exec::{PointLight, Tally, TileJob};
use crate::shade::{self, Finish, Lit, Points, Surface, bounce};

/// A ray's pixel, and what it adds to it.
#[derive(Clone, Copy)]
struct Path {
    pixel: usize,
    weight: Vec3,
}

/// A surface that a path met.
struct Met {
    path: Path,
    surface: Surface,
    finish: Finish,
}

/// Rays of one kind, and what each is for.
#[derive(Default)]
struct Batch {
    rays: Rays,
    paths: Vec<Path>,
}

impl Batch {
    fn clear(&mut self) {
        self.rays.clear();
        self.paths.clear();
    }
}

/// Memory for one tile.
#[derive(Default)]
pub(super) struct Scratch {
    /// Reflected and refracted rays.
    batches: [Batch; 2],
    met: Vec<Met>,
    points: Points,
    lit: Lit,
    shadows: Rays,
    /// For each shadow ray, its pixel and what the light adds if nothing is in the way.
    waiting: Vec<Path>,
    occluded: Vec<bool>,
}

/// What changes a pixel by less than this is not followed: far less than half a code of 8 bits.
const LEAST_WEIGHT: f32 = 1.0 / 4096.0;

/// About the most paths that are followed at once.
const MAX_PATHS: usize = 1 << 20;

/// The most paths that a pixel can have at once. Of a surface's weights none adds up to more than 1,
/// in each of three channels.
const MAX_PATHS_OF_PIXEL: usize = 3 * (1.0 / LEAST_WEIGHT) as usize;

pub(super) fn integrate(
    job: &TileJob<'_>,
    scratch: &mut super::Scratch,
    colors: &mut [Vec3],
    tally: &mut Tally,
) {
    let super::Scratch { rays, seen, whitted: scratch, .. } = scratch;
    // A pixel's sum does not depend on what other pixels go with it.
    let paths = MAX_PATHS_OF_PIXEL.min(1 << job.job.depth.min(16));
    let together = MAX_PATHS / paths;
    if rays.len() <= together {
        return scratch.pixels(job, rays, 0, seen, colors, tally);
    }
    let mut some = Rays::new();
    for first in (0..rays.len()).step_by(together) {
        some.clear();
        some.extend((first..rays.len().min(first + together)).map(|i| rays.get(i)));
        scratch.pixels(job, &some, first, seen, colors, tally);
    }
}

impl Scratch {
    /// Computes the colours of the pixels from `first` on, one for each primary ray.
    fn pixels(
        &mut self,
        job: &TileJob<'_>,
        rays: &Rays,
        first: usize,
        seen: &mut Seen,
        colors: &mut [Vec3],
        tally: &mut Tally,
    ) {
        self.met.clear();
        seen.find(job, RayKind::Primary, rays, tally);
        let start = |i| Path { pixel: first + i, weight: Vec3::ONE };
        tally.shading(|| meet(&mut self.met, job, rays, seen, start, colors));
        for bounces in 0.. {
            self.light(job, colors, tally);
            if bounces == job.job.depth {
                break;
            }
            tally.shading(|| self.send());
            self.met.clear();
            for (batch, kind) in self.batches.iter().zip([RayKind::Reflection, RayKind::Refraction])
            {
                if !batch.rays.is_empty() {
                    seen.find(job, kind, &batch.rays, tally);
                    let path = |i: usize| batch.paths[i];
                    tally.shading(|| meet(&mut self.met, job, &batch.rays, seen, path, colors));
                }
            }
            if self.met.is_empty() {
                break;
            }
        }
    }

    /// Adds the light of every light to the surfaces met, where no shadow falls.
    fn light(&mut self, job: &TileJob<'_>, colors: &mut [Vec3], tally: &mut Tally) {
        tally.shading(|| {
            self.points.clear();
            for Met { path, surface, finish } in &self.met {
                self.points.push(surface, finish, path.weight);
            }
            self.points.pad();
            self.shadows.clear();
            self.waiting.clear();
            for light in job.lights {
                self.lit_by(job, light, colors);
            }
        });
        tally.any(job, &self.shadows, &mut self.occluded);
        tally.shading(|| {
            for (waiting, occluded) in self.waiting.iter().zip(&self.occluded) {
                if !occluded {
                    colors[waiting.pixel] += waiting.weight;
                }
            }
        });
    }

    /// Adds what one light adds, or sends shadow rays to it.
    fn lit_by(&mut self, job: &TileJob<'_>, light: &PointLight, colors: &mut [Vec3]) {
        let Scratch { met, points, lit, .. } = self;
        shade::light(job.job.exec, job.job.relaxed, points, light, lit);
        for (i, Met { path, surface, finish }) in met.iter().enumerate() {
            let to_light = lit.to_light(i);
            let mut weight = lit.added(i);
            if finish.own_light {
                let point = &surface.point;
                let faces = point.true_normal.dot(to_light) > 0.0;
                let sent = || job.world.shader(point).light(point, finish, to_light);
                weight = if faces { path.weight * light.color * sent() } else { Vec3::ZERO };
            }
            if weight == Vec3::ZERO {
                continue;
            }
            if light.casts_shadows {
                // From the surface, although rays from the light would share their origin: only here
                // is the start exact, and no surface darkens itself however far the light is.
                let ray = Ray::new(surface.leave, to_light);
                self.shadows.push(Ray { tmax: lit.distance(i), ..ray });
                self.waiting.push(Path { pixel: path.pixel, weight });
            } else {
                colors[path.pixel] += weight;
            }
        }
    }

    /// Makes the rays of the next round: those that surfaces send on.
    fn send(&mut self) {
        self.batches.iter_mut().for_each(Batch::clear);
        for Met { path, surface, finish } in &self.met {
            if finish.mirror == Vec3::ZERO && finish.transmission == Vec3::ZERO {
                continue;
            }
            let sent = bounce(surface, finish, surface.point.dir);
            for (batch, sent) in self.batches.iter_mut().zip(sent) {
                let weight = path.weight * sent.weight;
                if weight.max_element() >= LEAST_WEIGHT {
                    batch.rays.push(Ray::new(sent.origin, sent.dir));
                    batch.paths.push(Path { pixel: path.pixel, weight });
                }
            }
        }
    }
}

/// Collects the surfaces that rays met; what gives off light and what is behind all is added at once.
fn meet(
    met: &mut Vec<Met>,
    job: &TileJob<'_>,
    rays: &Rays,
    seen: &Seen,
    path: impl Fn(usize) -> Path,
    colors: &mut [Vec3],
) {
    for i in 0..rays.len() {
        let path = path(i);
        match seen.get(i) {
            Some(hit) => {
                let surface = Surface::at(job.world, &rays.get(i), &hit);
                let finish = job.world.finish(&surface.point);
                colors[path.pixel] += path.weight * finish.emission;
                met.push(Met { path, surface, finish });
            }
            None => colors[path.pixel] += path.weight * job.job.background,
        }
    }
}
