//! Many rays against many triangles, one by one: the loop that tests, benches and charts share.

use simd4::{Simd, SimdF32, dispatch, scalar};

use super::{BlockLanes, Record, RecordBlock, TriangleKernel, intersect};
use crate::catalogue::{Shape, Way};
use crate::geom::Triangle;
use crate::packet::{Closest, Frame, Hits, Packet, Rays};

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
        Shape::Primitives => {
            dispatch!(way.level, s => native_triangles::<K, _>(s, triangles, rays, hits))
        }
    }
}

/// Whether a kernel is there for a level and a shape.
pub(super) fn runs<K: TriangleKernel>(way: Way) -> bool {
    way.shape == Shape::One || !K::SCALAR && (!K::FUSED || way.fuses())
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
