//! A ray that is kept while it is the turn of others.

use simd4::SimdF32;
use simd4::math::Vec3;

use super::frame::Shear;
use super::{Coherent, Packet, SameAxis};

/// One ray in plain numbers, with what all kernels derive from it.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Alone {
    pub(super) origin: [f32; 3],
    pub(super) inv: [f32; 3],
    pub(super) tmin: f32,
    /// A bit for each axis on which the direction is negative, x lowest.
    pub(super) octant: u32,
    pub(super) dir: [f32; 3],
    pub(super) axes: SameAxis,
    /// The origin with the dominant axis as its z, and the shear.
    pub(super) shear_origin: [f32; 3],
    pub(super) shear: [f32; 3],
}

impl Alone {
    /// A bit for each axis on which the direction is negative, x lowest.
    #[inline(always)]
    pub(crate) fn octant(&self) -> u32 {
        self.octant
    }

    /// In all lanes, up to `tmax`, and how it looks at the axes.
    #[inline(always)]
    pub(crate) fn packet<V: SimdF32>(&self, s: V::Simd, tmax: f32) -> (Packet<V>, Coherent<V>) {
        let packet = Packet {
            origin: Vec3::splat(s, self.origin),
            dir: Vec3::splat(s, self.dir),
            inv: Vec3::splat(s, self.inv),
            tmin: V::splat(s, self.tmin),
            tmax: V::splat(s, tmax),
        };
        let Vec3 { x, y, z } = Vec3::splat(s, self.shear);
        let shear = Shear { origin: Vec3::splat(s, self.shear_origin), x, y, z };
        (packet, Coherent::of_octant(self.octant, self.axes, shear))
    }
}
