//! Vectors of three components, one register a component.

use core::ops::{Add, Mul, Sub};

use crate::{Lanes, SimdF32};

/// As many 3-vectors as `V` has lanes, by component (SoA).
#[derive(Clone, Copy, Debug)]
pub struct Vec3<V> {
    /// First component.
    pub x: V,
    /// Second component.
    pub y: V,
    /// Third component.
    pub z: V,
}

impl<V: SimdF32> Vec3<V> {
    /// From its components.
    #[inline(always)]
    pub fn new(x: V, y: V, z: V) -> Self {
        Vec3 { x, y, z }
    }

    /// The same vector in every lane.
    #[inline(always)]
    pub fn splat(s: V::Simd, [x, y, z]: [f32; 3]) -> Self {
        Vec3 { x: V::splat(s, x), y: V::splat(s, y), z: V::splat(s, z) }
    }

    /// The scalar product, added in the order (x + y) + z.
    #[inline(always)]
    pub fn dot(self, other: Self) -> V {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The vector product; each component is a difference of two rounded products.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Vec3 {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// As [`Vec3::dot`], with each addition in one rounding or in two, whichever is faster.
    #[inline(always)]
    pub fn dot_fast(self, other: Self) -> V {
        self.z.mul_add_fast(other.z, self.y.mul_add_fast(other.y, self.x * other.x))
    }

    /// As [`Vec3::cross`], with each difference in one rounding or in two, whichever is faster.
    #[inline(always)]
    pub fn cross_fast(self, other: Self) -> Self {
        Vec3 {
            x: self.z.nmul_add_fast(other.y, self.y * other.z),
            y: self.x.nmul_add_fast(other.z, self.z * other.x),
            z: self.y.nmul_add_fast(other.x, self.x * other.y),
        }
    }

    /// The Euclidean length: the root of `self.dot(self)`, which overflows from about 2^63.5 on
    /// and vanishes below about 2^-75.
    #[inline(always)]
    pub fn length(self) -> V {
        self.dot(self).sqrt()
    }

    /// Divided by its length: by one exact division, `1 / length`, and three products. The zero
    /// vector gives NaN.
    #[inline(always)]
    pub fn normalize(self) -> Self {
        self * (V::splat(self.x.token(), 1.0) / self.length())
    }

    /// As [`Vec3::normalize`] with [`SimdF32::rsqrt_fast`].
    #[inline(always)]
    pub fn normalize_fast(self) -> Self {
        self * self.dot(self).rsqrt_fast()
    }

    /// `mask ? a : b`, lane by lane.
    #[inline(always)]
    pub fn select(mask: <V as Lanes>::Mask, a: Self, b: Self) -> Self {
        Vec3 {
            x: V::select(mask, a.x, b.x),
            y: V::select(mask, a.y, b.y),
            z: V::select(mask, a.z, b.z),
        }
    }
}

impl<V: SimdF32> Add for Vec3<V> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Vec3 { x: self.x + b.x, y: self.y + b.y, z: self.z + b.z }
    }
}

impl<V: SimdF32> Sub for Vec3<V> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Vec3 { x: self.x - b.x, y: self.y - b.y, z: self.z - b.z }
    }
}

/// Every component by the lane's own factor.
impl<V: SimdF32> Mul<V> for Vec3<V> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: V) -> Self {
        Vec3 { x: self.x * b, y: self.y * b, z: self.z * b }
    }
}
