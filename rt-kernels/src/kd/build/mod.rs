//! Builders of kd-trees: one file a rule for where to split.
//!
//! A cell is split where the rule says, and what both sides have is given to both: the
//! [pieces](piece) there, cut anew. It ends where no split pays, at a depth of 8 + 1.3 log2 n, and
//! where [`GROWTH`] is used up: how many entries splits may add is shared out among subtrees by their
//! pieces, so the tree does not depend on `join`.

mod binned;
mod median;
mod piece;
mod sah;
mod sweep;

use super::layout::{Cells, MAX_LINK, Node, Pair};
use crate::bvh::Join;
use crate::geom::Aabb;
use crate::primitives::Primitives;
use crate::tri::Method;
use piece::{Cutter, Piece};
use sah::Split;

/// How a kd-tree is built. The hits do not depend on it, the time to find them does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum KdBuilder {
    /// The surface area heuristic wherever a piece begins or ends, in O(n log n).
    Sweep,
    /// The surface area heuristic at the borders of bins, and where pieces begin or end once they are
    /// few: quick to build.
    #[default]
    Binned,
    /// In the middle of the longest axis.
    Median,
}

impl KdBuilder {
    /// All of them.
    pub const ALL: [KdBuilder; 3] = [KdBuilder::Sweep, KdBuilder::Binned, KdBuilder::Median];

    /// What it is called, on the command line too.
    pub fn name(self) -> &'static str {
        match self {
            KdBuilder::Sweep => "sweep",
            KdBuilder::Binned => "binned",
            KdBuilder::Median => "median",
        }
    }
}

/// How many entries the lists may have beyond one for each primitive, for each primitive.
pub const GROWTH: usize = 7;

/// The most nodes on a way from the root to a leaf.
pub(super) const MAX_DEPTH: usize = 48;

/// The least number of pieces for which the halves may go to different threads.
const PARALLEL: usize = 4096;

/// The bounds of all primitives, and the cells within, whose lists have their numbers. Pair 0 is the
/// root and nothing.
pub(super) fn build(
    builder: KdBuilder,
    primitives: &Primitives,
    method: Method,
    join: &impl Join,
) -> (Aabb, Cells) {
    let cutter = Cutter::new(primitives, method);
    let pieces = cutter.pieces();
    let bounds = pieces.iter().fold(Aabb::EMPTY, |all, piece| all.union(&piece.bounds));
    let n = pieces.len().max(1);
    let depth = (8 + (n.ilog2() as usize * 13).div_ceil(10)).min(MAX_DEPTH - 1);
    let spare = (GROWTH * n).min(MAX_LINK - n);
    let work = Work { cutter, depth, join };
    let mut cells = Cells { pairs: vec![Pair::default()], ..Cells::default() };
    let room = Room { cell: bounds, depth: 0, spare };
    let root = match builder {
        KdBuilder::Sweep => work.subtree::<sweep::Events>(pieces, room, &mut cells),
        KdBuilder::Binned => work.subtree::<binned::Bins>(pieces, room, &mut cells),
        KdBuilder::Median => work.subtree::<median::Middle>(pieces, room, &mut cells),
    };
    cells.pairs[0].0[0] = root;
    (bounds, cells)
}

/// The pieces of a cell, as a rule wants them.
trait Rule: Sized + Send {
    fn new(pieces: Vec<Piece>) -> Self;

    fn pieces(&self) -> &[Piece];

    /// Where to split the cell; `None` if it should be a leaf.
    fn best(&self, cell: &Aabb) -> Option<Split>;

    /// The pieces of both sides.
    fn split(self, split: &Split, cutter: &Cutter<'_>) -> [Self; 2];
}

/// Where a subtree goes.
struct Room {
    cell: Aabb,
    depth: usize,
    /// How many entries its lists may have beyond one for each piece.
    spare: usize,
}

/// What is the same in all subtrees.
struct Work<'a, J> {
    cutter: Cutter<'a>,
    /// The greatest depth of a leaf.
    depth: usize,
    join: &'a J,
}

impl<J: Join> Work<'_, J> {
    fn subtree<R: Rule>(&self, pieces: Vec<Piece>, room: Room, cells: &mut Cells) -> Node {
        self.grow(R::new(pieces), room, cells)
    }

    /// Adds what is below a node, and returns the node.
    fn grow<R: Rule>(&self, rule: R, room: Room, cells: &mut Cells) -> Node {
        let Room { cell, depth, spare } = room;
        let count = rule.pieces().len();
        let fits = |split: &Split| split.counts.iter().sum::<usize>() <= count + spare;
        let split = if depth < self.depth { rule.best(&cell).filter(fits) } else { None };
        let Some(split) = split else {
            return cells.leaf(rule.pieces().iter().map(|piece| piece.prim), depth);
        };

        let [low, high] = rule.split(&split, &self.cutter);
        let counts = [low.pieces().len(), high.pieces().len()];
        let both = (counts[0] + counts[1]).max(1);
        let spare = (count + spare).saturating_sub(both);
        let below = (spare as u64 * counts[0] as u64 / both as u64) as usize;
        let mut rooms = [below, spare - below].map(|spare| Room { cell, depth: depth + 1, spare });
        rooms[0].cell.axes[split.axis][1] = split.at;
        rooms[1].cell.axes[split.axis][0] = split.at;

        let pair = cells.pairs.len();
        cells.pairs.push(Pair::default());
        let [low_room, high_room] = rooms;
        cells.pairs[pair].0 = if counts[0].min(counts[1]) >= PARALLEL {
            let (low, high) =
                self.join.join(|| self.apart(low, low_room), || self.apart(high, high_room));
            [cells.append(low), cells.append(high)]
        } else {
            [self.grow(low, low_room, cells), self.grow(high, high_room, cells)]
        };
        Node::inner(split.axis, split.at, pair)
    }

    fn apart<R: Rule>(&self, rule: R, room: Room) -> (Node, Cells) {
        let mut cells = Cells::default();
        let root = self.grow(rule, room, &mut cells);
        (root, cells)
    }
}

/// Which sides of a split a piece is on, cut to them.
fn sides(piece: &Piece, split: &Split, cutter: &Cutter<'_>) -> [Option<Piece>; 2] {
    let [min, max] = piece.bounds.axes[split.axis];
    let (low, high) = match (min == max && min == split.at, max <= split.at, min >= split.at) {
        (true, ..) => (split.flat_low, !split.flat_low),
        (_, low, high) => (!high, !low),
    };
    if low && high {
        let slabs = [[f32::NEG_INFINITY, split.at], [split.at, f32::INFINITY]];
        let cut = slabs.map(|slab| cutter.within(piece, split.axis, slab));
        debug_assert!(cut.iter().any(Option::is_some), "some part of {piece:?} is somewhere");
        return cut;
    }
    [low, high].map(|on| on.then_some(*piece))
}

/// How many pieces are on either side of a plane, flat ones in it above.
fn count(pieces: &[Piece], axis: usize, at: f32) -> [usize; 2] {
    let mut counts = [0; 2];
    for piece in pieces {
        let [min, max] = piece.bounds.axes[axis];
        counts[0] += usize::from(min < at);
        counts[1] += usize::from(max > at || min == at);
    }
    counts
}

/// The pieces of both sides of a split.
fn share_out(pieces: &[Piece], split: &Split, cutter: &Cutter<'_>) -> [Vec<Piece>; 2] {
    let mut both = split.counts.map(Vec::with_capacity);
    for piece in pieces {
        for (side, cut) in both.iter_mut().zip(sides(piece, split, cutter)) {
            side.extend(cut);
        }
    }
    both
}
