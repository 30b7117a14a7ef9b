//! How a packet looks at the axes: which corner of a box is the nearer one, and which axis is
//! "forward".

use simd4::math::Vec3;
use simd4::{SimdF32, SimdMask};

use super::axes::{Axes, OwnAxes, SameAxis};
use super::{Boxes, Packet};
use crate::Ray;
use crate::tri::Records;

/// The signs and axes of a packet. Both kinds give the same bits; [`Coherent`] does it by
/// addressing, [`Mixed`] by selecting in every lane.
pub trait Frame<V: SimdF32> {
    /// The planes of a box that rays of this packet enter and leave by, on each axis: chosen by
    /// the sign bit of the direction.
    fn near_far<B: Boxes<V>>(&self, s: V::Simd, boxes: &B) -> (Vec3<V>, Vec3<V>);

    /// The points in that row of some records, seen from the rays' origins, with the dominant axis
    /// as z.
    fn relative<R: Records<V>>(&self, s: V::Simd, records: &R, row: usize) -> Vec3<V>;

    /// The shear that turns the rays into the z axis.
    fn shear(&self) -> &Shear<V>;
}

/// The shear of Woop, Benthin and Wald 2013: after it, a ray runs from 0 along z, at unit speed.
#[derive(Clone, Copy, Debug)]
pub struct Shear<V> {
    /// The origin, with the dominant axis as its z.
    pub(super) origin: Vec3<V>,
    /// What to subtract from x for each z.
    pub x: V,
    /// What to subtract from y for each z.
    pub y: V,
    /// `t` for each z.
    pub z: V,
}

impl<V: SimdF32> Shear<V> {
    /// From a packet's origins, directions and reciprocals, all with the dominant axis as their z.
    #[inline(always)]
    fn new(origin: Vec3<V>, dir: Vec3<V>, inv: Vec3<V>) -> Self {
        Shear { origin, x: dir.x / dir.z, y: dir.y / dir.z, z: inv.z }
    }
}

/// All rays of the packet agree in the signs of their directions and in the dominant axis.
#[derive(Clone, Copy, Debug)]
pub struct Coherent<V> {
    /// For each axis, which side of a box is the nearer one.
    near: [usize; 3],
    /// And which is the farther one.
    far: [usize; 3],
    axes: SameAxis,
    shear: Shear<V>,
}

/// The rays differ.
#[derive(Clone, Copy, Debug)]
pub struct Mixed<V: SimdF32> {
    /// Lanes with a negative direction, by axis.
    negative: [V::Mask; 3],
    /// The dominant axis of each lane.
    axes: OwnAxes<V::Mask>,
    shear: Shear<V>,
}

impl<V: SimdF32> Packet<V> {
    /// The packet's frame: coherent, if all active lanes agree.
    #[inline(always)]
    pub fn frame(&self, s: V::Simd) -> Result<Coherent<V>, Mixed<V>> {
        let [x, y, z] = self.negative(s);
        let OwnAxes([in_x, in_y]) = self.dominant();
        let active = self.active();
        let near = (agreed(x, active), agreed(y, active), agreed(z, active));
        let axes = (agreed(in_x, active), agreed(in_y, active));
        if let ((Some(x), Some(y), Some(z)), (Some(in_x), Some(in_y))) = (near, axes) {
            let axes = SameAxis::new(match (in_x, in_y) {
                (true, _) => 0,
                (_, true) => 1,
                _ => 2,
            });
            return Ok(Coherent::new([x, y, z], axes, self.shear(axes)));
        }
        Err(self.mixed(s))
    }

    /// The frame that fits any packet.
    #[inline(always)]
    pub fn mixed(&self, s: V::Simd) -> Mixed<V> {
        let (shear, axes) = self.own_shear();
        Mixed { negative: self.negative(s), axes, shear }
    }

    /// The shear of each lane, and its dominant axis.
    #[inline(always)]
    pub(super) fn own_shear(&self) -> (Shear<V>, OwnAxes<V::Mask>) {
        let axes = self.dominant();
        (self.shear(axes), axes)
    }

    /// By the reciprocal: −0 has the sign of −inf there, and a comparison sees it.
    #[inline(always)]
    pub(super) fn negative(&self, s: V::Simd) -> [V::Mask; 3] {
        let zero = V::splat(s, 0.0);
        [self.inv.x.lt(zero), self.inv.y.lt(zero), self.inv.z.lt(zero)]
    }

    #[inline(always)]
    pub(super) fn dominant(&self) -> OwnAxes<V::Mask> {
        let (x, y, z) = (self.dir.x.abs(), self.dir.y.abs(), self.dir.z.abs());
        let in_x = x.ge(y) & x.ge(z);
        OwnAxes([in_x, y.ge(z) & !in_x])
    }

    #[inline(always)]
    fn shear<A: Axes<V>>(&self, axes: A) -> Shear<V> {
        Shear::new(axes.last(self.origin), axes.last(self.dir), axes.last(self.inv))
    }
}

impl<V: SimdF32> Coherent<V> {
    /// Of one ray in all lanes. Without branches, which would be guesses.
    #[inline(always)]
    pub fn of_one(s: V::Simd, ray: &Ray) -> Self {
        let (origin, dir) = (ray.origin.to_array(), ray.dir.to_array());
        let [x, y, z] = dir.map(f32::abs);
        let in_x = (x >= y) & (x >= z);
        let in_y = (y >= z) & !in_x;
        let axes = SameAxis::new(2 - 2 * usize::from(in_x) - usize::from(in_y));
        let [kx, ky, kz] = axes.order();
        let shear = Shear {
            origin: Vec3::splat(s, [origin[kx], origin[ky], origin[kz]]),
            x: V::splat(s, dir[kx] / dir[kz]),
            y: V::splat(s, dir[ky] / dir[kz]),
            z: V::splat(s, 1.0 / dir[kz]),
        };
        Coherent::new(dir.map(f32::is_sign_negative), axes, shear)
    }

    /// Of rays into an octant: a bit for each axis on which the direction is negative, x lowest.
    #[inline(always)]
    pub(super) fn of_octant(octant: u32, axes: SameAxis, shear: Shear<V>) -> Self {
        let near = [0, 1, 2].map(|axis| (octant >> axis & 1) as usize);
        Coherent { near, far: near.map(|side| side ^ 1), axes, shear }
    }

    /// Of rays with these signs of their directions.
    #[inline(always)]
    pub(super) fn new([x, y, z]: [bool; 3], axes: SameAxis, shear: Shear<V>) -> Self {
        let near = [x.into(), y.into(), z.into()];
        let far = [(!x).into(), (!y).into(), (!z).into()];
        Coherent { near, far, axes, shear }
    }
}

/// What all active lanes agree in.
#[inline(always)]
fn agreed<M: SimdMask>(mask: M, active: M) -> Option<bool> {
    match (mask & active).bitmask() {
        0 => Some(false),
        // One lane agrees with itself: known when it is compiled, there is no other case.
        lanes => (M::LANES == 1 || lanes == active.bitmask()).then_some(true),
    }
}

impl<V: SimdF32> Frame<V> for Coherent<V> {
    #[inline(always)]
    fn near_far<B: Boxes<V>>(&self, s: V::Simd, boxes: &B) -> (Vec3<V>, Vec3<V>) {
        let ([nx, ny, nz], [fx, fy, fz]) = (self.near, self.far);
        let near = Vec3::new(boxes.side(s, 0, nx), boxes.side(s, 1, ny), boxes.side(s, 2, nz));
        let far = Vec3::new(boxes.side(s, 0, fx), boxes.side(s, 1, fy), boxes.side(s, 2, fz));
        (near, far)
    }

    #[inline(always)]
    fn relative<R: Records<V>>(&self, s: V::Simd, records: &R, row: usize) -> Vec3<V> {
        let [kx, ky, kz] = self.axes.order();
        let point =
            Vec3::new(records.get(s, row, kx), records.get(s, row, ky), records.get(s, row, kz));
        point - self.shear.origin
    }

    #[inline(always)]
    fn shear(&self) -> &Shear<V> {
        &self.shear
    }
}

impl<V: SimdF32> Frame<V> for Mixed<V> {
    #[inline(always)]
    fn near_far<B: Boxes<V>>(&self, s: V::Simd, boxes: &B) -> (Vec3<V>, Vec3<V>) {
        let low = Vec3::new(boxes.side(s, 0, 0), boxes.side(s, 1, 0), boxes.side(s, 2, 0));
        let high = Vec3::new(boxes.side(s, 0, 1), boxes.side(s, 1, 1), boxes.side(s, 2, 1));
        let [x, y, z] = self.negative;
        let near =
            Vec3::new(x.select(high.x, low.x), y.select(high.y, low.y), z.select(high.z, low.z));
        let far =
            Vec3::new(x.select(low.x, high.x), y.select(low.y, high.y), z.select(low.z, high.z));
        (near, far)
    }

    #[inline(always)]
    fn relative<R: Records<V>>(&self, s: V::Simd, records: &R, row: usize) -> Vec3<V> {
        self.axes.last(records.vec3(s, row)) - self.shear.origin
    }

    #[inline(always)]
    fn shear(&self) -> &Shear<V> {
        &self.shear
    }
}
