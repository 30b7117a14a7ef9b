//! What a test costs.

use std::hint::black_box;

use rt_kernels::geom::Triangle;
use rt_kernels::reference::random::Random;
use rt_kernels::{Hits, Ray, Rays};

use super::Kernel;
use crate::time::race;
use crate::{Subject, Time};

/// How many triangles and how many rays: what fits into the first level of a cache.
const TRIANGLES: usize = 64;
const RAYS: usize = 64;

/// Rays with like directions; 64 of them, and 64 triangles, of which a ray meets a few.
pub(super) fn time(subjects: &[Subject<Kernel>], rounds: usize) -> Vec<Time> {
    let (triangles, rays) = workload();
    let records: Vec<_> =
        subjects.iter().map(|subject| subject.kernel.triangles(&triangles)).collect();
    let mut hits = Hits::new();
    race(subjects.len(), rounds, RAYS * TRIANGLES, |i| {
        let (subject, records) = (&subjects[i], &records[i]);
        subject.kernel.closest(subject.way, records, black_box(&rays), &mut hits);
        black_box(&hits);
    })
}

/// Triangles scattered about the origin, and rays from one point at them.
fn workload() -> (Vec<Triangle>, Rays) {
    let mut random = Random::new(64);
    let triangles = (0..TRIANGLES).map(|_| {
        let center = random.in_cube();
        Triangle { corners: [(); 3].map(|()| center + random.in_cube() * 0.5) }
    });
    let triangles = triangles.collect();
    let eye = glam::Vec3::new(3.0, 4.0, 12.0);
    let rays = (0..RAYS).map(|_| Ray::new(eye, random.in_cube() - eye)).collect();
    (triangles, rays)
}
