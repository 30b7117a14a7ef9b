//! What kernels are judged by.
//!
//! Oracles say what is exactly so: they share no code with the kernels, take the `f32` they are
//! given as exact numbers, and are as slow as that takes. [`aim`], [`mesh`] and [`random`] make what
//! kernels are shown.

pub mod aabb;
pub mod aim;
mod ball;
mod determinant;
mod expansion;
pub mod mesh;
pub mod quadric;
pub mod random;
pub mod triangle;

/// Half the distance from 1 to the next `f32`.
pub const ROUNDOFF: f64 = 1.0 / (1 << 24) as f64;

/// How far `value` is from `exact`, in units in the last place of the `f32` nearest to `exact`.
pub fn ulps(value: f32, exact: f64) -> f64 {
    let magnitude = (exact as f32).abs().max(f32::MIN_POSITIVE);
    let ulp = f64::from(magnitude.next_up()) - f64::from(magnitude);
    ((f64::from(value) - exact) / ulp).abs()
}
