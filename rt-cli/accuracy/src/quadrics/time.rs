//! What a test of a curved surface costs.

use std::hint::black_box;

use glam::Vec3;
use rt_kernels::geom::{Cone, Curved, Sphere};
use rt_kernels::{Hits, Ray, Rays};

use rt_kernels::reference::random::Random;

use super::Kernel;
use crate::time::race;
use crate::{Subject, Time};

/// How many surfaces and how many rays: what fits into the first level of a cache.
const SURFACES: usize = 64;
const RAYS: usize = 64;

/// Times every subject on the calling thread, once a round for each in turn: 64 rays with like
/// directions and 64 spheres, or cones for what takes no spheres, of which a ray meets a few.
/// Nanoseconds for one test of one ray against one of them, stated as the kernel states it; the
/// rays' share of the setup of packets included.
pub(super) fn time(subjects: &[Subject<Kernel>], rounds: usize) -> Vec<Time> {
    let (spheres, cones, rays) = workload();
    let kept = |subject: &Subject<Kernel>| {
        let kept = subject.kernel.surfaces(&spheres).or_else(|| subject.kernel.surfaces(&cones));
        kept.expect("every kernel takes spheres or cones")
    };
    let surfaces: Vec<_> = subjects.iter().map(kept).collect();
    let mut hits = Hits::new();
    race(subjects.len(), rounds, RAYS * SURFACES, |i| {
        subjects[i].kernel.closest(subjects[i].way, &surfaces[i], black_box(&rays), &mut hits);
        black_box(&hits);
    })
}

/// Spheres scattered about the origin, cones, and rays from one point at them.
fn workload() -> (Vec<Curved>, Vec<Curved>, Rays) {
    let mut random = Random::new(64);
    let sphere = |random: &mut Random| Sphere {
        center: random.in_cube(),
        radius: 0.05 + 0.2 * random.unit() as f32,
    };
    let spheres: Vec<_> = (0..SURFACES).map(|_| sphere(&mut random)).collect();
    let eye = Vec3::new(3.0, 4.0, 12.0);
    let rays = (0..RAYS).map(|_| Ray::new(eye, random.in_cube() - eye)).collect();
    // About as large.
    let cone = |Sphere { center, radius }: &Sphere| {
        let axis = random.direction() * *radius;
        let (base_radius, apex_radius) = (*radius, 0.5 * radius);
        Cone { base: *center - axis, base_radius, apex: *center + axis, apex_radius }
    };
    let cones = spheres.iter().map(cone).map(Curved::Cone).collect();
    (spheres.into_iter().map(Curved::Sphere).collect(), cones, rays)
}
