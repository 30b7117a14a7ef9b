//! One ray at a time: in one lane, or in all of them against as many things.

use simd4::scalar::f32x1;
use simd4::{Level, Scalar, Simd, SimdF32, dispatch};

use crate::accelerator::Visitor;
use crate::bvh::layout::Wide;
use crate::bvh::traverse::large;
use crate::bvh::traverse::wide::{self, Stack};
use crate::packet::{Ask, Hits, Packet, Rays, Single};
use crate::trace::{Traverse, in_frame};
use crate::tri::with_kernel;
use crate::{Accelerator, Exec, PacketSize, Ray, Stats};

/// Shows a visitor what a ray hits, in no order.
pub(crate) fn visit<T: Traverse>(traverse: &T, ray: &Ray, visitor: Visitor<'_>) {
    let s = Scalar::new();
    let packet = Packet::<f32x1>::splat(s, ray);
    let mut query = Single::new(&packet, Ask::Each(visitor));
    let mut stats = Stats::default();
    with_kernel!(traverse.method(), K => {
        in_frame::<K, f32x1, T, _>(traverse, s, &packet, &mut query, &mut stats);
    });
}

/// Wide nodes are for single rays, one in all lanes, and else for large packets, whatever
/// packets are asked for.
impl<const N: usize> Accelerator for Wide<N>
where
    Self: Width,
{
    fn closest(&self, exec: Exec, rays: &Rays, hits: &mut Hits, stats: &mut Stats) {
        hits.resize(rays.len());
        batch(self, exec, rays, false, hits, stats);
    }

    fn any(&self, exec: Exec, rays: &Rays, found: &mut Vec<bool>, stats: &mut Stats) {
        let mut hits = Hits::new();
        hits.resize(rays.len());
        batch(self, exec, rays, true, &mut hits, stats);
        hits.found(found);
    }

    fn visit(&self, ray: &Ray, visitor: Visitor<'_>) {
        let level = Level::best().unwrap_or(Level::Scalar(Scalar::new()));
        one_by_one(self, level, Work::One { ray, visitor });
    }

    fn exec(&self, asked: Exec) -> Exec {
        let single = asked.packet == PacketSize::Single;
        Exec { packet: if single { PacketSize::Single } else { PacketSize::Large }, ..asked }
    }

    fn bytes(&self) -> usize {
        Wide::bytes(self)
    }
}

/// The vector that has a lane for each child of a node.
pub trait Width {
    /// At a level.
    type Vector<S: Simd>: SimdF32<Simd = S>;
}

impl Width for Wide<4> {
    type Vector<S: Simd> = S::f32x4;
}

impl Width for Wide<8> {
    type Vector<S: Simd> = S::f32x8;
}

/// Rays that go one by one. What is asked is decided at run time, since it matters only where
/// something is hit: that there is one loop and not three saves as much code.
enum Work<'a> {
    /// For the closest hit of each, or, with `any`, for whichever is found first.
    Batch { rays: &'a Rays, any: bool, hits: &'a mut Hits, stats: &'a mut Stats },
    /// Just one, for a visitor.
    One { ray: &'a Ray, visitor: Visitor<'a> },
}

fn batch<const N: usize>(
    wide: &Wide<N>,
    exec: Exec,
    rays: &Rays,
    any: bool,
    hits: &mut Hits,
    stats: &mut Stats,
) where
    Wide<N>: Width,
{
    let mut done = Stats::default();
    match exec.packet {
        PacketSize::Single => {
            one_by_one(wide, exec.level, Work::Batch { rays, any, hits, stats: &mut done })
        }
        _ => dispatch!(exec.level, s => large::trace::<_, <Wide<N> as Width>::Vector<_>, N>(
            s, wide, rays, any, hits, &mut done
        )),
    }
    *stats += done;
}

fn one_by_one<const N: usize>(wide: &Wide<N>, level: Level, work: Work<'_>)
where
    Wide<N>: Width,
{
    dispatch!(level, s => in_all_lanes::<<Wide<N> as Width>::Vector<_>, N>(s, wide, work));
}

#[inline(always)]
fn in_all_lanes<V: SimdF32, const N: usize>(s: V::Simd, wide: &Wide<N>, work: Work<'_>) {
    let mut stack = Stack::new(wide);
    match work {
        Work::Batch { rays, any, hits, stats } => {
            for i in 0..rays.len() {
                let ask = if any { Ask::Any } else { Ask::Closest };
                let hit = wide::trace::<V, N>(s, wide, &mut stack, &rays.get(i), ask, stats);
                hits.set(i, hit);
            }
        }
        Work::One { ray, visitor } => {
            let mut stats = Stats::default();
            wide::trace::<V, N>(s, wide, &mut stack, ray, Ask::Each(visitor), &mut stats);
        }
    }
}
