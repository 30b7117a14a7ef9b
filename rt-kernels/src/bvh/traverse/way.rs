//! How many rays together are tested against the children of a node: by what they have in common.

use simd4::{SimdF32, SimdMask};

use crate::bvh::layout::WideNode;
use crate::packet::{LARGE, LargePacket, OwnBoxes};
use crate::slab::pyramid::{BoxSides, Culling, Sides};
use crate::slab::{interval, robust};

/// How rays are tested against the children of a node: all children at once, then what is left child
/// by child.
pub(super) trait Way {
    /// The most rays that go on one by one below a node.
    const FEW: u32;
    /// The most rays that are tested one by one in a leaf.
    const FEW_IN_LEAF: u32;

    /// What all rays share of the children's boxes.
    type Seen<B: SimdF32>;
    /// The same of one child, in all lanes.
    type One<V: SimdF32>;

    /// The children that some ray may hit with `t <= limit`, those of them that all are taken to hit, and
    /// where none enters before.
    fn candidates<B: SimdF32, const N: usize>(
        s: B::Simd,
        culling: &Culling,
        node: &WideNode<N>,
        limit: f32,
    ) -> (B::Mask, u32, B, Self::Seen<B>);

    /// The child in that lane.
    fn one<B: SimdF32, V: SimdF32<Simd = B::Simd>, const N: usize>(
        s: V::Simd,
        node: &WideNode<N>,
        seen: &Self::Seen<B>,
        lane: usize,
    ) -> Self::One<V>;

    /// The rays of a register that may hit a child.
    fn may_hit<V: SimdF32>(
        s: V::Simd,
        one: &Self::One<V>,
        packet: &LargePacket<'_>,
        g: usize,
    ) -> V::Mask;
}

/// Rays with one origin.
pub(super) struct Pyramid;

impl Way for Pyramid {
    const FEW: u32 = 4;
    const FEW_IN_LEAF: u32 = 12;

    type Seen<B: SimdF32> = Sides<B>;
    type One<V: SimdF32> = BoxSides<V>;

    #[inline(always)]
    fn candidates<B: SimdF32, const N: usize>(
        s: B::Simd,
        culling: &Culling,
        node: &WideNode<N>,
        limit: f32,
    ) -> (B::Mask, u32, B, Sides<B>) {
        let found = culling.candidates::<B, _>(s, node, limit);
        (found.mask, found.all.bitmask(), found.enter, Sides::new(&found))
    }

    #[inline(always)]
    fn one<B: SimdF32, V: SimdF32<Simd = B::Simd>, const N: usize>(
        s: V::Simd,
        _: &WideNode<N>,
        seen: &Sides<B>,
        lane: usize,
    ) -> BoxSides<V> {
        seen.one(s, lane)
    }

    #[inline(always)]
    fn may_hit<V: SimdF32>(
        s: V::Simd,
        one: &BoxSides<V>,
        packet: &LargePacket<'_>,
        g: usize,
    ) -> V::Mask {
        one.may_hit(s, packet.reach::<V>(s, g))
    }
}

/// Rays that start or go anywhere in their class.
pub(super) struct Spread;

impl Way for Spread {
    const FEW: u32 = 16;
    const FEW_IN_LEAF: u32 = LARGE as u32;

    type Seen<B: SimdF32> = ();
    type One<V: SimdF32> = OwnBoxes<V>;

    #[inline(always)]
    fn candidates<B: SimdF32, const N: usize>(
        s: B::Simd,
        culling: &Culling,
        node: &WideNode<N>,
        limit: f32,
    ) -> (B::Mask, u32, B, ()) {
        let (mask, enter) = interval::candidates(s, node, culling.beam, limit);
        (mask, 0, enter, ())
    }

    #[inline(always)]
    fn one<B: SimdF32, V: SimdF32<Simd = B::Simd>, const N: usize>(
        s: V::Simd,
        node: &WideNode<N>,
        (): &(),
        lane: usize,
    ) -> OwnBoxes<V> {
        let sides = |[low, high]: [f32; 2]| [V::splat(s, low), V::splat(s, high)];
        let [x, y, z] = node.aabb(lane).axes;
        OwnBoxes([sides(x), sides(y), sides(z)])
    }

    #[inline(always)]
    fn may_hit<V: SimdF32>(
        s: V::Simd,
        one: &OwnBoxes<V>,
        packet: &LargePacket<'_>,
        g: usize,
    ) -> V::Mask {
        let (packet, frame) = packet.group::<V>(s, g);
        robust::may_hit(s, one, &packet, &frame, packet.tmax)
    }
}
