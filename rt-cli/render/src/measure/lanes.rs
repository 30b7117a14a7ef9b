//! What a triangle test costs, by what its lanes are for and by where its triangle comes from.

use std::hint::black_box;
use std::time::Instant;

use glam::Vec3;
use rt_kernels::geom::Triangle;
use rt_kernels::tri::Across;
use rt_kernels::{Hits, Ray, Rays};
use simd4::Level;

use super::random::Random;

/// Nanoseconds a test takes.
#[derive(Clone, Copy, Debug)]
pub struct TestRow {
    /// What the lanes are for.
    pub across: Across,
    /// The triangle is behind the ray: the first comparison rejects it.
    pub least: f64,
    /// It is hit, and closer than all before.
    pub most: f64,
    /// As the least, with triangles that are in no cache.
    pub memory: f64,
}

/// Triangles that fit into the first level of a cache, and rays.
const FEW: usize = 64;

/// Triangles that fit into no cache: 192 megabytes of records.
const MANY: usize = 1 << 22;

/// How often each of the few is tested for a measurement.
const REPEATS: usize = 64;

/// Measures every way at that level: the medians of all rounds.
pub fn tests(level: Level, rounds: usize, quick: bool) -> Vec<TestRow> {
    // One behind the other, all as wide as the beam.
    let few: Vec<_> = (0..FEW)
        .map(|i| {
            let z = -1.0 - i as f32;
            let corners = [[-90.0, -90.0], [90.0, -80.0], [0.0, 90.0]];
            Triangle { corners: corners.map(|[x, y]| Vec3::new(x, y, z)) }
        })
        .collect();
    let mut random = Random::new(1);
    let beam: Vec<_> =
        (0..FEW).map(|_| Vec3::new(0.1 * random.signed(), 0.1 * random.signed(), -1.0)).collect();
    let toward: Rays = beam.iter().map(|&dir| Ray::new(Vec3::ZERO, dir)).collect();
    let away: Rays = beam.iter().map(|&dir| Ray::new(Vec3::ZERO, -dir)).collect();
    let four: Rays = (0..4).map(|i| away.get(i)).collect();
    let far_to_near: Vec<u32> = (0..FEW as u32).rev().collect();

    let many = if quick { MANY / 16 } else { MANY };
    let anywhere: Vec<u32> = (0..many / 4).map(|_| random.below(many) as u32).collect();
    let among_few: Vec<u32> = anywhere.iter().map(|i| i % FEW as u32).collect();

    let mut rows = Vec::new();
    for across in Across::ALL {
        let records = across.records(&few);
        let time = |order: &[u32], rays: &Rays| {
            median(rounds, REPEATS * order.len() * rays.len(), || {
                let mut hits = Hits::new();
                for _ in 0..REPEATS {
                    across.closest(level, &records, order, black_box(rays), &mut hits);
                }
                black_box(&hits);
            })
        };
        let (least, most) = (time(&far_to_near, &away), time(&far_to_near, &toward));
        let all: Vec<_> = few.iter().copied().cycle().take(many).collect();
        let all = across.records(&all);
        let tests = |records: &[_], order: &[u32]| {
            median(rounds.min(5), order.len() * four.len(), || {
                let mut hits = Hits::new();
                across.closest(level, records, order, black_box(&four), &mut hits);
                black_box(&hits);
            })
        };
        // What the order itself costs is in both.
        let memory = least * tests(&all, &anywhere) / tests(&all, &among_few);
        rows.push(TestRow { across, least, most, memory });
    }
    rows
}

/// The median time of one of so many tests, in nanoseconds.
fn median(rounds: usize, tests: usize, mut run: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..=rounds)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64() * 1e9 / tests as f64
        })
        .collect();
    // The first round warms up.
    times.remove(0);
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
