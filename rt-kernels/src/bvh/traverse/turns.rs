//! Rays that take turns over nodes of N children.
//!
//! What a ray does next depends on what its last step has found: it waits for memory, for a chain of
//! operations, and again wherever a branch was guessed wrong. So many rays are on their way at once. Each
//! goes one step, to one node or one leaf, and sends for what comes next; then it is another's turn. A
//! step has no branch that would be a guess, but for hits, so that the CPU is at work on the steps of
//! several rays at a time.
//!
//! A node's children that a ray may hit are put on its stack all at once, in the order that the node
//! [guesses](WideNode::in_order) for rays of that octant, and the uppermost is where it goes next.
//! Nothing is dropped unvisited: to visit a node in vain takes less time than to guess whether.
//!
//! **The answer** is that of every other traversal ([why](crate#why-the-answer-is-one)): boxes and
//! triangles are decided as by [one ray at a time](super::wide), and hits do not depend on the order of
//! visits.
//!
//! **The stacks** cannot overflow: as [there](super::wide), and N entries more, since all lanes are written.
//!
//! Source: Wald, Benthin, Boulos, "Getting Rid of Packets", 2008, for the nodes; the order by octants is
//! that of Garanzha and Loop, "Fast Ray Sorting and Breadth-First Packet Traversal for GPU Ray Tracing",
//! 2010. To take turns is Wald's, Slusallek's and others' in "Embree"'s streams turned round: rays are not
//! sorted, but interleaved.

use simd4::{Lanes, Simd, SimdF32, SimdMask};

use super::wide;
use crate::bvh::layout::{Child, Wide};
use crate::packet::{Alone, Ask, Hits, Query, Single};
use crate::slab::robust;
use crate::tri::knobs::{Division, Plain};
use crate::tri::{BlockLanes, TriangleKernel, Watertight};
use crate::{Counters, Hit};

/// How many rays take turns: a bit for each in a `u32`.
const RAYS: usize = 32;

/// What a hit is before it is held in its triangle's own box.
type WithoutBox = Watertight<Division, Plain, true, false>;

/// The rays that are on their way.
pub(crate) struct Turns {
    slots: Box<[Slot; RAYS]>,
    /// Of each slot the children that are still to be visited, above one that is none.
    stacks: Vec<u32>,
    /// The rays whose next child is a node, and those where it is a leaf.
    at_nodes: u32,
    at_leaves: u32,
}

/// A ray on its way.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Slot {
    /// What it has found.
    hit: Hit,
    /// Where its next child came from in the stacks.
    top: u32,
    /// Where it goes next.
    child: u32,
    /// Its place in the batch.
    place: u32,
    ray: Alone,
}

impl Turns {
    /// Room for any rays in that hierarchy.
    pub(crate) fn new<const N: usize>(wide: &Wide<N>) -> Self {
        let hit = Hit { t: 0.0, prim: Hits::NONE, u: 0.0, v: 0.0 };
        let slot = Slot { hit, top: 0, child: 0, place: 0, ray: Alone::default() };
        let stacks = vec![Child::NONE.0; RAYS * room(wide)];
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

    /// Puts a ray among them, unless they are [full](Turns::full). `place` is where its hit goes.
    #[inline(always)]
    pub(crate) fn put<const N: usize>(
        &mut self,
        wide: &Wide<N>,
        ray: Alone,
        tmax: f32,
        place: usize,
    ) {
        let free = !(self.at_nodes | self.at_leaves);
        let i = free.trailing_zeros() as usize % RAYS;
        let hit = Hit { t: tmax, prim: Hits::NONE, u: 0.0, v: 0.0 };
        let (top, Child(child)) = ((i * room(wide)) as u32, Child::ROOT);
        self.slots[i] = Slot { hit, top: top + 1, child, place: place as u32, ray };
        self.at_nodes |= 1 << i;
    }

    /// All rays at nodes go one step; if there are enough at leaves, or none at nodes, so do those. What
    /// rays have found that are done goes to `hits`.
    #[inline(always)]
    pub(crate) fn round<V: SimdF32, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        any: bool,
        hits: &mut Hits,
        stats: &mut impl Counters,
    ) {
        let (slots, stacks) = (&mut *self.slots, &mut *self.stacks);
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
            let Child(child) = slots[i].at_node::<V, N>(s, wide, stacks);
            at_leaves |= u32::from(child & 15 != 0) << i;
            done |= u32::from(child == Child::NONE.0) << i;
        }
        at_nodes &= !at_leaves;
        at_leaves &= !done;
        if at_nodes == 0 || at_leaves.count_ones() as usize >= RAYS / 4 {
            let mut left = at_leaves;
            (at_nodes, at_leaves) = (at_nodes | left, 0);
            while left != 0 {
                let i = left.trailing_zeros() as usize;
                left &= left - 1;
                let Child(child) = slots[i].at_leaf::<V, N>(s, wide, stacks, any, i, stats);
                at_leaves |= u32::from(child & 15 != 0) << i;
                done |= u32::from(child == Child::NONE.0) << i;
            }
            at_nodes &= !at_leaves;
            at_leaves &= !done;
        }
        (self.at_nodes, self.at_leaves) = (at_nodes, at_leaves);
        while done != 0 {
            let slot = &slots[done.trailing_zeros() as usize];
            done &= done - 1;
            hits.set(slot.place as usize, slot.hit);
        }
    }
}

/// How many entries of the stacks are one ray's.
#[inline(always)]
fn room<const N: usize>(wide: &Wide<N>) -> usize {
    1 + wide.depth() * (N - 1) + N
}

impl Slot {
    /// One step, to a node: where to go next.
    #[inline(always)]
    fn at_node<V: SimdF32, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        stacks: &mut [u32],
    ) -> Child {
        let Some(node) = wide.nodes().get((self.child >> 4) as usize) else { return Child::NONE };
        let (packet, frame) = self.ray.packet::<V>(s, self.hit.t);
        let mask = robust::may_hit(s, node, &packet, &frame, packet.tmax);
        let (children, count) = node.in_order::<V>(s, mask, self.ray.octant());
        let top = self.top as usize;
        children.store(&mut stacks[top..]);
        self.go_on(s, wide, stacks, top + count)
    }

    /// Goes on with the uppermost of so many entries of the stacks.
    #[inline(always)]
    fn go_on<S: Simd, const N: usize>(
        &mut self,
        s: S,
        wide: &Wide<N>,
        stacks: &[u32],
        end: usize,
    ) -> Child {
        let top = end - 1;
        let child = Child(stacks[top]);
        (self.top, self.child) = (top as u32, child.0);
        wide.prefetch_child(s, child);
        child
    }

    /// One step, to a leaf: where to go next.
    #[inline(always)]
    fn at_leaf<V: SimdF32, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        stacks: &[u32],
        any: bool,
        i: usize,
        stats: &mut impl Counters,
    ) -> Child {
        let mut end = self.top as usize;
        if self.may_hit::<V, N>(s, wide) {
            if self.test::<V, _, N>(s, wide, any, stats) {
                end = i * room(wide) + 1;
            }
        } else {
            stats.count(|stats| stats.triangle_tests += N as u64);
        }
        self.go_on(s, wide, stacks, end)
    }

    /// Whether the ray may hit something in the leaf: no, if it is one block of triangles, and the ray
    /// hits none of them but for their own boxes.
    #[inline(always)]
    fn may_hit<V: SimdF32, const N: usize>(&self, s: V::Simd, wide: &Wide<N>) -> bool {
        let Err(slots) = Child(self.child).find() else { return true };
        let [block] = wide.blocks(&slots) else { return true };
        let (packet, frame) = self.ray.packet::<V>(s, self.hit.t);
        let triangles = BlockLanes::new(block, 0);
        let found = WithoutBox::test(s, &triangles, &packet, &frame, packet.tmax);
        found.is_some_and(|found| found.mask.any())
    }

    /// Tests the ray against all that is in the leaf; whether it has all that it asks for. Apart from the
    /// loop, which has more room in registers for it.
    #[cold]
    #[inline(never)]
    fn test<V: SimdF32, C: Counters, const N: usize>(
        &mut self,
        s: V::Simd,
        wide: &Wide<N>,
        any: bool,
        stats: &mut C,
    ) -> bool {
        s.vectorize(
            #[inline(always)]
            || {
                let (packet, frame) = self.ray.packet::<V>(s, self.hit.t);
                let ask = if any { Ask::Any } else { Ask::Closest };
                let mut query = Single::from_hit(s, self.hit, ask);
                if let Err(slots) = Child(self.child).find() {
                    wide::leaf(s, wide, &slots, &packet, &frame, &mut query, stats);
                }
                self.hit = query.hit();
                query.done(s)
            },
        )
    }
}
