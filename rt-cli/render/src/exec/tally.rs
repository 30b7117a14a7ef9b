//! What the work took.

use std::ops::AddAssign;
use std::time::{Duration, Instant};

use rt_kernels::{Hits, Rays, Stats};

use super::TileJob;
use crate::RayKind;

/// Rays of one kind.
#[derive(Clone, Copy, Debug, Default)]
struct KindTally {
    rays: u64,
    alone: u64,
    time: Duration,
}

/// Counts and times, of one tile or of several.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    kinds: [KindTally; 4],
    shading: Duration,
    stats: Stats,
}

impl Tally {
    /// Finds closest hits, and counts.
    pub(crate) fn closest(
        &mut self,
        job: &TileJob<'_>,
        kind: RayKind,
        rays: &Rays,
        hits: &mut Hits,
    ) {
        let mut stats = Stats::default();
        let start = Instant::now();
        job.world.accel.closest(job.job.exec, rays, hits, &mut stats);
        self.count(kind, rays, start, stats);
    }

    /// Finds which rays hit anything, and counts them as shadow rays.
    pub(crate) fn any(&mut self, job: &TileJob<'_>, rays: &Rays, found: &mut Vec<bool>) {
        let mut stats = Stats::default();
        let start = Instant::now();
        job.world.accel.any(job.job.exec, rays, found, &mut stats);
        self.count(RayKind::Shadow, rays, start, stats);
    }

    /// Nodes visited and primitives tested so far.
    pub(crate) fn steps(&self) -> u64 {
        let stats = &self.stats;
        stats.node_visits + stats.triangle_tests + stats.sphere_tests + stats.cone_tests
    }

    /// Does work that counts as shading.
    pub(crate) fn shading(&mut self, work: impl FnOnce()) {
        let start = Instant::now();
        work();
        self.shading += start.elapsed();
    }

    fn count(&mut self, kind: RayKind, rays: &Rays, start: Instant, stats: Stats) {
        let tally = &mut self.kinds[kind as usize];
        tally.time += start.elapsed();
        tally.rays += rays.len() as u64;
        tally.alone += stats.rays_alone;
        self.stats += stats;
    }

    /// The report of all tiles together.
    pub(crate) fn report(&self, total: Duration, threads: usize) -> Report {
        let threads = threads.max(1) as u32;
        let kind = |kind: RayKind| {
            let tally = self.kinds[kind as usize];
            KindReport { rays: tally.rays, alone: tally.alone, time: tally.time / threads }
        };
        Report {
            primary: kind(RayKind::Primary),
            shadow: kind(RayKind::Shadow),
            reflection: kind(RayKind::Reflection),
            refraction: kind(RayKind::Refraction),
            shading: self.shading / threads,
            total,
            stats: self.stats,
        }
    }
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Tally) {
        for (own, other) in self.kinds.iter_mut().zip(other.kinds) {
            own.rays += other.rays;
            own.alone += other.alone;
            own.time += other.time;
        }
        self.shading += other.shading;
        self.stats += other.stats;
    }
}

/// Rays of one kind, and the time that tracing them took, averaged over the threads.
#[derive(Clone, Copy, Debug)]
pub struct KindReport {
    /// How many.
    pub rays: u64,
    /// How many of them went on by themselves, in the end or all along, for want of others that went
    /// the same way.
    pub alone: u64,
    /// The time in the kernels, summed over the threads and divided by their number.
    pub time: Duration,
}

impl KindReport {
    /// Millions of rays a second, all threads together; `None` if there were none.
    pub fn mrays_per_s(&self) -> Option<f64> {
        (self.rays > 0).then(|| self.rays as f64 / self.time.as_secs_f64().max(1e-9) / 1e6)
    }
}

/// What a picture took.
#[derive(Clone, Copy, Debug)]
pub struct Report {
    /// Rays from the eye.
    pub primary: KindReport,
    /// Rays to lights.
    pub shadow: KindReport,
    /// Rays from mirrors.
    pub reflection: KindReport,
    /// Rays that go through surfaces.
    pub refraction: KindReport,
    /// The time spent on shading, summed over the threads and divided by their number.
    pub shading: Duration,
    /// From the first tile to the last.
    pub total: Duration,
    /// The work of the traversals.
    pub stats: Stats,
}

impl Report {
    /// All rays together.
    pub fn all(&self) -> KindReport {
        let kinds = [self.primary, self.shadow, self.reflection, self.refraction];
        KindReport {
            rays: kinds.iter().map(|kind| kind.rays).sum(),
            alone: kinds.iter().map(|kind| kind.alone).sum(),
            time: kinds.iter().map(|kind| kind.time).sum(),
        }
    }
}
