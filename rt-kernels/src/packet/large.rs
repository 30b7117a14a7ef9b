//! Many rays that go together.

use simd4::math::Vec3;
use simd4::{Lanes, SimdF32, SimdMask};

use super::chunk::{Chunk, Class, Found};
use super::column::{LARGE, get, get_by, get3, lanes, one3, put, put3};
use super::frame::Shear;
use super::{Alone, Axes, Coherent, Hits, Packet, Query};
use crate::Hit;

/// The least and the greatest of something over all rays of a large packet.
pub type Bounds = [f32; 2];

/// What is known of all rays of a class. Everything is in the order of `axes`.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    /// The dominant axis, last, and before it the other two.
    pub axes: [usize; 3],
    /// Whether directions are negative.
    pub negative: [bool; 3],
    /// The origins.
    pub origin: [Bounds; 3],
    /// The magnitudes of the directions' reciprocals.
    pub inv: [Bounds; 3],
    /// A direction's other components over the dominant one.
    pub slopes: [Bounds; 2],
}

impl Beam {
    /// Whether all rays have the same origin.
    #[inline(always)]
    pub fn has_apex(&self) -> bool {
        let [x, y, z] = self.origin;
        x[0] == x[1] && y[0] == y[1] && z[0] == z[1]
    }
}

/// The rays of one class of a chunk, to be traced together.
pub struct LargePacket<'a> {
    chunk: &'a mut Chunk,
    class: Class,
    any: bool,
}

impl<'a> LargePacket<'a> {
    /// The rays of that class, for the closest hits or for `any`, and what is known of all of them.
    #[inline(always)]
    pub fn new<V: SimdF32>(
        s: V::Simd,
        chunk: &'a mut Chunk,
        class: Class,
        any: bool,
    ) -> (Self, Beam) {
        let axes = class.axes.order().map(|axis| axis.min(2));
        let [kx, ky, kz] = axes;
        let lead = class.rays.trailing_zeros() as usize % LARGE;
        let mut bounds = [[V::splat(s, f32::INFINITY), V::splat(s, f32::NEG_INFINITY)]; 8];
        for g in 0..chunk.groups::<V>() {
            let at = g * V::LANES;
            let all = u64::MAX >> (LARGE - V::LANES);
            let some = class.rays >> at & all;
            if some == 0 {
                continue;
            }
            let [x, y, z] = get_by::<V>(s, &chunk.origin, axes, at);
            let [dir_x, dir_y, dir_z] = get_by::<V>(s, &chunk.dir, axes, at);
            let [inv_x, inv_y, inv_z] = get_by::<V>(s, &chunk.inv, axes, at);
            let shear = Vec3::new(dir_x / dir_z, dir_y / dir_z, inv_z);
            let inv = Vec3::new(inv_x.abs(), inv_y.abs(), inv_z.abs());
            put3(&mut chunk.shear, at, shear);
            put3(&mut chunk.inv_abs, at, inv);
            let mut values = [x, y, z, inv.x, inv.y, inv.z, shear.x, shear.y];
            if some != all {
                // What is not in the class is as its first ray is, of which all is known by now.
                let [x, y, z] = axes.map(|axis| &chunk.origin[axis]);
                let (inv, shear) = (&chunk.inv_abs, &chunk.shear);
                let columns = [x, y, z, &inv[0], &inv[1], &inv[2], &shear[0], &shear[1]];
                let lanes = lanes::<V>(s, some);
                for (value, column) in values.iter_mut().zip(columns) {
                    *value = lanes.select(*value, V::splat(s, column[lead]));
                }
            }
            for ([least, greatest], value) in bounds.iter_mut().zip(values) {
                *least = least.min(value);
                *greatest = greatest.max(value);
            }
        }
        let mut ends = [[0.0; 2]; 8];
        for (ends, [least, greatest]) in ends.iter_mut().zip(bounds) {
            *ends = [least.reduce_min(), greatest.reduce_max()];
        }
        let [x, y, z, inv_x, inv_y, inv_z, slope_x, slope_y] = ends;
        let beam = Beam {
            axes,
            negative: [class.negative[kx], class.negative[ky], class.negative[kz]],
            origin: [x, y, z],
            inv: [inv_x, inv_y, inv_z],
            slopes: [slope_x, slope_y],
        };
        (LargePacket { chunk, class, any }, beam)
    }

    /// Whether one hit is enough.
    #[inline(always)]
    pub fn any(&self) -> bool {
        self.any
    }

    /// The number of registers that hold the rays.
    #[inline(always)]
    pub fn groups<V: SimdF32>(&self) -> usize {
        self.chunk.groups::<V>()
    }

    /// The rays of a register, and how they look at the axes. Those of other classes hit nothing.
    #[inline(always)]
    pub fn group<V: SimdF32>(&self, s: V::Simd, g: usize) -> (Packet<V>, Coherent<V>) {
        let at = g * V::LANES;
        let chunk = &*self.chunk;
        let packet = Packet {
            origin: get3(s, &chunk.origin, at),
            dir: get3(s, &chunk.dir, at),
            inv: get3(s, &chunk.inv, at),
            tmin: get(s, &chunk.tmin, at),
            tmax: get(s, &chunk.hits.t, at),
        };
        let shear = get3(s, &chunk.shear, at);
        (packet, self.frame(&packet, shear))
    }

    /// The origins and the directions' reciprocals of the rays of a register, on one axis.
    #[inline(always)]
    pub(crate) fn along<V: SimdF32>(&self, s: V::Simd, g: usize, axis: usize) -> [V; 2] {
        let (chunk, at, axis) = (&*self.chunk, g * V::LANES, axis % 3);
        [get(s, &chunk.origin[axis], at), get(s, &chunk.inv[axis], at)]
    }

    /// One ray in all lanes, and how it looks at the axes.
    #[inline(always)]
    pub fn ray<B: SimdF32>(&self, s: B::Simd, ray: usize) -> (Packet<B>, Coherent<B>) {
        let ray = ray % LARGE;
        let chunk = &*self.chunk;
        let packet = Packet {
            origin: one3(s, &chunk.origin, ray),
            dir: one3(s, &chunk.dir, ray),
            inv: one3(s, &chunk.inv, ray),
            tmin: B::splat(s, chunk.tmin[ray]),
            tmax: B::splat(s, chunk.hits.t[ray]),
        };
        (packet, self.frame(&packet, one3(s, &chunk.shear, ray)))
    }

    #[inline(always)]
    fn frame<V: SimdF32>(&self, packet: &Packet<V>, Vec3 { x, y, z }: Vec3<V>) -> Coherent<V> {
        let Class { negative, axes, .. } = self.class;
        Coherent::new(negative, axes, Shear { origin: axes.last(packet.origin), x, y, z })
    }

    /// What the slab test asks of the rays of a register.
    #[inline(always)]
    pub fn reach<V: SimdF32>(&self, s: V::Simd, g: usize) -> Reach<V> {
        let at = g * V::LANES;
        let chunk = &*self.chunk;
        let inv = get3(s, &chunk.inv_abs, at);
        Reach { inv, tmin: get(s, &chunk.tmin, at), limit: get(s, &chunk.hits.t, at) }
    }

    /// The slopes of the rays of a register.
    #[inline(always)]
    pub fn slopes<V: SimdF32>(&self, s: V::Simd, g: usize) -> [V; 2] {
        let [x, y, _] = &self.chunk.shear;
        [get(s, x, g * V::LANES), get(s, y, g * V::LANES)]
    }

    /// What the rays of a register look for.
    #[inline(always)]
    pub fn query<V: SimdF32>(&mut self, s: V::Simd, g: usize) -> GroupQuery<'_, V> {
        let at = g * V::LANES;
        let (any, rays) = (self.any, self.class.rays >> (at % LARGE));
        GroupQuery { limit: self.limit(s, g), hits: &mut self.chunk.hits, rays, any, at }
    }

    /// The greatest `t` that still matters to the rays of a register.
    #[inline(always)]
    pub fn limit<V: SimdF32>(&self, s: V::Simd, g: usize) -> V {
        get(s, &self.chunk.hits.t, g * V::LANES)
    }

    /// One of the rays, and what it has found.
    #[inline(always)]
    pub(crate) fn alone(&self, ray: usize) -> (Alone, Hit) {
        let Class { negative: [x, y, z], axes, .. } = self.class;
        let octant = u32::from(x) | u32::from(y) << 1 | u32::from(z) << 2;
        (self.chunk.alone_in(ray, octant, axes), self.chunk.hit(ray))
    }

    /// Takes what a ray has found by itself, if it is better than what it has.
    #[inline(always)]
    pub(crate) fn take(&mut self, ray: usize, hit: Hit) {
        if hit.wins(&self.chunk.hit(ray)) {
            self.set_hit(ray, hit);
        }
    }

    /// What a ray has found.
    #[inline(always)]
    pub(crate) fn hit(&self, ray: usize) -> Hit {
        self.chunk.hit(ray)
    }

    /// States what a ray has found.
    #[inline(always)]
    pub(crate) fn set_hit(&mut self, ray: usize, Hit { t, prim, u, v }: Hit) {
        let (ray, hits) = (ray % LARGE, &mut self.chunk.hits);
        let done = self.any && prim != Hits::NONE;
        hits.t[ray] = if done { f32::NEG_INFINITY } else { t };
        (hits.u[ray], hits.v[ray], hits.prim[ray]) = (u, v, prim);
    }
}

/// How far rays reach.
#[derive(Clone, Copy, Debug)]
pub struct Reach<V> {
    /// The magnitudes of the directions' reciprocals, with the dominant axis as z.
    pub inv: Vec3<V>,
    /// The least `t`.
    pub tmin: V,
    /// The greatest `t` that still matters.
    pub limit: V,
}

/// What the rays of one register of a large packet look for: the closest hit, or any.
pub struct GroupQuery<'a, V> {
    hits: &'a mut Found,
    limit: V,
    /// Those of the class.
    rays: u64,
    any: bool,
    at: usize,
}

impl<V: SimdF32> Query<V> for GroupQuery<'_, V> {
    #[inline(always)]
    fn limit(&self) -> V {
        self.limit
    }

    #[inline(always)]
    fn record(&mut self, s: V::Simd, mask: V::Mask, prim: V::U32, t: V, u: V, v: V) {
        let (at, hits) = (self.at, &mut *self.hits);
        let best: V::U32 = get(s, &hits.prim, at);
        let first = t.lt(self.limit) | (t.eq(self.limit) & prim.lt(best));
        let wins = mask & first & lanes::<V>(s, self.rays);
        // A lane that has what it wants has no limit left.
        let t = if self.any { V::splat(s, f32::NEG_INFINITY) } else { t };
        self.limit = wins.select(t, self.limit);
        put(&mut hits.t, at, self.limit);
        put(&mut hits.prim, at, wins.select(prim, best));
        let (old_u, old_v) = (get(s, &hits.u, at), get(s, &hits.v, at));
        put(&mut hits.u, at, wins.select(u, old_u));
        put(&mut hits.v, at, wins.select(v, old_v));
    }

    #[inline(always)]
    fn done(&self, s: V::Simd) -> bool {
        self.any && self.limit.lt(V::splat(s, 0.0)).all()
    }
}
