//! The kd-tree: a box, split by planes across the axes.
//!
//! A builder ([`KdBuilder`]) says where cells are split, a layout ([`layout`]) how the tree lies in
//! memory, and [`traverse`] goes through it from front to back. Unlike the boxes of a
//! [`Bvh`](crate::Bvh), the cells of a kd-tree never overlap, and a primitive is in every cell that it
//! reaches: a [`Mailbox`] keeps rays from being tested against it again.
//!
//! # When to use it
//!
//! Where rays pass through much empty space between large triangles across the axes, as in rooms: cells
//! end at walls, and nothing is tested twice over. There packets of rays that have an end in common, as
//! primary rays and shadows, are as fast as in a [`Bvh`](crate::Bvh) or faster, by up to two and a half
//! times. Everywhere else the [`Bvh`](crate::Bvh) of wide nodes wins: in meshes of small triangles it is
//! two to three times as fast for all kinds of rays, it is built nine times as fast and more, and it takes
//! half the memory. `rt paper wald-2001` measures both.
//!
//! Packets of one register are the best; larger ones share visits and gain no time by it, as the paper
//! says.
//!
//! # Why the answer is one
//!
//! What a ray hits, and at which `t`, is defined by each primitive alone: see the
//! [crate](crate#why-the-answer-is-one). Hits are not held within cells. What is left to show is that
//! every hit is found before the traversal ends: that it enters, at no more than the hit's `t`, some
//! cell that has the primitive. A cell's segment is from the greatest distance to a plane that the
//! ray comes in by to the least to one that it leaves by, and no limit is ever below the `t` of the
//! closest hit.
//!
//! **Own boxes.** Where a primitive is in every cell that its own box reaches, any kernel may give any
//! `t`: the argument of [spatial splits](crate::bvh::build::spatial_splits#why-pieces-are-enough) holds
//! word by word. A cell contains the piece of the own box in it and shares with it the planes of the
//! cuts, so that some cell on every level is good. That the distances of planes are widened to both
//! sides only makes cells better. So it is with spheres and cones, and with all triangle tests but the
//! default.
//!
//! **Planes.** The box of a triangle askew to the axes is mostly empty, and to test it in all cells
//! there costs a third of the tests. The hits of the [default test](crate::tri::Watertight) lie, within
//! rounding, in the triangle's plane, however it is seen; so it is left out of cells that are farther
//! from that plane than its extent times 2^-15. Here is why. u is 2^-24, H the triangle's least
//! height, L its extent, and A the diagonal of its bounds over H, which is 8 at most, or the triangle
//! keeps its box.
//!
//! 1. The test is exact for corners moved by 6u of what the ray covers on each axis, and 6u of L; call
//!    that triangle T. Let e be the rounding errors of its edge functions: each is at most 2uL², and
//!    the weights of the computed `t` have one sign. So `t` is, up to 10u of itself and of L, that of a
//!    point of T; seen along the ray, this point lies off the ray by Σ e p / Σ w, where p are the
//!    sheared corners and w the computed edge functions.
//! 2. Across the trace of T's plane, p is at most its height there times the cosine of the plane's
//!    angle to the ray, and Σ w is twice T's area times the same cosine, but for Σ e. The cosines
//!    cancel: the ray at `t` is within 12uAL of the plane, even if it is seen edge-on, where along the
//!    trace the point may be anywhere. (That is why triangles are cut by their planes and not to their
//!    own parts: the computed `t` may precede all cells that a part is in. `tests/it/kd.rs` fails if
//!    they are.)
//! 3. Within the own box, weights of T's corners for a point of its plane are at most A each. So the
//!    plane of T is off that of the triangle by 18Au of what the ray covers on each axis, and 18Au of
//!    L. The ray's true crossing of T is in the own box and in the plane, and the ray at `t` is in the
//!    plane; so is all between them, and with it the point at `t`, or that of the own box next to it
//!    on the ray.
//! 4. Together, there is a point in the own box, within 42Au of L of the plane, that is off the ray at
//!    the hit's `t`, or at a lesser one, by no more than (18A + 10)u of what the ray covers on each
//!    axis. Its cell has the triangle, since 42Au is less than 2^-15. The distances to the cell's
//!    planes, three roundings each, are off by (18A + 13)u: widened by 2^-16 = 256u, they leave the
//!    `t` of that point between them.
//!
//! Where a ray runs in a plane, 0 · ∞ is NaN: it is dropped, as in the [slab test](crate::slab::robust),
//! and both sides are visited. Subnormal components of a direction have infinite reciprocals, and
//! their planes are behind the ray or beyond all hits.

mod build;
mod large;
pub mod layout;
mod run;
pub mod traverse;
mod visits;

pub use build::{GROWTH, KdBuilder};

use crate::bvh::{BuildError, Join};
use crate::geom::Aabb;
use crate::mailbox::{Mailbox, Stamps};
use crate::primitives::{Primitives, Store, kind};
use crate::tri::Method;
use layout::{Cells, Pair};

/// By how much the distance to a split is widened to both sides: 256 unit roundoffs, relative to it.
pub(crate) const WIDER: f32 = 1.0 / (1 << 16) as f32;

/// How far from the plane of a triangle a cell may be that has it, as a part of its extent: 512
/// roundoffs.
pub(crate) const THICKNESS: f64 = 1.0 / (1 << 15) as f64;

/// How often the least height of a triangle that is cut by its plane goes into the diagonal of its
/// bounds, at most.
pub(crate) const REACH: f64 = 8.0;

/// What there is to choose of a kd-tree. The hits depend on the triangle test alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct KdPlan {
    /// How it is built.
    pub builder: KdBuilder,
    /// What keeps rays from being tested twice.
    pub mailbox: Mailbox,
    /// The triangle test.
    pub method: Method,
}

/// A kd-tree. See the [module](self).
#[derive(Clone, Debug)]
pub struct KdTree {
    plan: KdPlan,
    bounds: Aabb,
    cells: Cells,
    store: Store,
    stamps: Stamps,
}

impl KdTree {
    /// Builds the tree by the default [`KdPlan`]. It is the same for any `join`.
    ///
    /// # Errors
    /// As [`Bvh::build`](crate::Bvh::build).
    pub fn build(primitives: &Primitives, join: &impl Join) -> Result<KdTree, BuildError> {
        KdTree::build_with(primitives, KdPlan::default(), join)
    }

    /// Builds the tree by that plan.
    ///
    /// # Errors
    /// As [`Bvh::build`](crate::Bvh::build).
    pub fn build_with(
        primitives: &Primitives,
        plan: KdPlan,
        join: &impl Join,
    ) -> Result<KdTree, BuildError> {
        primitives.check(join)?;
        let (bounds, mut cells) = build::build(plan.builder, primitives, plan.method, join);
        let store = fill(primitives, plan.method, &mut cells.list);
        let stamps = Stamps::new(plan.mailbox, store.slots());
        Ok(KdTree { plan, bounds, cells, store, stamps })
    }

    /// What it was built by.
    pub fn plan(&self) -> KdPlan {
        self.plan
    }

    /// The same tree with another mailbox.
    #[must_use]
    pub fn with_mailbox(self, mailbox: Mailbox) -> KdTree {
        let stamps = Stamps::new(mailbox, self.store.slots());
        KdTree { plan: KdPlan { mailbox, ..self.plan }, stamps, ..self }
    }

    /// The number of nodes, leaves included.
    pub fn nodes(&self) -> usize {
        2 * self.cells.pairs.len() - 1
    }

    /// The number of nodes on the longest way from the root to a leaf: 48 at most.
    pub fn depth(&self) -> usize {
        self.cells.depth
    }

    /// How many primitives all leaves have together: no more than 1 + [`GROWTH`] times as many as
    /// there are.
    pub fn references(&self) -> usize {
        self.cells.list.len()
    }

    fn bytes(&self) -> usize {
        let cells = size_of::<Pair>() * self.cells.pairs.len() + size_of_val(&*self.cells.list);
        cells + self.store.bytes() + self.stamps.bytes()
    }
}

/// Primitives in the order in which the leaves name them first; the list then has their slots.
fn fill(primitives: &Primitives, method: Method, list: &mut [u32]) -> Store {
    const NONE: u32 = u32::MAX;
    let mut slots = vec![NONE; primitives.len()];
    let mut order = Vec::with_capacity(primitives.len());
    let counts = primitives.counts();
    let [triangles, spheres, _] = counts.map(|count| count as u32);
    let mut next = [0, triangles, triangles + spheres];
    for entry in list {
        let prim = *entry as usize;
        if slots[prim] == NONE {
            let kind = kind(&counts, *entry);
            slots[prim] = next[kind];
            next[kind] += 1;
            order.push(*entry);
        }
        *entry = slots[prim];
    }
    Store::reordered(primitives, method, order.into_iter())
}
