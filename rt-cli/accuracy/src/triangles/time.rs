//! What a test costs.

use std::hint::black_box;
use std::time::Instant;

use rt_kernels::geom::Triangle;
use rt_kernels::{Hits, Ray, Rays};

use super::measure::Subject;
use super::random::Random;

/// How many triangles and how many rays: what fits into the first level of a cache.
const TRIANGLES: usize = 64;
const RAYS: usize = 64;

/// How often the loop is run for one measurement: long enough for the clock.
const REPEATS: u32 = 16;

/// Nanoseconds for one test of one ray against one triangle, the rays' share of the setup of
/// packets included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// The least of all rounds.
    pub least: f64,
    /// The median: half of the rounds took less.
    pub median: f64,
    /// The greatest.
    pub greatest: f64,
}

/// Times every subject on the calling thread, once a round for each in turn, so that a machine that
/// slows down slows down all of them. Rays with like directions; 64 of them, and 64 triangles, of
/// which a ray meets a few.
pub fn time(subjects: &[Subject], rounds: usize) -> Vec<Time> {
    let (triangles, rays) = workload();
    let records: Vec<_> =
        subjects.iter().map(|subject| subject.test.triangles(&triangles)).collect();
    let mut hits = Hits::new();
    race(subjects.len(), rounds, RAYS * TRIANGLES, |i| {
        let (subject, records) = (&subjects[i], &records[i]);
        subject.test.closest(subject.way, records, black_box(&rays), &mut hits);
        black_box(&hits);
    })
}

/// Times runs of so many tests by each of some subjects, in turn.
pub(super) fn race(
    subjects: usize,
    rounds: usize,
    tests: usize,
    mut run: impl FnMut(usize),
) -> Vec<Time> {
    let mut times = vec![Vec::with_capacity(rounds); subjects];
    for round in 0..=rounds {
        for (subject, times) in times.iter_mut().enumerate() {
            let start = Instant::now();
            for _ in 0..REPEATS {
                run(subject);
            }
            let ns = start.elapsed().as_secs_f64() * 1e9;
            // The first round warms up.
            if round > 0 {
                times.push(ns / f64::from(REPEATS) / tests as f64);
            }
        }
    }
    times.into_iter().map(summary).collect()
}

fn summary(mut times: Vec<f64>) -> Time {
    times.sort_by(f64::total_cmp);
    let at = |i: usize| times.get(i).copied().unwrap_or(f64::NAN);
    Time { least: at(0), median: at(times.len() / 2), greatest: at(times.len().saturating_sub(1)) }
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
