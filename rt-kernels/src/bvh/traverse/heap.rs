//! Traversal from near to far by a heap: the next node is always the one that is entered first.
//!
//! The children of a node are tested when it is taken from the heap, and those that some ray of the
//! packet may hit are put there, by the least distance at which one of them enters. When the
//! nearest node begins behind all that was found, nothing that is left matters.
//!
//! **The answer** is that of every other traversal ([why](crate#why-the-answer-is-one)): a node is left
//! out only if all rays miss its box or enter it after their limit.
//!
//! Source: Kay and Kajiya, "Ray Tracing Complex Scenes", 1986, Section 3; Geimer and Müller 2003,
//! Section 3.3, tried it with packets.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use simd4::{SimdF32, SimdMask};

use crate::Counters;
use crate::bvh::layout::SkipArray;
use crate::packet::{Frame, Packet, Query};
use crate::slab::{BoxKernel, Crossing, Viewed};
use crate::tri::TriangleKernel;
use crate::tri::knobs::Division;

/// Nodes that are still to be visited, the nearest first: the bits of the distance, which is not
/// negative, and the node.
#[derive(Default)]
pub struct Heap(BinaryHeap<Reverse<(u32, u32)>>);

/// As [`skip::traverse`](super::skip::traverse), from near to far.
#[inline(always)]
pub fn traverse<B, K, V, F, Q>(
    s: V::Simd,
    array: &SkipArray,
    Heap(heap): &mut Heap,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Q,
    stats: &mut impl Counters,
) where
    B: BoxKernel<Reciprocal = Division>,
    K: TriangleKernel,
    V: SimdF32,
    F: Frame<V>,
    Q: Query<V>,
{
    let nodes = array.nodes();
    let viewed = Viewed::by::<B>(s, packet);
    let mut visits = 0;
    heap.clear();
    // What has no parent comes first.
    let (mut child, mut end) = (0, nodes.len());
    loop {
        while child < end {
            let node = &nodes[child];
            visits += 1;
            if let Some(Crossing { mask, enter }) =
                viewed.test::<B, F>(s, &node.aabb, frame, query.limit())
                && let Some((_, nearest)) = enter.argmin(mask)
            {
                // Without the sign of -0.
                heap.push(Reverse(((nearest + 0.0).to_bits(), child as u32)));
            }
            child = node.skip as usize;
        }
        let Some(Reverse((nearest, next))) = heap.pop() else { break };
        if V::splat(s, f32::from_bits(nearest)).le(query.limit()).none() {
            break;
        }
        let node = &nodes[next as usize];
        match node.slots() {
            Some(slots) => {
                array.store.intersect::<K, V, F, Q>(s, slots, packet, frame, query, stats);
                if query.done(s) {
                    break;
                }
            }
            None => (child, end) = (next as usize + 1, node.skip as usize),
        }
    }
    stats.count(|stats| stats.node_visits += visits);
    stats.count(|stats| stats.box_tests += visits * V::LANES as u64);
}
