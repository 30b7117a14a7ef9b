//! Rays that take turns over nodes of N children.
//!
//! What a ray does next depends on what its last step has found: it waits for memory, for a chain of
//! operations, and again wherever a branch was guessed wrong. So many rays are on their way at once. Each
//! goes one step, to one node or one leaf, and sends for what comes next; then it is another's turn. A
//! step has no branch that would be a guess, but for hits, so that the CPU is at work on the steps of
//! several rays at a time.
//!
//! A node's children that a ray may hit are put on its stack all at once, in the order that the node
//! [guesses](crate::bvh::layout::WideNode) for rays of that octant, and the uppermost is where it goes next.
//! With each hit, what is entered behind it is dropped from the stack.
//!
//! **The answer** is that of every other traversal ([why](crate#why-the-answer-is-one)): boxes and
//! triangles are decided as by [one ray at a time](super::wide), and hits do not depend on the order of
//! visits.
//!
//! **The stacks** cannot overflow: as [there](super::wide), and N entries more, since all lanes are written.
//!
//! Source: Wald, Benthin, Boulos, "Getting Rid of Packets", 2008, for the nodes; the order of children by
//! octants is that of Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through
//! Compressed Wide BVHs", 2017, Section 3.2, with all eight orders in the node. The turns, and a step
//! without guesses, are worked out here.

use simd4::{Lanes, Simd, SimdF32, SimdMask, SimdU32};

use super::wide;
use crate::bvh::layout::{Child, Wide, without_gaps};
use crate::packet::{Alone, Ask, Coherent, Hits, Packet, Query, Single};
use crate::slab::{Crossing, robust};
use crate::tri::knobs::{Division, Plain};
use crate::tri::{self, BlockLanes, Found, RecordBlock, TriangleKernel, Watertight};
use crate::{Counters, Hit};

/// How many rays take turns: a bit for each in a `u32`.
const RAYS: usize = 32;

/// What a hit is before it is held in its triangle's own box.
type WithoutBox = Watertight<Division, Plain, true, false>;

/// The rays that are on their way.
pub(crate) struct Turns {
    slots: Box<[Slot; RAYS]>,
    stacks: Stacks,
    /// The rays whose next child is a node, and those where it is a leaf.
    at_nodes: u32,
    at_leaves: u32,
}

/// Of each ray the children that are still to be visited, above one that is none.
struct Stacks {
    children: Vec<u32>,
    /// Where each is entered.
    enters: Vec<f32>,
    /// How many entries are one ray's.
    room: usize,
}

/// A ray on its way.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Slot {
    /// What it has found.
    hit: Hit,
    /// Where its next child came from in the stacks: what is above is of no account.
    top: u32,
    /// Where it goes next.
    child: Child,
    /// Its place in the batch.
    place: u32,
    ray: Alone,
}

impl Turns {
    /// Room for any rays in that hierarchy.
    pub(crate) fn new<const N: usize>(wide: &Wide<N>) -> Self {
        let hit = Hit { t: 0.0, prim: Hits::NONE, u: 0.0, v: 0.0 };
        let slot = Slot { hit, top: 0, child: Child::ROOT, place: 0, ray: Alone::default() };
        let room = 1 + wide.depth() * (N - 1) + N;
        let (children, enters) = (vec![Child::NONE.0; RAYS * room], vec![0.0; RAYS * room]);
        let stacks = Stacks { children, enters, room };
        Turns { slots: Box::new([slot; RAYS]), stacks, at_nodes: 0, at_leaves: 0 }
    }

    /// Whether no other ray can be put among them.
    #[inline(always)]
    pub(crate) fn full(&self) -> bool {
        self.at_nodes | self.at_leaves == u32::MAX
    }

    /// Whether there is no ray.
    #[inline(always)]
    pub(crate) fn empty(&self) -> bool {
        self.at_nodes | self.at_leaves == 0
    }

    /// Puts a ray among them, which must not be [full](Turns::full): it looks for what is below `child`
    /// and better than `hit`.
    #[inline(always)]
    pub(crate) fn put(&mut self, child: Child, ray: Alone, hit: Hit, place: usize) {
        let free = !(self.at_nodes | self.at_leaves);
        let i = free.trailing_zeros() as usize % RAYS;
        let top = self.stacks.first(i) as u32;
        self.slots[i] = Slot { hit, top, child, place: place as u32, ray };
        let leaf = u32::from(child.is_leaf());
        self.at_nodes |= (leaf ^ 1) << i;
        self.at_leaves |= leaf << i;
    }

    /// All rays at nodes go one step; if there are enough at leaves, or none at nodes, so do those. The rays
    /// that are done then, each a bit for [`found`](Turns::found), are not among them any more.
    #[inline(always)]
    pub(crate) fn round<V: SimdF32, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        any: bool,
        stats: &mut impl Counters,
    ) -> u32 {
        let (slots, stacks) = (&mut *self.slots, &mut self.stacks);
        let (mut at_nodes, mut at_leaves, mut done) = (self.at_nodes, self.at_leaves, 0);
        let mut left = at_nodes;
        while left != 0 {
            let i = left.trailing_zeros() as usize;
            left &= left - 1;
            stats.count(|stats| {
                stats.node_visits += 1;
                stats.active_rays += 1;
                stats.box_tests += N as u64;
            });
            let child = slots[i].at_node::<V, N>(s, wide, stacks);
            at_leaves |= u32::from(child.is_leaf()) << i;
            done |= u32::from(child == Child::NONE) << i;
        }
        at_nodes &= !at_leaves;
        at_leaves &= !done;
        if at_nodes == 0 || at_leaves.count_ones() as usize >= RAYS / 2 {
            let mut left = at_leaves;
            (at_nodes, at_leaves) = (at_nodes | left, 0);
            while left != 0 {
                let i = left.trailing_zeros() as usize;
                left &= left - 1;
                let child = slots[i].at_leaf::<V, N>(s, wide, stacks, any, i, stats);
                at_leaves |= u32::from(child.is_leaf()) << i;
                done |= u32::from(child == Child::NONE) << i;
            }
            at_nodes &= !at_leaves;
            at_leaves &= !done;
        }
        (self.at_nodes, self.at_leaves) = (at_nodes, at_leaves);
        done
    }

    /// The place of a ray, and what it has found; nothing better, if that is what it came with.
    #[inline(always)]
    pub(crate) fn found(&self, i: u32) -> (usize, Hit) {
        let slot = &self.slots[i as usize % RAYS];
        (slot.place as usize, slot.hit)
    }
}

impl Stacks {
    /// The first of a ray's entries that may be a child.
    #[inline(always)]
    fn first(&self, i: usize) -> usize {
        i * self.room + 1
    }

    /// Drops those of ray `i`'s entries up to `end` that are entered after `t`, and says where the others
    /// end.
    #[inline(always)]
    fn drop_after<V: SimdF32>(&mut self, s: V::Simd, i: usize, end: usize, t: f32) -> usize {
        let first = self.first(i);
        let (mut at, mut kept) = (first, first);
        while at < end {
            let enters = V::load(s, &self.enters[at..]);
            let children = V::U32::load(s, &self.children[at..]);
            let there = u32::MAX >> (32 - (end - at).min(V::LANES));
            let (order, count) = without_gaps::<V>(s, enters.le(V::splat(s, t)).bitmask() & there);
            enters.permute(order).store(&mut self.enters[kept..]);
            children.permute(order).store(&mut self.children[kept..]);
            (at, kept) = (at + V::LANES, kept + count);
        }
        kept
    }
}

impl Slot {
    /// One step, to a node: where to go next.
    #[inline(always)]
    fn at_node<V: SimdF32, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        stacks: &mut Stacks,
    ) -> Child {
        let Some(node) = wide.nodes().get(self.child.first()) else { return Child::NONE };
        let (packet, frame) = self.ray.packet::<V>(s, self.hit.t);
        let Crossing { mask, enter } = robust::crossing(s, node, &packet, &frame, packet.tmax);
        let (children, enters, count) = node.in_order::<V>(s, mask, enter, self.ray.octant());
        let top = self.top as usize;
        children.store(&mut stacks.children[top..]);
        enters.store(&mut stacks.enters[top..]);
        self.go_on(s, wide, stacks, top + count)
    }

    /// Goes on with the uppermost of so many entries of the stacks.
    #[inline(always)]
    fn go_on<S: Simd, const N: usize>(
        &mut self,
        s: S,
        wide: &Wide<N>,
        stacks: &Stacks,
        end: usize,
    ) -> Child {
        let top = end - 1;
        let child = Child(stacks.children[top]);
        (self.top, self.child) = (top as u32, child);
        wide.prefetch_child(s, child);
        child
    }

    /// One step, to a leaf: where to go next.
    #[inline(always)]
    fn at_leaf<V: SimdF32, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        stacks: &mut Stacks,
        any: bool,
        i: usize,
        stats: &mut impl Counters,
    ) -> Child {
        let leaf = self.child.find().err();
        let blocks = leaf.as_ref().map_or(&[][..], |slots| wide.blocks(slots));
        let end = if let [block] = blocks {
            let (packet, frame) = self.ray.packet::<V>(s, self.hit.t);
            let triangles = BlockLanes::new(block, 0).without_early_out();
            let found = WithoutBox::test(s, &triangles, &packet, &frame, packet.tmax);
            stats.count(|stats| stats.triangle_tests += N as u64);
            match found {
                Some(found) if found.mask.any() => {
                    self.hold::<V, N>(s, block, &found, stacks, any, i)
                }
                _ => self.top as usize,
            }
        } else {
            self.test::<V, _, N>(s, wide, stacks, any, i, stats)
        };
        self.go_on(s, wide, stacks, end)
    }

    /// Records those of some hits that are in their triangles' own boxes; where the ray's entries of the
    /// stacks end then. Apart from the loop, which has more room in registers for it.
    #[inline(never)]
    fn hold<V: SimdF32, const N: usize>(
        &mut self,
        s: V::Simd,
        block: &RecordBlock<N>,
        found: &Found<V>,
        stacks: &mut Stacks,
        any: bool,
        i: usize,
    ) -> usize {
        s.vectorize(
            #[inline(always)]
            || {
                self.ask(
                    s,
                    stacks,
                    any,
                    i,
                    #[inline(always)]
                    |packet, frame, query| {
                        tri::hold(s, &BlockLanes::new(block, 0), packet, frame, query, *found);
                    },
                )
            },
        )
    }

    /// The same for all that is in the leaf, whatever it is, tested from the beginning.
    #[cold]
    #[inline(never)]
    fn test<V: SimdF32, C: Counters, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        stacks: &mut Stacks,
        any: bool,
        i: usize,
        stats: &mut C,
    ) -> usize {
        s.vectorize(
            #[inline(always)]
            || {
                let leaf = self.child.find().err().unwrap_or_default();
                self.ask::<V>(
                    s,
                    stacks,
                    any,
                    i,
                    #[inline(always)]
                    |packet, frame, query| {
                        wide::leaf(s, wide, &leaf, packet, frame, query, stats);
                    },
                )
            },
        )
    }

    /// Has the ray tested, and drops what is behind its hit.
    #[inline(always)]
    fn ask<V: SimdF32>(
        &mut self,
        s: V::Simd,
        stacks: &mut Stacks,
        any: bool,
        i: usize,
        test: impl FnOnce(&Packet<V>, &Coherent<V>, &mut Single<'_, V>),
    ) -> usize {
        let (packet, frame) = self.ray.packet::<V>(s, self.hit.t);
        let ask = if any { Ask::Any } else { Ask::Closest };
        let mut query = Single::from_hit(s, self.hit, ask);
        test(&packet, &frame, &mut query);
        self.hit = query.hit();
        let after = if query.done(s) { f32::NEG_INFINITY } else { self.hit.t };
        stacks.drop_after::<V>(s, i, self.top as usize, after)
    }
}
