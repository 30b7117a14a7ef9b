//! Every ray against every primitive: the oracle of all accelerators.

use simd4::SimdF32;

use crate::packet::{Frame, Packet, Query};
use crate::primitives::Store;
use crate::trace::Traverse;
use crate::tri::{Method, TriangleKernel};
use crate::{BuildError, Counters, Primitives, Sequential};

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
        Brute::build_with(primitives, Method::default())
    }

    /// Copies the primitives for a triangle test of that method.
    ///
    /// # Errors
    /// As [`Bvh::build`](crate::Bvh::build).
    pub fn build_with(primitives: &Primitives, method: Method) -> Result<Brute, BuildError> {
        primitives.check(&Sequential)?;
        Ok(Brute { store: Store::in_order(primitives, method) })
    }
}

impl Traverse for Brute {
    const ANY_PACKET: bool = false;

    #[inline(always)]
    fn traverse<K: TriangleKernel, V: SimdF32, F: Frame<V>, Q: Query<V>>(
        &self,
        s: V::Simd,
        packet: &Packet<V>,
        frame: &F,
        query: &mut Q,
        stats: &mut impl Counters,
    ) {
        let store = &self.store;
        for slots in &store.slots_by_kind() {
            store.intersect::<K, V, F, Q>(s, slots.clone(), packet, frame, query, stats);
        }
    }

    fn method(&self) -> Method {
        self.store.method()
    }

    fn bytes(&self) -> usize {
        self.store.bytes()
    }
}
