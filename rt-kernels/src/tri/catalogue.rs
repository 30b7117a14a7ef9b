//! Every kernel with every choice.

use std::any::TypeId;
use std::marker::PhantomData;

use super::knobs::{Division, Estimate, Fused, Kahan, Plain, Refined, Split};
use super::sweep::{self, Triangles};
use super::{MollerTrumbore, MollerTrumboreF64, Plucker, TriangleKernel, Wald, Watertight};
use crate::catalogue::{Listed, Shape, Way};
use crate::geom::Triangle;
use crate::packet::{Hits, Rays};

/// A [`TriangleKernel`] that is chosen at run time, batch by batch.
pub trait TriangleTest: Listed {
    /// What it keeps of triangles; they are numbered in their order.
    fn triangles(&self, triangles: &[Triangle]) -> Triangles;

    /// Finds the closest hit of every ray among all triangles, which this kernel made. `hits` is
    /// made as long as `rays`.
    ///
    /// # Panics
    /// If it cannot be [run](Listed::runs) that way.
    fn closest(&self, way: Way, triangles: &Triangles, rays: &Rays, hits: &mut Hits);
}

struct Entry<K>(PhantomData<fn() -> K>);

impl<K: TriangleKernel> Listed for Entry<K> {
    fn name(&self) -> &'static str {
        K::NAME
    }

    fn variant(&self) -> String {
        K::variant()
    }

    fn is_default(&self) -> bool {
        TypeId::of::<K>() == TypeId::of::<Watertight>()
    }

    fn is_exact(&self) -> bool {
        K::EXACT
    }

    fn runs(&self, way: Way) -> bool {
        sweep::runs::<K>(way)
    }

    fn is_emulated(&self, way: Way) -> bool {
        K::FUSED && way.shape == Shape::One
    }
}

impl<K: TriangleKernel> TriangleTest for Entry<K> {
    fn triangles(&self, triangles: &[Triangle]) -> Triangles {
        Triangles::new::<K>(triangles)
    }

    fn closest(&self, way: Way, triangles: &Triangles, rays: &Rays, hits: &mut Hits) {
        sweep::closest::<K>(way, triangles, rays, hits);
    }
}

/// Every kernel with every choice, methods together.
#[inline]
pub fn catalogue() -> Vec<&'static dyn TriangleTest> {
    let mut all: Vec<&'static dyn TriangleTest> = Vec::new();
    macro_rules! with_each_reciprocal {
        ($($Kernel:ident<_ $(, $more:tt)*>;)*) => {$(
            all.push(&Entry::<$Kernel<Division $(, $more)*>>(PhantomData));
            all.push(&Entry::<$Kernel<Refined $(, $more)*>>(PhantomData));
            all.push(&Entry::<$Kernel<Estimate $(, $more)*>>(PhantomData));
        )*};
    }
    with_each_reciprocal! {
        MollerTrumbore<_, Plain, false>;
        MollerTrumbore<_, Fused, false>;
        Wald<_, Plain>;
        Wald<_, Fused>;
        Plucker<_, Plain>;
        Plucker<_, Fused>;
        Watertight<_, Plain, true, false>;
        Watertight<_, Plain, false, false>;
        Watertight<_, Split, false, false>;
        Watertight<_, Kahan, false, false>;
        Watertight<_, Fused, false, false>;
    }
    all.push(&Entry::<MollerTrumbore<Division, Plain, true>>(PhantomData));
    all.push(&Entry::<MollerTrumbore<Division, Fused, true>>(PhantomData));
    all.push(&Entry::<Watertight>(PhantomData));
    all.push(&Entry::<MollerTrumboreF64>(PhantomData));
    all
}
