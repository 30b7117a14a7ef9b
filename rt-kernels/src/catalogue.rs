//! What the lists of kernels have in common: names, and ways to run them.
//!
//! [`tri::catalogue`](crate::tri::catalogue), [`slab::catalogue`](crate::slab::catalogue) and
//! [`quadric::catalogue`](crate::quadric::catalogue) list every kernel with every choice, so that
//! tests, benches and charts are a loop. They are inlined: who calls one compiles all of its
//! kernels at all levels, which takes a minute. Nothing that renders does.

use simd4::{Level, Simd, SimdF32, dispatch};

/// What goes in the lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// One ray against one primitive, in plain scalar code.
    One,
    /// As many rays as a register has lanes against one primitive.
    Rays,
    /// One ray against as many primitives as a register has lanes.
    Primitives,
}

/// A level and a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// The instructions to use. Of no account to [`Shape::One`].
    pub level: Level,
    /// What goes in the lanes.
    pub shape: Shape,
}

impl Way {
    /// Every way there is on this machine: scalar first, then both shapes at each level.
    pub fn all() -> Vec<Way> {
        let mut levels = Level::available().peekable();
        let first = levels.peek().copied();
        let one = first.map(|level| Way { level, shape: Shape::One });
        let lanes = levels
            .flat_map(|level| [Shape::Rays, Shape::Primitives].map(|shape| Way { level, shape }));
        one.into_iter().chain(lanes).collect()
    }

    /// The number of lanes.
    pub fn width(self) -> usize {
        match self.shape {
            Shape::One => 1,
            Shape::Rays | Shape::Primitives => self.level.lanes(),
        }
    }

    /// Whether a product and a sum can be rounded once there, by an instruction or, with one lane,
    /// by emulation.
    pub(crate) fn fuses(self) -> bool {
        #[inline(always)]
        fn by_instruction<S: Simd>(_: S) -> bool {
            <S::f32s as SimdF32>::FUSED
        }
        self.shape == Shape::One || dispatch!(self.level, s => by_instruction(s))
    }
}

/// A kernel that is chosen at run time.
pub trait Listed: Send + Sync {
    /// What the method is called.
    fn name(&self) -> &'static str;

    /// Its choices, in words: distinct among the variants of one method.
    fn variant(&self) -> String;

    /// Whether it is the one that renders.
    fn is_default(&self) -> bool;

    /// Whether its answers have the same bits on every level and machine.
    fn is_exact(&self) -> bool;

    /// Whether it can be run that way: one that fuses only where that can be done, and one that is
    /// made for some [`Shape`] only in that.
    fn runs(&self, way: Way) -> bool;

    /// Whether it fuses there by emulation, so that its time means nothing.
    fn is_emulated(&self, way: Way) -> bool;
}
