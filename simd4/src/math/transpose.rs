//! Rows to columns.

use crate::Lanes;

/// The columns of four rows of four lanes, by eight moves of two registers each.
///
/// ```
/// use simd4::{f32x4, math, prelude::*};
///
/// let rows = [0.0, 4.0, 8.0, 12.0].map(|x| f32x4::from([x, x + 1.0, x + 2.0, x + 3.0]));
/// let columns = math::transpose(rows);
/// assert_eq!(columns[1].to_array(), [1.0, 5.0, 9.0, 13.0]);
/// ```
#[inline(always)]
pub fn transpose<V: Lanes>([a, b, c, d]: [V; 4]) -> [V; 4] {
    const { assert!(V::LANES == 4, "four rows are transposed of four lanes each") };
    let (ac, bd) = (a.zip(c), b.zip(d));
    let (low, high) = (ac.0.zip(bd.0), ac.1.zip(bd.1));
    [low.0, low.1, high.0, high.1]
}
