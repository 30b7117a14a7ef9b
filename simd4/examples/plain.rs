//! Lanes without levels or tokens: the types at the root are the best that the build guarantees.

#![allow(clippy::print_stdout, reason = "an example shows what it does")]

use simd4::{f32x4, prelude::*};

/// The real roots of `a x² + b x + c`, four equations at once; NaN where there are none.
fn roots(a: f32x4, b: f32x4, c: f32x4) -> (f32x4, f32x4) {
    let root = (b * b - a * c * f32x4::from(4.0)).sqrt();
    // Of the two sums that could cancel, take the one that does not.
    let q = (b + root.copysign(b)) * f32x4::from(-0.5);
    (q / a, c / q)
}

fn main() {
    let a = f32x4::from([1.0, 1.0, 2.0, 1.0]);
    let b = f32x4::from([-3.0, 2.0, -7.0, 1.0]);
    let c = f32x4::from([2.0, 1.0, 3.0, 1.0]);
    let (x1, x2) = roots(a, b, c);
    println!("{x1:?}\n{x2:?}");
    assert_eq!(x1.to_array()[..3], [2.0, -1.0, 3.0]);
    assert_eq!(x2.to_array()[..3], [1.0, -1.0, 0.5]);
    assert!(x1.ne(x1).first() == Some(3), "the last has no real roots");
}
