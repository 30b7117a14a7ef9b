//! Bounding volume hierarchies.
//!
//! A builder ([`build`]) makes a build tree; a [`layout`] turns it into flat arrays; a traversal
//! ([`traverse`]) runs over them. [`Bvh`] is the combination that renders by default.

pub mod build;
pub mod layout;
pub mod traverse;

pub use build::{BuildError, Join, Sequential};

use simd4::SimdF32;

use crate::packet::{Frame, Packet, Query};
use crate::trace::Traverse;
use crate::tri::{Method, TriangleKernel};
use crate::{Primitives, Stats};
use layout::SkipArray;

/// A hierarchy of boxes, built by binned SAH, laid out as a depth-first array with skip pointers.
#[derive(Clone, Debug)]
pub struct Bvh {
    array: SkipArray,
}

impl Bvh {
    /// Builds the hierarchy. It is the same for any `join`.
    ///
    /// No primitives, coinciding ones and ones without area are all fine.
    ///
    /// # Errors
    /// If a coordinate is not finite or greater than 2^40, if a sphere has no radius, or if there
    /// are more than 2^28 primitives.
    pub fn build(primitives: &Primitives, join: &impl Join) -> Result<Bvh, BuildError> {
        Bvh::build_with(primitives, Method::default(), join)
    }

    /// Builds the hierarchy for a triangle test of that method.
    ///
    /// # Errors
    /// As [`build`](Bvh::build).
    pub fn build_with(
        primitives: &Primitives,
        method: Method,
        join: &impl Join,
    ) -> Result<Bvh, BuildError> {
        primitives.check()?;
        let tree = build::binned_sah::build(primitives, join);
        Ok(Bvh { array: SkipArray::new(primitives, &tree, method) })
    }

    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        self.array.nodes().len()
    }
}

impl Traverse for Bvh {
    #[inline(always)]
    fn traverse<K: TriangleKernel, V: SimdF32, F: Frame<V>, Q: Query<V>>(
        &self,
        s: V::Simd,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Q,
        stats: &mut Stats,
    ) {
        traverse::skip::traverse::<K, V, F, Q>(s, &self.array, packet, frame, query, stats);
    }

    fn method(&self) -> Method {
        self.array.store.method()
    }

    fn bytes(&self) -> usize {
        self.array.bytes()
    }
}
