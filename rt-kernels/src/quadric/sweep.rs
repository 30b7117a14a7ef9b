//! Many rays against many surfaces, one by one: the loop that tests, benches and charts share.

use simd4::{Simd, SimdF32, dispatch, scalar};

use super::record::BlockLanes;
use super::{Found, QuadricKernel, Record, RecordBlock, Records};
use crate::catalogue::{Shape, Way};
use crate::geom::Curved;
use crate::packet::{Closest, Frame, Hits, Packet, Query, Rays};

/// Surfaces as one kernel keeps them, for every [`Shape`].
#[derive(Clone, Debug)]
pub struct Surfaces {
    records: Vec<Record>,
    blocks: Vec<RecordBlock>,
}

impl Surfaces {
    /// The records that the kernel `K` makes of them; they are numbered in their order. `None` if
    /// it is not made for one of them.
    pub fn new<K: QuadricKernel>(surfaces: &[Curved]) -> Option<Surfaces> {
        let numbered = (0..).zip(surfaces);
        let records: Option<Vec<_>> =
            numbered.map(|(prim, surface)| K::record(surface, prim)).collect();
        let records = records?;
        let blocks = records.chunks(RecordBlock::LANES).map(RecordBlock::new).collect();
        Some(Surfaces { records, blocks })
    }
}

/// Finds the closest hit of every ray among all surfaces.
pub(super) fn closest<K: QuadricKernel>(
    way: Way,
    surfaces: &Surfaces,
    rays: &Rays,
    hits: &mut Hits,
) {
    hits.resize(rays.len());
    match way.shape {
        Shape::One => rays_in_lanes::<K, scalar::f32x1>(simd4::Scalar::new(), surfaces, rays, hits),
        _ if !runs::<K>(way) => panic!("{} does not run at {}", K::NAME, way.level),
        Shape::Rays => dispatch!(way.level, s => native_rays::<K, _>(s, surfaces, rays, hits)),
        Shape::Primitives => {
            dispatch!(way.level, s => native_surfaces::<K, _>(s, surfaces, rays, hits))
        }
    }
}

/// Whether a kernel is there for a level and a shape.
pub(super) fn runs<K: QuadricKernel>(way: Way) -> bool {
    !K::FUSED || way.fuses()
}

/// Whether there is code of a kernel for vectors of that type.
const fn has_code<K: QuadricKernel, V: SimdF32>() -> bool {
    V::LANES == 1 || !K::FUSED || V::FUSED
}

#[inline(always)]
fn native_rays<K: QuadricKernel, S: Simd>(s: S, surfaces: &Surfaces, rays: &Rays, hits: &mut Hits) {
    if const { has_code::<K, S::f32s>() } {
        rays_in_lanes::<K, S::f32s>(s, surfaces, rays, hits);
    }
}

#[inline(always)]
fn native_surfaces<K: QuadricKernel, S: Simd>(
    s: S,
    surfaces: &Surfaces,
    rays: &Rays,
    hits: &mut Hits,
) {
    if const { has_code::<K, S::f32s>() } {
        surfaces_in_lanes::<K, S::f32s>(s, surfaces, rays, hits);
    }
}

#[inline(always)]
fn intersect<K: QuadricKernel, V: SimdF32, F: Frame<V>, R: Records<V>>(
    s: V::Simd,
    records: &R,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Closest<V>,
) {
    if let Some(Found { mask, t }) = K::test(s, records, packet, frame, query.limit()) {
        let zero = V::splat(s, 0.0);
        query.record(s, mask, records.prim(s), t, zero, zero);
    }
}

#[inline(always)]
fn rays_in_lanes<K: QuadricKernel, V: SimdF32>(
    s: V::Simd,
    surfaces: &Surfaces,
    rays: &Rays,
    hits: &mut Hits,
) {
    let mut first = 0;
    while first < rays.len() {
        let packet = Packet::<V>::load(s, rays, first);
        let mut query = Closest::new(s, &packet);
        let records = &surfaces.records;
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
fn every_record<K: QuadricKernel, V: SimdF32, F: Frame<V>>(
    s: V::Simd,
    records: &[Record],
    packet: &Packet<V>,
    frame: &F,
    query: &mut Closest<V>,
) {
    for record in records {
        intersect::<K, V, F, _>(s, record, packet, frame, query);
    }
}

#[inline(always)]
fn surfaces_in_lanes<K: QuadricKernel, V: SimdF32>(
    s: V::Simd,
    surfaces: &Surfaces,
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
                every_block::<K, V, _>(s, &surfaces.blocks, &packet, &frame, &mut query);
            }
        } else {
            every_block::<K, V, _>(s, &surfaces.blocks, &packet, &packet.mixed(s), &mut query);
        }
        query.store_least(s, hits, i);
        i += 1;
    }
}

#[inline(always)]
fn every_block<K: QuadricKernel, V: SimdF32, F: Frame<V>>(
    s: V::Simd,
    blocks: &[RecordBlock],
    packet: &Packet<V>,
    frame: &F,
    query: &mut Closest<V>,
) {
    for block in blocks {
        let mut first = 0;
        while first < RecordBlock::LANES {
            intersect::<K, V, F, _>(s, &BlockLanes::new(block, first), packet, frame, query);
            first += V::LANES;
        }
    }
}
