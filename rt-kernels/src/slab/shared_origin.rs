//! The origin subtracted once a box.

use std::marker::PhantomData;

use simd4::math::Vec3;
use simd4::{SimdF32, SimdMask};

use super::knobs::words;
use super::{BoxKernel, Crossing};
use crate::geom::Aabb;
use crate::packet::{Boxes, Frame, Packet};

/// A kernel's form for rays with one origin, as those from an eye and to a point light are.
///
/// **Decides** what the kernel `K` decides, with the same bits: where all rays of a packet have the
/// same origin, it is subtracted from the six planes once, before they are spread over the lanes.
/// Other packets take the usual way. (One ray against boxes in lanes does so as it is.)
///
/// **Operations**, per box: 6 subtractions of scalars for 6 of vectors. Two blocks hold a box, so
/// that a compiler may make two of them.
///
/// Source: Geimer, Müller, "A Cross-Platform Framework for Interactive Ray Tracing", 2003, Section
/// 3.3.
#[derive(Clone, Copy, Debug)]
pub struct SharedOrigin<K>(PhantomData<K>);

impl<K: BoxKernel> BoxKernel for SharedOrigin<K> {
    const NAME: &'static str = "shared origin";
    const EXACT: bool = K::EXACT;
    const FUSED: bool = K::FUSED;
    const FRAMED: bool = K::FRAMED;
    const TOGETHER: bool = K::TOGETHER;
    const SHARED_ORIGIN: bool = true;

    type Reciprocal = K::Reciprocal;

    fn variant() -> String {
        words(&[&K::variant(), K::NAME])
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
        s: V::Simd,
        boxes: &B,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Crossing<V>> {
        K::test(s, boxes, packet, frame, limit)
    }
}

/// The origin of all rays of a packet, if they have the same.
#[inline(always)]
pub(super) fn common<V: SimdF32>(s: V::Simd, packet: &Packet<V>) -> Option<[f32; 3]> {
    let Vec3 { x, y, z } = packet.origin;
    let [first_x, first_y, first_z] = [x.lane(0), y.lane(0), z.lane(0)];
    let same = x.eq(V::splat(s, first_x)) & y.eq(V::splat(s, first_y)) & z.eq(V::splat(s, first_z));
    same.all().then_some([first_x, first_y, first_z])
}

/// A packet as a kernel has it against box after box: seen from its own origin, where the kernel
/// asks for that and all rays have the same.
pub(crate) struct Viewed<V> {
    packet: Packet<V>,
    origin: Option<[f32; 3]>,
}

impl<V: SimdF32> Viewed<V> {
    /// For the kernel `K`.
    #[inline(always)]
    pub(crate) fn by<K: BoxKernel>(s: V::Simd, packet: &Packet<V>) -> Self {
        if K::SHARED_ORIGIN
            && let Some(origin) = common(s, packet)
        {
            return Viewed { packet: from_origin(s, packet), origin: Some(origin) };
        }
        Viewed { packet: *packet, origin: None }
    }

    /// Tests one box.
    #[inline(always)]
    pub(crate) fn test<K: BoxKernel, F: Frame<V>>(
        &self,
        s: V::Simd,
        aabb: &Aabb,
        frame: &F,
        limit: V,
    ) -> Option<Crossing<V>> {
        match self.origin {
            Some(origin) => K::test(s, &seen_from(aabb, origin), &self.packet, frame, limit),
            None => K::test(s, aabb, &self.packet, frame, limit),
        }
    }
}

/// The packet as seen from its own origin.
#[inline(always)]
pub(super) fn from_origin<V: SimdF32>(s: V::Simd, packet: &Packet<V>) -> Packet<V> {
    Packet { origin: Vec3::splat(s, [0.0; 3]), ..*packet }
}

/// A box as seen from a point.
#[inline(always)]
pub(super) fn seen_from(aabb: &Aabb, [x, y, z]: [f32; 3]) -> Aabb {
    let [[x0, x1], [y0, y1], [z0, z1]] = aabb.axes;
    Aabb { axes: [[x0 - x, x1 - x], [y0 - y, y1 - y], [z0 - z, z1 - z]] }
}
