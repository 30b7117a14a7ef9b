//! Measuring the kernels: the same rays, once for each way to run them, in interleaved rounds.

mod rays;

pub use rays::{Batches, diffuse, primary};

use std::time::{Duration, Instant};

use rt_kernels::tri::Method;
use rt_kernels::{Exec, Hits, Stats};

use crate::World;

/// A world, which has a triangle test, and how to trace it.
#[derive(Clone, Copy)]
pub struct Way<'a> {
    /// The world. All ways have the same scene.
    pub world: &'a World,
    /// Level and packet size.
    pub exec: Exec,
}

/// What one way to trace the rays took.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The triangle test.
    pub method: Method,
    /// Level and packet size.
    pub exec: Exec,
    /// The number of rays.
    pub rays: u64,
    /// The median time of all rays.
    pub time: Duration,
    /// The work of all rays.
    pub stats: Stats,
    /// Rays whose hit is not, bit for bit, that of the first way. Anything but 0 is a fault, if the
    /// triangle test is the same.
    pub differing: u64,
}

/// Times the closest hits of some rays on the calling thread, once a round for every way in turn, so
/// that a machine that slows down slows down all of them.
pub fn trace(rays: &Batches, ways: &[Way<'_>], rounds: usize) -> Vec<Row> {
    let batches = &rays.batches;
    let mut reference = Vec::new();
    let mut rows = Vec::new();
    for &Way { world, exec } in ways {
        let mut row = Row {
            method: world.method(),
            exec: world.exec(exec),
            rays: 0,
            time: Duration::ZERO,
            stats: Stats::default(),
            differing: 0,
        };
        for (i, rays) in batches.iter().enumerate() {
            let mut hits = Hits::new();
            world.accel.closest(exec, rays, &mut hits, &mut row.stats);
            row.rays += rays.len() as u64;
            if reference.len() == i {
                reference.push(hits);
            } else {
                let first: &Hits = &reference[i];
                let differs = |ray: &usize| hits.get(*ray) != first.get(*ray);
                row.differing += (0..rays.len()).filter(differs).count() as u64;
            }
        }
        rows.push(row);
    }

    let mut times = vec![Vec::new(); ways.len()];
    let mut hits = Hits::new();
    for _ in 0..rounds {
        for (&Way { world, exec }, times) in ways.iter().zip(&mut times) {
            let start = Instant::now();
            for rays in batches {
                world.accel.closest(exec, rays, &mut hits, &mut Stats::default());
            }
            times.push(start.elapsed());
        }
    }
    for (row, mut times) in rows.iter_mut().zip(times) {
        times.sort_unstable();
        row.time = times[times.len() / 2];
    }
    rows
}
