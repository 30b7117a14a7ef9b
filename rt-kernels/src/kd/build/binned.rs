//! The surface area heuristic at the borders of bins.
//!
//! In one pass it is counted in which bin of each axis pieces begin and end. Once pieces are few, the
//! rest is [swept](super::sweep). Source: Popov, Günther, Seidel, Slusallek, "Experiences with
//! Streaming Construction of SAH KD-Trees", 2006; Shevtsov, Soupikov, Kapustin, "Highly Parallel Fast
//! KD-tree Construction for Interactive Ray Tracing of Dynamic Scenes", 2007.

use super::piece::{Cutter, Piece};
use super::sah::{Costs, Split, pays};
use super::sweep::Events;
use super::{Rule, count, share_out};
use crate::geom::Aabb;

/// Bins an axis.
const BINS: usize = 64;

/// The most pieces that are swept.
const FEW: usize = 256;

pub(super) enum Bins {
    Many(Vec<Piece>),
    Few(Events),
}

impl Rule for Bins {
    fn new(pieces: Vec<Piece>) -> Self {
        if pieces.len() > FEW { Bins::Many(pieces) } else { Bins::Few(Events::new(pieces)) }
    }

    fn pieces(&self) -> &[Piece] {
        match self {
            Bins::Many(pieces) => pieces,
            Bins::Few(events) => events.pieces(),
        }
    }

    fn best(&self, cell: &Aabb) -> Option<Split> {
        let pieces = match self {
            Bins::Many(pieces) => pieces,
            Bins::Few(events) => return events.best(cell),
        };
        let bounds = pieces.iter().fold(Aabb::EMPTY, |all, piece| all.union(&piece.bounds));
        // All axes in one pass: what there are many of is in no cache.
        let mut axes = bounds.axes.map(Counts::new);
        for piece in pieces {
            for (counts, ends) in axes.iter_mut().zip(piece.bounds.axes) {
                counts.add(ends);
            }
        }
        let mut best = None;
        for (axis, counts) in axes.iter().enumerate() {
            let Some(costs) = Costs::new(cell, axis) else { continue };
            let [low, high] = bounds.axes[axis];
            // Empty space first.
            costs.offer(&mut best, low, 0, pieces.len(), 0);
            costs.offer(&mut best, high, pieces.len(), 0, 0);
            if counts.scale == 0.0 {
                continue;
            }
            let (mut below, mut above) = (0, pieces.len());
            for i in 1..BINS {
                below += counts.begin[i - 1] as usize;
                above -= counts.end[i - 1] as usize;
                costs.offer(&mut best, low + counts.step * i as f32, below, above, 0);
            }
        }
        let split = best.filter(|split| pays(split, pieces.len()))?;
        Some(Split { counts: count(pieces, split.axis, split.at), ..split })
    }

    fn split(self, split: &Split, cutter: &Cutter<'_>) -> [Self; 2] {
        match self {
            Bins::Many(pieces) => share_out(&pieces, split, cutter).map(Bins::new),
            Bins::Few(events) => events.split(split, cutter).map(Bins::Few),
        }
    }
}

/// How many pieces begin and end in each bin of an axis. A border is at the bin's low end. What is
/// counted may be off by rounding: it is but a guess of the cost.
struct Counts {
    low: f32,
    step: f32,
    /// Bins for a unit of length; 0 if there is no length.
    scale: f32,
    begin: [u32; BINS],
    end: [u32; BINS],
}

impl Counts {
    fn new([low, high]: [f32; 2]) -> Counts {
        let step = (high - low) / BINS as f32;
        let scale = if (1.0 / step).is_finite() { 1.0 / step } else { 0.0 };
        Counts { low, step, scale, begin: [0; BINS], end: [0; BINS] }
    }

    #[inline(always)]
    fn add(&mut self, [min, max]: [f32; 2]) {
        let bin = |x: f32| (((x - self.low) * self.scale) as usize).min(BINS - 1);
        let (first, last) = (bin(min), bin(max));
        self.begin[first] += 1;
        self.end[last] += 1;
    }
}
