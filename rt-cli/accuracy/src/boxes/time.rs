//! What a slab test costs.

use std::hint::black_box;

use glam::Vec3;
use rt_kernels::geom::Aabb;
use rt_kernels::slab::{BoxSet, Crossings};
use rt_kernels::{Ray, Rays};

use rt_kernels::reference::random::Random;

use super::Kernel;
use crate::time::race;
use crate::{Subject, Time};

/// How many boxes and how many rays: what fits into the first level of a cache.
const BOXES: usize = 64;
const RAYS: usize = 64;

/// How alike the rays are that share a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Likeness {
    /// From one eye, in directions of the same signs.
    Alike,
    /// From anywhere to anywhere.
    Unlike,
}

/// Times every subject on the calling thread, once a round for each in turn: 64 rays and 64 boxes, of
/// which a ray meets a few. Nanoseconds for one test of one ray against one box, the rays' share of
/// the setup of packets included.
pub fn time(subjects: &[Subject<Kernel>], likeness: Likeness, rounds: usize) -> Vec<Time> {
    let (boxes, rays) = workload(likeness);
    let mut crossings = Crossings::new();
    race(subjects.len(), rounds, RAYS * BOXES, |i| {
        subjects[i].kernel.cross(subjects[i].way, &boxes, black_box(&rays), &mut crossings);
        black_box(&crossings);
    })
}

/// Boxes scattered about the origin, and rays among them.
fn workload(likeness: Likeness) -> (BoxSet, Rays) {
    let mut random = Random::new(64);
    let boxes: Vec<_> = (0..BOXES)
        .map(|_| {
            let (center, half) = (random.in_cube(), random.in_cube().abs() * 0.25);
            Aabb::new(center - half, center + half)
        })
        .collect();
    let rays = (0..RAYS).map(|_| {
        let origin = match likeness {
            Likeness::Alike => Vec3::new(3.0, 4.0, 12.0),
            Likeness::Unlike => random.in_cube() * 2.0,
        };
        Ray::new(origin, random.in_cube() - origin)
    });
    let rays = rays.collect();
    (BoxSet::new(&boxes), rays)
}
