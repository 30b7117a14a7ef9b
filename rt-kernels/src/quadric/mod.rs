//! Ray against surfaces of the second order, which stay curved: one file a method, all behind
//! [`QuadricKernel`].
//!
//! A ray meets such a surface where a t² − 2 b t + c = 0. Methods differ in how they have b² − a c,
//! the difference of two large numbers if the surface is small and far, and in how they have the
//! roots from it. Each is one text for three [forms](form) of surface: spheres, quadrics about their
//! centre, quadrics about the world's origin; and one text for rays in lanes against one surface
//! ([`Record`]), one ray in all lanes against surfaces in lanes ([`RecordBlock`]), and one against
//! one. [`catalogue`] lists every method with every choice; what renders is [`sphere`] and [`cone`],
//! which has a method of its own.

mod catalogue;
pub mod cone;
pub mod form;
mod record;
mod residual;
pub mod sphere;
mod stable;
mod sweep;
mod textbook;

pub use catalogue::{QuadricTest, catalogue};
pub use cone::OwnBoxCone;
pub use record::{Record, RecordBlock, Records};
pub use residual::Residual;
pub use sphere::OwnBoxSphere;
pub use stable::Stable;
pub use sweep::Surfaces;
pub use textbook::Textbook;

use simd4::{SimdF32, SimdMask};

use crate::geom::Curved;
use crate::packet::{Frame, Packet};
use form::{Form, Seen};

/// A way to decide whether a ray meets a surface of the second order, and where it first does.
pub trait QuadricKernel: Send + Sync + 'static {
    /// What the method is called.
    const NAME: &'static str;
    /// Whether it rounds a product and a sum once: slow on a level without such an instruction.
    const FUSED: bool = false;
    /// Whether it looks at the [`Frame`]. If not, any frame will do.
    const FRAMED: bool = false;

    /// Its choices, in words: distinct among the variants of one method.
    fn variant() -> String;

    /// What it keeps of a surface, whose number is `prim`: `None` if it is not made for such.
    fn record(surface: &Curved, prim: u32) -> Option<Record>;

    /// The lanes whose ray meets its record's surface with `packet.tmin <= t <= limit`: `None` if
    /// there is none.
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        frame: &F,
        limit: V,
    ) -> Option<Found<V>>;
}

/// What a kernel found.
#[derive(Clone, Copy, Debug)]
pub struct Found<V: SimdF32> {
    /// The lanes that hit.
    pub mask: V::Mask,
    /// The distance, in units of the direction's length.
    pub t: V,
}

/// Where lines meet surfaces.
#[derive(Clone, Copy, Debug)]
struct Roots<V: SimdF32> {
    /// The lanes in which there are roots.
    meets: V::Mask,
    /// The roots, in any order.
    t: [V; 2],
}

impl<V: SimdF32> Roots<V> {
    /// The lesser root and the greater; of a NaN and a number the number.
    #[inline(always)]
    fn in_order(&self) -> [V; 2] {
        let [a, b] = self.t;
        [a.min(b), a.max(b)]
    }

    /// The first root that is not before `tmin` and within what is left of the surface.
    #[inline(always)]
    fn first<S: Form, R: Records<V>>(
        self,
        s: V::Simd,
        records: &R,
        seen: &Seen<V>,
        packet: &Packet<V>,
        limit: V,
    ) -> Option<Found<V>> {
        let [first, second] = self.in_order();
        let first_counts = packet.tmin.le(first) & S::keeps(s, records, seen, packet, first);
        let second_counts = packet.tmin.le(second) & S::keeps(s, records, seen, packet, second);
        let t = first_counts.select(first, second);
        let mask = self.meets & (first_counts | second_counts) & t.le(limit);
        mask.any().then_some(Found { mask, t })
    }
}
