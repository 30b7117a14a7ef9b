//! Ray against box by slabs (Kay and Kajiya 1986): one file a method, all behind [`BoxKernel`].
//!
//! A box is what three pairs of planes have in common; a ray is within each pair from one distance
//! to another, and meets the box if these intervals have a point in common. Methods differ in how
//! they find the nearer plane of a pair, in what they make of 0 · ∞, which is what a ray has that
//! starts in a plane and runs along it, and in whether they allow for rounding.
//!
//! A kernel is one text for three uses: rays in lanes against one box ([`Aabb`](crate::geom::Aabb)), one ray in all
//! lanes against boxes in lanes ([`OwnBoxes`](crate::packet::OwnBoxes)), and one against one, which
//! is the same with one lane. [`catalogue`] lists every kernel with every choice, so that tests,
//! benches and charts are a loop; what renders is [`Robust`]'s default.
//!
//! All are tests for a bound: to say "may hit" of a box that is missed costs time, to say "missed"
//! of one that is hit costs the picture.

mod catalogue;
mod conservative;
pub(crate) mod interval;
pub mod knobs;
pub(crate) mod pyramid;
pub mod robust;
mod shared_origin;
mod signed;
mod sweep;
mod unordered;

pub use catalogue::{BoxTest, catalogue};
pub use conservative::{AsPrinted, Conservative, Corrected, Estimated};
pub use robust::Robust;
pub use shared_origin::SharedOrigin;
pub(crate) use shared_origin::Viewed;
pub use signed::Signed;
pub use sweep::{BoxSet, Crossings};
pub use unordered::Unordered;

use simd4::SimdF32;

use crate::packet::{Boxes, Frame, Packet};
use crate::tri::knobs::Reciprocal;

/// A way to decide whether a ray may meet something in a box.
pub trait BoxKernel: Send + Sync + 'static {
    /// What the method is called.
    const NAME: &'static str;
    /// Whether its answers are the same on every level and machine, with any number of lanes.
    const EXACT: bool;
    /// Whether it rounds a product and a sum once: slow on a level without such an instruction.
    const FUSED: bool = false;
    /// Whether it looks at the [`Frame`]. If not, any frame will do.
    const FRAMED: bool = false;
    /// Whether it gives one answer for all rays of a packet: none for boxes in lanes.
    const TOGETHER: bool = false;
    /// Whether it subtracts the origin once a box where all rays of a packet have the same.
    const SHARED_ORIGIN: bool = false;

    /// How the reciprocals of directions are had, once a packet.
    type Reciprocal: Reciprocal;

    /// Its choices, in words: distinct among the variants of one method.
    fn variant() -> String;

    /// The lanes whose ray may meet something in its box with `packet.tmin <= t <= limit`: `None`
    /// if there is none. The packet's reciprocals are those of [`BoxKernel::Reciprocal`].
    fn test<V: SimdF32, F: Frame<V>, B: Boxes<V>>(
        s: V::Simd,
        boxes: &B,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Crossing<V>>;
}

/// What a kernel found.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<V: SimdF32> {
    /// The lanes that may hit.
    pub mask: V::Mask,
    /// Where they enter the box, or start in it.
    pub enter: V,
}
