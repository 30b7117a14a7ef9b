//! What the rays of a packet have in common, and what mailboxes spare.

use std::thread;
use std::time::{Duration, Instant};

use rt_kernels::{Accelerator, Exec, Hits, KdBuilder, KdPlan, KdTree, Mailbox, Ray, Rays};
use rt_kernels::{Sequential, Stats};

use super::Batches;
use crate::world::primitives;
use crate::{RenderError, World};

/// A kd-tree of what is in a world.
///
/// # Errors
/// If the kernels refuse it.
pub fn kd_tree(world: &World, builder: KdBuilder) -> Result<KdTree, RenderError> {
    let plan = KdPlan { builder, ..KdPlan::default() };
    Ok(KdTree::build_with(&primitives(&world.scene), plan, &Sequential)?)
}

/// By how much the visits of nodes are more in packets of so many rays: those of a packet, once for
/// each ray, over those of the rays alone, minus 1.
pub fn packet_overhead(tree: &KdTree, rays: &Batches, exec: Exec, packets: &[usize]) -> Vec<f64> {
    let mut alone = 0u64;
    let mut together = vec![0u64; packets.len()];
    let mut last = vec![vec![u32::MAX; tree.nodes() + 1]; packets.len()];
    let mut hits = Hits::new();
    let mut first = 0;
    for batch in &rays.batches {
        tree.closest(exec, batch, &mut hits, &mut Stats::default());
        for i in 0..batch.len() {
            let ray = batch.get(i);
            let tmax = hits.get(i).map_or(ray.tmax, |hit| hit.t);
            tree.visits(&Ray { tmax, ..ray }, &mut |node| {
                alone += 1;
                for ((&rays, together), last) in packets.iter().zip(&mut together).zip(&mut last) {
                    let packet = ((first + i) / rays) as u32;
                    *together += u64::from(last[node] != packet);
                    last[node] = packet;
                }
            });
        }
        first += batch.len();
    }
    let over =
        |(&rays, &visits): (&usize, &u64)| (visits * rays as u64) as f64 / alone as f64 - 1.0;
    packets.iter().zip(&together).map(over).collect()
}

/// What a mailbox does for some rays.
#[derive(Clone, Copy, Debug)]
pub struct MailRow {
    /// The mailbox.
    pub mailbox: Mailbox,
    /// Level and packet size.
    pub exec: Exec,
    /// The median time of all rays.
    pub time: Duration,
    /// The work.
    pub stats: Stats,
}

/// Traces the rays with every mailbox, once a round for each in turn.
pub fn mailboxes(
    tree: &KdTree,
    mailboxes: &[Mailbox],
    rays: &Batches,
    exec: Exec,
    rounds: usize,
) -> Vec<MailRow> {
    let trees: Vec<_> =
        mailboxes.iter().map(|&mailbox| tree.clone().with_mailbox(mailbox)).collect();
    let mut times = vec![Vec::new(); trees.len()];
    let mut works = vec![Stats::default(); trees.len()];
    for round in 0..=rounds {
        for ((tree, times), work) in trees.iter().zip(&mut times).zip(&mut works) {
            let mut stats = Stats::default();
            let time = all(tree, &rays.batches, exec, &mut stats);
            if round > 0 {
                times.push(time);
            }
            *work = stats;
        }
    }
    let row = |((&mailbox, mut times), stats): ((&Mailbox, Vec<Duration>), Stats)| {
        times.sort_unstable();
        MailRow { mailbox, exec: tree.exec(exec), time: times[times.len() / 2], stats }
    };
    mailboxes.iter().zip(times).zip(works).map(row).collect()
}

/// How much more rays two threads trace than one, both the same at about the same time, with each
/// mailbox: the medians of all rounds. 2 is all there is to gain.
pub fn two_threads(
    tree: &KdTree,
    mailboxes: &[Mailbox],
    rays: &Batches,
    exec: Exec,
    rounds: usize,
) -> Vec<f64> {
    let trees: Vec<_> =
        mailboxes.iter().map(|&mailbox| tree.clone().with_mailbox(mailbox)).collect();
    let mut gains = vec![Vec::new(); trees.len()];
    for _ in 0..rounds {
        for (tree, gains) in trees.iter().zip(&mut gains) {
            let one = || all(tree, &rays.batches, exec, &mut Stats::default());
            let alone = one();
            let start = Instant::now();
            thread::scope(|scope| {
                scope.spawn(one);
                one();
            });
            gains.push(2.0 * alone.as_secs_f64() / start.elapsed().as_secs_f64());
        }
    }
    let median = |mut gains: Vec<f64>| {
        gains.sort_by(f64::total_cmp);
        gains[gains.len() / 2]
    };
    gains.into_iter().map(median).collect()
}

fn all(tree: &KdTree, batches: &[Rays], exec: Exec, stats: &mut Stats) -> Duration {
    let mut hits = Hits::new();
    let start = Instant::now();
    for rays in batches {
        tree.closest(exec, rays, &mut hits, stats);
    }
    start.elapsed()
}
