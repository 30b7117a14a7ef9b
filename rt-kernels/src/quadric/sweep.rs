//! Curved surfaces for the common loop.

use std::marker::PhantomData;

use simd4::SimdF32;

use super::record::BlockLanes;
use super::{Found, QuadricKernel, Record, RecordBlock, Records};
use crate::catalogue::Way;
use crate::geom::Curved;
use crate::packet::{Closest, Frame, Hits, Packet, Query, Rays};
use crate::sweep::{self, Sweep};

/// Surfaces as one kernel keeps them, for every [`Shape`](crate::catalogue::Shape).
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
    sweep::closest::<Of<K>>(way, &surfaces.records, &surfaces.blocks, rays, hits);
}

/// Whether a kernel is there for a level and a shape.
pub(super) fn runs<K: QuadricKernel>(way: Way) -> bool {
    sweep::runs::<Of<K>>(way)
}

/// A kernel as the common loop has it.
struct Of<K>(PhantomData<K>);

impl<K: QuadricKernel> Sweep for Of<K> {
    const NAME: &'static str = K::NAME;
    const FRAMED: bool = K::FRAMED;
    const FUSED: bool = K::FUSED;
    type Record = Record;
    type Block = RecordBlock;

    #[inline(always)]
    fn one<V: SimdF32, F: Frame<V>>(
        s: V::Simd,
        record: &Record,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Closest<V>,
    ) {
        intersect::<K, V, F, _>(s, record, packet, frame, query);
    }

    #[inline(always)]
    fn lanes<V: SimdF32, F: Frame<V>>(
        s: V::Simd,
        block: &RecordBlock,
        first: usize,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Closest<V>,
    ) {
        intersect::<K, V, F, _>(s, &BlockLanes::new(block, first), packet, frame, query);
    }
}

const _: () = assert!(RecordBlock::LANES == 16);

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
