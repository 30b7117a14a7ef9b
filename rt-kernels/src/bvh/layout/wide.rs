//! Nodes of up to N children, 4 or 8, whose boxes are tested at once, one in each lane.
//!
//! Which nodes of the build tree are a node's children is chosen for the least surface of all nodes
//! but the first ([`collapse`](super::collapse)). Subtrees of up to N triangles become one block, whose
//! triangles are tested at once too: that takes little longer than to test a node, and is quicker than
//! to test them one by one from the second on.
//!
//! A lane without a child has the box from +∞ to −∞. A ray enters it at +∞ and leaves it at −∞ on
//! every axis, whatever its direction, and so misses it; a box of NaNs would be met by every ray, since
//! a distance that is NaN counts as no end ([`robust`](crate::slab::robust)).
//!
//! Source: Wald, Benthin, Boulos, "Getting Rid of Packets", 2008; Dammertz, Hanika, Keller,
//! "Shallow Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent Rays", 2008.

use std::ops::Range;

use simd4::{Simd, SimdF32};

use super::MAX_SLOTS;
use super::collapse::{Inner, Subtree};
use crate::bvh::build::{self, Content, Join, Reference};
use crate::bvh::refit::Refit;
use crate::geom::Aabb;
use crate::packet::Boxes;
use crate::primitives::{KINDS, Primitives, SphereRecord, kind};
use crate::quadric::cone::ConeRecord;
use crate::tri::{Method, Record, RecordBlock};

/// On so many levels from the root on, what is largest is opened first: most rays pass all of these
/// nodes, and it counts how soon the first hit is found. With the least sum of surfaces there too, a
/// room seen from outside takes a quarter more time; further down it saves a twentieth or less.
const FIRST_DEPTHS: usize = 2;

/// Up to N boxes by side (SoA), and what is in them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct WideNode<const N: usize> {
    sides: [[[f32; N]; 2]; 3],
    pub(crate) children: [Child; N],
}

const _: () = assert!(size_of::<WideNode<4>>() == 128, "two cache lines");
const _: () = assert!(size_of::<WideNode<8>>() == 256, "four cache lines");

impl<const N: usize> WideNode<N> {
    /// No children.
    const EMPTY: Self = WideNode {
        sides: [[[f32::INFINITY; N], [f32::NEG_INFINITY; N]]; 3],
        children: [Child::NONE; N],
    };

    fn set_box(&mut self, lane: usize, aabb: &Aabb) {
        for (sides, axis) in self.sides.iter_mut().zip(aabb.axes) {
            for (side, value) in sides.iter_mut().zip(axis) {
                side[lane] = value;
            }
        }
    }

    /// The children and their boxes.
    pub(crate) fn boxes(&self) -> impl Iterator<Item = (Child, Aabb)> {
        let aabb = |lane: usize| Aabb { axes: self.sides.map(|sides| sides.map(|s| s[lane])) };
        let lanes = self.children.into_iter().enumerate();
        lanes
            .filter(|(_, child)| *child != Child::NONE)
            .map(move |(lane, child)| (child, aabb(lane)))
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
pub(crate) struct Child(u32);

impl Child {
    const NONE: Child = Child(u32::MAX);

    /// The root.
    pub(crate) const ROOT: Child = Child(0);

    fn node(at: usize) -> Child {
        Child((at as u32) << 4)
    }

    fn leaf(slots: Range<usize>) -> Child {
        Child((slots.start as u32) << 4 | slots.len() as u32)
    }

    /// The node, or the slots of the leaf.
    #[inline(always)]
    pub(crate) fn find(self) -> Result<usize, Range<usize>> {
        let first = (self.0 >> 4) as usize;
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
    nodes: Vec<WideNode<N>>,
    blocks: Vec<RecordBlock<N>>,
    spheres: Vec<SphereRecord>,
    cones: Vec<ConeRecord>,
    counts: [usize; KINDS],
    depth: usize,
}

impl<const N: usize> Wide<N> {
    /// Converts a build tree.
    pub(crate) fn new(primitives: &Primitives, tree: build::Tree, join: &impl Join) -> Self {
        let build::Tree { root, order: mut references } = tree;
        let counts = primitives.counts();
        let mut wide = Wide {
            nodes: Vec::new(),
            blocks: Vec::new(),
            spheres: Vec::with_capacity(primitives.spheres.len()),
            cones: Vec::with_capacity(primitives.cones.len()),
            counts,
            depth: 0,
        };
        let Some(root) = root else { return wide };
        if counts.iter().filter(|&&count| count > 0).count() > 1 {
            root.leaves(&mut |_, range| {
                references[range].sort_by_key(|one| kind(&counts, one.prim()));
            });
        }
        let blocks = Blocks { counts, references: &references };
        let whole = blocks.subtree(root, 0, join);
        let leaves = [const { Vec::new() }; KINDS];
        let (slots, prims) = (Vec::new(), Vec::new());
        let mut converter = Converter { primitives, blocks, leaves, wide: &mut wide, slots, prims };
        let children = match whole {
            Subtree::Inner(inner) => open(inner, 1),
            leaf => vec![leaf],
        };
        converter.node(children, 1);
        let Converter { leaves: [_, of_spheres, of_cones], slots, .. } = converter;
        let (blocks, spheres) = (slots.len(), wide.spheres.len());
        for (leaves, before) in [(of_spheres, blocks), (of_cones, blocks + spheres)] {
            for (node, lane) in leaves {
                wide.nodes[node].children[lane].0 += (before as u32) << 4;
            }
        }
        wide.blocks.resize(blocks, RecordBlock::new(&[]));
        fill(primitives, &slots, &mut wide.blocks, join);
        wide
    }

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
        let (nodes, blocks) = (self.nodes.as_ptr(), self.blocks.as_ptr());
        while lanes != 0 {
            let child = node.children[lanes.trailing_zeros() as usize & (N - 1)];
            lanes &= lanes - 1;
            // Without a branch, which would be a guess; what is not there is not sent for.
            let first = (child.0 >> 4) as usize;
            let block = blocks.wrapping_add(first);
            let node = nodes.wrapping_add(first).cast();
            s.prefetch(if child.0 & 15 == 0 { node } else { block });
        }
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
            let records: Vec<_> = block.prims().map(|prim| record(primitives, prim)).collect();
            *block = RecordBlock::new(&records);
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
            for (lane, child) in node.children.into_iter().enumerate() {
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
            self.nodes[i] = node;
        }
    }
}

fn record(primitives: &Primitives, prim: u32) -> Record {
    Method::default().record(&primitives.triangles[prim as usize], prim)
}

fn sphere(primitives: &Primitives, prim: u32) -> SphereRecord {
    SphereRecord { sphere: primitives.spheres[prim as usize - primitives.triangles.len()], prim }
}

fn cone(primitives: &Primitives, prim: u32) -> ConeRecord {
    let first = primitives.triangles.len() + primitives.spheres.len();
    ConeRecord::new(&primitives.cones[prim as usize - first], prim)
}

/// At so many levels of the build tree from the root on, what is below may be converted at once.
const PARALLEL_DEPTHS: usize = 10;

/// What is a leaf here, and what is a node.
struct Blocks<'a, const N: usize> {
    counts: [usize; KINDS],
    /// Those of a leaf are in the order of their kinds.
    references: &'a [Reference],
}

impl<const N: usize> Blocks<'_, N> {
    /// A node and all below, down to what is a leaf here; `depth` is how deep it is itself.
    fn subtree(&self, node: build::Node, depth: usize, join: &impl Join) -> Subtree<N> {
        if self.parts(&node) == 0 {
            return Subtree::Leaf(node);
        }
        let aabb = node.aabb;
        let mut parts = self.part(node);
        let all = |parts: Vec<build::Node>| -> Vec<_> {
            parts.into_iter().map(|part| self.subtree(part, depth + 1, join)).collect()
        };
        if depth >= PARALLEL_DEPTHS {
            return Subtree::inner(aabb, all(parts));
        }
        let last = parts.split_off(parts.len() / 2);
        let (mut children, last) = join.join(|| all(parts), || all(last));
        children.extend(last);
        Subtree::inner(aabb, children)
    }

    /// How many nodes [`part`](Blocks::part) makes of one; 0 for what is a leaf here.
    fn parts(&self, node: &build::Node) -> usize {
        match &node.content {
            _ if self.is_block(node) => 0,
            Content::Inner(children) if children.len() > N => 2,
            Content::Inner(children) => children.len(),
            Content::Leaf(range) => {
                let references = &self.references[range.clone()];
                let of_one_kind =
                    references.windows(2).all(|two| self.kind(&two[0]) == self.kind(&two[1]));
                if of_one_kind && references.len() <= MAX_SLOTS { 0 } else { 2 }
            }
        }
    }

    /// A node's children, or the halves of those if they are more than N, or of a leaf if it is of
    /// several kinds or too large.
    fn part(&self, node: build::Node) -> Vec<build::Node> {
        match node.content {
            Content::Inner(children) if children.len() > N => halves(children.into_vec()).into(),
            Content::Inner(children) => children.into_vec(),
            Content::Leaf(Range { start, end }) => {
                let references = &self.references[start..end];
                let least = self.kind(&references[0]);
                let first = references.partition_point(|one| self.kind(one) == least);
                let count = references.len();
                let first = if first < count { first } else { count / 2 };
                [start..start + first, start + first..end]
                    .map(|range| {
                        let boxes =
                            self.references[range.clone()].iter().map(|r| r.bounds().aabb());
                        let aabb = boxes.fold(Aabb::EMPTY, |all, one| all.union(&one));
                        build::Node { aabb, content: Content::Leaf(range) }
                    })
                    .into()
            }
        }
    }

    fn kind(&self, reference: &Reference) -> usize {
        kind(&self.counts, reference.prim())
    }

    /// Whether all below is triangles, and no more than N.
    fn is_block(&self, node: &build::Node) -> bool {
        let mut room = N;
        self.fits(node, &mut room)
    }

    /// Whether all below is triangles that fit into the room that is left.
    fn fits(&self, node: &build::Node, room: &mut usize) -> bool {
        match &node.content {
            Content::Inner(children) => children.iter().all(|child| self.fits(child, room)),
            Content::Leaf(range) => {
                let left = room.checked_sub(range.len());
                *room = left.unwrap_or_default();
                let mut references = self.references[range.clone()].iter();
                left.is_some() && references.all(|one| self.kind(one) == 0)
            }
        }
    }
}

/// A layout that grows.
struct Converter<'a, const N: usize> {
    primitives: &'a Primitives,
    blocks: Blocks<'a, N>,
    wide: &'a mut Wide<N>,
    /// The nodes and lanes of the leaves of each kind, whose slots count from the first of that kind.
    leaves: [Vec<(usize, usize)>; KINDS],
    /// What will be in the blocks.
    slots: Vec<Slot<N>>,
    /// Those of one leaf.
    prims: Vec<u32>,
}

/// The triangles of a block, and after them as often as need be [`NO_PRIM`].
type Slot<const N: usize> = [u32; N];

/// No triangle.
const NO_PRIM: u32 = u32::MAX;

impl<const N: usize> Converter<'_, N> {
    /// Lays out a node and all below, and returns where it is.
    fn node(&mut self, children: Vec<Subtree<N>>, depth: usize) -> usize {
        let at = self.wide.nodes.len();
        self.wide.nodes.push(WideNode::EMPTY);
        self.wide.depth = self.wide.depth.max(depth);
        for (lane, child) in children.into_iter().enumerate() {
            self.wide.nodes[at].set_box(lane, child.aabb());
            let child = match child {
                Subtree::Inner(inner) => Child::node(self.node(open(inner, depth + 1), depth + 1)),
                Subtree::Leaf(node) => self.leaf(&node, (at, lane)),
            };
            self.wide.nodes[at].children[lane] = child;
        }
        at
    }

    /// Lays out the primitives of all leaves below; `place` is the child's.
    fn leaf(&mut self, node: &build::Node, place: (usize, usize)) -> Child {
        let Converter { primitives, blocks, wide, prims, slots, .. } = self;
        prims.clear();
        node.leaves(&mut |_, range| {
            prims.extend(blocks.references[range].iter().map(Reference::prim));
        });
        // Of a box that was cut there may be several pieces.
        prims.sort_unstable();
        prims.dedup();
        let kind = kind(&blocks.counts, prims[0]);
        self.leaves[kind].push(place);
        if kind == 0 {
            let first = slots.len();
            slots.extend(prims.chunks(N).map(|prims| {
                let mut slot = [NO_PRIM; N];
                slot[..prims.len()].copy_from_slice(prims);
                slot
            }));
            Child::leaf(first..slots.len())
        } else if kind == 1 {
            let first = wide.spheres.len();
            wide.spheres.extend(prims.iter().map(|&prim| sphere(primitives, prim)));
            Child::leaf(first..wide.spheres.len())
        } else {
            let first = wide.cones.len();
            wide.cones.extend(prims.iter().map(|&prim| cone(primitives, prim)));
            Child::leaf(first..wide.cones.len())
        }
    }
}

/// The least number of blocks of which the halves may be filled at once.
const PARALLEL_BLOCKS: usize = 1024;

/// Puts the triangles that slots name into as many blocks.
fn fill<const N: usize>(
    primitives: &Primitives,
    slots: &[Slot<N>],
    blocks: &mut [RecordBlock<N>],
    join: &impl Join,
) {
    if slots.len() >= PARALLEL_BLOCKS {
        let ((slots, more_slots), (blocks, more_blocks)) =
            (slots.split_at(slots.len() / 2), blocks.split_at_mut(slots.len() / 2));
        join.join(
            || fill(primitives, slots, blocks, join),
            || fill(primitives, more_slots, more_blocks, join),
        );
        return;
    }
    for (slot, block) in slots.iter().zip(blocks) {
        let mut records = [Record::nothing(); N];
        let prims = slot.iter().take_while(|&&prim| prim != NO_PRIM);
        let count =
            records.iter_mut().zip(prims).map(|(to, &i)| *to = record(primitives, i)).count();
        *block = RecordBlock::new(&records[..count]);
    }
}

/// The children of a node at that depth; the root's is 1.
fn open<const N: usize>(inner: Inner<N>, depth: usize) -> Vec<Subtree<N>> {
    if depth <= FIRST_DEPTHS { inner.open_largest() } else { inner.open() }
}

/// Two nodes with one half each of some nodes, parted where their boxes' centres are furthest apart.
fn halves(mut nodes: Vec<build::Node>) -> [build::Node; 2] {
    let center = |node: &build::Node, axis: usize| node.aabb.min()[axis] + node.aabb.max()[axis];
    let centers = nodes
        .iter()
        .fold(Aabb::EMPTY, |all, node| all.union(&Aabb::point(node.aabb.min() + node.aabb.max())));
    let axis = centers.extent().max_position();
    nodes.sort_by(|a, b| center(a, axis).total_cmp(&center(b, axis)));
    let right = nodes.split_off(nodes.len() / 2);
    [nodes, right].map(|children| {
        let aabb = children.iter().fold(Aabb::EMPTY, |all, child| all.union(&child.aabb));
        build::Node { aabb, content: Content::Inner(children.into()) }
    })
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, Vec3Swizzles};
    use simd4::{Level, Simd, SimdMask, dispatch};

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
            for (lane, child) in node.children.iter().enumerate() {
                let side = |axis: usize, side: usize| node.sides[axis][side][lane];
                let aabb = Aabb { axes: [0, 1, 2].map(|axis| [side(axis, 0), side(axis, 1)]) };
                match child.find() {
                    _ if *child == Child::NONE => assert_eq!(aabb, Aabb::EMPTY),
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
            let leaves = wide.nodes.iter().flat_map(|node| &node.children);
            let leaves = leaves.filter(|child| **child != Child::NONE && child.find().is_err());
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
