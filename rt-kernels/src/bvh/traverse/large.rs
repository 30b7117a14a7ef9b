//! Up to 64 rays together over nodes of N children, from near to far.
//!
//! The children of a node are tested at once against all rays ([`Beam`]); those that are left, and that
//! not all rays pass, ray by ray. Each child goes on with the rays that may hit it, a bit for each, and
//! where it is entered first. What was found closer since then drops rays, and with the last of them the child. In a
//! leaf, rays with a common origin are filtered by [`EdgeVolumes`] before the triangle test. Where few
//! are left, each goes on by itself, and they take [turns](super::turns): a ray that is on its way is
//! still among the others, and goes no second way before it is back.
//!
//! **The answer** is that of every other traversal ([why](crate#why-the-answer-is-one)): a ray is left
//! out only where it misses the box by the slab test, or enters it after its bound, or where the
//! triangle test would reject it; all hits are those of the one triangle test. To go on with more rays
//! than need be, or in another order, changes nothing.
//!
//! **The stack** cannot overflow: of a node's children, at most N, one is gone on with, and the
//! others are put on it.
//!
//! Source: Wald, Boulos, Shirley, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume
//! Hierarchies", 2007; Overbeck, Ramamoorthi, Mark, "Large Ray Packets for Real-time Whitted Ray
//! Tracing", 2008; Benthin, Wald, "Efficient Ray Traced Soft Shadows using Multi-Frusta Tracing", 2009.

use std::ops::Range;

use simd4::{Lanes, Scalar, Simd, SimdF32, SimdMask};

use super::turns::Turns;
use super::way::{Pyramid, Spread, Way};
use super::wide;
use crate::Counters;
use crate::bvh::layout::{Child, Wide, WideNode};
use crate::packet::{Ask, Beam, Chunk, Hits, LARGE, LargePacket, Rays, Single};
use crate::quadric::{cone, sphere};
use crate::slab::pyramid::Culling;
use crate::tri::edge_volumes::EdgeVolumes;
use crate::tri::{
    self, BlockLanes, Candidates, OwnBoxLanes, RecordBlock, TriangleKernel, Watertight, WithoutBox,
};

/// Rays, and where to put what they hit.
pub(crate) struct Batch<'a> {
    pub(crate) rays: &'a Rays,
    /// How many may go together, up to [`LARGE`].
    pub(crate) most: usize,
    /// Whether one hit is enough, and not the closest wanted.
    pub(crate) any: bool,
    pub(crate) hits: &'a mut Hits,
}

/// What a traversal needs besides the rays. Made before a level is chosen: where nothing is to be
/// dropped, no operation of a level needs a way out, and the compiler has less to do.
pub(crate) struct Scratch {
    chunk: Box<Chunk>,
    turns: Turns,
    large: Vec<Entry>,
}

/// A child that is still to be visited.
#[derive(Clone, Copy)]
struct Entry {
    child: Child,
    /// No ray enters it before.
    enter: f32,
    /// The rays that may hit it.
    rays: u64,
}

impl Scratch {
    /// Room for any rays in that hierarchy.
    pub(crate) fn new<const N: usize>(wide: &Wide<N>) -> Self {
        let entry = Entry { child: Child::ROOT, enter: 0.0, rays: 0 };
        let large = vec![entry; wide.depth() * (N - 1) + 1];
        let (chunk, turns) = (Box::new(Chunk::default()), Turns::new(wide));
        Scratch { chunk, turns, large }
    }
}

/// Finds what a batch of rays hits. `B` has a lane for each child.
///
/// Neighbours go together as long as they are alike. Others take [turns](super::turns).
#[inline(always)]
pub(crate) fn trace<S: Simd, B: SimdF32<Simd = S>, C: Counters, const N: usize>(
    s: S,
    wide: &Wide<N>,
    batch: Batch<'_>,
    scratch: &mut Scratch,
    stats: &mut C,
) {
    let Batch { rays, most, any, hits } = batch;
    let mut done = C::default();
    let Scratch { chunk, turns, large } = scratch;
    let mut first = 0;
    while first < rays.len() {
        chunk.load::<S::f32s>(s, rays, first, most);
        if chunk.is_mixed() {
            chunk.store(hits, first);
            let mut left = chunk.take_alone::<S::f32s>(s);
            done.count(|stats| stats.rays_alone += u64::from(left.count_ones()));
            while left != 0 {
                while turns.full() {
                    take(turns.round::<B, N>(s, wide, any, &mut done), turns, hits);
                }
                let ray = left.trailing_zeros() as usize;
                left &= left - 1;
                turns.put(Child::ROOT, chunk.alone(ray), chunk.hit(ray), first + ray);
            }
        } else {
            while let Some(class) = chunk.next_class() {
                let (packet, beam) = LargePacket::new::<S::f32s>(s, chunk, class, any);
                let (large, turns, hits, stats) =
                    (&mut **large, &mut *turns, &mut *hits, &mut done);
                let (alone, on_way) = (0, 0);
                Traversal {
                    s,
                    wide,
                    large,
                    turns,
                    packet,
                    most,
                    first,
                    hits,
                    alone,
                    on_way,
                    stats,
                }
                .trace::<B>(&beam, class.rays);
            }
            chunk.store(hits, first);
        }
        first += most;
    }
    while !turns.empty() {
        take(turns.round::<B, N>(s, wide, any, &mut done), turns, hits);
    }
    *stats += done;
}

/// Takes what rays have found that are done with their turns, each a bit.
#[inline(always)]
fn take(mut done: u32, turns: &Turns, hits: &mut Hits) {
    while done != 0 {
        let (place, hit) = turns.found(done.trailing_zeros());
        done &= done - 1;
        hits.take(place, hit);
    }
}

/// Rays of one class on their way through a hierarchy.
pub(super) struct Traversal<'a, S: Simd, C: Counters, const N: usize> {
    pub(super) s: S,
    pub(super) wide: &'a Wide<N>,
    large: &'a mut [Entry],
    turns: &'a mut Turns,
    pub(super) packet: LargePacket<'a>,
    /// How many rays may go together, of which few are half at most.
    most: usize,
    /// The first ray's place in the batch.
    first: usize,
    /// What is found of rays of chunks before, which are still taking turns.
    hits: &'a mut Hits,
    /// The rays that have gone on by themselves, and those that are on their way.
    alone: u64,
    on_way: u64,
    pub(super) stats: &'a mut C,
}

impl<S: Simd, C: Counters, const N: usize> Traversal<'_, S, C, N> {
    /// Finds what those rays hit.
    #[inline(always)]
    fn trace<B: SimdF32<Simd = S>>(&mut self, beam: &Beam, rays: u64) {
        if beam.has_apex() {
            self.run::<B, Pyramid>(&Culling::new(beam), rays);
        } else {
            self.run::<B, Spread>(&Culling::new(beam), rays);
        }
    }

    /// Finds what those rays hit. Where so few are left below a node, they go on one by one.
    #[inline(always)]
    fn run<B: SimdF32<Simd = S>, W: Way>(&mut self, culling: &Culling, rays: u64) {
        let wide = self.wide;
        let few = W::FEW.min(self.most as u32 / 2);
        let mut next = Entry { child: Child::ROOT, enter: 0.0, rays };
        let mut limit = f32::INFINITY;
        // The entries below may have been overtaken by hits.
        let (mut top, mut overtaken) = (0, 1);
        loop {
            let mut rays = next.rays;
            if top < overtaken {
                (rays, limit) = self.active(&next);
                overtaken = top;
            }
            match next.child.find() {
                Ok(_) if rays.count_ones() <= few => {
                    self.one_by_one::<B>(next.child, rays);
                    overtaken = top;
                }
                Err(slots) => {
                    match rays.count_ones() <= W::FEW_IN_LEAF {
                        true => self.leaf_one_by_one::<B>(&slots, rays),
                        false => self.leaf::<B>(culling, &slots, rays),
                    }
                    overtaken = top;
                }
                Ok(node) => {
                    let Some(node) = wide.nodes().get(node) else { break };
                    self.stats.count(|stats| stats.node_visits += 1);
                    self.stats.count(|stats| stats.active_rays += u64::from(rays.count_ones()));
                    let Children { mut lanes, enter, rays } =
                        self.children::<B, W>(culling, node, rays, limit);
                    let first = top;
                    while lanes != 0 {
                        let lane = lanes.trailing_zeros() as usize & (N - 1);
                        lanes &= lanes - 1;
                        let (child, enter) = (node.child(lane), enter.as_ref()[lane]);
                        // The nearer the higher.
                        let mut at = top;
                        while at > first && self.large[at - 1].enter < enter {
                            self.large[at] = self.large[at - 1];
                            at -= 1;
                        }
                        self.large[at] = Entry { child, enter, rays: rays[lane] };
                        top += 1;
                    }
                }
            }
            if top == 0 {
                break;
            }
            top -= 1;
            next = self.large[top];
        }
    }

    /// The rays of an entry to which it still matters, and the greatest `t` that does to any.
    #[inline(always)]
    fn active(&self, entry: &Entry) -> (u64, f32) {
        let s = self.s;
        let enter = S::f32s::splat(s, entry.enter);
        let mut greatest = S::f32s::splat(s, f32::NEG_INFINITY);
        let mut rays = 0;
        for first in registers::<S>(entry.rays) {
            let limit = self.packet.limit::<S::f32s>(s, first / S::LANES);
            rays |= u64::from(limit.ge(enter).bitmask()) << first;
            greatest = greatest.max(limit);
        }
        (rays & entry.rays, greatest.reduce_max())
    }

    /// The children that some of the rays may hit with `t <= limit`, which is the greatest of all.
    #[inline(always)]
    fn children<B: SimdF32<Simd = S>, W: Way>(
        &mut self,
        culling: &Culling,
        node: &WideNode<N>,
        rays: u64,
        limit: f32,
    ) -> Children<B, N> {
        let s = self.s;
        let (mask, all, enter, seen) = W::candidates::<B, N>(s, culling, node, limit);
        let mut left = mask.bitmask();
        self.wide.prefetch(s, node, left);
        let mut children = Children { lanes: 0, enter: enter.to_array(), rays: [0; N] };
        while left != 0 {
            let lane = left.trailing_zeros() as usize & (N - 1);
            left &= left - 1;
            if all >> lane & 1 == 1 {
                children.add(lane, rays);
                continue;
            }
            let one = W::one::<B, S::f32s, N>(s, node, &seen, lane);
            let mut passing = 0;
            for first in registers::<S>(rays) {
                self.stats.count(|stats| stats.box_tests += S::LANES as u64);
                let may_hit = W::may_hit(s, &one, &self.packet, first / S::LANES);
                passing |= u64::from(may_hit.bitmask()) << first;
            }
            children.add(lane, passing & rays);
        }
        children
    }

    /// Tests rays with one origin against the primitives of a leaf.
    #[inline(always)]
    fn leaf<B: SimdF32<Simd = S>>(&mut self, culling: &Culling, slots: &Range<usize>, rays: u64) {
        let (s, wide) = (self.s, self.wide);
        for block in wide.blocks(slots) {
            let lanes = BlockLanes::new(block, 0);
            let volumes = EdgeVolumes::<B>::new(s, &lanes, culling.beam, culling.apex());
            // The rays that are not certain to miss each triangle.
            let mut passing = [0; N];
            let (mut left, mut some) = (volumes.lanes, 0);
            while left != 0 {
                let lane = left.trailing_zeros() as usize & (N - 1);
                left &= left - 1;
                let triangle = volumes.spread::<S::f32s>(s, lane);
                for first in registers::<S>(rays) {
                    self.stats.count(|stats| stats.triangle_tests += S::LANES as u64);
                    let [x, y] = self.packet.slopes(s, first / S::LANES);
                    passing[lane] |= u64::from(triangle.may_hit(x, y).bitmask()) << first;
                }
                passing[lane] &= rays;
                some |= u32::from(passing[lane] != 0) << lane;
            }
            if some == 0 {
                continue;
            }
            let own_boxes = OwnBoxLanes::<B>::new(s, &lanes);
            while some != 0 {
                let lane = some.trailing_zeros() as usize & (N - 1);
                some &= some - 1;
                let record = own_boxes.one(block, lane);
                for g in registers::<S>(passing[lane]).map(|first| first / S::LANES) {
                    let (packet, frame) = self.packet.group::<S::f32s>(s, g);
                    let mut query = self.packet.query::<S::f32s>(s, g);
                    tri::intersect::<Watertight, _, _, _, _>(
                        s, &record, &packet, &frame, &mut query,
                    );
                }
            }
        }
        for record in wide.spheres(slots) {
            for g in registers::<S>(rays).map(|first| first / S::LANES) {
                self.stats.count(|stats| stats.sphere_tests += S::LANES as u64);
                let (packet, frame) = self.packet.group::<S::f32s>(s, g);
                sphere::intersect(s, record, &packet, &frame, &mut self.packet.query(s, g));
            }
        }
        for record in wide.cones(slots) {
            for g in registers::<S>(rays).map(|first| first / S::LANES) {
                self.stats.count(|stats| stats.cone_tests += S::LANES as u64);
                let (packet, frame) = self.packet.group::<S::f32s>(s, g);
                cone::intersect(s, record, &packet, &frame, &mut self.packet.query(s, g));
            }
        }
    }

    /// Rays go on from a child, each by itself, while it is others' turn too.
    #[inline(always)]
    fn one_by_one<B: SimdF32<Simd = S>>(&mut self, child: Child, mut rays: u64) {
        self.count_alone(rays);
        while rays != 0 {
            let ray = rays.trailing_zeros() as usize;
            // What it finds on one way spares it others.
            while self.turns.full() || self.on_way >> ray & 1 == 1 {
                self.round::<B>();
            }
            rays &= rays - 1;
            self.on_way |= 1 << ray;
            let (alone, hit) = self.packet.alone(ray);
            self.turns.put(child, alone, hit, self.first + ray);
        }
    }

    /// Tests rays against the primitives of a leaf one by one.
    #[inline(always)]
    fn leaf_one_by_one<B: SimdF32<Simd = S>>(&mut self, slots: &Range<usize>, mut rays: u64) {
        self.count_alone(rays);
        let (s, wide) = (self.s, self.wide);
        for block in wide.blocks(slots) {
            match S::LANES {
                4 => self.block_one_by_one::<S::f32x4>(block, rays),
                _ => self.block_one_by_one::<B>(block, rays),
            }
        }
        if !wide.blocks(slots).is_empty() {
            return;
        }
        while rays != 0 {
            let ray = rays.trailing_zeros() as usize;
            rays &= rays - 1;
            let (packet, frame) = self.packet.ray::<B>(s, ray);
            let ask = if self.packet.any() { Ask::Any } else { Ask::Closest };
            let mut query = Single::from_hit(s, self.packet.hit(ray), ask);
            wide::leaf(s, wide, slots, &packet, &frame, &mut query, self.stats);
            self.packet.set_hit(ray, query.hit());
        }
    }

    /// Tests rays against the triangles of a block one by one.
    #[inline(always)]
    fn block_one_by_one<V: SimdF32<Simd = S>>(&mut self, block: &RecordBlock<N>, mut rays: u64) {
        let s = self.s;
        while rays != 0 {
            let ray = rays.trailing_zeros() as usize;
            rays &= rays - 1;
            self.stats.count(|stats| stats.triangle_tests += N as u64);
            let (packet, frame) = self.packet.ray::<V>(s, ray);
            let mut candidates = Candidates::default();
            for part in 0..N / V::LANES {
                let triangles = BlockLanes::new(block, part * V::LANES);
                if let Some(found) = WithoutBox::test(s, &triangles, &packet, &frame, packet.tmax)
                    && found.mask.any()
                {
                    candidates.put(part * V::LANES, &found);
                }
            }
            if candidates.lanes != 0 {
                let (packet, frame) = self.packet.ray(Scalar::new(), ray);
                let mut hit = self.packet.hit(ray);
                candidates.hold(block, &packet, &frame, &mut hit);
                self.packet.set_hit(ray, hit);
            }
        }
    }

    /// Counts those rays that go by themselves for the first time.
    #[inline(always)]
    fn count_alone(&mut self, rays: u64) {
        let new = rays & !self.alone;
        self.alone |= rays;
        self.stats.count(|stats| stats.rays_alone += u64::from(new.count_ones()));
    }

    /// All rays by themselves have their turn.
    #[inline(always)]
    fn round<B: SimdF32<Simd = S>>(&mut self) {
        let any = self.packet.any();
        let mut done = self.turns.round::<B, N>(self.s, self.wide, any, self.stats);
        while done != 0 {
            let (place, hit) = self.turns.found(done.trailing_zeros());
            done &= done - 1;
            match place.checked_sub(self.first) {
                Some(ray) => {
                    self.on_way &= !(1 << ray);
                    self.packet.take(ray, hit);
                }
                None => self.hits.take(place, hit),
            }
        }
    }
}

/// The children of a node that some rays may hit.
struct Children<B: SimdF32, const N: usize> {
    lanes: u32,
    /// No ray enters a child before.
    enter: B::Array,
    /// The rays, by child.
    rays: [u64; N],
}

impl<B: SimdF32, const N: usize> Children<B, N> {
    /// Adds a child, if there are rays for it.
    #[inline(always)]
    fn add(&mut self, lane: usize, rays: u64) {
        self.rays[lane] = rays;
        self.lanes |= u32::from(rays != 0) << lane;
    }
}

/// The first lanes of the registers that have some of the rays.
#[inline(always)]
fn registers<S: Simd>(rays: u64) -> impl Iterator<Item = usize> {
    // To the lowest bit of each register come all of its bits.
    let (mut left, mut shift) = (rays, 1);
    while shift < S::LANES {
        left |= left >> shift;
        shift *= 2;
    }
    left &= u64::MAX / (u64::MAX >> (LARGE - S::LANES));
    std::iter::from_fn(move || {
        let first = left.trailing_zeros() as usize;
        (left != 0).then(|| {
            left &= left - 1;
            first % LARGE
        })
    })
}
