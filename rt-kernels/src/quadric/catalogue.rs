//! Every kernel with every choice.

use std::any::TypeId;
use std::marker::PhantomData;

use super::form::{Ball, Central, World};
use super::sweep::{self, Surfaces};
use super::{OwnBoxCone, OwnBoxSphere, QuadricKernel, Residual, Stable, Textbook};
use crate::catalogue::{Listed, Shape, Way};
use crate::geom::Curved;
use crate::packet::{Hits, Rays};
use crate::tri::knobs::{Fused, Plain};

/// A [`QuadricKernel`] that is chosen at run time, batch by batch.
pub trait QuadricTest: Listed {
    /// What it keeps of surfaces; they are numbered in their order. `None` if it is not made for
    /// one of them.
    fn surfaces(&self, surfaces: &[Curved]) -> Option<Surfaces>;

    /// Finds the closest hit of every ray among all surfaces, which this kernel made. `hits` is
    /// made as long as `rays`.
    ///
    /// # Panics
    /// If it cannot be [run](Listed::runs) that way.
    fn closest(&self, way: Way, surfaces: &Surfaces, rays: &Rays, hits: &mut Hits);
}

struct Entry<K>(PhantomData<fn() -> K>);

impl<K: QuadricKernel> Listed for Entry<K> {
    fn name(&self) -> &'static str {
        K::NAME
    }

    fn variant(&self) -> String {
        K::variant()
    }

    fn is_default(&self) -> bool {
        [TypeId::of::<OwnBoxSphere>(), TypeId::of::<OwnBoxCone>()].contains(&TypeId::of::<K>())
    }

    /// None estimates.
    fn is_exact(&self) -> bool {
        true
    }

    fn runs(&self, way: Way) -> bool {
        sweep::runs::<K>(way)
    }

    fn is_emulated(&self, way: Way) -> bool {
        K::FUSED && way.shape == Shape::One
    }
}

impl<K: QuadricKernel> QuadricTest for Entry<K> {
    fn surfaces(&self, surfaces: &[Curved]) -> Option<Surfaces> {
        Surfaces::new::<K>(surfaces)
    }

    fn closest(&self, way: Way, surfaces: &Surfaces, rays: &Rays, hits: &mut Hits) {
        sweep::closest::<K>(way, surfaces, rays, hits);
    }
}

/// Every kernel with every choice, methods together.
#[inline]
pub fn catalogue() -> Vec<&'static dyn QuadricTest> {
    let mut all: Vec<&'static dyn QuadricTest> = Vec::new();
    macro_rules! with_each_form {
        ($($Kernel:ident;)*) => {$(
            all.push(&Entry::<$Kernel<Ball, Plain>>(PhantomData));
            all.push(&Entry::<$Kernel<Ball, Fused>>(PhantomData));
            all.push(&Entry::<$Kernel<Central, Plain>>(PhantomData));
            all.push(&Entry::<$Kernel<Central, Fused>>(PhantomData));
            all.push(&Entry::<$Kernel<World, Plain>>(PhantomData));
        )*};
    }
    with_each_form! {
        Textbook;
        Stable;
        Residual;
    }
    all.push(&Entry::<OwnBoxSphere>(PhantomData));
    all.push(&Entry::<OwnBoxCone>(PhantomData));
    all
}
