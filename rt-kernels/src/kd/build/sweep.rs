//! The surface area heuristic wherever a piece begins or ends, in O(n log n).
//!
//! Where pieces begin and end is sorted once for each axis. The sides of a split take these events in
//! their order; only those of pieces that were cut are sorted anew, and merged.
//!
//! Source: Wald and Havran 2006, Section 4.3. Deviation: a list for each axis instead of one for all.

use super::piece::{Cutter, Piece};
use super::sah::{Costs, Split, pays};
use super::{Rule, sides};
use crate::geom::Aabb;

/// What happens to a piece at a plane that sweeps over it, in the order at one place.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum What {
    Ends,
    IsFlat,
    Begins,
}

#[derive(Clone, Copy)]
struct Event {
    at: f32,
    what: What,
    /// The piece's number in this cell.
    piece: u32,
}

/// Pieces, and their events on all axes, sorted.
pub(super) struct Events {
    pieces: Vec<Piece>,
    events: [Vec<Event>; 3],
}

impl Rule for Events {
    fn new(pieces: Vec<Piece>) -> Self {
        let events = [0, 1, 2].map(|axis| {
            let mut events = Vec::with_capacity(2 * pieces.len());
            for (piece, i) in pieces.iter().zip(0..) {
                push(&mut events, piece, i, axis);
            }
            sort(&mut events);
            events
        });
        Events { pieces, events }
    }

    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn best(&self, cell: &Aabb) -> Option<Split> {
        let mut best = None;
        for (axis, events) in self.events.iter().enumerate() {
            let Some(costs) = Costs::new(cell, axis) else { continue };
            let (mut low, mut high) = (0, self.pieces.len());
            let mut i = 0;
            while i < events.len() {
                let at = events[i].at;
                let mut here = [0; 3];
                while i < events.len() && events[i].at == at {
                    here[events[i].what as usize] += 1;
                    i += 1;
                }
                let [ends, flat, begins] = here;
                high -= ends + flat;
                costs.offer(&mut best, at, low, high, flat);
                low += begins + flat;
            }
        }
        best.filter(|split| pays(split, self.pieces.len()))
    }

    fn split(self, split: &Split, cutter: &Cutter<'_>) -> [Self; 2] {
        /// The number of a piece that is not on a side, or was cut.
        const NONE: u32 = u32::MAX;
        let mut both = split.counts.map(Vec::with_capacity);
        let mut numbers = [vec![NONE; self.pieces.len()], vec![NONE; self.pieces.len()]];
        let mut cut: [Vec<u32>; 2] = Default::default();
        for (i, piece) in self.pieces.iter().enumerate() {
            let on = sides(piece, split, cutter);
            for (side, part) in on.iter().enumerate() {
                let Some(part) = part else { continue };
                let number = both[side].len() as u32;
                both[side].push(*part);
                if part.bounds == piece.bounds {
                    numbers[side][i] = number;
                } else {
                    cut[side].push(number);
                }
            }
        }
        let mut side = 0;
        both.map(|pieces| {
            let (numbers, cut) = (&numbers[side], &cut[side]);
            side += 1;
            let events = [0, 1, 2].map(|axis| {
                let mut new = Vec::with_capacity(2 * cut.len());
                for &i in cut {
                    push(&mut new, &pieces[i as usize], i, axis);
                }
                sort(&mut new);
                let old = self.events[axis].iter().filter_map(|event| {
                    let piece = numbers[event.piece as usize];
                    (piece != NONE).then_some(Event { piece, ..*event })
                });
                merge(old, new, 2 * pieces.len())
            });
            Events { pieces, events }
        })
    }
}

fn push(events: &mut Vec<Event>, piece: &Piece, i: u32, axis: usize) {
    let [min, max] = piece.bounds.axes[axis];
    if min == max {
        events.push(Event { at: min, what: What::IsFlat, piece: i });
    } else {
        events.push(Event { at: min, what: What::Begins, piece: i });
        events.push(Event { at: max, what: What::Ends, piece: i });
    }
}

/// By place. What is at one place may come in any order.
fn sort(events: &mut [Event]) {
    events.sort_unstable_by(|a, b| a.at.total_cmp(&b.at));
}

fn merge(old: impl Iterator<Item = Event>, new: Vec<Event>, capacity: usize) -> Vec<Event> {
    let mut all = Vec::with_capacity(capacity);
    let mut new = new.into_iter().peekable();
    for event in old {
        while let Some(other) = new.next_if(|other| other.at.total_cmp(&event.at).is_lt()) {
            all.push(other);
        }
        all.push(event);
    }
    all.extend(new);
    all
}
