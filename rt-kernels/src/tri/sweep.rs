//! Many rays against many triangles, one by one: the loop that tests, benches and charts share.

use simd4::{Level, Simd, SimdF32, dispatch, scalar};

use super::{BlockLanes, Record, RecordBlock, TriangleKernel, intersect};
use crate::geom::Triangle;
use crate::packet::{Closest, Frame, Hits, Packet, Rays};

/// What goes in the lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// One ray against one triangle, in plain scalar code.
    One,
    /// As many rays as a register has lanes against one triangle.
    Rays,
    /// One ray against as many triangles as a register has lanes.
    Triangles,
}

/// A level and a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// The instructions to use. Of no account to [`Shape::One`].
    pub level: Level,
    /// What goes in the lanes.
    pub shape: Shape,
}

impl Way {
    /// Every way there is on this machine: scalar first, then both shapes at each level.
    pub fn all() -> Vec<Way> {
        let mut levels = Level::available().peekable();
        let first = levels.peek().copied();
        let one = first.map(|level| Way { level, shape: Shape::One });
        let lanes = levels
            .flat_map(|level| [Shape::Rays, Shape::Triangles].map(|shape| Way { level, shape }));
        one.into_iter().chain(lanes).collect()
    }

    /// The number of lanes.
    pub fn width(self) -> usize {
        match self.shape {
            Shape::One => 1,
            Shape::Rays | Shape::Triangles => self.level.lanes(),
        }
    }
}

/// Triangles as one kernel keeps them, for every [`Shape`].
#[derive(Clone, Debug)]
pub struct Triangles {
    records: Vec<Record>,
    blocks: Vec<RecordBlock>,
}

impl Triangles {
    /// The records that the kernel `K` makes of them; they are numbered in their order.
    pub fn new<K: TriangleKernel>(triangles: &[Triangle]) -> Triangles {
        let numbered = (0..).zip(triangles);
        let records: Vec<_> = numbered.map(|(prim, triangle)| K::record(triangle, prim)).collect();
        let blocks = records.chunks(RecordBlock::LANES).map(RecordBlock::new).collect();
        Triangles { records, blocks }
    }
}

/// Finds the closest hit of every ray among all triangles.
pub(super) fn closest<K: TriangleKernel>(
    way: Way,
    triangles: &Triangles,
    rays: &Rays,
    hits: &mut Hits,
) {
    hits.resize(rays.len());
    match way.shape {
        Shape::One => {
            rays_in_lanes::<K, scalar::f32x1>(simd4::Scalar::new(), triangles, rays, hits)
        }
        _ if !runs::<K>(way) => panic!("{} does not run at {}", K::NAME, way.level),
        Shape::Rays => dispatch!(way.level, s => native_rays::<K, _>(s, triangles, rays, hits)),
        Shape::Triangles => {
            dispatch!(way.level, s => native_triangles::<K, _>(s, triangles, rays, hits))
        }
    }
}

/// Whether a kernel is there for a level and a shape: one that fuses is not for registers of a level
/// that does not.
pub(super) fn runs<K: TriangleKernel>(way: Way) -> bool {
    #[inline(always)]
    fn fuses<S: Simd>(_: S) -> bool {
        <S::f32s as SimdF32>::FUSED
    }
    way.shape == Shape::One || !K::SCALAR && (!K::FUSED || dispatch!(way.level, s => fuses(s)))
}

/// Whether a kernel fuses there by emulation.
pub(super) fn emulates<K: TriangleKernel>(way: Way) -> bool {
    K::FUSED && way.shape == Shape::One
}

/// Whether there is code of a kernel for vectors of that type.
const fn has_code<K: TriangleKernel, V: SimdF32>() -> bool {
    V::LANES == 1 || !K::SCALAR && (!K::FUSED || V::FUSED)
}

#[inline(always)]
fn native_rays<K: TriangleKernel, S: Simd>(
    s: S,
    triangles: &Triangles,
    rays: &Rays,
    hits: &mut Hits,
) {
    if const { has_code::<K, S::f32s>() } {
        rays_in_lanes::<K, S::f32s>(s, triangles, rays, hits);
    }
}

#[inline(always)]
fn native_triangles<K: TriangleKernel, S: Simd>(
    s: S,
    triangles: &Triangles,
    rays: &Rays,
    hits: &mut Hits,
) {
    if const { has_code::<K, S::f32s>() } {
        triangles_in_lanes::<K, S::f32s>(s, triangles, rays, hits);
    }
}

#[inline(always)]
fn rays_in_lanes<K: TriangleKernel, V: SimdF32>(
    s: V::Simd,
    triangles: &Triangles,
    rays: &Rays,
    hits: &mut Hits,
) {
    let mut first = 0;
    while first < rays.len() {
        let packet = Packet::<V>::load(s, rays, first);
        let mut query = Closest::new(s, &packet);
        let records = &triangles.records;
        if K::FRAMED {
            match packet.frame(s) {
                Ok(frame) => every_record::<K, V, _>(s, records, &packet, &frame, &mut query),
                Err(frame) => every_record::<K, V, _>(s, records, &packet, &frame, &mut query),
            }
        } else {
            every_record::<K, V, _>(s, records, &packet, &packet.mixed(s), &mut query);
        }
        query.store(hits, first);
        first += V::LANES;
    }
}

#[inline(always)]
fn every_record<K: TriangleKernel, V: SimdF32, F: Frame<V>>(
    s: V::Simd,
    records: &[Record],
    packet: &Packet<V>,
    frame: &F,
    query: &mut Closest<V>,
) {
    for record in records {
        intersect::<K, V, F, _, _>(s, record, packet, frame, query);
    }
}

#[inline(always)]
fn triangles_in_lanes<K: TriangleKernel, V: SimdF32>(
    s: V::Simd,
    triangles: &Triangles,
    rays: &Rays,
    hits: &mut Hits,
) {
    let mut i = 0;
    while i < rays.len() {
        let packet = Packet::<V>::splat(s, &rays.get(i));
        let mut query = Closest::new(s, &packet);
        if K::FRAMED {
            // All lanes agree.
            if let Ok(frame) = packet.frame(s) {
                every_block::<K, V, _>(s, &triangles.blocks, &packet, &frame, &mut query);
            }
        } else {
            every_block::<K, V, _>(s, &triangles.blocks, &packet, &packet.mixed(s), &mut query);
        }
        query.store_least(s, hits, i);
        i += 1;
    }
}

#[inline(always)]
fn every_block<K: TriangleKernel, V: SimdF32, F: Frame<V>>(
    s: V::Simd,
    blocks: &[RecordBlock],
    packet: &Packet<V>,
    frame: &F,
    query: &mut Closest<V>,
) {
    for block in blocks {
        let mut first = 0;
        while first < RecordBlock::LANES {
            let records = BlockLanes::new(block, first);
            intersect::<K, V, F, _, _>(s, &records, packet, frame, query);
            first += V::LANES;
        }
    }
}
