//! Every ray against every primitive: the oracle of all accelerators.

use simd4::SimdF32;

use crate::packet::{Frame, Packet, Query};
use crate::primitives::Store;
use crate::trace::Traverse;
use crate::{BuildError, Primitives, Stats};

/// No acceleration at all.
#[derive(Clone, Debug)]
pub struct Brute {
    store: Store,
}

impl Brute {
    /// Copies the primitives.
    ///
    /// # Errors
    /// As [`Bvh::build`](crate::Bvh::build).
    pub fn build(primitives: &Primitives) -> Result<Brute, BuildError> {
        primitives.check()?;
        Ok(Brute { store: Store::in_order(primitives) })
    }
}

impl Traverse for Brute {
    #[inline(always)]
    fn traverse<V: SimdF32, F: Frame<V>, Q: Query<V>>(
        &self,
        s: V::Simd,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Q,
        stats: &mut Stats,
    ) {
        self.store.intersect(s, self.store.triangle_slots(), packet, frame, query, stats);
        self.store.intersect(s, self.store.sphere_slots(), packet, frame, query, stats);
    }

    fn bytes(&self) -> usize {
        self.store.bytes()
    }
}
