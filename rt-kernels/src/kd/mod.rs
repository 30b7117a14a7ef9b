//! The kd-tree: a box, split by planes across the axes.
//!
//! A builder ([`KdBuilder`]) says where cells are split, a layout ([`layout`]) how the tree lies in
//! memory, and [`traverse`] goes through it from front to back. Unlike the boxes of a
//! [`Bvh`](crate::Bvh), the cells of a kd-tree never overlap, and a primitive is in every cell that it
//! reaches: a [`Mailbox`] keeps rays from being tested against it again.
//!
//! # Why the answer is one
//!
//! (below)

mod build;
pub mod layout;
mod run;
pub mod traverse;

pub use build::{GROWTH, KdBuilder};

use crate::bvh::{BuildError, Join};
use crate::geom::Aabb;
use crate::mailbox::{Mailbox, Stamps};
use crate::primitives::{Primitives, Store};
use crate::tri::Method;
use layout::{Cells, Pair};

/// By how much the distance to a split is widened to both sides: 256 unit roundoffs, relative to it.
pub(crate) const WIDER: f32 = 1.0 / (1 << 16) as f32;

/// How far from the plane of a triangle its hits may be, as a part of its extent: 512 roundoffs.
pub(crate) const THICKNESS: f64 = 1.0 / (1 << 15) as f64;

/// How often the least height of a triangle goes into the diagonal of its bounds, if it is cut by
/// its plane.
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
        primitives.check()?;
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
    let mut next = [0, primitives.triangles.len() as u32];
    for entry in list {
        let prim = *entry as usize;
        if slots[prim] == NONE {
            let kind = usize::from(prim >= primitives.triangles.len());
            slots[prim] = next[kind];
            next[kind] += 1;
            order.push(*entry);
        }
        *entry = slots[prim];
    }
    Store::reordered(primitives, method, order.into_iter())
}
