//! A kernel for every level: written once, compiled for each, chosen when the program runs.
//!
//! `SIMD4_LEVEL=sse2 cargo run -p simd4 --example kernel` runs it as an older CPU would.

#![forbid(unsafe_code)]
#![allow(clippy::print_stdout, reason = "an example shows what it does")]

use simd4::math::Vec3;
use simd4::prelude::*;

/// Points by component.
struct Points {
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
}

/// The nearest point to `to` and its squared distance; the first of several.
#[inline(always)]
fn nearest<S: Simd>(s: S, points: &Points, to: [f32; 3]) -> Option<(usize, f32)> {
    let to = Vec3::<S::f32s>::splat(s, to);
    let mut best: Option<(usize, f32)> = None;
    for start in (0..points.x.len()).step_by(S::LANES) {
        let point = Vec3::new(
            from(s, &points.x, start),
            from(s, &points.y, start),
            from(s, &points.z, start),
        );
        let way = point - to;
        let squared = way.dot(way);
        let bound = match best {
            Some((_, squared)) => squared,
            None => f32::INFINITY,
        };
        let nearer = squared.lt(S::f32s::splat(s, bound));
        if let Some((lane, squared)) = squared.argmin(nearer) {
            best = Some((start + lane, squared));
        }
    }
    best
}

/// The components from `start` on; behind the last point lies infinity.
#[inline(always)]
fn from<S: Simd>(s: S, xs: &[f32], start: usize) -> S::f32s {
    S::f32s::load_prefix(s, &xs[start..], f32::INFINITY)
}

fn main() -> Result<(), simd4::LevelError> {
    let coordinate = |i: usize, k: usize| ((i * k) % 1009) as f32 / 1009.0;
    let axis = |k: usize| (0..100_003).map(|i| coordinate(i, k)).collect();
    let points = Points { x: axis(7), y: axis(31), z: axis(113) };

    let level = Level::best()?;
    let found = simd4::dispatch!(level, s => nearest(s, &points, [0.5, 0.25, 0.75]));
    println!("{level}: {found:?}");

    for level in Level::available() {
        let same = simd4::dispatch!(level, s => nearest(s, &points, [0.5, 0.25, 0.75]));
        assert_eq!(same, found, "{level}");
    }
    Ok(())
}
