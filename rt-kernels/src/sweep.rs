//! Many rays against many primitives, one by one: the loop that kernels of triangles and of curved
//! surfaces share.

use simd4::{Simd, SimdF32, dispatch, scalar};

use crate::catalogue::{Shape, Way};
use crate::packet::{Closest, Frame, Hits, Packet, Rays};

/// A kernel and what it keeps of primitives, one by one and in blocks of sixteen.
pub(crate) trait Sweep {
    /// What it is called.
    const NAME: &'static str;
    /// Whether it looks at the [`Frame`].
    const FRAMED: bool;
    /// Whether it fuses.
    const FUSED: bool;
    /// Whether it is for scalar use only.
    const SCALAR: bool = false;
    /// A primitive.
    type Record;
    /// Sixteen of them.
    type Block;

    /// Shows a packet one primitive.
    fn one<V: SimdF32, F: Frame<V>>(
        s: V::Simd,
        record: &Self::Record,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Closest<V>,
    );

    /// Shows a ray the primitives of a block from `first` on, a lane each.
    fn lanes<V: SimdF32, F: Frame<V>>(
        s: V::Simd,
        block: &Self::Block,
        first: usize,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Closest<V>,
    );
}

/// Primitives to a block.
const BLOCK: usize = 16;

/// Finds the closest hit of every ray among all primitives.
pub(crate) fn closest<K: Sweep>(
    way: Way,
    records: &[K::Record],
    blocks: &[K::Block],
    rays: &Rays,
    hits: &mut Hits,
) {
    hits.resize(rays.len());
    match way.shape {
        Shape::One => rays_in_lanes::<K, scalar::f32x1>(simd4::Scalar::new(), records, rays, hits),
        _ if !runs::<K>(way) => panic!("{} does not run at {}", K::NAME, way.level),
        Shape::Rays => dispatch!(way.level, s => native_rays::<K, _>(s, records, rays, hits)),
        Shape::Primitives => {
            dispatch!(way.level, s => native_primitives::<K, _>(s, blocks, rays, hits))
        }
    }
}

/// Whether a kernel is there for a level and a shape: one that fuses is not for registers of a level
/// that does not.
pub(crate) fn runs<K: Sweep>(way: Way) -> bool {
    way.shape == Shape::One || !K::SCALAR && (!K::FUSED || way.fuses())
}

/// Whether there is code of a kernel for vectors of that type.
const fn has_code<K: Sweep, V: SimdF32>() -> bool {
    V::LANES == 1 || !K::SCALAR && (!K::FUSED || V::FUSED)
}

#[inline(always)]
fn native_rays<K: Sweep, S: Simd>(s: S, records: &[K::Record], rays: &Rays, hits: &mut Hits) {
    if const { has_code::<K, S::f32s>() } {
        rays_in_lanes::<K, S::f32s>(s, records, rays, hits);
    }
}

#[inline(always)]
fn native_primitives<K: Sweep, S: Simd>(s: S, blocks: &[K::Block], rays: &Rays, hits: &mut Hits) {
    if const { has_code::<K, S::f32s>() } {
        primitives_in_lanes::<K, S::f32s>(s, blocks, rays, hits);
    }
}

#[inline(always)]
fn rays_in_lanes<K: Sweep, V: SimdF32>(
    s: V::Simd,
    records: &[K::Record],
    rays: &Rays,
    hits: &mut Hits,
) {
    let mut first = 0;
    while first < rays.len() {
        let packet = Packet::<V>::load(s, rays, first);
        let mut query = Closest::new(s, &packet);
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
fn every_record<K: Sweep, V: SimdF32, F: Frame<V>>(
    s: V::Simd,
    records: &[K::Record],
    packet: &Packet<V>,
    frame: &F,
    query: &mut Closest<V>,
) {
    for record in records {
        K::one(s, record, packet, frame, query);
    }
}

#[inline(always)]
fn primitives_in_lanes<K: Sweep, V: SimdF32>(
    s: V::Simd,
    blocks: &[K::Block],
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
                every_block::<K, V, _>(s, blocks, &packet, &frame, &mut query);
            }
        } else {
            every_block::<K, V, _>(s, blocks, &packet, &packet.mixed(s), &mut query);
        }
        query.store_least(s, hits, i);
        i += 1;
    }
}

#[inline(always)]
fn every_block<K: Sweep, V: SimdF32, F: Frame<V>>(
    s: V::Simd,
    blocks: &[K::Block],
    packet: &Packet<V>,
    frame: &F,
    query: &mut Closest<V>,
) {
    for block in blocks {
        let mut first = 0;
        while first < BLOCK {
            K::lanes(s, block, first, packet, frame, query);
            first += V::LANES;
        }
    }
}
