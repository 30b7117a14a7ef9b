//! From a batch of rays to its hits, packet by packet: where a level and a packet size are chosen.

use std::marker::PhantomData;

use simd4::{Level, LevelError, Simd, SimdF32, dispatch, scalar};

use crate::accelerator::Visitor;
use crate::bvh::layout::SkipArray;
use crate::packet::{Either, Frame, Hits, LARGE, Packet, Query, Rays};
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
    /// As many as go together, up to 64: over [wide nodes](crate::Layout), where it is the native size,
    /// and in [kd-trees](crate::KdTree) for the default triangle test.
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
    ($Type:ty) => {
        impl Accelerator for $Type {
            fn closest(&self, exec: Exec, rays: &Rays, hits: &mut Hits, stats: &mut Stats) {
                trace(self, exec, rays, false, hits, stats);
            }

            fn any(&self, exec: Exec, rays: &Rays, found: &mut Vec<bool>, stats: &mut Stats) {
                let mut hits = Hits::new();
                trace(self, exec, rays, true, &mut hits, stats);
                hits.found(found);
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

accelerator!(Brute);
accelerator!(SkipArray);

/// Finds the closest hit of each ray or, with `any`, whichever is found first.
pub(crate) fn trace<T: Traverse + Accelerator>(
    traverse: &T,
    exec: Exec,
    rays: &Rays,
    any: bool,
    hits: &mut Hits,
    stats: &mut impl Counters,
) {
    hits.resize(rays.len());
    let exec = traverse.exec(exec);
    with_kernel!(traverse.method(), K => {
        run(exec, rays, &mut Batch::<_, K> { traverse, any, hits, kernel: PhantomData }, stats);
    });
}

const fn any_packet<T: Traverse, K: TriangleKernel>() -> bool {
    T::ANY_PACKET && K::ANY_PACKET
}

/// What is done with each packet of a batch. Whether one hit is enough is decided at run time: that
/// there is one loop and not two saves half the code.
struct Batch<'a, T, K> {
    traverse: &'a T,
    any: bool,
    hits: &'a mut Hits,
    kernel: PhantomData<K>,
}

impl<T: Traverse, K: TriangleKernel> Batch<'_, T, K> {
    /// Whether there is code for packets of any size.
    const ANY_PACKET: bool = any_packet::<T, K>();

    #[inline(always)]
    fn packet<V: SimdF32>(
        &mut self,
        s: V::Simd,
        packet: &Packet<V>,
        first: usize,
        stats: &mut impl Counters,
    ) {
        let mut query = Either::new(s, packet, self.any);
        in_frame::<K, V, T, _>(self.traverse, s, packet, &mut query, stats);
        query.store(self.hits, first);
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
fn run<T: Traverse, K: TriangleKernel>(
    exec: Exec,
    rays: &Rays,
    batch: &mut Batch<'_, T, K>,
    stats: &mut impl Counters,
) {
    match exec.packet {
        PacketSize::Single => {
            packets::<scalar::f32x1, _, _, _>(simd4::Scalar::new(), rays, batch, stats)
        }
        _ => match exec.lanes() {
            4 => dispatch!(exec.level, s => four(s, rays, batch, stats)),
            8 => dispatch!(exec.level, s => eight(s, rays, batch, stats)),
            _ => dispatch!(exec.level, s => native(s, rays, batch, stats)),
        },
    }
}

// There is code only for what can come, and for no type twice.

#[inline(always)]
fn native<S: Simd, T: Traverse, K: TriangleKernel>(
    s: S,
    rays: &Rays,
    batch: &mut Batch<'_, T, K>,
    stats: &mut impl Counters,
) {
    if const { S::LANES != 4 && S::LANES != 8 } {
        packets::<S::f32s, _, _, _>(s, rays, batch, stats);
    }
}

#[inline(always)]
fn four<S: Simd, T: Traverse, K: TriangleKernel>(
    s: S,
    rays: &Rays,
    batch: &mut Batch<'_, T, K>,
    stats: &mut impl Counters,
) {
    if const { Batch::<T, K>::ANY_PACKET || is_register::<S>(4) } {
        packets::<S::f32x4, _, _, _>(s, rays, batch, stats);
    }
}

#[inline(always)]
fn eight<S: Simd, T: Traverse, K: TriangleKernel>(
    s: S,
    rays: &Rays,
    batch: &mut Batch<'_, T, K>,
    stats: &mut impl Counters,
) {
    if const { Batch::<T, K>::ANY_PACKET && !S::EMULATED || is_register::<S>(8) } {
        packets::<S::f32x8, _, _, _>(s, rays, batch, stats);
    }
}

/// Whether the level has registers, and of that many lanes.
const fn is_register<S: Simd>(lanes: usize) -> bool {
    S::LANES == lanes && !S::EMULATED
}

#[inline(always)]
fn packets<V: SimdF32, T: Traverse, K: TriangleKernel, C: Counters>(
    s: V::Simd,
    rays: &Rays,
    batch: &mut Batch<'_, T, K>,
    stats: &mut C,
) {
    let mut done = C::default();
    let mut first = 0;
    while first < rays.len() {
        batch.packet::<V>(s, &Packet::load(s, rays, first), first, &mut done);
        first += V::LANES;
    }
    if V::LANES == 1 {
        done.count(|stats| stats.rays_alone += rays.len() as u64);
    }
    *stats += done;
}
