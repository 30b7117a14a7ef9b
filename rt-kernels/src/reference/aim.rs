//! Rays that are aimed at something.

use crate::Ray;
use glam::Vec3;

use super::random::power;

/// The ray from `origin` through `target`, which it reaches at a `t` of 1.
pub fn at(origin: Vec3, target: Vec3) -> Ray {
    Ray::new(origin, target - origin)
}

/// The point that divides `a` to `b` at `s`, rounded once.
pub fn between(a: Vec3, b: Vec3, s: f64) -> Vec3 {
    a.as_dvec3().lerp(b.as_dvec3(), s).as_vec3()
}

/// The same ray at another pace: the greatest component of its direction is brought between 2 to
/// `exponent` and twice that, by an exact power of two. (0 stays 0.)
pub fn paced(ray: Ray, exponent: i32) -> Ray {
    let greatest = ray.dir.abs().max_element();
    let now = (greatest.to_bits() >> 23) as i32 - 127;
    // In two steps: one factor alone might be out of range.
    Ray { dir: ray.dir * power(-now) * power(exponent), ..ray }
}
