//! Every kernel with every choice.

use std::any::TypeId;
use std::marker::PhantomData;

use super::conservative::{AsPrinted, Corrected};
use super::knobs::{Bare, EachClipped, IntervalFirst, IntervalLast, Ize, Relative, Scaled};
use super::sweep::{self, BoxSet, Crossings};
use super::{BoxKernel, Conservative, Robust, SharedOrigin, Signed, Unordered};
use crate::packet::Rays;
use crate::tri::Way;
use crate::tri::knobs::{Division, Estimate, Refined};

/// A [`BoxKernel`] that is chosen at run time, batch by batch.
pub trait BoxTest: Send + Sync {
    /// What the method is called.
    fn name(&self) -> &'static str;

    /// Its choices, in words.
    fn variant(&self) -> String;

    /// Whether it is the one that renders.
    fn is_default(&self) -> bool;

    /// Whether its answers are the same on every level and machine, with any number of lanes.
    fn is_exact(&self) -> bool;

    /// Whether it can be run that way: one that [fuses](BoxKernel::FUSED) with one lane, by
    /// emulation, or at a level that does too; one that answers for a packet not with boxes in
    /// lanes.
    fn runs(&self, way: Way) -> bool;

    /// Whether it does so by emulation, so that its time means nothing.
    fn is_emulated(&self, way: Way) -> bool;

    /// Shows every box to every ray. `crossings` is made as long as `rays`.
    ///
    /// # Panics
    /// If it cannot be [run](BoxTest::runs) that way.
    fn cross(&self, way: Way, boxes: &BoxSet, rays: &Rays, crossings: &mut Crossings);
}

struct Entry<K>(PhantomData<fn() -> K>);

impl<K: BoxKernel> BoxTest for Entry<K> {
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
        sweep::emulates::<K>(way)
    }

    fn cross(&self, way: Way, boxes: &BoxSet, rays: &Rays, crossings: &mut Crossings) {
        sweep::cross::<K>(way, boxes, rays, crossings);
    }
}

/// Every kernel with every choice, methods together.
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
