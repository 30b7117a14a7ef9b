//! Traversals of the skip array to compare: what renders, and what Geimer and Müller had or tried.
//!
//! All are for packets of four, at every level, with the default triangle test, and all give the
//! same hits.

use std::marker::PhantomData;

use simd4::{Level, Simd, SimdF32, dispatch};

use super::heap::{self, Heap};
use super::skip;
use crate::Stats;
use crate::bvh::Bvh;
use crate::bvh::layout::SkipArray;
use crate::packet::{Closest, Frame, Hits, Packet, Rays};
use crate::slab::knobs::{EachClipped, Padded};
use crate::slab::{BoxKernel, Conservative, Corrected, Robust, SharedOrigin, Unordered};
use crate::tri::Watertight;
use crate::tri::knobs::Division;

/// A traversal that is chosen at run time, batch by batch.
pub trait Compared: Send + Sync {
    /// The order of visits: `skip` or `heap`.
    fn order(&self) -> &'static str;

    /// The box test and its choices.
    fn box_test(&self) -> String;

    /// Finds the closest hit of every ray by packets of four. `hits` is made as long as `rays`;
    /// work is added to `stats`.
    ///
    /// # Panics
    /// If the hierarchy has another layout than [`Layout::Skip`](crate::Layout::Skip), or another
    /// triangle test than the default.
    fn closest(&self, level: Level, bvh: &Bvh, rays: &Rays, hits: &mut Hits, stats: &mut Stats);
}

/// Every traversal, that which renders first.
#[inline]
pub fn catalogue() -> Vec<&'static dyn Compared> {
    type Exact = Unordered<Division, EachClipped, Padded>;
    type Estimate = Conservative<Division, Corrected<Padded>>;
    vec![
        &Entry::<DepthFirst, Robust>(PhantomData),
        &Entry::<DepthFirst, Exact>(PhantomData),
        &Entry::<DepthFirst, Estimate>(PhantomData),
        &Entry::<DepthFirst, SharedOrigin<Estimate>>(PhantomData),
        &Entry::<NearestFirst, Robust>(PhantomData),
    ]
}

/// An order of visits.
trait Order: Send + Sync + 'static {
    const NAME: &'static str;
    /// What it remembers from node to node.
    type Memory: Default;

    fn traverse<B: BoxKernel<Reciprocal = Division>, V: SimdF32, F: Frame<V>>(
        s: V::Simd,
        array: &SkipArray,
        memory: &mut Self::Memory,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Closest<V>,
        stats: &mut Stats,
    );
}

struct DepthFirst;

impl Order for DepthFirst {
    const NAME: &'static str = "skip";
    type Memory = ();

    #[inline(always)]
    fn traverse<B: BoxKernel<Reciprocal = Division>, V: SimdF32, F: Frame<V>>(
        s: V::Simd,
        array: &SkipArray,
        (): &mut (),
        packet: &Packet<V>,
        frame: &F,
        query: &mut Closest<V>,
        stats: &mut Stats,
    ) {
        skip::traverse::<B, Watertight, V, F, _>(s, array, packet, frame, query, stats);
    }
}

struct NearestFirst;

impl Order for NearestFirst {
    const NAME: &'static str = "heap";
    type Memory = Heap;

    #[inline(always)]
    fn traverse<B: BoxKernel<Reciprocal = Division>, V: SimdF32, F: Frame<V>>(
        s: V::Simd,
        array: &SkipArray,
        heap: &mut Heap,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Closest<V>,
        stats: &mut Stats,
    ) {
        heap::traverse::<B, Watertight, V, F, _>(s, array, heap, packet, frame, query, stats);
    }
}

struct Entry<O, B>(PhantomData<fn() -> (O, B)>);

impl<O: Order, B: BoxKernel<Reciprocal = Division>> Compared for Entry<O, B> {
    fn order(&self) -> &'static str {
        O::NAME
    }

    fn box_test(&self) -> String {
        format!("{} ({})", B::NAME, B::variant())
    }

    fn closest(&self, level: Level, bvh: &Bvh, rays: &Rays, hits: &mut Hits, stats: &mut Stats) {
        let array = bvh.skip_array().expect("a skip array with the default triangle test");
        hits.resize(rays.len());
        dispatch!(level, s => by_four::<O, B, _>(s, array, rays, hits, stats));
    }
}

#[inline(always)]
fn by_four<O: Order, B: BoxKernel<Reciprocal = Division>, S: Simd>(
    s: S,
    array: &SkipArray,
    rays: &Rays,
    hits: &mut Hits,
    stats: &mut Stats,
) {
    let mut memory = O::Memory::default();
    let mut done = Stats::default();
    let mut first = 0;
    while first < rays.len() {
        let packet = Packet::<S::f32x4>::load(s, rays, first);
        let mut query = Closest::new(s, &packet);
        let (memory, query_of) = (&mut memory, &mut query);
        match packet.frame(s) {
            Ok(frame) => {
                O::traverse::<B, _, _>(s, array, memory, &packet, &frame, query_of, &mut done);
            }
            Err(frame) => {
                O::traverse::<B, _, _>(s, array, memory, &packet, &frame, query_of, &mut done);
            }
        }
        query.store(hits, first);
        first += 4;
    }
    *stats += done;
}
