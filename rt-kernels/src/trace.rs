//! From a batch of rays to its hits, packet by packet: where a level and a packet size are chosen.

use std::marker::PhantomData;

use simd4::{Level, LevelError, Simd, SimdF32, dispatch, scalar};

use crate::accelerator::Visitor;
use crate::bvh::layout::SkipArray;
use crate::packet::{Any, Closest, Frame, Hits, LARGE, Packet, Query, Rays};
use crate::tri::{Method, TriangleKernel, with_kernel};
use crate::{Accelerator, Brute, Counters, Ray, Stats, single};

/// How many rays a packet has. The hits are the same for all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PacketSize {
    /// As many as one register of the level has lanes.
    #[default]
    Native,
    /// One ray at a time: over [wide nodes](crate::Layout) in all lanes of a vector, elsewhere in
    /// plain scalar code, whatever the level.
    Single,
    /// Four rays.
    Four,
    /// Eight rays.
    Eight,
    /// Sixteen rays.
    Sixteen,
    /// As many as go together, up to 64: over [wide nodes](crate::Layout) alone, where it is the
    /// native size.
    Large,
}

/// How to run a batch. No choice changes the hits.
#[derive(Clone, Copy, Debug)]
pub struct Exec {
    /// The instructions to use.
    pub level: Level,
    /// The rays that go together.
    pub packet: PacketSize,
}

impl Exec {
    /// The best level of this machine, and its native packets.
    ///
    /// # Errors
    /// As [`Level::best`].
    pub fn best() -> Result<Exec, LevelError> {
        Level::best().map(Exec::at)
    }

    /// That level, and its native packets.
    pub fn at(level: Level) -> Exec {
        Exec { level, packet: PacketSize::Native }
    }

    /// The nearest to it of what there is code for: where no register holds a packet, eight rays
    /// gain nothing on four, and sixteen nothing on eight; large packets are for
    /// [wide nodes](crate::Layout).
    pub(crate) fn compiled(self) -> Exec {
        let emulated = matches!(self.level, Level::Scalar(_));
        let packet = match self.packet {
            PacketSize::Eight | PacketSize::Sixteen if emulated => PacketSize::Four,
            PacketSize::Sixteen if self.level.lanes() == 16 => PacketSize::Native,
            PacketSize::Sixteen => PacketSize::Eight,
            PacketSize::Large => PacketSize::Native,
            packet => packet,
        };
        Exec { packet, ..self }
    }

    /// The nearest to it where there is code for the fewest: single rays, and registers of levels
    /// that have some.
    fn limited(self) -> Exec {
        let single = self.packet == PacketSize::Single || matches!(self.level, Level::Scalar(_));
        let packet = if single { PacketSize::Single } else { PacketSize::Native };
        Exec { packet, ..self }
    }

    /// The number of rays in a packet.
    pub fn lanes(&self) -> usize {
        match self.packet {
            PacketSize::Native => self.level.lanes(),
            PacketSize::Single => 1,
            PacketSize::Four => 4,
            PacketSize::Eight => 8,
            PacketSize::Sixteen => 16,
            PacketSize::Large => LARGE,
        }
    }
}

/// The traversal of one packet, which makes an [`Accelerator`].
pub(crate) trait Traverse: Send + Sync {
    /// Whether there is code for packets of any size, if the triangle test has it too.
    const ANY_PACKET: bool;

    /// Hands every primitive that the packet may hit to its kernel, triangles to `K`: that of the
    /// [method](Traverse::method).
    fn traverse<K: TriangleKernel, V: SimdF32, F: Frame<V>, Q: Query<V>>(
        &self,
        s: V::Simd,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Q,
        stats: &mut impl Counters,
    );

    /// The triangle test that it was built for.
    fn method(&self) -> Method;

    /// See [`Accelerator::bytes`].
    fn bytes(&self) -> usize;
}

/// A [`Traverse`] is an [`Accelerator`] at every level and packet size.
macro_rules! accelerator {
    ($Type:ty, any: $any:ident) => {
        impl Accelerator for $Type {
            fn closest(&self, exec: Exec, rays: &Rays, hits: &mut Hits, stats: &mut Stats) {
                closest(self, exec, rays, hits, stats);
            }

            fn any(&self, exec: Exec, rays: &Rays, found: &mut Vec<bool>, stats: &mut Stats) {
                $any(self, exec, rays, found, stats);
            }

            fn visit(&self, ray: &Ray, visitor: Visitor<'_>) {
                single::visit(self, ray, visitor);
            }

            fn exec(&self, asked: Exec) -> Exec {
                with_kernel!(Traverse::method(self), K => match any_packet::<Self, K>() {
                    true => asked.compiled(),
                    false => asked.limited(),
                })
            }

            fn bytes(&self) -> usize {
                Traverse::bytes(self)
            }
        }
    };
}

accelerator!(Brute, any: any_by_closest);
accelerator!(SkipArray, any: any);

pub(crate) fn closest<T: Traverse + Accelerator>(
    traverse: &T,
    exec: Exec,
    rays: &Rays,
    hits: &mut Hits,
    stats: &mut impl Counters,
) {
    hits.resize(rays.len());
    let exec = traverse.exec(exec);
    with_kernel!(traverse.method(), K => {
        run(exec, rays, &mut ClosestOf::<_, K>(traverse, hits, PhantomData), stats);
    });
}

pub(crate) fn any<T: Traverse + Accelerator>(
    traverse: &T,
    exec: Exec,
    rays: &Rays,
    found: &mut Vec<bool>,
    stats: &mut impl Counters,
) {
    found.clear();
    found.resize(rays.len(), false);
    let exec = traverse.exec(exec);
    with_kernel!(traverse.method(), K => {
        run(exec, rays, &mut AnyOf::<_, K>(traverse, found, PhantomData), stats);
    });
}

/// Without code of its own, for whom speed does not matter.
fn any_by_closest<T: Traverse + Accelerator>(
    traverse: &T,
    exec: Exec,
    rays: &Rays,
    found: &mut Vec<bool>,
    stats: &mut impl Counters,
) {
    let mut hits = Hits::new();
    closest(traverse, exec, rays, &mut hits, stats);
    hits.found(found);
}

const fn any_packet<T: Traverse, K: TriangleKernel>() -> bool {
    T::ANY_PACKET && K::ANY_PACKET
}

/// What is done with each packet of a batch.
trait Batch {
    /// Whether there is code for packets of any size.
    const ANY_PACKET: bool;

    fn packet<V: SimdF32>(
        &mut self,
        s: V::Simd,
        packet: &Packet<V>,
        first: usize,
        stats: &mut impl Counters,
    );
}

struct ClosestOf<'a, T, K>(&'a T, &'a mut Hits, PhantomData<K>);

impl<T: Traverse, K: TriangleKernel> Batch for ClosestOf<'_, T, K> {
    const ANY_PACKET: bool = any_packet::<T, K>();

    #[inline(always)]
    fn packet<V: SimdF32>(
        &mut self,
        s: V::Simd,
        packet: &Packet<V>,
        first: usize,
        stats: &mut impl Counters,
    ) {
        let mut query = Closest::new(s, packet);
        in_frame::<K, V, T, _>(self.0, s, packet, &mut query, stats);
        query.store(self.1, first);
    }
}

struct AnyOf<'a, T, K>(&'a T, &'a mut [bool], PhantomData<K>);

impl<T: Traverse, K: TriangleKernel> Batch for AnyOf<'_, T, K> {
    const ANY_PACKET: bool = any_packet::<T, K>();

    #[inline(always)]
    fn packet<V: SimdF32>(
        &mut self,
        s: V::Simd,
        packet: &Packet<V>,
        first: usize,
        stats: &mut impl Counters,
    ) {
        let mut query = Any::new(s, packet);
        in_frame::<K, V, T, _>(self.0, s, packet, &mut query, stats);
        query.store(self.1, first);
    }
}

#[inline(always)]
pub(crate) fn in_frame<K: TriangleKernel, V: SimdF32, T: Traverse, Q: Query<V>>(
    traverse: &T,
    s: V::Simd,
    packet: &Packet<V>,
    query: &mut Q,
    stats: &mut impl Counters,
) {
    match packet.frame(s) {
        Ok(frame) => traverse.traverse::<K, V, _, Q>(s, packet, &frame, query, stats),
        Err(frame) => traverse.traverse::<K, V, _, Q>(s, packet, &frame, query, stats),
    }
}

/// Cuts a batch into packets, once the level and the packet size are known.
fn run<B: Batch>(exec: Exec, rays: &Rays, batch: &mut B, stats: &mut impl Counters) {
    match exec.packet {
        PacketSize::Single => packets::<scalar::f32x1, _>(simd4::Scalar::new(), rays, batch, stats),
        _ => match exec.lanes() {
            4 => dispatch!(exec.level, s => four(s, rays, batch, stats)),
            8 => dispatch!(exec.level, s => eight(s, rays, batch, stats)),
            _ => dispatch!(exec.level, s => native(s, rays, batch, stats)),
        },
    }
}

// There is code only for what can come, and for no type twice.

#[inline(always)]
fn native<S: Simd>(s: S, rays: &Rays, batch: &mut impl Batch, stats: &mut impl Counters) {
    if const { S::LANES != 4 && S::LANES != 8 } {
        packets::<S::f32s, _>(s, rays, batch, stats);
    }
}

#[inline(always)]
fn four<S: Simd, B: Batch>(s: S, rays: &Rays, batch: &mut B, stats: &mut impl Counters) {
    if const { B::ANY_PACKET || is_register::<S>(4) } {
        packets::<S::f32x4, _>(s, rays, batch, stats);
    }
}

#[inline(always)]
fn eight<S: Simd, B: Batch>(s: S, rays: &Rays, batch: &mut B, stats: &mut impl Counters) {
    if const { B::ANY_PACKET && !S::EMULATED || is_register::<S>(8) } {
        packets::<S::f32x8, _>(s, rays, batch, stats);
    }
}

/// Whether the level has registers, and of that many lanes.
const fn is_register<S: Simd>(lanes: usize) -> bool {
    S::LANES == lanes && !S::EMULATED
}

#[inline(always)]
fn packets<V: SimdF32, C: Counters>(
    s: V::Simd,
    rays: &Rays,
    batch: &mut impl Batch,
    stats: &mut C,
) {
    let mut done = C::default();
    let mut first = 0;
    while first < rays.len() {
        batch.packet::<V>(s, &Packet::load(s, rays, first), first, &mut done);
        first += V::LANES;
    }
    *stats += done;
}
