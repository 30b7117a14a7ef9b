//! Determinants of differences of `f32` numbers, with a promised precision.
//!
//! First in `f64`, with a bound for the error; if that does not do, as the exact sum of all
//! products, kept as an [`Expansion`]. Three `f32` multiplied neither overflow nor vanish in `f64`.

use glam::{DVec3, Vec3};

use super::expansion::Expansion;

/// Half the distance from 1 to the next `f64`.
const ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// A row of the matrix: the first point minus the second.
pub(super) type Difference = [Vec3; 2];

/// The determinant of three rows, with a relative error of at most `precision`, which is no less
/// than 2^-48: so 0 and its sign are right.
pub(super) fn determinant(rows: [Difference; 3], precision: f64) -> f64 {
    let [a, b, c] = rows.map(|[p, q]| p.as_dvec3() - q.as_dvec3());
    let value = a.dot(b.cross(c));
    // No product has more than seven roundings: three differences, two products, and two of the
    // sums (one in the cross product, two in the dot product).
    let error = 16.0 * ROUNDOFF * permanent(a.abs(), b.abs(), c.abs());
    if error <= precision * value.abs() { value } else { exact(rows) }
}

/// The determinant with sums for differences.
fn permanent(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let cross = DVec3::new(b.y * c.z + b.z * c.y, b.z * c.x + b.x * c.z, b.x * c.y + b.y * c.x);
    a.dot(cross)
}

/// The determinant, multiplied out and added exactly, then rounded.
fn exact(rows: [Difference; 3]) -> f64 {
    let mut sum = Expansion::default();
    for choice in 0..8 {
        let row = |i: usize| rows[i][choice >> i & 1].to_array().map(f64::from);
        let (a, b, c) = (row(0), row(1), row(2));
        let sign = if choice.count_ones() % 2 == 0 { 1.0 } else { -1.0 };
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            // Of 48 bits: exact.
            sum.add_product(sign * a[i] * b[j], c[k]);
            sum.add_product(-sign * a[i] * b[k], c[j]);
        }
    }
    sum.value()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of 24 bits and of either sign, from a stream of their own.
    fn integers(seed: &mut u64) -> [[i128; 2]; 3] {
        [[(); 2]; 3].map(|pair| {
            pair.map(|()| {
                *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                i128::from((*seed >> 40) as u32) - (1 << 23)
            })
        })
    }

    /// Against integers, with rows that are all but linearly dependent.
    #[test]
    fn exact_is_exact() {
        let mut seed = 7;
        for round in 0..2_000 {
            let [x, y, z] = [(); 3].map(|()| integers(&mut seed));
            let mut points: [[[i128; 3]; 2]; 3] =
                std::array::from_fn(|i| std::array::from_fn(|j| [x[i][j], y[i][j], z[i][j]]));
            if round % 2 == 0 {
                // A row that is another one, but for the last place.
                points[2] = points[1];
                points[2][0][round / 2 % 3] += (round % 3) as i128 - 1;
            }
            let d: [[i128; 3]; 3] =
                std::array::from_fn(|i| std::array::from_fn(|k| points[i][0][k] - points[i][1][k]));
            let minor = |j: usize, k: usize| d[1][j] * d[2][k] - d[1][k] * d[2][j];
            let want = d[0][0] * minor(1, 2) + d[0][1] * minor(2, 0) + d[0][2] * minor(0, 1);
            let rows = points.map(|row| row.map(|p| Vec3::from_array(p.map(|x| x as f32))));
            for got in [exact(rows), determinant(rows, 1e-12)] {
                let error = (got - want as f64).abs();
                assert!(error <= 1e-12 * (want as f64).abs(), "{got} is not {want}: {points:?}");
            }
        }
    }

    /// Where products of three span nearly all of the range of `f64` exponents that there can be.
    #[test]
    fn no_number_is_too_large_or_too_small() {
        for size in [f32::MAX, f32::from_bits(1)] {
            let row = |k: usize| {
                let mut p = Vec3::ZERO;
                p[k] = size;
                [p, -p]
            };
            let want = 8.0 * f64::from(size).powi(3);
            assert_eq!(determinant([row(0), row(1), row(2)], 1e-12), want);
            assert_eq!(determinant([row(1), row(0), row(2)], 1e-12), -want);
            assert_eq!(exact([row(0), row(0), row(2)]), 0.0);
        }
    }
}
