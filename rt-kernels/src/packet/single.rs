//! What is asked of one ray in all lanes, tested against other things in each.

use simd4::{Lanes, SimdF32, SimdMask};

use super::{Hits, Packet, Query};
use crate::Hit;

/// What is asked of one ray.
pub enum Ask<'a> {
    /// For the closest hit.
    Closest,
    /// For whichever is found first.
    Any,
    /// For what [`Accelerator::visit`](crate::Accelerator::visit) shows.
    Each(&'a mut dyn FnMut(Hit) -> f32),
}

/// What one ray in all lanes has found: what one lane finds bounds all others.
pub struct Single<'a, V> {
    limit: V,
    hit: Hit,
    ask: Ask<'a>,
}

impl<'a, V: SimdF32> Single<'a, V> {
    /// No hit yet.
    #[inline(always)]
    pub fn new(packet: &Packet<V>, ask: Ask<'a>) -> Self {
        let t = packet.tmax.lane(0);
        Single { limit: packet.tmax, hit: Hit { t, prim: Hits::NONE, u: 0.0, v: 0.0 }, ask }
    }

    /// A hit already, or none if its number is [`Hits::NONE`] and `t` the limit.
    #[inline(always)]
    pub(crate) fn from_hit(s: V::Simd, hit: Hit, ask: Ask<'a>) -> Self {
        Single { limit: V::splat(s, hit.t), hit, ask }
    }

    /// The greatest `t` that still matters.
    #[inline(always)]
    pub fn bound(&self) -> f32 {
        self.hit.t
    }

    /// Whether anything was found.
    #[inline(always)]
    pub fn found(&self) -> bool {
        self.hit.prim != Hits::NONE
    }

    /// What was found; nothing if its number is [`Hits::NONE`].
    #[inline(always)]
    pub(crate) fn hit(&self) -> Hit {
        self.hit
    }
}

impl<V: SimdF32> Query<V> for Single<'_, V> {
    #[inline(always)]
    fn limit(&self) -> V {
        self.limit
    }

    /// Of all lanes and what was found before, the least `(t, primitive)` is kept.
    #[inline(always)]
    fn record(&mut self, s: V::Simd, mask: V::Mask, prim: V::U32, t: V, u: V, v: V) {
        if let Ask::Each(visitor) = &mut self.ask {
            let mut lanes = mask.bitmask();
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let hit = Hit {
                    t: t.lane(lane),
                    prim: prim.lane(lane),
                    u: u.lane(lane),
                    v: v.lane(lane),
                };
                if hit.t <= self.hit.t {
                    self.hit.t = self.hit.t.min(visitor(hit));
                }
            }
            self.limit = V::splat(s, self.hit.t);
            return;
        }
        let lanes = mask.bitmask();
        // Most often it is one lane, and there is nothing to compare.
        let lane = if lanes & lanes.wrapping_sub(1) == 0 {
            lanes.trailing_zeros() as usize & (V::LANES - 1)
        } else {
            let Some((_, least)) = t.argmin(mask) else { return };
            let closest = mask & t.eq(V::splat(s, least));
            let Some((lane, _)) = prim.argmin(closest) else { return };
            lane
        };
        let (t, prim) = (t.lane(lane), prim.lane(lane));
        if lanes != 0 && (t < self.hit.t || prim < self.hit.prim) {
            self.hit = Hit { t, prim, u: u.lane(lane), v: v.lane(lane) };
            self.limit = V::splat(s, t);
        }
    }

    #[inline(always)]
    fn done(&self, _: V::Simd) -> bool {
        match self.ask {
            Ask::Closest => false,
            Ask::Any => self.found(),
            Ask::Each(_) => self.hit.t < 0.0,
        }
    }
}
