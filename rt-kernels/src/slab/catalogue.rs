//! Every kernel with every choice.

use std::any::TypeId;
use std::marker::PhantomData;

use super::conservative::{AsPrinted, Corrected};
use super::knobs::{Bare, EachClipped, IntervalFirst, IntervalLast, Ize, Relative, Scaled};
use super::sweep::{self, BoxSet, Crossings};
use super::{BoxKernel, Conservative, Robust, SharedOrigin, Signed, Unordered};
use crate::catalogue::{Listed, Shape, Way};
use crate::packet::Rays;
use crate::tri::knobs::{Division, Estimate, Refined};

/// A [`BoxKernel`] that is chosen at run time, batch by batch. One that answers for a whole packet
/// does not run with boxes in lanes, nor does one that moves the boxes to the rays' origin.
pub trait BoxTest: Listed {
    /// Shows every box to every ray. `crossings` is made as long as `rays`.
    ///
    /// # Panics
    /// If it cannot be [run](Listed::runs) that way.
    fn cross(&self, way: Way, boxes: &BoxSet, rays: &Rays, crossings: &mut Crossings);
}

struct Entry<K>(PhantomData<fn() -> K>);

impl<K: BoxKernel> Listed for Entry<K> {
    fn name(&self) -> &'static str {
        K::NAME
    }

    fn variant(&self) -> String {
        K::variant()
    }

    fn is_default(&self) -> bool {
        TypeId::of::<K>() == TypeId::of::<Robust>()
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

impl<K: BoxKernel> BoxTest for Entry<K> {
    fn cross(&self, way: Way, boxes: &BoxSet, rays: &Rays, crossings: &mut Crossings) {
        sweep::cross::<K>(way, boxes, rays, crossings);
    }
}

/// Every kernel with every choice, methods together.
#[inline]
pub fn catalogue() -> Vec<&'static dyn BoxTest> {
    let mut all: Vec<&'static dyn BoxTest> = Vec::new();
    macro_rules! with_each_reciprocal {
        ($($Kernel:ident<_ $(, $more:ty)*>;)*) => {$(
            all.push(&Entry::<$Kernel<Division $(, $more)*>>(PhantomData));
            all.push(&Entry::<$Kernel<Refined $(, $more)*>>(PhantomData));
            all.push(&Entry::<$Kernel<Estimate $(, $more)*>>(PhantomData));
        )*};
    }
    with_each_reciprocal! {
        Unordered<_, IntervalFirst, Bare>;
        Unordered<_, IntervalLast, Bare>;
        Unordered<_, EachClipped, Bare>;
        Unordered<_, EachClipped, Ize>;
        Signed<_, Relative, Bare>;
        Signed<_, Relative, Ize>;
        Signed<_, Scaled, Bare>;
        Signed<_, Scaled, Ize>;
        Robust<_>;
        Conservative<_, AsPrinted>;
        Conservative<_, Corrected<Bare>>;
        Conservative<_, Corrected<Ize>>;
    }
    all.push(&Entry::<SharedOrigin<Robust>>(PhantomData));
    all.push(&Entry::<SharedOrigin<Unordered<Division, EachClipped, Ize>>>(PhantomData));
    all
}
