//! The own box of a hit: what makes the answer one, with any kernel.

use simd4::SimdF32;

use super::Found;
use crate::packet::{Boxes, Frame, Packet};
use crate::slab::robust;

/// What is left of hits when they are held in their triangles' own boxes: only rays that meet the
/// box hit, and none before its entry. `limit` is that which the hits were found with.
#[inline(always)]
pub(super) fn held<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
    s: V::Simd,
    boxes: &B,
    packet: &Packet<V>,
    frame: &F,
    limit: V,
    found: Found<V>,
) -> Found<V> {
    let (enter, exit) = robust::enter_exit(s, boxes, packet, frame);
    let t = found.t.max(enter);
    let mask = found.mask & enter.le(exit) & packet.tmin.le(exit) & t.le(limit);
    Found { mask, t, ..found }
}
