//! Ray against triangle: one file a method, all behind [`TriangleKernel`].
//!
//! A kernel is one text for three uses: rays in lanes against one [`Record`], one ray in all lanes
//! against records in lanes ([`RecordBlock`]), and one against one, which is the same with one
//! lane. Its choices of [arithmetic](knobs) are type parameters. [`catalogue`] lists every kernel
//! with every choice; what renders is [`Watertight`]'s default, or another [`Method`] that was asked
//! for.
//!
//! Rays that run in a triangle's plane, triangles without area and numbers that are not finite hit
//! nothing, with any kernel, but for what the file of a kernel says.

mod across;
mod catalogue;
pub(crate) mod edge_volumes;
pub mod knobs;
pub(crate) mod method;
mod moller_trumbore;
mod moller_trumbore_f64;
mod own_box;
mod plucker;
mod record;
mod sweep;
mod wald;
mod watertight;

pub use across::Across;
pub use catalogue::{TriangleTest, catalogue};
pub use method::Method;
pub(crate) use method::with_kernel;
pub use moller_trumbore::MollerTrumbore;
pub use moller_trumbore_f64::MollerTrumboreF64;
pub use plucker::Plucker;
pub(crate) use record::OwnBoxLanes;
pub use record::{BlockLanes, Record, RecordBlock, Records};
pub use sweep::Triangles;
pub use wald::Wald;
pub use watertight::Watertight;

use simd4::scalar::f32x1;
use simd4::{Lanes, Scalar, SimdF32, SimdMask};

use self::knobs::{Division, Plain};
use crate::Hit;
use crate::geom::{Aabb, Triangle};
use crate::packet::{Coherent, Frame, Packet, Query};

/// A way to decide whether a ray meets a triangle, and where.
pub trait TriangleKernel: Send + Sync + 'static {
    /// What the method is called.
    const NAME: &'static str;
    /// Whether the bits of a hit are the same on every level and machine.
    const EXACT: bool;
    /// Whether it rounds a product and a sum once: slow on a level without such an instruction.
    const FUSED: bool = false;
    /// Whether it looks at the [`Frame`]. If not, any frame will do.
    const FRAMED: bool = false;
    /// Whether renderers have it for packets of any size. If not, for single rays and registers
    /// alone: code is what takes time to compile.
    const ANY_PACKET: bool = false;
    /// Whether it is for scalar use only.
    const SCALAR: bool = false;
    /// Whether its hits are held in the triangle's own box already
    /// ([why](crate#why-the-answer-is-one)).
    const IN_OWN_BOX: bool = false;

    /// Its choices, in words: distinct among the variants of one method.
    fn variant() -> String;

    /// What it keeps of a triangle, whose number is `prim`.
    fn record(triangle: &Triangle, prim: u32) -> Record;

    /// The lanes whose ray meets its record's triangle with `packet.tmin <= t <= limit`: `None`
    /// if there is none.
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Found<V>>;
}

/// What a kernel found.
#[derive(Clone, Copy, Debug)]
pub struct Found<V: SimdF32> {
    /// The lanes that hit.
    pub mask: V::Mask,
    /// The distance, in units of the direction's length.
    pub t: V,
    /// The weight of the second corner.
    pub u: V,
    /// The weight of the third corner.
    pub v: V,
}

/// Tests a packet against a record, or records in lanes, and records the hits.
#[inline(always)]
pub fn intersect<K: TriangleKernel, V: SimdF32, F: Frame<V>, R: Records<V>, Q: Query<V>>(
    s: V::Simd,
    records: &R,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Q,
) {
    if let Some(found) = K::test(s, records, packet, frame, query.limit())
        && found.mask.any()
    {
        query.record(s, found.mask, records.prim(s), found.t, found.u, found.v);
    }
}

/// The kernel that renders, before what it finds is held in the triangles' own boxes.
pub(crate) type WithoutBox = Watertight<Division, Plain, true, false>;

/// What [`WithoutBox`] has found for one ray in a block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Candidates {
    /// A bit for each triangle.
    pub(crate) lanes: u32,
    t: [f32; 8],
    u: [f32; 8],
    v: [f32; 8],
}

impl Candidates {
    /// Adds what was found among the triangles from `first` on.
    #[inline(always)]
    pub(crate) fn put<V: SimdF32>(&mut self, first: usize, found: &Found<V>) {
        let first = first & (8 - V::LANES);
        self.lanes |= found.mask.bitmask() << first;
        found.t.store(&mut self.t[first..]);
        found.u.store(&mut self.u[first..]);
        found.v.store(&mut self.v[first..]);
    }

    /// Keeps the best of them in `best`, if it is better than what is there. Each is held in its triangle's own
    /// box by itself: mostly there is but one.
    #[inline(always)]
    pub(crate) fn hold<const N: usize>(
        &self,
        block: &RecordBlock<N>,
        packet: &Packet<f32x1>,
        frame: &Coherent<f32x1>,
        best: &mut Hit,
    ) {
        let s = Scalar::new();
        let mut left = self.lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % 8;
            left &= left - 1;
            let one = BlockLanes::new(block, lane);
            let [t, u, v] = [&self.t, &self.u, &self.v].map(|lanes| f32x1::splat(s, lanes[lane]));
            let found = Found { mask: t.eq(t), t, u, v };
            let limit = f32x1::splat(s, best.t);
            let held = own_box::held(s, &one.own_boxes(s), packet, frame, limit, found);
            let prim = Records::<f32x1>::prim(&one, s).lane(0);
            let hit = Hit { t: held.t.lane(0), prim, u: u.lane(0), v: v.lane(0) };
            if held.mask.any() && hit.wins(best) {
                *best = hit;
            }
        }
    }
}

/// As [`intersect`], with hits held in the triangle's own box, which this is.
#[inline(always)]
pub fn intersect_in<K: TriangleKernel, V: SimdF32, F: Frame<V>, Q: Query<V>>(
    s: V::Simd,
    record: &Record,
    own_box: &Aabb,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Q,
) {
    let limit = query.limit();
    if let Some(found) = K::test(s, record, packet, frame, limit)
        && found.mask.any()
    {
        let held = own_box::held(s, own_box, packet, frame, limit, found);
        query.record(s, held.mask, Records::<V>::prim(record, s), held.t, held.u, held.v);
    }
}
