//! What is asked of a packet.

use simd4::{Lanes, SimdF32, SimdMask};

use super::{Hits, Packet};

/// What a traversal looks for. It prunes by [`limit`](Query::limit) and hands every hit to
/// [`record`](Query::record).
pub trait Query<V: SimdF32> {
    /// The greatest `t` that still matters; −inf in lanes that are done.
    fn limit(&self) -> V;

    /// Takes a hit: in the lanes of `mask`, the primitive `prim` at `t`, which is within
    /// [`limit`](Query::limit), with weights `u`, `v`.
    fn record(&mut self, s: V::Simd, mask: V::Mask, prim: V::U32, t: V, u: V, v: V);

    /// Whether nothing matters any more, in any lane.
    fn done(&self, s: V::Simd) -> bool;
}

/// The closest hit: the least `t`, and of equal ones the lowest primitive.
#[derive(Clone, Copy, Debug)]
pub struct Closest<V: SimdF32> {
    t: V,
    u: V,
    v: V,
    prim: V::U32,
}

impl<V: SimdF32> Closest<V> {
    /// No hit yet.
    #[inline(always)]
    pub fn new(s: V::Simd, packet: &Packet<V>) -> Self {
        let zero = V::splat(s, 0.0);
        Closest { t: packet.tmax, u: zero, v: zero, prim: V::U32::splat(s, Hits::NONE) }
    }

    /// Writes the hits of the rays from `first` on.
    #[inline(always)]
    pub fn store(self, hits: &mut Hits, first: usize) {
        self.t.store_prefix(&mut hits.t[first..]);
        self.u.store_prefix(&mut hits.u[first..]);
        self.v.store_prefix(&mut hits.v[first..]);
        self.prim.store_prefix(&mut hits.prim[first..]);
    }

    /// Writes the closest hit of all lanes, which have the same ray, as that of ray `i`.
    #[inline(always)]
    pub fn store_least(self, s: V::Simd, hits: &mut Hits, i: usize) {
        let found = self.prim.ne(V::U32::splat(s, Hits::NONE));
        let Some((_, t)) = self.t.argmin(found) else {
            hits.prim[i] = Hits::NONE;
            return;
        };
        let closest = found & self.t.eq(V::splat(s, t));
        let Some((lane, prim)) = self.prim.argmin(closest) else { return };
        (hits.t[i], hits.prim[i]) = (t, prim);
        (hits.u[i], hits.v[i]) = (self.u.lane(lane), self.v.lane(lane));
    }
}

impl<V: SimdF32> Query<V> for Closest<V> {
    #[inline(always)]
    fn limit(&self) -> V {
        self.t
    }

    #[inline(always)]
    fn record(&mut self, _: V::Simd, mask: V::Mask, prim: V::U32, t: V, u: V, v: V) {
        let wins = mask & (t.lt(self.t) | (t.eq(self.t) & prim.lt(self.prim)));
        self.t = wins.select(t, self.t);
        self.u = wins.select(u, self.u);
        self.v = wins.select(v, self.v);
        self.prim = wins.select(prim, self.prim);
    }

    #[inline(always)]
    fn done(&self, _: V::Simd) -> bool {
        false
    }
}

/// The closest hit, or whether there is any, as is decided at run time: two loops would be twice the
/// code.
#[derive(Clone, Copy, Debug)]
pub struct Either<V: SimdF32> {
    closest: Closest<V>,
    any: bool,
}

impl<V: SimdF32> Either<V> {
    /// No hit yet.
    #[inline(always)]
    pub fn new(s: V::Simd, packet: &Packet<V>, any: bool) -> Self {
        Either { closest: Closest::new(s, packet), any }
    }

    /// Writes the hits of the rays from `first` on: with `any`, only whether there are any.
    #[inline(always)]
    pub fn store(self, hits: &mut Hits, first: usize) {
        self.closest.store(hits, first);
    }
}

impl<V: SimdF32> Query<V> for Either<V> {
    #[inline(always)]
    fn limit(&self) -> V {
        self.closest.limit()
    }

    #[inline(always)]
    fn record(&mut self, s: V::Simd, mask: V::Mask, prim: V::U32, t: V, u: V, v: V) {
        // Nothing is closer than what is closer than everything.
        let t = if self.any { V::splat(s, f32::NEG_INFINITY) } else { t };
        self.closest.record(s, mask, prim, t, u, v);
    }

    #[inline(always)]
    fn done(&self, s: V::Simd) -> bool {
        self.any && self.limit().lt(V::splat(s, 0.0)).all()
    }
}
