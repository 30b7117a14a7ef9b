//! Many rays that go together.

use simd4::math::Vec3;
use simd4::{LaneArray, Lanes, SimdF32, SimdMask};

use super::frame::Shear;
use super::{Alone, Axes, Coherent, Hits, OwnAxes, Packet, Query, Rays, SameAxis};
use crate::Hit;

/// The number of rays in a large packet: a bit for each in a `u64`.
pub const LARGE: usize = 64;

/// More classes than so many are few rays a class.
const MIXED: usize = 4;

/// A number of each ray of a large packet.
type Column<T> = [T; LARGE];

/// Up to [`LARGE`] rays of a batch by component (SoA), with what all kernels derive from them and
/// with what they find: registers of any size and single rays are loaded from it.
#[repr(C, align(64))]
pub struct Chunk {
    /// The number of rays, and of lanes that registers have for them.
    count: usize,
    origin: [Column<f32>; 3],
    dir: [Column<f32>; 3],
    inv: [Column<f32>; 3],
    tmin: Column<f32>,
    /// With the dominant axis of the class that is traced as z, or with each ray's own, if they are to go
    /// [by themselves](Chunk::part).
    shear: [Column<f32>; 3],
    /// The magnitudes of the reciprocals, with the dominant axis of the class that is traced as z.
    inv_abs: [Column<f32>; 3],
    hits: Found,
    /// Of rays that are to go by themselves a bit for each axis on which the direction is negative, x lowest;
    /// above them the dominant axis.
    signs_and_axis: Column<u32>,
    /// Rays with a negative direction, by axis.
    negative: [u64; 3],
    /// Rays whose dominant axis is x, and those where it is y.
    dominant: [u64; 2],
    /// The rays that are in no class yet.
    left: u64,
}

/// What the rays have found: nothing if the number is [`Hits::NONE`], and then `t` is the limit.
struct Found {
    t: Column<f32>,
    u: Column<f32>,
    v: Column<f32>,
    prim: Column<u32>,
}

/// Rays that agree in the signs of their directions and in the dominant axis.
#[derive(Clone, Copy, Debug)]
pub struct Class {
    /// The rays: a bit for each.
    pub rays: u64,
    negative: [bool; 3],
    axes: SameAxis,
}

impl Default for Chunk {
    /// No rays.
    fn default() -> Self {
        let column = [0.0; LARGE];
        Chunk {
            count: 0,
            origin: [column; 3],
            dir: [column; 3],
            inv: [column; 3],
            tmin: column,
            shear: [column; 3],
            inv_abs: [column; 3],
            hits: Found { t: column, u: column, v: column, prim: [0; LARGE] },
            signs_and_axis: [0; LARGE],
            negative: [0; 3],
            dominant: [0; 2],
            left: 0,
        }
    }
}

impl Chunk {
    /// Takes the rays from `first` on, as many as `most`, up to [`LARGE`].
    #[inline(always)]
    pub fn load<V: SimdF32>(&mut self, s: V::Simd, rays: &Rays, first: usize, most: usize) {
        self.count = (rays.len() - first).min(most).min(LARGE);
        (self.negative, self.dominant, self.left) = ([0; 3], [0; 2], 0);
        let rays = rays.part(first, self.count);
        let mut at = 0;
        while at < self.count {
            let packet = Packet::<V>::load_part(s, &rays, at);
            let [x, y, z] = packet.negative(s);
            let OwnAxes([in_x, in_y]) = packet.dominant();
            self.negative[0] |= u64::from(x.bitmask()) << at;
            self.negative[1] |= u64::from(y.bitmask()) << at;
            self.negative[2] |= u64::from(z.bitmask()) << at;
            self.dominant[0] |= u64::from(in_x.bitmask()) << at;
            self.dominant[1] |= u64::from(in_y.bitmask()) << at;
            self.left |= u64::from(packet.active().bitmask()) << at;
            put3(&mut self.origin, at, packet.origin);
            put3(&mut self.dir, at, packet.dir);
            put3(&mut self.inv, at, packet.inv);
            put(&mut self.tmin, at, packet.tmin);
            put(&mut self.hits.t, at, packet.tmax);
            put(&mut self.hits.prim, at, V::U32::splat(s, Hits::NONE));
            at += V::LANES;
        }
        // Lanes beyond the last ray are active nowhere, but their signs are any.
        self.left &= u64::MAX >> (LARGE - self.count.max(1));
    }

    /// Takes the rays that are in no class yet, of which each is to go [by itself](Chunk::alone).
    #[inline(always)]
    pub(crate) fn part<V: SimdF32>(&mut self, s: V::Simd) -> u64 {
        for g in 0..self.groups::<V>() {
            let at = g * V::LANES;
            let (origin, dir) = (get3(s, &self.origin, at), get3(s, &self.dir, at));
            let inv = get3(s, &self.inv, at);
            let packet: Packet<V> =
                Packet { origin, dir, inv, tmin: get(s, &self.tmin, at), tmax: dir.x };
            let [x, y, z] = packet.negative(s);
            let (shear, OwnAxes([in_x, in_y])) = packet.own_shear();
            let bit =
                |mask, bits| V::U32::select(mask, V::U32::splat(s, bits), V::U32::splat(s, 0));
            let axis = V::U32::splat(s, 2 << 3) ^ bit(in_x, 2 << 3) ^ bit(in_y, 3 << 3);
            put(&mut self.signs_and_axis, at, axis | bit(x, 1) | bit(y, 2) | bit(z, 4));
            put3(&mut self.shear, at, Vec3::new(shear.x, shear.y, shear.z));
        }
        std::mem::take(&mut self.left)
    }

    /// The number of registers that hold the rays.
    #[inline(always)]
    pub fn groups<V: SimdF32>(&self) -> usize {
        self.count.div_ceil(V::LANES)
    }

    /// Rays that go together and have not been returned yet.
    #[inline(always)]
    pub fn next_class(&mut self) -> Option<Class> {
        if self.left == 0 {
            return None;
        }
        let lead = self.left.trailing_zeros();
        let mut rays = self.left;
        let mut signs = [false; 5];
        let [x, y, z] = self.negative;
        let [in_x, in_y] = self.dominant;
        for (sign, those) in signs.iter_mut().zip([x, y, z, in_x, in_y]) {
            *sign = those >> lead & 1 == 1;
            rays &= if *sign { those } else { !those };
        }
        self.left &= !rays;
        let [x, y, z, in_x, in_y] = signs;
        let axes = SameAxis::new(match (in_x, in_y) {
            (true, _) => 0,
            (_, true) => 1,
            _ => 2,
        });
        Some(Class { rays, negative: [x, y, z], axes })
    }

    /// Whether the rays are of so many classes that few are of one.
    #[inline(always)]
    pub fn is_mixed(&mut self) -> bool {
        let all = self.left;
        let mut classes = 0;
        while classes < MIXED && self.next_class().is_some() {
            classes += 1;
        }
        let mixed = self.left != 0;
        self.left = all;
        mixed
    }

    /// One of the rays that are to go by themselves.
    #[inline(always)]
    pub(crate) fn alone(&self, ray: usize) -> Alone {
        let bits = self.signs_and_axis[ray % LARGE];
        self.alone_in(ray, bits & 7, SameAxis::new((bits >> 3) as usize))
    }

    #[inline(always)]
    fn alone_in(&self, ray: usize, octant: u32, axes: SameAxis) -> Alone {
        let ray = ray % LARGE;
        let of = |[x, y, z]: &[Column<f32>; 3]| [x[ray], y[ray], z[ray]];
        Alone {
            origin: of(&self.origin),
            inv: of(&self.inv),
            tmin: self.tmin[ray],
            octant,
            dir: of(&self.dir),
            axes,
            shear_origin: axes.order().map(|axis| self.origin[axis.min(2)][ray]),
            shear: of(&self.shear),
        }
    }

    /// What a ray has found.
    #[inline(always)]
    pub(crate) fn hit(&self, ray: usize) -> Hit {
        self.hits.get(ray)
    }

    /// Writes what all rays have found; ray `first` is the first.
    #[inline(always)]
    pub fn store(&self, hits: &mut Hits, first: usize) {
        let (rays, count) = (first..first + self.count, self.count);
        hits.t[rays.clone()].copy_from_slice(&self.hits.t[..count]);
        hits.u[rays.clone()].copy_from_slice(&self.hits.u[..count]);
        hits.v[rays.clone()].copy_from_slice(&self.hits.v[..count]);
        hits.prim[rays].copy_from_slice(&self.hits.prim[..count]);
    }

    /// Writes what all rays have found, each at its place.
    #[inline(always)]
    pub fn scatter(&self, hits: &mut Hits, places: &[u32]) {
        for (ray, &place) in places.iter().enumerate().take(self.count) {
            hits.set(place as usize, self.hits.get(ray));
        }
    }
}

impl Found {
    #[inline(always)]
    fn get(&self, ray: usize) -> Hit {
        let ray = ray % LARGE;
        Hit { t: self.t[ray], prim: self.prim[ray], u: self.u[ray], v: self.v[ray] }
    }
}

impl Class {
    /// A number for each class, from 0 to 23.
    #[inline(always)]
    pub(super) fn key(&self) -> usize {
        let [x, y, z] = self.negative.map(usize::from);
        let [_, _, axis] = self.axes.order();
        ((axis * 2 + x) * 2 + y) * 2 + z
    }
}

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
                let ([x, y, z], inv, shear) = (&chunk.origin, &chunk.inv_abs, &chunk.shear);
                let [origin_x, origin_y, origin_z] = [[x, y, z][kx], [x, y, z][ky], [x, y, z][kz]];
                let columns =
                    [origin_x, origin_y, origin_z, &inv[0], &inv[1], &inv[2], &shear[0], &shear[1]];
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

/// The lanes of those bits.
#[inline(always)]
fn lanes<V: SimdF32>(s: V::Simd, bits: u64) -> V::Mask {
    let own = V::U32::from_array(s, LaneArray::from_fn(bit));
    (V::U32::splat(s, bits as u32) & own).ne(V::U32::splat(s, 0))
}

#[inline(always)]
fn bit(i: usize) -> u32 {
    1 << i
}

// The mask tells the compiler that the lanes are within the column.

#[inline(always)]
fn get<L: Lanes>(s: L::Simd, column: &Column<L::Elem>, at: usize) -> L {
    L::load(s, &column[at & (LARGE - L::LANES)..])
}

#[inline(always)]
fn put<L: Lanes>(column: &mut Column<L::Elem>, at: usize, lanes: L) {
    lanes.store(&mut column[at & (LARGE - L::LANES)..]);
}

#[inline(always)]
fn get3<V: SimdF32>(s: V::Simd, [x, y, z]: &[Column<f32>; 3], at: usize) -> Vec3<V> {
    Vec3::new(get(s, x, at), get(s, y, at), get(s, z, at))
}

/// In the order of some axes.
#[inline(always)]
fn get_by<V: SimdF32>(
    s: V::Simd,
    columns: &[Column<f32>; 3],
    [x, y, z]: [usize; 3],
    at: usize,
) -> [V; 3] {
    [get(s, &columns[x], at), get(s, &columns[y], at), get(s, &columns[z], at)]
}

#[inline(always)]
fn put3<V: SimdF32>([x, y, z]: &mut [Column<f32>; 3], at: usize, v: Vec3<V>) {
    put(x, at, v.x);
    put(y, at, v.y);
    put(z, at, v.z);
}

#[inline(always)]
fn one3<B: SimdF32>(s: B::Simd, [x, y, z]: &[Column<f32>; 3], ray: usize) -> Vec3<B> {
    Vec3::splat(s, [x[ray], y[ray], z[ray]])
}
