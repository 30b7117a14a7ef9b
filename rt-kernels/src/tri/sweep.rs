//! Triangles for the common loop.

use std::marker::PhantomData;

use simd4::SimdF32;

use super::{BlockLanes, Record, RecordBlock, TriangleKernel, intersect};
use crate::catalogue::Way;
use crate::geom::Triangle;
use crate::packet::{Closest, Frame, Hits, Packet, Rays};
use crate::sweep::{self, Sweep};

/// Triangles as one kernel keeps them, for every [`Shape`](crate::catalogue::Shape).
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
        let blocks = records
            .chunks(<RecordBlock>::LANES)
            .map(|records| RecordBlock::new(records.iter().copied()))
            .collect();
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
    sweep::closest::<Of<K>>(way, &triangles.records, &triangles.blocks, rays, hits);
}

/// Whether a kernel is there for a level and a shape.
pub(super) fn runs<K: TriangleKernel>(way: Way) -> bool {
    sweep::runs::<Of<K>>(way)
}

/// A kernel as the common loop has it.
struct Of<K>(PhantomData<K>);

impl<K: TriangleKernel> Sweep for Of<K> {
    const NAME: &'static str = K::NAME;
    const FRAMED: bool = K::FRAMED;
    const FUSED: bool = K::FUSED;
    const SCALAR: bool = K::SCALAR;
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
        intersect::<K, V, F, _, _>(s, record, packet, frame, query);
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
        intersect::<K, V, F, _, _>(s, &BlockLanes::new(block, first), packet, frame, query);
    }
}

const _: () = assert!(<RecordBlock>::LANES == 16);
