//! Measuring the kernels: the same rays, once for each way to run them, in interleaved rounds.

mod coherence;
mod frames;
mod lanes;
mod random;
mod raster;
mod rays;
mod shading;
mod terrain;
mod traversals;

pub use coherence::{MailRow, kd_tree, mailboxes, packet_overhead, two_threads};
pub use frames::{Extent, FrameTimes, frames};
pub use lanes::{TestRow, tests};
pub use raster::ZBuffer;
pub use rays::{Batches, diffuse, primary, shadow};
pub use shading::{phong, pictures, textured_terrain};
pub use terrain::terrain;
pub use traversals::{TraversalRow, traversals};

use std::time::{Duration, Instant};

use rt_kernels::tri::Method;
use rt_kernels::{Exec, Hits, Rays, Stats};

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

/// Times the hits of some rays on the calling thread, once a round for every way in turn, so
/// that a machine that slows down slows down all of them.
pub fn trace(rays: &Batches, ways: &[Way<'_>], rounds: usize) -> Vec<Row> {
    let batches = &rays.batches;
    let mut reference: Vec<Answers> = Vec::new();
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
        for (i, batch) in batches.iter().enumerate() {
            let mut answers = Answers::default();
            answers.ask(world, exec, batch, rays.any, &mut row.stats);
            row.rays += batch.len() as u64;
            match reference.get(i) {
                None => reference.push(answers),
                Some(first) => row.differing += answers.differing(first),
            }
        }
        rows.push(row);
    }

    let mut times = vec![Vec::new(); ways.len()];
    let mut answers = Answers::default();
    for _ in 0..rounds {
        for (&Way { world, exec }, times) in ways.iter().zip(&mut times) {
            let start = Instant::now();
            for batch in batches {
                answers.ask(world, exec, batch, rays.any, &mut Stats::default());
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

/// Traces some rays, and that is all: for whoever watches from outside.
pub fn once(world: &World, rays: &Batches, exec: Exec) {
    let (mut answers, mut stats) = (Answers::default(), Stats::default());
    for batch in &rays.batches {
        answers.ask(world, exec, batch, rays.any, &mut stats);
    }
}

/// What was asked of some rays: their closest hits, or whether there are any.
#[derive(Default)]
struct Answers {
    hits: Hits,
    found: Vec<bool>,
}

impl Answers {
    fn ask(&mut self, world: &World, exec: Exec, rays: &Rays, any: bool, stats: &mut Stats) {
        match any {
            true => world.accel.any(exec, rays, &mut self.found, stats),
            false => world.accel.closest(exec, rays, &mut self.hits, stats),
        }
    }

    /// How many are not the same.
    fn differing(&self, other: &Answers) -> u64 {
        let hits = (0..self.hits.len()).filter(|&i| self.hits.get(i) != other.hits.get(i)).count();
        let found = self.found.iter().zip(&other.found).filter(|(a, b)| a != b).count();
        (hits + found) as u64
    }
}
