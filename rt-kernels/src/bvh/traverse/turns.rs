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
//! Hits wait until all rays at leaves have had their turn; with each, what is entered behind it is dropped
//! from the stack.
//!
//! **The answer** is that of every other traversal ([why](crate#why-the-answer-is-one)): boxes and
//! triangles are decided as by [one ray at a time](super::wide), and hits do not depend on the order of
//! visits.
//!
//! **The stacks** cannot overflow: as [there](super::wide), and some entries more, since all lanes are written.
//!
//! Source: Wald, Benthin, Boulos, "Getting Rid of Packets", 2008, for the nodes; the order of children by
//! octants is that of Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through
//! Compressed Wide BVHs", 2017, Section 3.2, with all eight orders in the node. The turns, and a step
//! without guesses, are worked out here.

use simd4::{Lanes, Scalar, Simd, SimdF32, SimdMask, SimdU32};

use super::wide;
use crate::bvh::layout::{Child, Wide, without_gaps};
use crate::packet::{Alone, Ask, Hits, Single};
use crate::slab::{Crossing, robust};
use crate::tri::{BlockLanes, Candidates, TriangleKernel, WithoutBox};
use crate::{Counters, Hit};

/// How many rays take turns: a bit for each in a `u32`.
const RAYS: usize = 32;

/// The rays that are on their way.
pub(crate) struct Turns {
    slots: Box<[Slot; RAYS]>,
    /// Where each goes next.
    next: [u32; RAYS],
    /// What was found in the leaf where each is.
    candidates: Box<[Candidates; RAYS]>,
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

/// What is in the stacks.
struct View<'a> {
    children: &'a mut [u32],
    enters: &'a mut [f32],
}

/// More entries than a step at a node looks at. That they are so many, and a power of two, tells the compiler
/// that all it looks at is there.
const MANY: usize = 16;

/// A ray on its way.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Slot {
    ray: Alone,
    /// What it has found.
    hit: Hit,
    /// The lowest of its entries in the stacks, which is none.
    bottom: u32,
    /// The uppermost, below its next child. What is above is of no account.
    top: u32,
    /// Its place in the batch.
    place: u32,
}

impl Turns {
    /// Room for any rays in that hierarchy.
    pub(crate) fn new<const N: usize>(wide: &Wide<N>) -> Self {
        let hit = Hit { t: 0.0, prim: Hits::NONE, u: 0.0, v: 0.0 };
        let slot = Slot { ray: Alone::default(), hit, bottom: 0, top: 0, place: 0 };
        let room = wide.depth() * (N - 1) + 2 * MANY;
        let (children, enters) = (vec![Child::NONE.0; RAYS * room], vec![0.0; RAYS * room]);
        let stacks = Stacks { children, enters, room };
        let next = [Child::NONE.0; RAYS];
        let candidates = Box::new([Candidates::default(); RAYS]);
        Turns { slots: Box::new([slot; RAYS]), next, candidates, stacks, at_nodes: 0, at_leaves: 0 }
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
        let bottom = (i * self.stacks.room) as u32;
        self.slots[i] = Slot { ray, hit, bottom, top: bottom, place: place as u32 };
        self.next[i] = child.0;
        let leaf = u32::from(child.is_leaf());
        self.at_nodes |= (leaf ^ 1) << i;
        self.at_leaves |= leaf << i;
    }

    /// All rays at nodes go one step; if there are enough at leaves, or none at nodes, so do those. The rays
    /// that are done then, each a bit for [`found`](Turns::found), are not among them any more.
    #[inline(always)]
    pub(crate) fn round<B: SimdF32, const N: usize>(
        &mut self,
        s: B::Simd,
        wide: &Wide<N>,
        any: bool,
        stats: &mut impl Counters,
    ) -> u32 {
        // Where a register has four lanes, half a node is all that there are registers for.
        match <B::Simd as Simd>::LANES {
            4 => self.steps::<<B::Simd as Simd>::f32x4, N>(s, wide, any, stats),
            _ => self.steps::<B, N>(s, wide, any, stats),
        }
    }

    #[inline(always)]
    fn steps<V: SimdF32, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        any: bool,
        stats: &mut impl Counters,
    ) -> u32 {
        let Turns { slots, next, candidates, stacks, at_nodes, at_leaves } = self;
        let (slots, candidates) = (&mut **slots, &mut **candidates);
        let mut stacks = stacks.view();
        let mut left = *at_nodes;
        while left != 0 {
            let i = left.trailing_zeros() as usize;
            left &= left - 1;
            stats.count(|stats| {
                stats.node_visits += 1;
                stats.active_rays += 1;
                stats.box_tests += N as u64;
            });
            next[i] = slots[i].at_node::<V, N>(s, wide, Child(next[i]), &mut stacks).0;
        }
        let [leaves, mut done] = find::<V>(s, next);
        done &= *at_nodes;
        *at_leaves |= *at_nodes & leaves & !done;
        *at_nodes &= !leaves;
        if *at_nodes == 0 || at_leaves.count_ones() as usize >= RAYS / 2 {
            // Hits are for later, all at once: a guess that was wrong costs what other rays have begun.
            let (mut left, mut hit) = (*at_leaves, 0);
            let mut leaf = [Child::NONE; RAYS];
            while left != 0 {
                let i = left.trailing_zeros() as usize;
                left &= left - 1;
                leaf[i] = Child(next[i]);
                hit |= slots[i].at_leaf::<V, N>(s, wide, leaf[i], &mut candidates[i], stats) << i;
                next[i] = slots[i].go_on(s, wide, &stacks).0;
            }
            while hit != 0 {
                let i = hit.trailing_zeros() as usize;
                hit &= hit - 1;
                // What it would have gone on with may be behind the hit.
                slots[i].top = slots[i].top.wrapping_add(1);
                slots[i].hold::<V, _, N>(s, wide, leaf[i], &candidates[i], &mut stacks, any, stats);
                next[i] = slots[i].go_on(s, wide, &stacks).0;
            }
            let [leaves, none] = find::<V>(s, next);
            done |= *at_leaves & none;
            *at_nodes |= *at_leaves & !leaves;
            *at_leaves &= leaves & !none;
        }
        done
    }

    /// The place of a ray, and what it has found; nothing better, if that is what it came with.
    #[inline(always)]
    pub(crate) fn found(&self, i: u32) -> (usize, Hit) {
        let slot = &self.slots[i as usize % RAYS];
        (slot.place as usize, slot.hit)
    }
}

/// The rays, each a bit, that go to a leaf next, or nowhere, and those that go nowhere.
#[inline(always)]
fn find<V: SimdF32>(s: V::Simd, next: &[u32; RAYS]) -> [u32; 2] {
    let (mut nodes, mut none) = (0, 0);
    for (i, next) in next.chunks_exact(V::LANES).enumerate() {
        let next = V::U32::load(s, next);
        let (low, zero) = (V::U32::splat(s, 15), V::U32::splat(s, 0));
        nodes |= (next & low).eq(zero).bitmask() << (i * V::LANES);
        none |= next.eq(V::U32::splat(s, Child::NONE.0)).bitmask() << (i * V::LANES);
    }
    [!nodes, none]
}

impl Stacks {
    /// What is in them.
    #[inline(always)]
    fn view(&mut self) -> View<'_> {
        // So the compiler knows: where the one has an entry, the other has.
        let len = self.children.len().min(self.enters.len());
        View { children: &mut self.children[..len], enters: &mut self.enters[..len] }
    }
}

impl View<'_> {
    /// Drops those entries above `bottom` and up to `top` that are entered after `t`, and says which is then
    /// the uppermost.
    #[inline(always)]
    fn drop_after<V: SimdF32>(&mut self, s: V::Simd, bottom: u32, top: u32, t: f32) -> u32 {
        let (first, end) = (bottom as usize + 1, top as usize + 1);
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
        kept as u32 - 1
    }
}

impl Slot {
    /// One step, to a node: where to go next.
    #[inline(always)]
    fn at_node<V: SimdF32, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        child: Child,
        stacks: &mut View<'_>,
    ) -> Child {
        let top = self.top as usize;
        let window = top..top + 2 * MANY;
        let (Some(node), Some(children), Some(enters)) = (
            wide.nodes().get(child.first()),
            stacks.children.get_mut(window.clone()),
            stacks.enters.get_mut(window),
        ) else {
            return Child::NONE;
        };
        let (packet, frame) = self.ray.packet::<V>(s, self.hit.t);
        let mut pushed = 0;
        for part in node.parts(self.ray.octant()).iter().take(N / V::LANES) {
            let Crossing { mask, enter } = robust::crossing(s, part, &packet, &frame, packet.tmax);
            let (some, at, count) = part.in_order::<V>(s, mask, enter);
            let end = pushed % MANY + 1;
            some.store(&mut children[end..]);
            at.store(&mut enters[end..]);
            pushed += count;
        }
        // If it is none of these, then what is below.
        let child = Child(children[pushed % MANY]);
        self.top = ((top + pushed) as u32).wrapping_sub(1);
        wide.prefetch_child(s, child);
        child
    }

    /// Goes on with the uppermost entry of its stack.
    #[inline(always)]
    fn go_on<S: Simd, const N: usize>(&mut self, s: S, wide: &Wide<N>, stacks: &View<'_>) -> Child {
        let child =
            stacks.children.get(self.top as usize).map_or(Child::NONE, |&child| Child(child));
        self.top = self.top.wrapping_sub(1);
        wide.prefetch_child(s, child);
        child
    }

    /// One step, to a leaf: 1 if something may be hit there.
    #[inline(always)]
    fn at_leaf<V: SimdF32, const N: usize>(
        &self,
        s: V::Simd,
        wide: &Wide<N>,
        child: Child,
        candidates: &mut Candidates,
        stats: &mut impl Counters,
    ) -> u32 {
        let leaf = child.find().err();
        let blocks = leaf.as_ref().map_or(&[][..], |slots| wide.blocks(slots));
        let [block] = blocks else { return 1 };
        stats.count(|stats| stats.triangle_tests += N as u64);
        let (packet, frame) = self.ray.packet::<V>(s, self.hit.t);
        candidates.lanes = 0;
        for first in (0..N).step_by(V::LANES) {
            let triangles = BlockLanes::new(block, first).without_early_out();
            if let Some(found) = WithoutBox::test(s, &triangles, &packet, &frame, packet.tmax) {
                candidates.put(first, &found);
            }
        }
        u32::from(candidates.lanes != 0)
    }

    /// Takes the best hit of the leaf. Apart from the loop, which has more room in registers for it.
    #[expect(clippy::too_many_arguments, reason = "strategies and state are arguments")]
    #[inline(never)]
    fn hold<V: SimdF32, C: Counters, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        child: Child,
        candidates: &Candidates,
        stacks: &mut View<'_>,
        any: bool,
        stats: &mut C,
    ) {
        s.vectorize(
            #[inline(always)]
            || {
                let leaf = child.find().err().unwrap_or_default();
                if let [block] = wide.blocks(&leaf) {
                    let (packet, frame) = self.ray.packet(Scalar::new(), self.hit.t);
                    candidates.hold(block, &packet, &frame, &mut self.hit);
                } else {
                    // Several blocks, or what is no triangle.
                    let (packet, frame) = self.ray.packet::<V>(s, self.hit.t);
                    let ask = if any { Ask::Any } else { Ask::Closest };
                    let mut query = Single::from_hit(s, self.hit, ask);
                    wide::leaf(s, wide, &leaf, &packet, &frame, &mut query, stats);
                    self.hit = query.hit();
                }
                self.drop_behind::<V>(s, stacks, any);
            },
        );
    }

    /// Drops what is behind the ray's hit, or all if any hit is enough.
    #[inline(always)]
    fn drop_behind<V: SimdF32>(&mut self, s: V::Simd, stacks: &mut View<'_>, any: bool) {
        let done = any && self.hit.prim != Hits::NONE;
        let after = if done { f32::NEG_INFINITY } else { self.hit.t };
        self.top = stacks.drop_after::<V>(s, self.bottom, self.top, after);
    }
}
