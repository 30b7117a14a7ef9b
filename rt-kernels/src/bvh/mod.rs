//! Bounding volume hierarchies.
//!
//! A builder ([`build`]) makes a build tree; a [`layout`] turns it into flat arrays; a traversal
//! ([`traverse`]) runs over them. A [`Bvh`] is a combination of them, as a [`Plan`] has it.

pub mod build;
mod closest_point;
pub mod layout;
mod plan;
mod refit;
pub mod traverse;

pub use build::{BuildError, Builder, Join, Sequential};
pub use closest_point::ClosestPoint;
pub use plan::{Layout, Plan};
pub use refit::RefitError;

use crate::accelerator::Visitor;
use crate::packet::{Hits, Rays};
use crate::tri::Method;
use crate::{Accelerator, Exec, NoStats, Primitives, Ray, Stats, trace};
use build::Block;
use layout::{SkipArray, Wide};

/// A hierarchy of boxes.
#[derive(Clone, Debug)]
pub struct Bvh {
    plan: Plan,
    array: Array,
}

/// A hierarchy in its layout.
#[derive(Clone, Debug)]
enum Array {
    Skip(SkipArray),
    Bvh4(Wide<4>),
    Bvh8(Wide<8>),
}

/// Evaluates an expression for the layout, whichever it is.
macro_rules! with_array {
    ($array:expr, $a:ident => $body:expr) => {
        match $array {
            Array::Skip($a) => $body,
            Array::Bvh4($a) => $body,
            Array::Bvh8($a) => $body,
        }
    };
}

use with_array;

impl Bvh {
    /// Builds the hierarchy by the default [`Plan`]. It is the same for any `join`.
    ///
    /// No primitives, coinciding ones and ones without area are all fine.
    ///
    /// # Errors
    /// If a coordinate is not finite or greater than 2^40, if a sphere has no radius or a cone
    /// no mantle, or if there are more than 2^28 primitives.
    pub fn build(primitives: &Primitives, join: &impl Join) -> Result<Bvh, BuildError> {
        Bvh::build_with(primitives, Plan::default(), join)
    }

    /// Builds the hierarchy by that plan.
    ///
    /// # Errors
    /// As [`build`](Bvh::build).
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Builder, Bvh, Layout, Plan, Primitives, Sequential};
    /// # let vertices = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    /// # let scene = Primitives::mesh(&vertices, &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
    /// let plan = Plan { builder: Builder::Spatial, layout: Layout::Bvh4, ..Plan::default() };
    /// let bvh = Bvh::build_with(&scene, plan, &Sequential)?;
    /// assert_eq!((bvh.plan(), bvh.references()), (plan, 4));
    /// # Ok::<(), rt_kernels::BuildError>(())
    /// ```
    pub fn build_with(
        primitives: &Primitives,
        plan: Plan,
        join: &impl Join,
    ) -> Result<Bvh, BuildError> {
        primitives.check(join)?;
        let plan = Plan { layout: plan.layout(), ..plan };
        let tree = plan.builder.build(primitives, plan.layout.block(primitives), join);
        let array = match plan.layout {
            Layout::Skip => Array::Skip(SkipArray::new(primitives, tree, plan.method)),
            Layout::Bvh4 => Array::Bvh4(Wide::new(primitives, tree, join)),
            Layout::Bvh8 => Array::Bvh8(Wide::new(primitives, tree, join)),
        };
        Ok(Bvh { plan, array })
    }

    /// The same by the default triangle test in a skip array whose children are in the builder's
    /// order, not in that of their surface: for comparison.
    ///
    /// # Errors
    /// As [`build`](Bvh::build).
    pub fn build_unsorted(
        primitives: &Primitives,
        builder: Builder,
        join: &impl Join,
    ) -> Result<Bvh, BuildError> {
        primitives.check(join)?;
        let plan = Plan { builder, layout: Layout::Skip, ..Plan::default() };
        let tree = builder.build(primitives, Block::ONE, join);
        let array = SkipArray::unsorted(primitives, tree, plan.method);
        Ok(Bvh { plan, array: Array::Skip(array) })
    }

    /// The array, if it is one with skip pointers and the default triangle test.
    pub(crate) fn skip_array(&self) -> Option<&SkipArray> {
        match &self.array {
            Array::Skip(array) if self.plan.method == Method::default() => Some(array),
            _ => None,
        }
    }

    /// Takes new positions of the primitives that it was built for, in the same order, and keeps its
    /// tree: much quicker than to build another, and as good as long as neighbours stay neighbours.
    /// The hits are those of the new positions.
    ///
    /// # Errors
    /// As [`build`](Bvh::build), or if there are more primitives of a kind than before, or
    /// fewer.
    /// The hierarchy stays as it was.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Accelerator, Bvh, Primitives, Ray, Sequential};
    /// # let mut vertices = vec![Vec3::ZERO, Vec3::X * 4.0, Vec3::Z * 4.0];
    /// let triangles = [[0, 1, 2]];
    /// let mut bvh = Bvh::build(&Primitives::mesh(&vertices, &triangles)?, &Sequential)?;
    /// let ray = Ray::new(Vec3::new(1.0, 3.0, 1.0), Vec3::NEG_Y);
    /// assert_eq!(bvh.intersect(&ray).map(|hit| hit.t), Some(3.0));
    ///
    /// vertices.iter_mut().for_each(|vertex| vertex.y += 1.0);
    /// bvh.refit(&Primitives::mesh(&vertices, &triangles)?)?;
    /// assert_eq!(bvh.intersect(&ray).map(|hit| hit.t), Some(2.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn refit(&mut self, primitives: &Primitives) -> Result<(), RefitError> {
        with_array!(&mut self.array, array => refit::refit(array, primitives))
    }

    /// As [`closest`](Accelerator::closest), and counts nothing. (Inlined, so that only who asks for it
    /// compiles it.)
    #[inline]
    pub fn closest_uncounted(&self, exec: Exec, rays: &Rays, hits: &mut Hits) {
        self.uncounted(exec, rays, false, hits);
    }

    /// As [`any`](Accelerator::any), and counts nothing. (Inlined, as above.)
    #[inline]
    pub fn any_uncounted(&self, exec: Exec, rays: &Rays, found: &mut Vec<bool>) {
        let mut hits = Hits::new();
        self.uncounted(exec, rays, true, &mut hits);
        hits.found(found);
    }

    #[inline]
    fn uncounted(&self, exec: Exec, rays: &Rays, any: bool, hits: &mut Hits) {
        match &self.array {
            Array::Skip(array) => trace::trace(array, exec, rays, any, hits, &mut NoStats),
            Array::Bvh4(array) => array.trace(exec, rays, any, hits, &mut NoStats),
            Array::Bvh8(array) => array.trace(exec, rays, any, hits, &mut NoStats),
        }
    }

    /// What it was built by: the layout is that which it has.
    pub fn plan(&self) -> Plan {
        self.plan
    }

    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        with_array!(&self.array, array => array.nodes().len())
    }

    /// The number of nodes on the longest way from the root down: some hundred at most. Leaves are
    /// nodes with [`Layout::Skip`] alone, but a leaf that is all there is has one above it.
    pub fn depth(&self) -> usize {
        with_array!(&self.array, array => array.depth())
    }

    /// How many primitives all leaves have together. Those that were cut count more than once.
    pub fn references(&self) -> usize {
        with_array!(&self.array, array => array.references())
    }
}

impl Accelerator for Bvh {
    fn closest(&self, exec: Exec, rays: &Rays, hits: &mut Hits, stats: &mut Stats) {
        with_array!(&self.array, array => array.closest(exec, rays, hits, stats));
    }

    fn any(&self, exec: Exec, rays: &Rays, found: &mut Vec<bool>, stats: &mut Stats) {
        with_array!(&self.array, array => array.any(exec, rays, found, stats));
    }

    fn visit(&self, ray: &Ray, visitor: Visitor<'_>) {
        with_array!(&self.array, array => array.visit(ray, visitor));
    }

    fn exec(&self, asked: Exec) -> Exec {
        with_array!(&self.array, array => array.exec(asked))
    }

    fn bytes(&self) -> usize {
        with_array!(&self.array, array => Accelerator::bytes(array))
    }
}
