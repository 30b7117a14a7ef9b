//! Traversal from front to back with a segment of the ray for each lane.
//!
//! The packet goes on to a child if the segment of any ray meets it; a ray whose segment is empty goes
//! along. The rays of a packet agree in the signs of their directions, and with that in which child
//! comes first; a packet in which they differ is taken in groups that agree, one after the other.
//! What has been found ends the segments of cells that are still to come.
//!
//! Source: Wald et al. 2001, Section 4.1. Deviations: the distance to a split is widened to both sides
//! ([why](super#why-the-answer-is-one)), and hits need not lie within the cell.

use simd4::{Simd, SimdF32, SimdMask};

use super::{KdTree, WIDER};
use crate::Stats;
use crate::mailbox::Mail;
use crate::packet::{Coherent, Frame, Mixed, Packet, Query};
use crate::tri::{Method, TriangleKernel, with_kernel};

use super::build::MAX_DEPTH;
use super::layout::Node;

/// Cells that are still to be visited. Each is the sibling of one above the present cell, so that
/// there are fewer than the tree is deep.
pub(super) struct Stack<V>([Cell<V>; MAX_DEPTH]);

/// A cell, and the segments of the rays in it.
#[derive(Clone, Copy)]
pub(super) struct Cell<V> {
    pub(super) node: Node,
    pub(super) near: V,
    pub(super) far: V,
}

impl<V: SimdF32> Stack<V> {
    #[inline(always)]
    pub(super) fn new(s: V::Simd) -> Stack<V> {
        let zero = V::splat(s, 0.0);
        Stack([Cell { node: Node::default(), near: zero, far: zero }; MAX_DEPTH])
    }
}

/// How the packet looks at the axes, and with that which kernels it is handed to.
pub(super) trait Look<V: SimdF32> {
    /// Tests a packet against one primitive.
    fn test<Q: Query<V>>(
        &self,
        s: V::Simd,
        tree: &KdTree,
        slot: usize,
        packet: &Packet<V>,
        query: &mut Q,
        stats: &mut Stats,
    );
}

/// For any triangle test.
type Sight<V> = Result<Coherent<V>, Mixed<V>>;

/// Hands the primitives of every leaf that some ray may hit to their kernels.
#[inline(always)]
pub(super) fn traverse<V: SimdF32, Q: Query<V>>(
    s: V::Simd,
    tree: &KdTree,
    stack: &mut Stack<V>,
    mail: &mut Mail<'_>,
    packet: &Packet<V>,
    query: &mut Q,
    stats: &mut Stats,
) {
    mail.next_packet();
    let sight = tree.sight(s, packet);
    let zero = V::splat(s, 0.0);
    let inv = [packet.inv.x, packet.inv.y, packet.inv.z];
    let negative = [inv[0].lt(zero), inv[1].lt(zero), inv[2].lt(zero)];
    let mut waiting = packet.active();
    while let Some(lane) = waiting.first() {
        let mut group = waiting;
        let mut signs = [0; 3];
        for (sign, negative) in signs.iter_mut().zip(negative) {
            *sign = (negative.bitmask() >> lane & 1) as usize;
            group &= if *sign == 1 { negative } else { !negative };
        }
        one_way(s, tree, stack, mail, packet, (&sight, group, signs), query, stats);
        if query.done(s) {
            break;
        }
        waiting &= !group;
    }
}

/// The rays of a packet that agree in the signs of their directions.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "it is one function with its caller")]
fn one_way<V: SimdF32, Q: Query<V>>(
    s: V::Simd,
    tree: &KdTree,
    stack: &mut Stack<V>,
    mail: &mut Mail<'_>,
    packet: &Packet<V>,
    (sight, group, signs): (&Sight<V>, V::Mask, [usize; 3]),
    query: &mut Q,
    stats: &mut Stats,
) {
    let [sooner, later] = [V::splat(s, 1.0 - WIDER), V::splat(s, 1.0 + WIDER)];
    let origin = [packet.origin.x, packet.origin.y, packet.origin.z];
    let inv = [packet.inv.x, packet.inv.y, packet.inv.z];

    // NaN is the first operand of a minimum or a maximum where it can be: the other is the result.
    let mut near = group.select(packet.tmin, V::splat(s, f32::INFINITY));
    let mut far = query.limit();
    for axis in 0..3 {
        let sides = tree.bounds.axes[axis];
        let (first, last) = (sides[signs[axis] & 1], sides[!signs[axis] & 1]);
        let first = (V::splat(s, first) - origin[axis]) * inv[axis];
        let last = (V::splat(s, last) - origin[axis]) * inv[axis];
        near = (first * sooner).max(near);
        far = (last * later).min(far);
    }

    if near.le(far).any() {
        let cell = Cell { node: tree.cells.pairs[0].0[0], near, far };
        cells(s, tree, stack, mail, packet, (sight, signs), cell, query, stats);
    }
}

/// What those rays meet in a cell and in all that follow within it.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "it is one function with its caller")]
pub(super) fn cells<V: SimdF32, L: Look<V>, Q: Query<V>>(
    s: V::Simd,
    tree: &KdTree,
    stack: &mut Stack<V>,
    mail: &mut Mail<'_>,
    packet: &Packet<V>,
    (look, signs): (&L, [usize; 3]),
    Cell { mut node, mut near, mut far }: Cell<V>,
    query: &mut Q,
    stats: &mut Stats,
) {
    let [sooner, later] = [V::splat(s, 1.0 - WIDER), V::splat(s, 1.0 + WIDER)];
    let origin = [packet.origin.x, packet.origin.y, packet.origin.z];
    let inv = [packet.inv.x, packet.inv.y, packet.inv.z];
    let stack = &mut stack.0;
    let mut top = 0;
    let mut visits = 0;
    'cells: loop {
        visits += 1;
        if let Some(axis) = node.axis() {
            let (origin, inv) = (origin[axis], inv[axis]);
            let split = (V::splat(s, node.at()) - origin) * inv;
            let leave = (split * later).min(far);
            let enter = (split * sooner).max(near);
            let children = &tree.cells.pairs[node.pair()].0;
            let sign = signs[axis] & 1;
            let [first, second] = [children[sign], children[1 - sign]];
            tree.prefetch(s, first);
            tree.prefetch(s, second);
            let (to_first, to_second) = (near.le(leave).any(), enter.le(far).any());
            if to_second {
                if to_first {
                    stack[top] = Cell { node: second, near: enter, far };
                    top += 1;
                    (node, far) = (first, leave);
                } else {
                    (node, near) = (second, enter);
                }
            } else {
                node = first;
            }
            continue;
        }
        for &slot in &tree.cells.list[node.slots()] {
            if mail.untested(slot, 1) == 0 {
                stats.mailed += V::LANES as u64;
            } else {
                look.test(s, tree, slot as usize, packet, query, stats);
            }
        }
        if query.done(s) {
            break;
        }
        loop {
            if top == 0 {
                break 'cells;
            }
            top -= 1;
            let cell = &stack[top];
            (node, near, far) = (cell.node, cell.near, cell.far.min(query.limit()));
            if near.le(far).any() {
                break;
            }
        }
    }
    stats.node_visits += visits;
    stats.box_tests += visits * V::LANES as u64;
}

impl KdTree {
    /// Only the default triangle test has code for packets that agree: it alone looks at the axes.
    #[inline(always)]
    fn sight<V: SimdF32>(&self, s: V::Simd, packet: &Packet<V>) -> Sight<V> {
        match self.plan.method {
            Method::Watertight => packet.frame(s),
            _ => Err(packet.mixed(s)),
        }
    }
}

impl KdTree {
    /// Sends for what a node leads to, before it is known whether it is needed: in a tree that fits into
    /// no cache it spares packets a twentieth of their time.
    #[inline(always)]
    fn prefetch<S: Simd>(&self, s: S, node: Node) {
        let pairs = self.cells.pairs.as_ptr().wrapping_add(node.pair());
        let list = self.cells.list.as_ptr().wrapping_add(node.slots().start);
        // Without a branch, which would be a guess.
        s.prefetch(if node.axis().is_some() { pairs } else { list.cast() });
    }
}

impl<V: SimdF32> Look<V> for Sight<V> {
    #[inline(always)]
    fn test<Q: Query<V>>(
        &self,
        s: V::Simd,
        tree: &KdTree,
        slot: usize,
        packet: &Packet<V>,
        query: &mut Q,
        stats: &mut Stats,
    ) {
        match self {
            Ok(frame) => frame.test(s, tree, slot, packet, query, stats),
            Err(frame) => with_kernel!(tree.plan.method, K => {
                test_with::<K, V, _, Q>(s, tree, slot, packet, frame, query, stats);
            }),
        }
    }
}

/// For the default triangle test.
impl<V: SimdF32> Look<V> for Coherent<V> {
    #[inline(always)]
    fn test<Q: Query<V>>(
        &self,
        s: V::Simd,
        tree: &KdTree,
        slot: usize,
        packet: &Packet<V>,
        query: &mut Q,
        stats: &mut Stats,
    ) {
        test_with::<crate::tri::Watertight, V, _, Q>(s, tree, slot, packet, self, query, stats);
    }
}

#[inline(always)]
fn test_with<K: TriangleKernel, V: SimdF32, F: Frame<V>, Q: Query<V>>(
    s: V::Simd,
    tree: &KdTree,
    slot: usize,
    packet: &Packet<V>,
    frame: &F,
    query: &mut Q,
    stats: &mut Stats,
) {
    tree.store.intersect::<K, V, F, Q>(s, slot..slot + 1, packet, frame, query, stats);
}
