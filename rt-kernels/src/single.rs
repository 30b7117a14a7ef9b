//! One ray at a time: in one lane, or in all of them against as many things.

use simd4::scalar::f32x1;
use simd4::{Level, Scalar, Simd, SimdF32, dispatch};

use crate::accelerator::Visitor;
use crate::bvh::layout::Wide;
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

/// Wide nodes are for single rays: whatever packets are asked for, there is one ray in all lanes.
impl<const N: usize> Accelerator for Wide<N>
where
    Self: Width,
{
    fn closest(&self, exec: Exec, rays: &Rays, hits: &mut Hits, stats: &mut Stats) {
        hits.resize(rays.len());
        one_by_one(self, exec.level, Work::Batch { rays, any: false, hits, stats });
    }

    fn any(&self, exec: Exec, rays: &Rays, found: &mut Vec<bool>, stats: &mut Stats) {
        let mut hits = Hits::new();
        hits.resize(rays.len());
        one_by_one(self, exec.level, Work::Batch { rays, any: true, hits: &mut hits, stats });
        hits.found(found);
    }

    fn visit(&self, ray: &Ray, visitor: Visitor<'_>) {
        let level = Level::best().unwrap_or(Level::Scalar(Scalar::new()));
        one_by_one(self, level, Work::One { ray, visitor });
    }

    fn exec(&self, asked: Exec) -> Exec {
        Exec { packet: PacketSize::Single, ..asked }
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

fn one_by_one<const N: usize>(wide: &Wide<N>, level: Level, work: Work<'_>)
where
    Wide<N>: Width,
{
    dispatch!(level, s => in_all_lanes::<<Wide<N> as Width>::Vector<_>, N>(s, wide, work));
}

#[inline(always)]
fn in_all_lanes<V: SimdF32, const N: usize>(s: V::Simd, wide: &Wide<N>, mut work: Work<'_>) {
    let mut stack = Stack::new(wide);
    let mut done = Stats::default();
    let mut i = 0;
    loop {
        let (ray, ask) = match &mut work {
            Work::Batch { rays, .. } if i == rays.len() => break,
            Work::Batch { rays, any, .. } => {
                (rays.get(i), if *any { Ask::Any } else { Ask::Closest })
            }
            Work::One { .. } if i == 1 => break,
            Work::One { ray, visitor } => (**ray, Ask::Each(visitor)),
        };
        let packet = Packet::<V>::splat(s, &ray);
        let mut query = Single::new(&packet, ask);
        // All lanes agree.
        if let Ok(frame) = packet.frame(s) {
            wide::traverse(s, wide, &mut stack, &packet, &frame, &mut query, &mut done);
        }
        let found = query.hit();
        if let Work::Batch { hits, .. } = &mut work {
            hits.set(i, found);
        }
        i += 1;
    }
    if let Work::Batch { stats, .. } = work {
        *stats += done;
    }
}
