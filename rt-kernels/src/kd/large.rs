//! Up to 64 rays together, with a segment for each.
//!
//! The rays agree in the signs of their directions, so they agree in which child comes first. The
//! distances of all rays to a split are between those that intervals of their origins and reciprocals
//! give, and where that interval is before or behind all segments, one child is gone on with and
//! nothing else is to do. Else the split is compared with the segment of each ray, in registers. A leaf
//! is tested against the registers in which some ray's segment is not empty. Where few rays are left,
//! they go on [one by one](super::traverse).
//!
//! **The answer** is that of single rays ([why](super#why-the-answer-is-one)): every ray goes to the
//! cells to which its own segment leads it, and perhaps to others; hits are those of the one triangle
//! test. Operations are monotone as they round, so that the ends of an interval bound the distances of
//! the rays as they are computed; where one is NaN, because a ray runs in the plane of a split, so is an
//! end of the interval, or it is infinite, and nothing is decided for all.
//!
//! For comparison: [packets of a register](super::traverse) take no more time.
//!
//! Source: Wald et al. 2001, Section 4; intervals: Reshetov, Soupikov, Hurley, "Multi-Level Ray Tracing
//! Algorithm", 2005, Section 3; Boulos, Wald, Shirley, "Geometric and Arithmetic Culling Methods for
//! Entire Ray Packets", 2006.

use simd4::scalar::f32x1;
use simd4::{Lanes, Scalar, Simd, SimdMask};

use super::build::MAX_DEPTH;
use super::layout::Node;
use super::traverse::{Cell, Stack, cells};
use super::{KdTree, WIDER};
use crate::Stats;
use crate::mailbox::Mail;
use crate::packet::{Ask, Beam, Bounds, Buckets, Chunk, Hits, LARGE, LargePacket, Rays, Single};
use crate::tri::edge_volumes::EdgeVolumes;
use crate::tri::{self, Watertight};

/// The most rays that go on one by one.
const FEW: u32 = 2;

/// A number for each ray.
type Column = [f32; LARGE];

/// The segments of all rays in a cell: those whose segment is empty are not there.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Segments {
    near: Column,
    far: Column,
}

/// A cell, the rays in it, and the least and the greatest ends of their segments, or what is beyond
/// those.
#[derive(Clone, Copy)]
struct Step {
    node: Node,
    rays: u64,
    near: f32,
    far: f32,
}

/// A cell that is still to be visited.
#[derive(Clone, Copy)]
struct Entry {
    step: Step,
    segments: Segments,
}

/// Finds the closest hits of all rays or, with `any`, whichever is found first. The tree is for the
/// default triangle test.
///
/// Neighbours go together as long as they are alike. Others wait in [`Buckets`] for those of their
/// class, wherever in the batch they are.
#[inline(always)]
pub(super) fn trace<S: Simd>(
    s: S,
    tree: &KdTree,
    rays: &Rays,
    any: bool,
    hits: &mut Hits,
    scratch: &mut Scratch<'_>,
    stats: &mut Stats,
) {
    let Scratch { chunk, buckets, mail, mail_alone, cells } = scratch;
    let mut first = 0;
    loop {
        let waited = buckets.take(rays, LARGE, first >= rays.len());
        if waited {
            chunk.load::<S::f32s>(s, buckets.rays(), 0, LARGE);
        } else if first < rays.len() {
            chunk.load::<S::f32s>(s, rays, first, LARGE);
            first += LARGE;
            if chunk.is_mixed() {
                chunk.store(hits, first - LARGE);
                buckets.put(chunk, first - LARGE);
                continue;
            }
        } else {
            break;
        }
        while let Some(class) = chunk.next_class() {
            let (packet, beam) = LargePacket::new::<S::f32s>(s, chunk, class, any);
            Traversal { s, tree, packet, mail, mail_alone, cells, alone: 0, stats }
                .trace(&beam, class.rays);
        }
        if waited {
            chunk.scatter(hits, buckets.places());
        } else {
            chunk.store(hits, first - LARGE);
        }
    }
}

/// What a traversal needs besides the rays; made before a level is chosen, as that of
/// [wide nodes](crate::bvh::traverse::large::Scratch) is.
pub(super) struct Scratch<'m> {
    chunk: Box<Chunk>,
    buckets: Buckets,
    mail: Mail<'m>,
    mail_alone: Mail<'m>,
    cells: Cells,
}

impl<'m> Scratch<'m> {
    /// Room for any rays in that tree.
    pub(super) fn new(tree: &'m KdTree) -> Self {
        let nowhere = Segments { near: [0.0; LARGE], far: [0.0; LARGE] };
        let step = Step { node: Node::default(), rays: 0, near: 0.0, far: 0.0 };
        let mail = || Mail::new(tree.plan.mailbox, &tree.stamps);
        Scratch {
            chunk: Box::new(Chunk::default()),
            buckets: Buckets::default(),
            mail: mail(),
            mail_alone: mail(),
            cells: Cells {
                now: nowhere,
                waiting: vec![Entry { step, segments: nowhere }; MAX_DEPTH],
                alone: Stack::new(Scalar::new()),
            },
        }
    }
}

/// Where a packet is and will be.
struct Cells {
    /// The segments in the present cell.
    now: Segments,
    /// Cells that are still to be visited, each the sibling of one above the present cell.
    waiting: Vec<Entry>,
    /// The same for one ray.
    alone: Stack<f32x1>,
}

/// Rays of one class on their way through a tree.
struct Traversal<'a, 'm, S: Simd> {
    s: S,
    tree: &'a KdTree,
    packet: LargePacket<'a>,
    mail: &'a mut Mail<'m>,
    mail_alone: &'a mut Mail<'m>,
    cells: &'a mut Cells,
    /// The rays that have gone on by themselves.
    alone: u64,
    stats: &'a mut Stats,
}

impl<S: Simd> Traversal<'_, '_, S> {
    /// Finds what those rays hit.
    #[inline(always)]
    fn trace(&mut self, beam: &Beam, rays: u64) {
        self.mail.next_packet();
        let planes = Planes::new(beam);
        let tree = self.tree;
        let root = tree.cells.pairs[0].0[0];
        self.enter(&planes, rays);
        let Some(mut step) = self.step(root, rays, f32::NEG_INFINITY) else { return };
        let mut top = 0;
        loop {
            let Step { node, rays, near, far } = step;
            if rays.count_ones() <= FEW {
                self.one_by_one(&planes, node, rays);
            } else if let Some(axis) = node.axis() {
                self.stats.node_visits += 1;
                let children = &tree.cells.pairs[node.pair()].0;
                let sign = planes.negative[axis] & 1;
                let [first, second] = [children[sign], children[1 - sign]];
                let [least, most] = planes.distances(axis, node.at());
                let (enter, leave) = (least * (1.0 - WIDER), most * (1.0 + WIDER));
                if enter > far {
                    step.node = first;
                    continue;
                }
                if leave < near {
                    step.node = second;
                    continue;
                }
                let [to_first, to_second] = self.split(axis, node.at(), rays, top);
                // A minimum or a maximum drops NaN.
                let in_first = Step { node: first, rays: to_first, near, far: far.min(leave) };
                let in_second = Step { node: second, rays: to_second, near: near.max(enter), far };
                step = match (to_first, to_second) {
                    // All segments are as they were.
                    (0, _) => in_second,
                    (_, 0) => in_first,
                    _ => {
                        self.part(rays, top);
                        self.cells.waiting[top].step = in_second;
                        top += 1;
                        in_first
                    }
                };
                continue;
            } else {
                self.stats.node_visits += 1;
                self.leaf(beam, node, rays);
            }
            step = loop {
                if top == 0 {
                    return;
                }
                top -= 1;
                if let Some(step) = self.resume(top) {
                    break step;
                }
            };
        }
    }

    /// The segments of those rays in the whole tree; all others are empty.
    #[inline(always)]
    fn enter(&mut self, planes: &Planes, rays: u64) {
        let s = self.s;
        let [sooner, later] = widened::<S>(s);
        for g in 0..self.packet.groups::<S::f32s>() {
            let (packet, _) = self.packet.group::<S::f32s>(s, g);
            let origin = [packet.origin.x, packet.origin.y, packet.origin.z];
            let inv = [packet.inv.x, packet.inv.y, packet.inv.z];
            let (mut near, mut far) = (packet.tmin, packet.tmax);
            for axis in 0..3 {
                let (sides, sign) = (self.tree.bounds.axes[axis], planes.negative[axis] & 1);
                let first = (S::f32s::splat(s, sides[sign]) - origin[axis]) * inv[axis];
                let last = (S::f32s::splat(s, sides[1 - sign]) - origin[axis]) * inv[axis];
                near = (first * sooner).max(near);
                far = (last * later).min(far);
            }
            put::<S>(&mut self.cells.now.near, g, near);
            put::<S>(&mut self.cells.now.far, g, far);
        }
        let mut others = !rays;
        while others != 0 {
            self.cells.now.near[others.trailing_zeros() as usize] = f32::INFINITY;
            others &= others - 1;
        }
    }

    /// What goes on to a cell with the segments as they are, none of which begins before `near`.
    #[inline(always)]
    fn step(&self, node: Node, rays: u64, near: f32) -> Option<Step> {
        let s = self.s;
        let mut least = S::f32s::splat(s, f32::INFINITY);
        let mut greatest = S::f32s::splat(s, f32::NEG_INFINITY);
        let mut left = 0;
        for g in 0..self.packet.groups::<S::f32s>() {
            if of_group::<S>(rays, g) == 0 {
                continue;
            }
            let begin = get::<S>(s, &self.cells.now.near, g);
            let end = get::<S>(s, &self.cells.now.far, g);
            let there = begin.le(end);
            left |= to_rays::<S>(there.bitmask(), g);
            least = there.select(begin, least).min(least);
            greatest = there.select(end, greatest).max(greatest);
        }
        let left = left & rays;
        let far = greatest.reduce_max();
        (left != 0).then(|| Step { node, rays: left, near: near.max(least.reduce_min()), far })
    }

    /// The rays that go to the child that comes first, and to the other. The ends of their segments
    /// there, and the beginnings here, are left in the entry that is free.
    #[inline(always)]
    fn split(&mut self, axis: usize, at: f32, rays: u64, free: usize) -> [u64; 2] {
        let s = self.s;
        let [sooner, later] = widened::<S>(s);
        let Cells { now, waiting, .. } = &mut *self.cells;
        let other = &mut waiting[free].segments;
        let at = S::f32s::splat(s, at);
        let mut to = [0; 2];
        for g in 0..self.packet.groups::<S::f32s>() {
            if of_group::<S>(rays, g) == 0 {
                continue;
            }
            let (near, far) = (get::<S>(s, &now.near, g), get::<S>(s, &now.far, g));
            let [origin, inv] = self.packet.along::<S::f32s>(s, g, axis);
            let split = (at - origin) * inv;
            let leave = (split * later).min(far);
            let enter = (split * sooner).max(near);
            to[0] |= to_rays::<S>(near.le(leave).bitmask(), g);
            to[1] |= to_rays::<S>(enter.le(far).bitmask(), g);
            put::<S>(&mut other.near, g, enter);
            put::<S>(&mut other.far, g, leave);
        }
        to.map(|to| to & rays)
    }

    /// Takes the segments of both children apart: those of the one that comes first are now.
    #[inline(always)]
    fn part(&mut self, rays: u64, free: usize) {
        let s = self.s;
        let Cells { now, waiting, .. } = &mut *self.cells;
        let other = &mut waiting[free].segments;
        for g in 0..self.packet.groups::<S::f32s>() {
            if of_group::<S>(rays, g) == 0 {
                continue;
            }
            let (leave, far) = (get::<S>(s, &other.far, g), get::<S>(s, &now.far, g));
            put::<S>(&mut other.far, g, far);
            put::<S>(&mut now.far, g, leave);
        }
    }

    /// Goes on with a cell that waited, with what it still matters to.
    #[inline(always)]
    fn resume(&mut self, top: usize) -> Option<Step> {
        let s = self.s;
        let Cells { now, waiting, .. } = &mut *self.cells;
        let Entry { step, segments } = &waiting[top];
        for g in 0..self.packet.groups::<S::f32s>() {
            if of_group::<S>(step.rays, g) == 0 {
                continue;
            }
            let far = get::<S>(s, &segments.far, g);
            put::<S>(&mut now.near, g, get::<S>(s, &segments.near, g));
            put::<S>(&mut now.far, g, far.min(self.packet.limit::<S::f32s>(s, g)));
        }
        let Step { node, rays, near, .. } = *step;
        self.step(node, rays, near)
    }

    /// Tests the primitives of a leaf, each against the registers of those rays.
    #[inline(always)]
    fn leaf(&mut self, beam: &Beam, node: Node, rays: u64) {
        let mut groups = 0;
        for g in 0..self.packet.groups::<S::f32s>() {
            groups |= u32::from(of_group::<S>(rays, g) != 0) << g;
        }
        let tree = self.tree;
        for &slot in &tree.cells.list[node.slots()] {
            let left = self.mail.untested(slot, groups);
            self.stats.mailed += u64::from((groups & !left).count_ones()) * S::LANES as u64;
            if left != 0 {
                self.test(beam, slot as usize, left);
            }
        }
    }

    /// Tests a primitive against those registers, with all their rays: they are not tested again.
    #[inline(always)]
    fn test(&mut self, beam: &Beam, slot: usize, mut groups: u32) {
        let (s, store) = (self.s, &self.tree.store);
        let Some(record) = store.triangle(slot) else {
            while groups != 0 {
                let g = groups.trailing_zeros() as usize;
                groups &= groups - 1;
                let (packet, frame) = self.packet.group::<S::f32s>(s, g);
                let mut query = self.packet.query::<S::f32s>(s, g);
                let (slots, stats) = (slot..slot + 1, &mut *self.stats);
                store
                    .intersect::<Watertight, _, _, _>(s, slots, &packet, &frame, &mut query, stats);
            }
            return;
        };
        self.stats.triangle_tests += u64::from(groups.count_ones()) * S::LANES as u64;
        if beam.has_apex() {
            let apex = beam.origin.map(|[origin, _]| origin);
            let volumes = EdgeVolumes::<S::f32x4>::new(s, record, beam, apex);
            if volumes.lanes == 0 {
                return;
            }
            let triangle = volumes.spread::<S::f32s>(s, 0);
            let mut may_hit = 0;
            while groups != 0 {
                let g = groups.trailing_zeros() as usize;
                groups &= groups - 1;
                let [x, y] = self.packet.slopes(s, g);
                may_hit |= u32::from(triangle.may_hit(x, y).any()) << g;
            }
            groups = may_hit;
        }
        while groups != 0 {
            let g = groups.trailing_zeros() as usize;
            groups &= groups - 1;
            let (packet, frame) = self.packet.group::<S::f32s>(s, g);
            let mut query = self.packet.query::<S::f32s>(s, g);
            tri::intersect::<Watertight, _, _, _, _>(s, record, &packet, &frame, &mut query);
        }
    }

    /// Rays go on from a cell, each by itself.
    #[inline(always)]
    fn one_by_one(&mut self, planes: &Planes, node: Node, mut rays: u64) {
        let s = Scalar::new();
        self.stats.rays_alone += u64::from((rays & !self.alone).count_ones());
        self.alone |= rays;
        while rays != 0 {
            let ray = rays.trailing_zeros() as usize;
            rays &= rays - 1;
            let (packet, frame) = self.packet.ray::<f32x1>(s, ray);
            let ask = if self.packet.any() { Ask::Any } else { Ask::Closest };
            let mut query = Single::from_hit(s, self.packet.hit(ray), ask);
            let Segments { near, far } = &self.cells.now;
            let (near, far) = (f32x1::splat(s, near[ray]), f32x1::splat(s, far[ray]));
            let cell = Cell { node, near, far };
            self.mail_alone.next_packet();
            cells(
                s,
                self.tree,
                &mut self.cells.alone,
                self.mail_alone,
                &packet,
                (&frame, planes.negative),
                cell,
                &mut query,
                self.stats,
            );
            self.packet.set_hit(ray, query.hit());
        }
    }
}

/// What is known of all rays, by axis: the signs of directions, and the intervals of origins and of the
/// reciprocals' magnitudes.
struct Planes {
    negative: [usize; 3],
    origin: [Bounds; 3],
    inv: [Bounds; 3],
}

impl Planes {
    #[inline(always)]
    fn new(beam: &Beam) -> Planes {
        let mut planes = Planes { negative: [0; 3], origin: [[0.0; 2]; 3], inv: [[0.0; 2]; 3] };
        for (i, axis) in beam.axes.into_iter().enumerate() {
            let axis = axis % 3;
            planes.negative[axis] = beam.negative[i].into();
            planes.origin[axis] = beam.origin[i];
            planes.inv[axis] = beam.inv[i];
        }
        planes
    }

    /// The least and the greatest distance to a plane across an axis; NaN, or without an end, if that
    /// of some ray is NaN.
    #[inline(always)]
    fn distances(&self, axis: usize, at: f32) -> Bounds {
        let ([first, last], [least, most]) = (self.origin[axis], self.inv[axis]);
        let [near, far] = match self.negative[axis] {
            0 => [at - last, at - first],
            _ => [first - at, last - at],
        };
        [near * if near < 0.0 { most } else { least }, far * if far < 0.0 { least } else { most }]
    }
}

/// By what distances are multiplied for the beginning and the end of a segment.
#[inline(always)]
fn widened<S: Simd>(s: S) -> [S::f32s; 2] {
    [S::f32s::splat(s, 1.0 - WIDER), S::f32s::splat(s, 1.0 + WIDER)]
}

/// The rays of a register, from its first lane on.
#[inline(always)]
fn of_group<S: Simd>(rays: u64, g: usize) -> u32 {
    (rays >> (g * S::LANES % LARGE)) as u32 & u32::MAX >> (32 - S::LANES)
}

/// The rays in those lanes of a register.
#[inline(always)]
fn to_rays<S: Simd>(lanes: u32, g: usize) -> u64 {
    u64::from(lanes) << (g * S::LANES % LARGE)
}

// The mask tells the compiler that the lanes are within the column.

#[inline(always)]
fn get<S: Simd>(s: S, column: &Column, g: usize) -> S::f32s {
    S::f32s::load(s, &column[(g * S::LANES) & (LARGE - S::LANES)..])
}

#[inline(always)]
fn put<S: Simd>(column: &mut Column, g: usize, lanes: S::f32s) {
    lanes.store(&mut column[(g * S::LANES) & (LARGE - S::LANES)..]);
}
