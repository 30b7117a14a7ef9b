//! Many rays against many boxes, one by one: the loop that tests, benches and charts share.

use simd4::math::Vec3;
use simd4::{Block16, Lanes, Simd, SimdF32, SimdMask, dispatch, scalar};

use super::shared_origin::{common, from_origin, seen_from};
use super::{BoxKernel, Crossing};
use crate::catalogue::{Shape, Way};
use crate::geom::Aabb;
use crate::packet::{Frame, OwnBoxes, Packet, Rays};
use crate::tri::knobs::Reciprocal;

/// Boxes for every [`Shape`].
#[derive(Clone, Debug)]
pub struct BoxSet {
    boxes: Vec<Aabb>,
    blocks: Vec<BoxBlock>,
}

impl BoxSet {
    /// Of these boxes.
    pub fn new(boxes: &[Aabb]) -> BoxSet {
        let blocks = boxes.chunks(BoxBlock::LANES).map(BoxBlock::new).collect();
        BoxSet { boxes: boxes.to_vec(), blocks }
    }
}

/// Sixteen boxes by side (SoA).
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct BoxBlock {
    axes: [[Block16<f32>; 2]; 3],
}

impl BoxBlock {
    const LANES: usize = 16;

    /// At most sixteen; what the rest of the block is does not matter.
    fn new(boxes: &[Aabb]) -> BoxBlock {
        let mut axes = Aabb::EMPTY.axes.map(|axis| axis.map(|side| Block16([side; 16])));
        for (lane, aabb) in boxes.iter().enumerate() {
            for (sides, from) in axes.iter_mut().zip(aabb.axes) {
                for (side, from) in sides.iter_mut().zip(from) {
                    side[lane] = from;
                }
            }
        }
        BoxBlock { axes }
    }

    /// The boxes from `first` on, which is a multiple of the number of lanes.
    #[inline(always)]
    fn lanes<V: SimdF32>(&self, s: V::Simd, first: usize) -> OwnBoxes<V> {
        let [x, y, z] = &self.axes;
        OwnBoxes([sides(s, x, first), sides(s, y, first), sides(s, z, first)])
    }
}

#[inline(always)]
fn sides<V: SimdF32>(s: V::Simd, [low, high]: &[Block16<f32>; 2], first: usize) -> [V; 2] {
    // The mask tells the compiler that the lanes are within the block.
    let first = first & (BoxBlock::LANES - V::LANES);
    [V::load(s, &low.0[first..]), V::load(s, &high.0[first..])]
}

/// What became of a batch of rays, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Crossings {
    count: Vec<u32>,
    enter: Vec<f32>,
}

impl Crossings {
    /// No rays.
    pub fn new() -> Self {
        Crossings::default()
    }

    /// The number of rays.
    pub fn len(&self) -> usize {
        self.count.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count.is_empty()
    }

    /// How many boxes the ray of that number may hit, and the least of the distances at which it
    /// enters one, or starts in it.
    ///
    /// # Panics
    /// If there is no such ray.
    pub fn get(&self, i: usize) -> (u32, f32) {
        (self.count[i], self.enter[i])
    }

    fn resize(&mut self, n: usize) {
        self.count.resize(n, 0);
        self.enter.resize(n, 0.0);
    }
}

/// Shows every box to every ray.
pub(super) fn cross<K: BoxKernel>(way: Way, boxes: &BoxSet, rays: &Rays, to: &mut Crossings) {
    to.resize(rays.len());
    match way.shape {
        Shape::One => rays_in_lanes::<K, scalar::f32x1>(simd4::Scalar::new(), boxes, rays, to),
        _ if !runs::<K>(way) => panic!("{} does not run at {}", K::NAME, way.level),
        Shape::Rays => dispatch!(way.level, s => native_rays::<K, _>(s, boxes, rays, to)),
        Shape::Primitives => dispatch!(way.level, s => native_boxes::<K, _>(s, boxes, rays, to)),
    }
}

/// Whether a kernel is there for a level and a shape.
pub(super) fn runs<K: BoxKernel>(way: Way) -> bool {
    (way.shape != Shape::Primitives || boxes_in_lanes_differ::<K>()) && (!K::FUSED || way.fuses())
}

/// Whether a kernel is one of its own for one ray and boxes in lanes.
const fn boxes_in_lanes_differ<K: BoxKernel>() -> bool {
    !K::TOGETHER && !K::SHARED_ORIGIN
}

/// Whether there is code of a kernel for vectors of that type.
const fn has_code<K: BoxKernel, V: SimdF32>() -> bool {
    V::LANES == 1 || !K::FUSED || V::FUSED
}

#[inline(always)]
fn native_rays<K: BoxKernel, S: Simd>(s: S, boxes: &BoxSet, rays: &Rays, to: &mut Crossings) {
    if const { has_code::<K, S::f32s>() } {
        rays_in_lanes::<K, S::f32s>(s, boxes, rays, to);
    }
}

#[inline(always)]
fn native_boxes<K: BoxKernel, S: Simd>(s: S, boxes: &BoxSet, rays: &Rays, to: &mut Crossings) {
    if const { has_code::<K, S::f32s>() && boxes_in_lanes_differ::<K>() } {
        boxes_in_lanes::<K, S::f32s>(s, boxes, rays, to);
    }
}

/// The packet with a kernel's own reciprocals.
#[inline(always)]
fn with_reciprocals<K: BoxKernel, V: SimdF32>(s: V::Simd, packet: Packet<V>) -> Packet<V> {
    let Vec3 { x, y, z } = packet.dir;
    let inv = Vec3::new(K::Reciprocal::of(s, x), K::Reciprocal::of(s, y), K::Reciprocal::of(s, z));
    Packet { inv, ..packet }
}

#[inline(always)]
fn rays_in_lanes<K: BoxKernel, V: SimdF32>(
    s: V::Simd,
    boxes: &BoxSet,
    rays: &Rays,
    to: &mut Crossings,
) {
    let mut first = 0;
    while first < rays.len() {
        let packet = with_reciprocals::<K, V>(s, Packet::load(s, rays, first));
        let mut tally = Tally::new(s);
        if K::FRAMED {
            match packet.frame(s) {
                Ok(frame) => every_box::<K, V, _>(s, &boxes.boxes, &packet, &frame, &mut tally),
                Err(frame) => every_box::<K, V, _>(s, &boxes.boxes, &packet, &frame, &mut tally),
            }
        } else {
            every_box::<K, V, _>(s, &boxes.boxes, &packet, &packet.mixed(s), &mut tally);
        }
        tally.enter.store_prefix(&mut to.enter[first..]);
        tally.count.store_prefix(&mut to.count[first..]);
        first += V::LANES;
    }
}

#[inline(always)]
fn every_box<K: BoxKernel, V: SimdF32, F: Frame<V>>(
    s: V::Simd,
    boxes: &[Aabb],
    packet: &Packet<V>,
    frame: &F,
    tally: &mut Tally<V>,
) {
    if K::SHARED_ORIGIN
        && let Some(origin) = common(s, packet)
    {
        let packet = from_origin(s, packet);
        for aabb in boxes {
            let aabb = seen_from(aabb, origin);
            tally.add(s, K::test(s, &aabb, &packet, frame, packet.tmax));
        }
        return;
    }
    for aabb in boxes {
        tally.add(s, K::test(s, aabb, packet, frame, packet.tmax));
    }
}

#[inline(always)]
fn boxes_in_lanes<K: BoxKernel, V: SimdF32>(
    s: V::Simd,
    boxes: &BoxSet,
    rays: &Rays,
    to: &mut Crossings,
) {
    let mut i = 0;
    while i < rays.len() {
        let packet = with_reciprocals::<K, V>(s, Packet::splat(s, &rays.get(i)));
        let mut tally = Tally::new(s);
        if K::FRAMED {
            // All lanes agree.
            if let Ok(frame) = packet.frame(s) {
                every_block::<K, V, _>(s, boxes, &packet, &frame, &mut tally);
            }
        } else {
            every_block::<K, V, _>(s, boxes, &packet, &packet.mixed(s), &mut tally);
        }
        to.enter[i] = tally.enter.reduce_min();
        to.count[i] = tally.count.reduce_sum();
        i += 1;
    }
}

#[inline(always)]
fn every_block<K: BoxKernel, V: SimdF32, F: Frame<V>>(
    s: V::Simd,
    boxes: &BoxSet,
    packet: &Packet<V>,
    frame: &F,
    tally: &mut Tally<V>,
) {
    let mut done = 0;
    while done < boxes.boxes.len() {
        let block: OwnBoxes<V> =
            boxes.blocks[done / BoxBlock::LANES].lanes(s, done % BoxBlock::LANES);
        let left = (boxes.boxes.len() - done) as u32;
        if let Some(Crossing { mask, enter }) = K::test(s, &block, packet, frame, packet.tmax) {
            let mask = mask & V::U32::iota(s).lt(V::U32::splat(s, left));
            tally.add(s, Some(Crossing { mask, enter }));
        }
        done += V::LANES;
    }
}

/// What each lane has found.
struct Tally<V: SimdF32> {
    count: V::U32,
    enter: V,
}

impl<V: SimdF32> Tally<V> {
    #[inline(always)]
    fn new(s: V::Simd) -> Self {
        Tally { count: V::U32::splat(s, 0), enter: V::splat(s, f32::INFINITY) }
    }

    #[inline(always)]
    fn add(&mut self, s: V::Simd, found: Option<Crossing<V>>) {
        if let Some(Crossing { mask, enter }) = found {
            self.count += mask.select(V::U32::splat(s, 1), V::U32::splat(s, 0));
            // A NaN stays: it is what the kernel said.
            self.enter = mask.select(self.enter.min(enter), self.enter);
        }
    }
}
