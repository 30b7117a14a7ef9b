//! One kernel on every level of this CPU, side by side with the scalar level.
//!
//! What this crate promises of its operations, a user's kernel built of them has too, unless it
//! uses what ends in `_est` or `_fast`, or depends on the number of lanes. These three lines in a
//! test show it:
//!
//! ```
//! use simd4::{check, dispatch, prelude::*};
//!
//! /// The sum of squares, in one order whatever the width: four partial sums.
//! #[inline(always)]
//! fn sum_of_squares<S: Simd>(s: S, xs: &[f32]) -> f32 {
//!     let mut sums = S::f32x4::splat(s, 0.0);
//!     for chunk in xs.chunks(4) {
//!         let x = S::f32x4::load_prefix(s, chunk, 0.0);
//!         sums += x * x;
//!     }
//!     sums.reduce_sum()
//! }
//!
//! let xs: Vec<f32> = (0..1001).map(|i| 1.0 / i as f32).collect();
//! check::levels_agree(|level| {
//!     dispatch!(level, s => sum_of_squares(s, &xs))
//! });
//! ```

use core::fmt::Debug;

use crate::Level;

/// Runs a kernel on every [available](Level::available) level and compares what it returns with
/// what it returns on the scalar level: bit for bit, but for NaNs, which are all the same.
///
/// # Panics
/// If a level's answer differs, with the level and the first difference.
#[track_caller]
pub fn levels_agree<T: SameBits>(mut kernel: impl FnMut(Level) -> T) {
    let mut levels = Level::available();
    let scalar = levels.next().map(&mut kernel).expect("scalar is always there");
    for level in levels {
        if let Some(difference) = kernel(level).difference(&scalar) {
            panic!("{level} and scalar differ{difference}");
        }
    }
}

/// Values that are compared by their bits.
pub trait SameBits {
    /// Where two values differ first, and how; nothing if they are the same.
    fn difference(&self, other: &Self) -> Option<String>;

    /// Whether two values are the same.
    fn same_bits(&self, other: &Self) -> bool {
        self.difference(other).is_none()
    }
}

impl SameBits for f32 {
    fn difference(&self, other: &f32) -> Option<String> {
        let same = self.to_bits() == other.to_bits() || self.is_nan() && other.is_nan();
        let bits = |x: &f32| format!("{x:?} ({:#010x})", x.to_bits());
        (!same).then(|| format!(": {}, not {}", bits(self), bits(other)))
    }
}

macro_rules! same_if_equal {
    ($($ty:ty),*) => {$(
        impl SameBits for $ty {
            fn difference(&self, other: &$ty) -> Option<String> {
                (self != other).then(|| format!(": {self:?}, not {other:?}"))
            }
        }
    )*};
}

same_if_equal!(bool, u8, i32, u32, u64, usize, ());

impl<T: SameBits> SameBits for [T] {
    fn difference(&self, other: &[T]) -> Option<String> {
        if self.len() != other.len() {
            return Some(format!(": {} elements, not {}", self.len(), other.len()));
        }
        self.iter().zip(other).enumerate().find_map(|(i, (a, b))| {
            a.difference(b).map(|difference| format!(" at [{i}]{difference}"))
        })
    }
}

impl<T: SameBits, const N: usize> SameBits for [T; N] {
    fn difference(&self, other: &[T; N]) -> Option<String> {
        self[..].difference(&other[..])
    }
}

impl<T: SameBits> SameBits for Vec<T> {
    fn difference(&self, other: &Vec<T>) -> Option<String> {
        self[..].difference(&other[..])
    }
}

impl<T: SameBits + Debug> SameBits for Option<T> {
    fn difference(&self, other: &Option<T>) -> Option<String> {
        match (self, other) {
            (Some(a), Some(b)) => a.difference(b),
            (None, None) => None,
            _ => Some(format!(": {self:?}, not {other:?}")),
        }
    }
}

impl<A: SameBits, B: SameBits> SameBits for (A, B) {
    fn difference(&self, other: &(A, B)) -> Option<String> {
        let of = |i, difference: Option<String>| difference.map(|d| format!(" at .{i}{d}"));
        of(0, self.0.difference(&other.0)).or_else(|| of(1, self.1.difference(&other.1)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_say_where() {
        let (a, b) = (vec![(1.0f32, 2u32), (3.0, 4)], vec![(1.0f32, 2u32), (3.0, 5)]);
        assert_eq!(a.difference(&b).unwrap(), " at [1] at .1: 4, not 5");
        assert_eq!(0.0f32.difference(&-0.0).unwrap(), ": 0.0 (0x00000000), not -0.0 (0x80000000)");
        assert!(f32::NAN.same_bits(&-f32::NAN));
        assert!(a.same_bits(&a.clone()));
        assert_eq!([1u32; 3][..].difference(&[1; 2]).unwrap(), ": 3 elements, not 2");
        assert_eq!(Some(1u32).difference(&None).unwrap(), ": Some(1), not None");
    }

    #[test]
    #[cfg_attr(not(panic = "unwind"), ignore = "without unwinding there is nothing to catch")]
    fn a_kernel_that_knows_its_level_is_caught() {
        if Level::available().count() == 1 {
            return;
        }
        let caught =
            std::panic::catch_unwind(|| levels_agree(|level| u32::from(level.name() == "scalar")));
        let message = *caught.expect_err("names differ").downcast::<String>().unwrap();
        assert!(message.contains(" and scalar differ: "), "{message}");
    }
}
