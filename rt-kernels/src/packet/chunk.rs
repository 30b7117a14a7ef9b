//! Rays that are neighbours in a batch.

use simd4::math::Vec3;
use simd4::{Lanes, SimdF32, SimdMask};

use super::column::{Column, LARGE, get, get3, put, put3};
use super::{Alone, Hits, OwnAxes, Packet, Rays, SameAxis};
use crate::Hit;

/// More classes than so many are few rays a class.
const MIXED: usize = 4;

/// Up to [`LARGE`] rays of a batch by component (SoA), with what all kernels derive from them and
/// with what they find: registers of any size and single rays are loaded from it.
#[repr(C, align(64))]
pub struct Chunk {
    pub(super) origin: [Column<f32>; 3],
    pub(super) dir: [Column<f32>; 3],
    pub(super) inv: [Column<f32>; 3],
    pub(super) tmin: Column<f32>,
    /// With the dominant axis of the class that is traced as z, or with each ray's own, if they are to go
    /// [by themselves](Chunk::take_alone).
    pub(super) shear: [Column<f32>; 3],
    /// The magnitudes of the reciprocals, with the dominant axis of the class that is traced as z.
    pub(super) inv_abs: [Column<f32>; 3],
    pub(super) hits: Found,
    /// Of rays that are to go by themselves a bit for each axis on which the direction is negative, x lowest;
    /// above them the dominant axis.
    signs_and_axis: Column<u32>,
    /// The number of rays. (After the columns, which are aligned as they come.)
    count: usize,
    /// Rays with a negative direction, by axis.
    negative: [u64; 3],
    /// Rays whose dominant axis is x, and those where it is y.
    dominant: [u64; 2],
    /// The rays that are in no class yet.
    left: u64,
}

/// What the rays have found: nothing if the number is [`Hits::NONE`], and then `t` is the limit.
pub(super) struct Found {
    pub(super) t: Column<f32>,
    pub(super) u: Column<f32>,
    pub(super) v: Column<f32>,
    pub(super) prim: Column<u32>,
}

/// Rays that agree in the signs of their directions and in the dominant axis.
#[derive(Clone, Copy, Debug)]
pub struct Class {
    /// The rays: a bit for each.
    pub rays: u64,
    pub(super) negative: [bool; 3],
    pub(super) axes: SameAxis,
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
    }

    /// Takes the rays that are in no class yet, of which each is to go [by itself](Chunk::alone).
    #[inline(always)]
    pub(crate) fn take_alone<V: SimdF32>(&mut self, s: V::Simd) -> u64 {
        for g in 0..self.groups::<V>() {
            let at = g * V::LANES;
            let (origin, dir) = (get3(s, &self.origin, at), get3(s, &self.dir, at));
            let inv = get3(s, &self.inv, at);
            let packet: Packet<V> = Packet {
                origin,
                dir,
                inv,
                tmin: get(s, &self.tmin, at),
                tmax: get(s, &self.hits.t, at),
            };
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
    pub(super) fn alone_in(&self, ray: usize, octant: u32, axes: SameAxis) -> Alone {
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
