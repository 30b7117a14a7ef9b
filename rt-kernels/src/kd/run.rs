//! From a batch of rays to its hits, where a level and a packet size are chosen. What is asked is
//! decided at run time: it matters only where something is hit, and one loop is less to compile.

use simd4::scalar::f32x1;
use simd4::{Scalar, Simd, SimdF32, dispatch};

use super::traverse::{Stack, traverse};
use super::{KdTree, large};
use crate::accelerator::Visitor;
use crate::mailbox::Mail;
use crate::packet::{Ask, Either, Hits, Packet, Rays, Single};
use crate::tri::Method;
use crate::{Accelerator, Exec, PacketSize, Ray, Stats};

impl Accelerator for KdTree {
    fn closest(&self, exec: Exec, rays: &Rays, hits: &mut Hits, stats: &mut Stats) {
        self.run(exec, &mut Batch { rays, any: false, hits, stats });
    }

    fn any(&self, exec: Exec, rays: &Rays, found: &mut Vec<bool>, stats: &mut Stats) {
        let mut hits = Hits::new();
        self.run(exec, &mut Batch { rays, any: true, hits: &mut hits, stats });
        hits.found(found);
    }

    fn visit(&self, ray: &Ray, visitor: Visitor<'_>) {
        single(
            self,
            &mut std::iter::once((*ray, Ask::Each(visitor))),
            &mut |_, _| {},
            &mut Stats::default(),
        );
    }

    fn exec(&self, asked: Exec) -> Exec {
        let packet = match asked.packet {
            PacketSize::Large if self.is_for_large() => PacketSize::Large,
            PacketSize::Eight | PacketSize::Sixteen if asked.level.lanes() == 4 => PacketSize::Four,
            _ => return asked.compiled(),
        };
        Exec { packet, ..asked }
    }

    fn bytes(&self) -> usize {
        KdTree::bytes(self)
    }
}

/// The closest hits of some rays, or for each whichever is found first.
struct Batch<'a> {
    rays: &'a Rays,
    any: bool,
    hits: &'a mut Hits,
    stats: &'a mut Stats,
}

impl KdTree {
    /// Large packets are for the default triangle test.
    fn is_for_large(&self) -> bool {
        self.plan.method == Method::default()
    }

    fn run(&self, exec: Exec, batch: &mut Batch<'_>) {
        batch.hits.resize(batch.rays.len());
        let exec = Accelerator::exec(self, exec);
        match exec.packet {
            PacketSize::Large => {
                let Batch { rays, any, hits, stats } = batch;
                let mut done = Stats::default();
                let mut scratch = large::Scratch::new(self);
                dispatch!(exec.level, s => large::trace(
                    s, self, rays, *any, hits, &mut scratch, &mut done
                ));
                **stats += done;
            }
            PacketSize::Single => {
                let Batch { rays, any, hits, stats } = batch;
                let mut asks = (0..rays.len())
                    .map(|i| (rays.get(i), if *any { Ask::Any } else { Ask::Closest }));
                single(self, &mut asks, &mut |i, hit| hits.set(i, hit), stats);
            }
            _ => {
                let mut mail = Mail::new(self.plan.mailbox, &self.stamps);
                let mail = &mut mail;
                match exec.lanes() {
                    4 => dispatch!(exec.level, s => four(s, self, batch, mail)),
                    8 => dispatch!(exec.level, s => eight(s, self, batch, mail)),
                    _ => dispatch!(exec.level, s => native(s, self, batch, mail)),
                }
            }
        }
    }
}

/// Ray by ray, and what is asked of each.
fn single<'a>(
    tree: &KdTree,
    asks: &mut dyn Iterator<Item = (Ray, Ask<'a>)>,
    found: &mut dyn FnMut(usize, crate::Hit),
    stats: &mut Stats,
) {
    let s = Scalar::new();
    let mut stack = Stack::<f32x1>::new(s);
    let mut mail = Mail::new(tree.plan.mailbox, &tree.stamps);
    let mut done = Stats::default();
    for (i, (ray, ask)) in asks.enumerate() {
        let packet = Packet::splat(s, &ray);
        let mut query = Single::new(&packet, ask);
        traverse(s, tree, &mut stack, &mut mail, &packet, &mut query, &mut done);
        found(i, query.hit());
        done.rays_alone += 1;
    }
    *stats += done;
}

// There is code only for what can come, and for no type twice.

#[inline(always)]
fn native<S: Simd>(s: S, tree: &KdTree, batch: &mut Batch<'_>, mail: &mut Mail<'_>) {
    if const { S::LANES != 4 && S::LANES != 8 } {
        packets::<S::f32s>(s, tree, batch, mail);
    }
}

#[inline(always)]
fn four<S: Simd>(s: S, tree: &KdTree, batch: &mut Batch<'_>, mail: &mut Mail<'_>) {
    packets::<S::f32x4>(s, tree, batch, mail);
}

#[inline(always)]
fn eight<S: Simd>(s: S, tree: &KdTree, batch: &mut Batch<'_>, mail: &mut Mail<'_>) {
    if const { S::LANES >= 8 } {
        packets::<S::f32x8>(s, tree, batch, mail);
    }
}

#[inline(always)]
fn packets<V: SimdF32>(s: V::Simd, tree: &KdTree, batch: &mut Batch<'_>, mail: &mut Mail<'_>) {
    let Batch { rays, any, hits, stats } = batch;
    let mut stack = Stack::<V>::new(s);
    let mut done = Stats::default();
    let mut first = 0;
    while first < rays.len() {
        let packet = Packet::<V>::load(s, rays, first);
        let mut query = Either::new(s, &packet, *any);
        traverse(s, tree, &mut stack, mail, &packet, &mut query, &mut done);
        query.store(hits, first);
        first += V::LANES;
    }
    **stats += done;
}
