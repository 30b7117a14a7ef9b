//! Depth-first traversal without a stack: a node that is missed skips its subtree.
//!
//! If any ray of the packet hits a node, all go on to its children. Source: Geimer and Müller
//! 2003, Section 3.3; Smits 1998. Deviation: nodes behind what was already found are skipped. The
//! box test is an argument: [`Robust`] where it renders.

use simd4::{SimdF32, SimdMask};

use crate::Counters;
use crate::bvh::layout::SkipArray;
use crate::packet::{Frame, Packet, Query};
use crate::slab::{BoxKernel, Robust, Viewed};
use crate::trace::Traverse;
use crate::tri::knobs::Division;
use crate::tri::{Method, TriangleKernel};

/// Hands the primitives of every leaf that some ray may hit to their kernels, triangles to `K`: that
/// of the method that the array was made for. `B` may say "may hit" too often, but no less often than
/// [`Robust`] does.
#[inline(always)]
pub fn traverse<B, K, V, F, Q>(
    s: V::Simd,
    array: &SkipArray,
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
    let mut i = 0;
    let mut visits = 0;
    let mut active = 0;
    while let Some(node) = nodes.get(i) {
        visits += 1;
        let Some(crossing) = viewed.test::<B, F>(s, &node.aabb, frame, query.limit()) else {
            i = node.skip as usize;
            continue;
        };
        active += u64::from(crossing.mask.bitmask().count_ones());
        i += 1;
        if let Some(slots) = node.slots() {
            array.store.intersect::<K, V, F, Q>(s, slots, packet, frame, query, stats);
            if query.done(s) {
                break;
            }
        }
    }
    stats.count(|stats| stats.node_visits += visits);
    stats.count(|stats| stats.active_rays += active);
    stats.count(|stats| stats.box_tests += visits * V::LANES as u64);
}

impl Traverse for SkipArray {
    const ANY_PACKET: bool = true;

    #[inline(always)]
    fn traverse<K: TriangleKernel, V: SimdF32, F: Frame<V>, Q: Query<V>>(
        &self,
        s: V::Simd,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Q,
        stats: &mut impl Counters,
    ) {
        traverse::<Robust, K, V, F, Q>(s, self, packet, frame, query, stats);
    }

    fn method(&self) -> Method {
        self.store.method()
    }

    fn bytes(&self) -> usize {
        SkipArray::bytes(self)
    }
}
