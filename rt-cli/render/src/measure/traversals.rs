//! Traversals of one hierarchy, side by side: those that Geimer and Müller (2003) compare.

use std::time::{Duration, Instant};

use rt_kernels::bvh::traverse::{Compared, catalogue};
use rt_kernels::{Bvh, Hits, Layout, Plan, Stats};
use simd4::Level;

use super::Batches;
use crate::exec::{RayonJoin, on_threads};
use crate::world::primitives;
use crate::{RenderError, World};

/// What one traversal took, with packets of four.
#[derive(Clone, Debug)]
pub struct TraversalRow {
    /// `skip` or `heap`.
    pub order: &'static str,
    /// The box test and its choices.
    pub box_test: String,
    /// Whether children are sorted by surface.
    pub sorted: bool,
    /// The number of rays.
    pub rays: u64,
    /// The least time of all rounds for all rays.
    pub time: Duration,
    /// The work of all rays.
    pub stats: Stats,
    /// Rays whose hit is not, bit for bit, that of the first row. Anything but 0 is a fault.
    pub differing: u64,
}

/// Times the closest hits of some rays on the calling thread, once a round for every traversal in
/// turn, over the hierarchy of the world's builder: each over sorted children, and that which renders
/// over unsorted ones too.
///
/// # Errors
/// If the kernels refuse the scene.
pub fn traversals(
    world: &World,
    rays: &Batches,
    level: Level,
    rounds: usize,
) -> Result<Vec<TraversalRow>, RenderError> {
    let builder = world.plan().builder;
    let [sorted, unsorted] = on_threads(1, || {
        let primitives = primitives(&world.scene);
        let plan = Plan { builder, layout: Layout::Skip, ..Plan::default() };
        Ok::<_, RenderError>([
            Bvh::build_with(&primitives, plan, &RayonJoin)?,
            Bvh::build_unsorted(&primitives, builder, &RayonJoin)?,
        ])
    })??;
    let all = catalogue();
    let mut ways: Vec<(&dyn Compared, &Bvh)> = all.iter().map(|&way| (way, &sorted)).collect();
    ways.push((all[0], &unsorted));

    let mut hits = Hits::new();
    let mut first = Vec::new();
    let mut rows = Vec::new();
    for (traversal, bvh) in &ways {
        let mut row = TraversalRow {
            order: traversal.order(),
            box_test: traversal.box_test(),
            sorted: std::ptr::eq(*bvh, &sorted),
            rays: 0,
            time: Duration::ZERO,
            stats: Stats::default(),
            differing: 0,
        };
        for (i, rays) in rays.batches.iter().enumerate() {
            traversal.closest(level, bvh, rays, &mut hits, &mut row.stats);
            row.rays += rays.len() as u64;
            match first.get(i) {
                None => first.push(hits.clone()),
                Some(first) => {
                    let differs = |ray: &usize| hits.get(*ray) != first.get(*ray);
                    row.differing += (0..rays.len()).filter(differs).count() as u64;
                }
            }
        }
        rows.push(row);
    }

    for round in 0..rounds {
        for ((traversal, bvh), row) in ways.iter().zip(&mut rows) {
            let start = Instant::now();
            for rays in &rays.batches {
                traversal.closest(level, bvh, rays, &mut hits, &mut Stats::default());
            }
            let time = start.elapsed();
            row.time = if round == 0 { time } else { row.time.min(time) };
        }
    }
    Ok(rows)
}
