//! How a packet looks at the axes: which corner of a box is the nearer one, and which axis is
//! "forward".

use simd4::math::Vec3;
use simd4::{SimdF32, SimdMask};

use super::Packet;
use crate::geom::Aabb;

/// The signs and axes of a packet. Both kinds give the same bits; [`Coherent`] does it by
/// addressing, [`Mixed`] by selecting in every lane.
pub trait Frame<V: SimdF32> {
    /// The planes of a box that rays of this packet enter and leave by, on each axis: chosen by
    /// the sign bit of the direction.
    fn near_far(&self, s: V::Simd, aabb: &Aabb) -> (Vec3<V>, Vec3<V>);

    /// A point, seen from the rays' origins, with the dominant axis as its z.
    fn relative(&self, s: V::Simd, point: &[f32; 3]) -> Vec3<V>;

    /// The shear that turns the rays into the z axis.
    fn shear(&self) -> &Shear<V>;
}

/// The shear of Woop, Benthin and Wald 2013: after it, a ray runs from 0 along z, at unit speed.
#[derive(Clone, Copy, Debug)]
pub struct Shear<V> {
    /// The origin, with the dominant axis as its z.
    origin: Vec3<V>,
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
    axes: [usize; 3],
    shear: Shear<V>,
}

/// The rays differ.
#[derive(Clone, Copy, Debug)]
pub struct Mixed<V: SimdF32> {
    /// Lanes with a negative direction, by axis.
    negative: [V::Mask; 3],
    /// Lanes whose dominant axis is x, and those where it is y.
    dominant: [V::Mask; 2],
    shear: Shear<V>,
}

impl<V: SimdF32> Packet<V> {
    /// The packet's frame: coherent, if all active lanes agree.
    #[inline(always)]
    pub fn frame(&self, s: V::Simd) -> Result<Coherent<V>, Mixed<V>> {
        let zero = V::splat(s, 0.0);
        // By the reciprocal: −0 has the sign of −inf there, and a comparison sees it.
        let negative = [self.inv.x.lt(zero), self.inv.y.lt(zero), self.inv.z.lt(zero)];
        let (x, y, z) = (self.dir.x.abs(), self.dir.y.abs(), self.dir.z.abs());
        let dominant_x = x.ge(y) & x.ge(z);
        let dominant = [dominant_x, y.ge(z) & !dominant_x];

        let active = self.active();
        let near =
            (agreed(negative[0], active), agreed(negative[1], active), agreed(negative[2], active));
        let axes = (agreed(dominant[0], active), agreed(dominant[1], active));
        if let ((Some(x), Some(y), Some(z)), (Some(in_x), Some(in_y))) = (near, axes) {
            let axes = match (in_x, in_y) {
                (true, _) => [1, 2, 0],
                (_, true) => [2, 0, 1],
                _ => [0, 1, 2],
            };
            let (origin, dir) = (reorder(axes, self.origin), reorder(axes, self.dir));
            let shear = Shear::new(origin, dir, reorder(axes, self.inv));
            let near = [x.into(), y.into(), z.into()];
            let far = [(!x).into(), (!y).into(), (!z).into()];
            return Ok(Coherent { near, far, axes, shear });
        }
        let (origin, dir) = (permute(dominant, self.origin), permute(dominant, self.dir));
        let shear = Shear::new(origin, dir, permute(dominant, self.inv));
        Err(Mixed { negative, dominant, shear })
    }
}

/// What all active lanes agree in.
#[inline(always)]
fn agreed<M: SimdMask>(mask: M, active: M) -> Option<bool> {
    match (mask & active).bitmask() {
        0 => Some(false),
        lanes => (lanes == active.bitmask()).then_some(true),
    }
}

/// Puts the same dominant axis last in all lanes, and the others in cyclic order before it.
#[inline(always)]
fn reorder<V: SimdF32>([kx, ky, kz]: [usize; 3], v: Vec3<V>) -> Vec3<V> {
    let v = [v.x, v.y, v.z];
    Vec3::new(v[kx], v[ky], v[kz])
}

/// Puts each lane's own dominant axis last.
#[inline(always)]
fn permute<V: SimdF32>([x, y]: [V::Mask; 2], v: Vec3<V>) -> Vec3<V> {
    Vec3::new(
        x.select(v.y, y.select(v.z, v.x)),
        x.select(v.z, y.select(v.x, v.y)),
        x.select(v.x, y.select(v.y, v.z)),
    )
}

impl<V: SimdF32> Frame<V> for Coherent<V> {
    #[inline(always)]
    fn near_far(&self, s: V::Simd, aabb: &Aabb) -> (Vec3<V>, Vec3<V>) {
        let ([nx, ny, nz], [fx, fy, fz]) = (self.near, self.far);
        // The masks tell the compiler that there are but two sides.
        let [x, y, z] = &aabb.axes;
        let near = [x[nx & 1], y[ny & 1], z[nz & 1]];
        let far = [x[fx & 1], y[fy & 1], z[fz & 1]];
        (Vec3::splat(s, near), Vec3::splat(s, far))
    }

    #[inline(always)]
    fn relative(&self, s: V::Simd, point: &[f32; 3]) -> Vec3<V> {
        let [kx, ky, kz] = self.axes;
        Vec3::splat(s, [point[kx % 3], point[ky % 3], point[kz % 3]]) - self.shear.origin
    }

    #[inline(always)]
    fn shear(&self) -> &Shear<V> {
        &self.shear
    }
}

impl<V: SimdF32> Frame<V> for Mixed<V> {
    #[inline(always)]
    fn near_far(&self, s: V::Simd, aabb: &Aabb) -> (Vec3<V>, Vec3<V>) {
        let [[x0, x1], [y0, y1], [z0, z1]] = aabb.axes;
        let (low, high) = (Vec3::splat(s, [x0, y0, z0]), Vec3::splat(s, [x1, y1, z1]));
        let [x, y, z] = self.negative;
        let near =
            Vec3::new(x.select(high.x, low.x), y.select(high.y, low.y), z.select(high.z, low.z));
        let far =
            Vec3::new(x.select(low.x, high.x), y.select(low.y, high.y), z.select(low.z, high.z));
        (near, far)
    }

    #[inline(always)]
    fn relative(&self, s: V::Simd, point: &[f32; 3]) -> Vec3<V> {
        permute(self.dominant, Vec3::splat(s, *point)) - self.shear.origin
    }

    #[inline(always)]
    fn shear(&self) -> &Shear<V> {
        &self.shear
    }
}
