//! Nodes of up to N children, 4 or 8, whose boxes are tested at once, one in each lane.
//!
//! How a build tree becomes one is in [`convert`](super::convert).
//!
//! A lane without a child has the box from +∞ to −∞. A ray enters it at +∞ and leaves it at −∞ on
//! every axis, whatever its direction, and so misses it; a box of NaNs would be met by every ray, since
//! a distance that is NaN counts as no end ([`robust`](crate::slab::robust)).
//!
//! Source: Wald, Benthin, Boulos, "Getting Rid of Packets", 2008; Dammertz, Hanika, Keller,
//! "Shallow Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent Rays", 2008.

use std::ops::Range;

use simd4::{Lanes, Simd, SimdF32, SimdMask, SimdU32};

use super::order::{Half, Order, without_gaps};
use crate::bvh::refit::Refit;
use crate::geom::Aabb;
use crate::packet::Boxes;
use crate::primitives::{KINDS, Primitives, SphereRecord};
use crate::quadric::cone::ConeRecord;
use crate::tri::{Record, RecordBlock, TriangleKernel, Watertight};

/// Up to N boxes by side (SoA), and what is in them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct WideNode<const N: usize> {
    sides: [[[f32; N]; 2]; 3],
    children: [u32; N],
    /// In which order rays come by them.
    order: Order<N>,
}

const _: () = assert!(size_of::<WideNode<4>>() == 128, "two cache lines");
const _: () = assert!(size_of::<WideNode<8>>() == 256, "four cache lines");

impl<const N: usize> WideNode<N> {
    /// No children.
    pub(super) const EMPTY: Self = WideNode {
        sides: [[[f32::INFINITY; N], [f32::NEG_INFINITY; N]]; 3],
        children: [Child::NONE.0; N],
        order: Order::ANY,
    };

    pub(super) fn set_box(&mut self, lane: usize, aabb: &Aabb) {
        for (sides, axis) in self.sides.iter_mut().zip(aabb.axes) {
            for (side, value) in sides.iter_mut().zip(axis) {
                side[lane] = value;
            }
        }
    }

    /// Guesses in which order rays come by the children.
    pub(super) fn set_order(&mut self) {
        // Where there is no child, from infinity to its opposite, that is NaN.
        let centers = self
            .sides
            .each_ref()
            .map(|[low, high]| std::array::from_fn(|lane| low[lane] + high[lane]));
        self.order = Order::of(&centers);
    }

    /// Its halves, for rays of an octant, the one that they come by last first; the second is of no account if
    /// `V` has a lane for each child: then the first is all.
    #[inline(always)]
    pub(crate) fn parts(&self, octant: u32) -> [Part<'_, N>; 2] {
        self.order.halves(octant).map(|half| Part { node: self, half, octant })
    }

    /// The child in a lane.
    #[inline(always)]
    pub(crate) fn child(&self, lane: usize) -> Child {
        Child(self.children[lane & (N - 1)])
    }

    pub(super) fn set_child(&mut self, lane: usize, child: Child) {
        self.children[lane] = child.0;
    }

    /// The same after so many nodes, and its leaves after so many slots.
    pub(super) fn after(mut self, nodes: usize, slots: usize) -> Self {
        for child in self.children.iter_mut().filter(|child| **child != Child::NONE.0) {
            let one = Child(*child);
            *child = one.after(if one.is_leaf() { slots } else { nodes }).0;
        }
        self
    }

    /// The children and their boxes.
    pub(crate) fn boxes(&self) -> impl Iterator<Item = (Child, Aabb)> {
        let lanes = (0..N).map(|lane| (self.child(lane), self.aabb(lane)));
        lanes.filter(|(child, _)| *child != Child::NONE)
    }

    /// The box of one child.
    #[inline(always)]
    pub(crate) fn aabb(&self, lane: usize) -> Aabb {
        let [x, y, z] = &self.sides;
        Aabb {
            axes: [[x[0][lane], x[1][lane]], [y[0][lane], y[1][lane]], [z[0][lane], z[1][lane]]],
        }
    }

    /// The box around those of all children.
    fn bounds(&self) -> Aabb {
        let least = |lanes: &[f32; N]| lanes.iter().copied().fold(f32::INFINITY, f32::min);
        let greatest = |lanes: &[f32; N]| lanes.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        Aabb { axes: self.sides.each_ref().map(|[low, high]| [least(low), greatest(high)]) }
    }
}

/// As many lanes of a node as fit into a register.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part<'a, const N: usize> {
    node: &'a WideNode<N>,
    half: Half,
    octant: u32,
}

impl<const N: usize> Part<'_, N> {
    /// Its first lane.
    #[inline(always)]
    fn first<V: Lanes>(&self) -> usize {
        (self.half.half * V::LANES) & (N - V::LANES)
    }

    /// The children in the lanes of `mask`, without gaps, in the order in which rays of an octant come by
    /// them, the last first; where each is entered, by the same order of `enter`; and how many there are.
    #[inline(always)]
    pub(crate) fn in_order<V: SimdF32>(
        &self,
        s: V::Simd,
        mask: V::Mask,
        enter: V,
    ) -> (V::U32, V, usize) {
        let node = self.node;
        let children = V::U32::load(s, &node.children[self.first::<V>()..]);
        if V::LANES == 4 {
            let (order, count) = self.half.order::<V>(s, mask.bitmask());
            return (children.permute(order), enter.permute(order), count);
        }
        let none = V::U32::splat(s, Child::NONE.0);
        let order = node.order.of_eight::<V>(s, self.octant);
        let children = V::U32::select(mask, children, none).permute(order);
        let enter = enter.permute(order);
        let (order, count) = without_gaps::<V>(s, children.ne(none).bitmask());
        (children.permute(order), enter.permute(order), count)
    }
}

impl<V: SimdF32, const N: usize> Boxes<V> for Part<'_, N> {
    #[inline(always)]
    fn side(&self, s: V::Simd, axis: usize, side: usize) -> V {
        // The mask tells the compiler that there are but two sides.
        V::load(s, &self.node.sides[axis][side & 1][self.first::<V>()..])
    }
}

impl<V: SimdF32, const N: usize> Boxes<V> for WideNode<N> {
    #[inline(always)]
    fn side(&self, s: V::Simd, axis: usize, side: usize) -> V {
        // The mask tells the compiler that there are but two sides.
        V::load(s, &self.sides[axis][side & 1])
    }
}

/// What is in a box: another node, or a leaf of some slots. A **slot** is a block of triangles, a
/// sphere or a cone; those of spheres follow those of blocks, and then come those of cones.
///
/// In the upper 28 bits the node or the first slot, in the lower 4 the number of slots; 0: a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(pub(crate) u32);

impl Child {
    /// None.
    pub(crate) const NONE: Child = Child(u32::MAX);

    /// The root.
    pub(crate) const ROOT: Child = Child(0);

    pub(super) fn node(at: usize) -> Child {
        Child((at as u32) << 4)
    }

    pub(super) fn leaf(slots: Range<usize>) -> Child {
        Child((slots.start as u32) << 4 | slots.len() as u32)
    }

    /// The same after so many nodes, or slots if it is a leaf.
    pub(super) fn after(self, before: usize) -> Child {
        Child(self.0 + ((before as u32) << 4))
    }

    /// Whether it is a leaf; [`NONE`](Child::NONE) counts as one.
    #[inline(always)]
    pub(crate) fn is_leaf(self) -> bool {
        self.0 & 15 != 0
    }

    /// The node, or the first slot.
    #[inline(always)]
    pub(crate) fn first(self) -> usize {
        (self.0 >> 4) as usize
    }

    /// The node, or the slots of the leaf.
    #[inline(always)]
    pub(crate) fn find(self) -> Result<usize, Range<usize>> {
        let first = self.first();
        match (self.0 & 15) as usize {
            0 => Ok(first),
            count => Err(first..first + count),
        }
    }
}

/// The nodes, and the primitives in the order of the leaves. Only for the default triangle test.
#[derive(Clone, Debug)]
pub struct Wide<const N: usize> {
    /// A node comes before those below it; the first is the root. None if there is nothing.
    pub(super) nodes: Vec<WideNode<N>>,
    pub(super) blocks: Vec<RecordBlock<N>>,
    pub(super) spheres: Vec<SphereRecord>,
    pub(super) cones: Vec<ConeRecord>,
    pub(super) counts: [usize; KINDS],
    pub(super) depth: usize,
}

impl<const N: usize> Wide<N> {
    /// The nodes; the first is the root.
    #[inline(always)]
    pub(crate) fn nodes(&self) -> &[WideNode<N>] {
        &self.nodes
    }

    /// The blocks in slots of a leaf; none if they are of another kind.
    #[inline(always)]
    pub(crate) fn blocks(&self, slots: &Range<usize>) -> &[RecordBlock<N>] {
        self.blocks.get(slots.clone()).unwrap_or_default()
    }

    /// The spheres in slots of a leaf; none if they are of another kind.
    #[inline(always)]
    pub(crate) fn spheres(&self, slots: &Range<usize>) -> &[SphereRecord] {
        after(self.blocks.len(), &self.spheres, slots)
    }

    /// The cones in slots of a leaf; none if they are of another kind.
    #[inline(always)]
    pub(crate) fn cones(&self, slots: &Range<usize>) -> &[ConeRecord] {
        after(self.blocks.len() + self.spheres.len(), &self.cones, slots)
    }

    /// Sends for what is in these lanes of a node: it is on its way while something else is done.
    #[inline(always)]
    pub(crate) fn prefetch<S: Simd>(&self, s: S, node: &WideNode<N>, mut lanes: u32) {
        while lanes != 0 {
            let child = node.child(lanes.trailing_zeros() as usize);
            lanes &= lanes - 1;
            self.prefetch_child(s, child);
        }
    }

    /// Sends for what is in a child.
    #[inline(always)]
    pub(crate) fn prefetch_child<S: Simd>(&self, s: S, child: Child) {
        let (nodes, blocks) = (self.nodes.as_ptr(), self.blocks.as_ptr());
        // Without a branch, which would be a guess; what is not there is not sent for.
        let first = child.first();
        let block = blocks.wrapping_add(first);
        let node = nodes.wrapping_add(first).cast();
        s.prefetch(if child.is_leaf() { block } else { node });
    }

    /// The primitives in slots of a leaf.
    pub(crate) fn prims(&self, slots: &Range<usize>) -> impl Iterator<Item = u32> {
        let triangles = self.blocks(slots).iter().flat_map(RecordBlock::prims);
        let spheres = self.spheres(slots).iter().map(|sphere| sphere.prim);
        triangles.chain(spheres).chain(self.cones(slots).iter().map(|cone| cone.prim))
    }

    /// The number of nodes on the longest way from the root down.
    pub(crate) fn depth(&self) -> usize {
        self.depth
    }

    /// How many primitives all leaves have together.
    pub(crate) fn references(&self) -> usize {
        let triangles: usize = self.blocks.iter().map(|block| block.prims().count()).sum();
        triangles + self.spheres.len() + self.cones.len()
    }

    /// The memory of nodes and primitives.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
            + size_of_val(&*self.blocks)
            + size_of_val(&*self.spheres)
            + size_of_val(&*self.cones)
    }
}

/// The records in some slots, if the first is in slot `before` and they are in those.
#[inline(always)]
fn after<'a, T>(before: usize, records: &'a [T], slots: &Range<usize>) -> &'a [T] {
    match slots.start.checked_sub(before) {
        Some(first) => records.get(first..slots.end - before).unwrap_or_default(),
        None => &[],
    }
}

impl<const N: usize> Refit for Wide<N> {
    fn counts(&self) -> [usize; KINDS] {
        self.counts
    }

    fn replace(&mut self, primitives: &Primitives, own_boxes: &[Aabb]) {
        for block in &mut self.blocks {
            *block = RecordBlock::new(block.prims().map(|prim| record(primitives, prim)));
        }
        for record in &mut self.spheres {
            *record = sphere(primitives, record.prim);
        }
        for record in &mut self.cones {
            *record = cone(primitives, record.prim);
        }
        // Those below a node come after it.
        for i in (0..self.nodes.len()).rev() {
            let mut node = self.nodes[i];
            for lane in 0..N {
                let child = node.child(lane);
                if child == Child::NONE {
                    continue;
                }
                let aabb = match child.find() {
                    Ok(node) => self.nodes[node].bounds(),
                    Err(slots) => {
                        let boxes = self.prims(&slots).map(|prim| &own_boxes[prim as usize]);
                        boxes.fold(Aabb::EMPTY, |all, one| all.union(one))
                    }
                };
                node.set_box(lane, &aabb);
            }
            node.set_order();
            self.nodes[i] = node;
        }
    }
}

#[inline(always)]
pub(super) fn record(primitives: &Primitives, prim: u32) -> Record {
    <Watertight>::record(&primitives.triangles[prim as usize], prim)
}

pub(super) fn sphere(primitives: &Primitives, prim: u32) -> SphereRecord {
    SphereRecord { sphere: primitives.spheres[prim as usize - primitives.triangles.len()], prim }
}

pub(super) fn cone(primitives: &Primitives, prim: u32) -> ConeRecord {
    let first = primitives.triangles.len() + primitives.spheres.len();
    ConeRecord::new(&primitives.cones[prim as usize - first], prim)
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, Vec3Swizzles};
    use simd4::{LaneArray, Level, Simd, dispatch};

    use super::*;
    use crate::bvh::build::Block;
    use crate::bvh::{Builder, Sequential};
    use crate::geom::{Cone, Sphere, Triangle};
    use crate::packet::Packet;
    use crate::{Ray, slab::robust};

    /// Triangles, balls and cones of all sizes.
    fn heap() -> Primitives {
        let at = |i: usize, k: usize| (Vec3::new(0.61, 1.37, 2.71) * (i * k) as f32).map(f32::sin);
        let size = |i: usize| if i.is_multiple_of(7) { 1.0 } else { 0.05 };
        let triangle = |i| [3, 5, 7].map(|k| at(i, 2) + at(i, k) * size(i));
        let triangles = (0..400).map(|i| Triangle { corners: triangle(i) }).collect();
        let sphere = |i| Sphere { center: at(i, 11), radius: 0.2 * size(i) };
        let cone = |i| {
            let (base, apex) = (at(i, 13), at(i, 13) + at(i, 17) * size(i));
            let [base_radius, apex_radius] = [0.1, 0.2].map(|radius| radius * size(i));
            Cone { base, base_radius, apex, apex_radius }
        };
        let (spheres, cones) = ((0..40).map(sphere).collect(), (1..41).map(cone).collect());
        Primitives { triangles, spheres, cones }
    }

    /// That boxes contain what is in them, and how often each primitive is in a leaf.
    fn looked_through<const N: usize>(wide: &Wide<N>, scene: &Primitives) -> Vec<u32> {
        let own_boxes: Vec<_> = scene.own_boxes().collect();
        let mut found = vec![0; scene.len()];
        for (at, node) in wide.nodes.iter().enumerate() {
            for lane in 0..N {
                let child = node.child(lane);
                let side = |axis: usize, side: usize| node.sides[axis][side][lane];
                let aabb = Aabb { axes: [0, 1, 2].map(|axis| [side(axis, 0), side(axis, 1)]) };
                match child.find() {
                    _ if child == Child::NONE => assert_eq!(aabb, Aabb::EMPTY),
                    Ok(below) => {
                        assert!(below > at);
                        assert_eq!(aabb.union(&wide.nodes[below].bounds()), aabb);
                    }
                    Err(slots) => {
                        for prim in wide.prims(&slots).map(|prim| prim as usize) {
                            assert_eq!(aabb.union(&own_boxes[prim]), aabb);
                            found[prim] += 1;
                        }
                    }
                }
            }
        }
        found
    }

    fn once_each<const N: usize>() {
        let scene = heap();
        let builders = [Builder::BinnedSah, Builder::SweepSah, Builder::Insertion];
        let blocks = [Block::ONE, Block::of(N)];
        for (builder, block) in
            builders.into_iter().flat_map(|builder| blocks.map(|b| (builder, b)))
        {
            let mut wide =
                Wide::<N>::new(&scene, builder.build(&scene, block, &Sequential), &Sequential);
            assert_eq!(looked_through(&wide, &scene), vec![1; scene.len()], "{builder:?}");
            let most = wide.nodes.len() * (N - 1) + 1;
            let leaves = wide.nodes.iter().flat_map(|node| (0..N).map(|lane| node.child(lane)));
            let leaves = leaves.filter(|child| *child != Child::NONE && child.find().is_err());
            assert!(leaves.count() <= most, "{builder:?}: a tree");

            let mut moved = scene.clone();
            moved.triangles.reverse();
            moved.spheres.reverse();
            moved.cones.reverse();
            let own_boxes: Vec<_> = moved.own_boxes().collect();
            wide.replace(&moved, &own_boxes);
            assert_eq!(looked_through(&wide, &moved), vec![1; scene.len()], "{builder:?}, moved");
        }
    }

    #[test]
    fn every_primitive_is_in_a_leaf_and_every_box_in_its_node() {
        once_each::<4>();
        once_each::<8>();
    }

    /// In each of some masks and each octant: every lane of the mask once, one half after the other, each from
    /// the last to the first, and with it where it is entered.
    #[inline(always)]
    fn ordered<V: SimdF32, const N: usize>(s: V::Simd, wide: &Wide<N>) {
        for node in &wide.nodes {
            let is_there = |lane: &usize| node.child(*lane) != Child::NONE;
            for (octant, some) in
                (0..8).flat_map(|octant| [255, 0, 0x5a, 0x81, 4].map(|m| (octant, m)))
            {
                let along = |lane: usize| -> f32 {
                    let sides = node.aabb(lane).axes;
                    let center = |axis: usize| sides[axis][0] + sides[axis][1];
                    let sign = |axis: usize| if octant >> axis & 1 == 1 { -1.0 } else { 1.0 };
                    (0..3).map(|axis| center(axis) * sign(axis)).sum()
                };
                let mean = |half: usize| -> f32 {
                    let lanes = (half * 4..half * 4 + 4).filter(is_there);
                    lanes.clone().map(along).sum::<f32>() / lanes.count() as f32
                };
                let mut lanes: Vec<usize> = Vec::new();
                for part in node.parts(octant).iter().take(N / V::LANES) {
                    let first = part.first::<V>();
                    let is_wanted = |lane: usize| is_there(&lane) && some >> lane & 1 == 1;
                    let mask = LaneArray::from_fn(|lane| is_wanted(first + lane));
                    let mask = V::Mask::from_array(s, mask);
                    let enter = V::iota(s) + V::splat(s, first as f32);
                    let (children, enters, count) = part.in_order::<V>(s, mask, enter);
                    for i in 0..count {
                        let lane = enters.lane(i) as usize;
                        assert_eq!(Child(children.lane(i)), node.child(lane));
                        lanes.push(lane);
                    }
                }
                for two in lanes.windows(2) {
                    let [later, sooner] = match two[0] / 4 == two[1] / 4 {
                        true => [along(two[0]), along(two[1])],
                        false => [mean(two[0] / 4), mean(two[1] / 4)],
                    };
                    assert!(sooner <= later + 1e-5, "octant {octant}: {sooner} after {later}");
                }
                lanes.sort_unstable();
                let wanted = (0..N).filter(|&lane| is_there(&lane) && some >> lane & 1 == 1);
                assert!(lanes.iter().copied().eq(wanted), "octant {octant}: {lanes:?}");
            }
        }
    }

    #[test]
    fn children_come_in_the_order_of_their_centres() {
        let scene = heap();
        let tree = || Builder::BinnedSah.build(&scene, Block::ONE, &Sequential);
        let four = Wide::<4>::new(&scene, tree(), &Sequential);
        let eight = Wide::<8>::new(&scene, tree(), &Sequential);
        assert!(four.nodes.len() > 100 && eight.nodes.len() > 50);
        #[inline(always)]
        fn both<S: Simd>(s: S, four: &Wide<4>, eight: &Wide<8>) {
            ordered::<S::f32x4, 4>(s, four);
            ordered::<S::f32x4, 8>(s, eight);
            ordered::<S::f32x8, 8>(s, eight);
        }
        for level in Level::available() {
            dispatch!(level, s => both(s, &four, &eight));
        }
    }

    #[inline(always)]
    fn meets_nothing<S: Simd>(s: S, ray: &Ray) -> bool {
        let packet = Packet::<S::f32x8>::splat(s, ray);
        let Ok(frame) = packet.frame(s) else { return false };
        let nothing = WideNode::<8>::EMPTY;
        robust::may_hit(s, &nothing, &packet, &frame, packet.tmax).none()
    }

    #[test]
    fn no_ray_meets_a_lane_without_a_child() {
        let special = [0.0, -0.0, 1.0, -1e-45, f32::MAX, f32::MIN, f32::NAN];
        let pairs = || special.into_iter().flat_map(|x| special.map(|y| [x, y]));
        for ([x, y], [dx, dy]) in pairs().flat_map(|at| pairs().map(move |dir| (at, dir))) {
            let (at, dir) = (Vec3::new(x, y, 0.5), Vec3::new(dx, dy, -0.0));
            for (origin, dir) in [(at, dir), (dir, at), (at.zxy(), dir.yzx())] {
                let ray = Ray::new(origin, dir);
                for level in Level::available() {
                    let nothing = dispatch!(level, s => meets_nothing(s, &ray));
                    assert!(nothing, "{level}: {ray:?}");
                }
            }
        }
    }
}
