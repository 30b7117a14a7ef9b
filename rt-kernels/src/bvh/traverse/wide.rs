//! One ray over nodes of N children: their boxes are tested at once, and children visited from near
//! to far.
//!
//! A stack holds the children that are still to be visited, each with the distance at which the ray
//! enters it; what was found closer since then drops it unvisited.
//!
//! **The answer** is that of every other traversal ([why](crate#why-the-answer-is-one)). Each lane does
//! the operations that a lane of a packet does, on the same numbers, so boxes and triangles are
//! decided bit for bit as there. A child is left out only if the ray misses its box or enters it
//! after the bound. The bound never falls below the `t` of the closest hit, and the boxes above that
//! hit are entered no later than it: they are visited in any order. Equal `t` go to the lowest
//! primitive among lanes as among visits.
//!
//! **The stack** cannot overflow: it is made for the layout's depth. Of a node's children, at most N,
//! one is gone on with and the others are put on it; so D nodes one below the other leave no more
//! than D (N − 1) entries.
//!
//! Source: Wald, Benthin, Boulos, "Getting Rid of Packets", 2008; Dammertz, Hanika, Keller, "Shallow
//! Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent Rays", 2008. Deviation: the
//! children of a node are all sorted, by distance.

use std::ops::Range;

use simd4::{SimdF32, SimdMask};

use crate::bvh::layout::{Child, Wide, WideNode};
use crate::packet::{Ask, Coherent, Frame, Packet, Query, Single};
use crate::quadric::{cone, sphere};
use crate::slab::{BoxKernel, Crossing, Robust};
use crate::tri::knobs::Division;
use crate::tri::{self, BlockLanes, Watertight};
use crate::{Counters, Hit, Ray};

/// Children that are still to be visited.
pub struct Stack(Vec<Entry>);

#[derive(Clone, Copy)]
struct Entry {
    child: Child,
    /// Where the ray enters its box, or starts in it.
    enter: f32,
}

impl Stack {
    /// Room for any ray in that hierarchy.
    pub fn new<const N: usize>(wide: &Wide<N>) -> Stack {
        let entry = Entry { child: Child::ROOT, enter: 0.0 };
        Stack(vec![entry; wide.depth() * (N - 1)])
    }
}

/// What one ray finds: nothing if its number is [`Hits::NONE`].
#[inline(always)]
pub(crate) fn trace<V: SimdF32, const N: usize>(
    s: V::Simd,
    wide: &Wide<N>,
    stack: &mut Stack,
    ray: &Ray,
    ask: Ask<'_>,
    stats: &mut impl Counters,
) -> Hit {
    let packet = Packet::<V>::splat(s, ray);
    let mut query = Single::new(&packet, ask);
    let frame = Coherent::of_one(s, ray);
    traverse(s, wide, stack, Child::ROOT, &packet, &frame, &mut query, stats);
    query.hit()
}

/// Hands the primitives of every leaf below a child that the ray, which is in all N lanes of
/// `packet`, may hit to their kernels, until the query is done.
#[expect(clippy::too_many_arguments, reason = "strategies and state are arguments")]
#[inline(always)]
pub(crate) fn traverse<V: SimdF32, F: Frame<V>, const N: usize>(
    s: V::Simd,
    wide: &Wide<N>,
    stack: &mut Stack,
    mut child: Child,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Single<'_, V>,
    stats: &mut impl Counters,
) {
    let nodes = wide.nodes();
    let stack = &mut *stack.0;
    let mut top = 0;
    let mut visits = 0;
    'visits: loop {
        match child.find() {
            Ok(node) => {
                let Some(node) = nodes.get(node) else { break };
                visits += 1;
                let crossing = Robust::<Division>::test(s, node, packet, frame, query.limit());
                if let Some(Crossing { mask, enter }) = crossing {
                    let enter = enter.to_array();
                    let lanes = mask.bitmask();
                    wide.prefetch(s, node, lanes);
                    child = descend(node, lanes, enter.as_ref(), stack, &mut top);
                    continue;
                }
            }
            Err(slots) => {
                leaf(s, wide, &slots, packet, frame, query, stats);
                if query.done(s) {
                    break;
                }
            }
        }
        loop {
            if top == 0 {
                break 'visits;
            }
            top -= 1;
            if stack[top].enter <= query.bound() {
                child = stack[top].child;
                break;
            }
        }
    }
    stats.count(|stats| stats.node_visits += visits);
    stats.count(|stats| stats.active_rays += visits);
    stats.count(|stats| stats.box_tests += visits * N as u64);
}

/// Tests the ray against the primitives in some slots.
#[inline(always)]
pub(super) fn leaf<V: SimdF32, F: Frame<V>, const N: usize>(
    s: V::Simd,
    wide: &Wide<N>,
    slots: &Range<usize>,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Single<'_, V>,
    stats: &mut impl Counters,
) {
    for block in wide.blocks(slots) {
        stats.count(|stats| stats.triangle_tests += N as u64);
        for part in 0..N / V::LANES {
            let triangles = BlockLanes::new(block, part * V::LANES);
            tri::intersect::<Watertight, V, F, _, _>(s, &triangles, packet, frame, query);
        }
    }
    for record in wide.spheres(slots) {
        stats.count(|stats| stats.sphere_tests += 1);
        sphere::intersect(s, record, packet, frame, query);
    }
    for record in wide.cones(slots) {
        stats.count(|stats| stats.cone_tests += 1);
        cone::intersect(s, record, packet, frame, query);
    }
}

/// Of the children in these lanes the nearest; the others are put on the stack, the nearer the
/// higher.
#[inline(always)]
fn descend<const N: usize>(
    node: &WideNode<N>,
    mut lanes: u32,
    enter: &[f32],
    stack: &mut [Entry],
    top: &mut usize,
) -> Child {
    let first = *top;
    let mut nearest = take(node, &mut lanes, enter);
    while lanes != 0 {
        let mut next = take(node, &mut lanes, enter);
        if next.enter < nearest.enter {
            (nearest, next) = (next, nearest);
        }
        let mut at = *top;
        while at > first && stack[at - 1].enter < next.enter {
            stack[at] = stack[at - 1];
            at -= 1;
        }
        stack[at] = next;
        *top += 1;
    }
    nearest.child
}

/// The first of the lanes, which is none of them any more.
#[inline(always)]
fn take<const N: usize>(node: &WideNode<N>, lanes: &mut u32, enter: &[f32]) -> Entry {
    // The mask tells the compiler that the lane is within the node.
    let lane = lanes.trailing_zeros() as usize & (N - 1);
    *lanes &= *lanes - 1;
    Entry { child: node.child(lane), enter: enter[lane] }
}
