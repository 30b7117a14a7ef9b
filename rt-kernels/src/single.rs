//! One ray at a time: in one lane, or in all of them against as many things.

use simd4::scalar::f32x1;
use simd4::{Level, Scalar, Simd, SimdF32, dispatch};

use crate::accelerator::Visitor;
use crate::bvh::layout::Wide;
use crate::bvh::traverse::large::{self, Batch, Scratch};
use crate::bvh::traverse::wide::{self, Stack};
use crate::packet::{Ask, Hits, Packet, Rays, Single};
use crate::trace::{Traverse, in_frame};
use crate::tri::with_kernel;
use crate::{Accelerator, Counters, Exec, Hit, NoStats, PacketSize, Ray, Stats};

/// Shows a visitor what a ray hits, in no order.
pub(crate) fn visit<T: Traverse>(traverse: &T, ray: &Ray, visitor: Visitor<'_>) {
    let s = Scalar::new();
    let packet = Packet::<f32x1>::splat(s, ray);
    let mut query = Single::new(&packet, Ask::Each(visitor));
    let mut stats = NoStats;
    with_kernel!(traverse.method(), K => {
        in_frame::<K, f32x1, T, _>(traverse, s, &packet, &mut query, &mut stats);
    });
}

/// Over wide nodes single rays are in all lanes, and packets of any size go as large ones do.
impl<const N: usize> Accelerator for Wide<N>
where
    Self: Width,
{
    fn closest(&self, exec: Exec, rays: &Rays, hits: &mut Hits, stats: &mut Stats) {
        self.trace(exec, rays, false, hits, stats);
    }

    fn any(&self, exec: Exec, rays: &Rays, found: &mut Vec<bool>, stats: &mut Stats) {
        let mut hits = Hits::new();
        self.trace(exec, rays, true, &mut hits, stats);
        hits.found(found);
    }

    fn visit(&self, ray: &Ray, visitor: Visitor<'_>) {
        let level = Level::best().unwrap_or(Level::Scalar(Scalar::new()));
        one_by_one::<Stats, N>(self, level, Work::One { ray, visitor });
    }

    fn exec(&self, asked: Exec) -> Exec {
        let native = asked.packet == PacketSize::Native;
        Exec { packet: if native { PacketSize::Large } else { asked.packet }, ..asked }
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
enum Work<'a, C> {
    /// For the closest hit of each, or, with `any`, for whichever is found first.
    Batch { rays: &'a Rays, any: bool, hits: &'a mut Hits, stats: &'a mut C },
    /// Just one, for a visitor.
    One { ray: &'a Ray, visitor: Visitor<'a> },
}

impl<C> Work<'_, C> {
    fn len(&self) -> usize {
        match self {
            Work::Batch { rays, .. } => rays.len(),
            Work::One { .. } => 1,
        }
    }

    /// A ray, and what is asked of it.
    #[inline(always)]
    fn get(&mut self, i: usize) -> (Ray, Ask<'_>) {
        match self {
            Work::Batch { rays, any: true, .. } => (rays.get(i), Ask::Any),
            Work::Batch { rays, .. } => (rays.get(i), Ask::Closest),
            Work::One { ray, visitor } => (**ray, Ask::Each(visitor)),
        }
    }

    /// What a ray has found.
    #[inline(always)]
    fn found(&mut self, i: usize, hit: Hit) {
        if let Work::Batch { hits, .. } = self {
            hits.set(i, hit);
        }
    }
}

impl<const N: usize> Wide<N>
where
    Self: Width,
{
    /// For the closest hit of each ray, or, with `any`, for whichever is found first.
    pub(crate) fn trace(
        &self,
        exec: Exec,
        rays: &Rays,
        any: bool,
        hits: &mut Hits,
        stats: &mut impl Counters,
    ) {
        hits.resize(rays.len());
        let exec = self.exec(exec);
        match exec.packet {
            PacketSize::Single => {
                one_by_one(self, exec.level, Work::Batch { rays, any, hits, stats })
            }
            _ => {
                let batch = Batch { rays, most: exec.lanes(), any, hits };
                let mut scratch = Scratch::new(self);
                dispatch!(exec.level, s => large::trace::<_, <Self as Width>::Vector<_>, _, N>(
                    s, self, batch, &mut scratch, stats
                ));
            }
        }
    }
}

fn one_by_one<C: Counters, const N: usize>(wide: &Wide<N>, level: Level, work: Work<'_, C>)
where
    Wide<N>: Width,
{
    let mut stack = Stack::new(wide);
    dispatch!(level, s => in_all_lanes::<<Wide<N> as Width>::Vector<_>, _, N>(
        s, wide, work, &mut stack
    ));
}

#[inline(always)]
fn in_all_lanes<V: SimdF32, C: Counters, const N: usize>(
    s: V::Simd,
    wide: &Wide<N>,
    mut work: Work<'_, C>,
    stack: &mut Stack,
) {
    let mut done = C::default();
    for i in 0..work.len() {
        let (ray, ask) = work.get(i);
        let hit = wide::trace::<V, N>(s, wide, stack, &ray, ask, &mut done);
        work.found(i, hit);
    }
    done.count(|stats| stats.rays_alone += work.len() as u64);
    if let Work::Batch { stats, .. } = work {
        *stats += done;
    }
}
