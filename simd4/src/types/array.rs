//! What lanes are made of, and the arrays of them.

use core::array::TryFromSliceError;
use core::fmt::Debug;

use crate::simd::sealed::Sealed;

/// A number that fits in a lane of 32 bits.
pub trait Element:
    Copy + Default + PartialEq + PartialOrd + Debug + Send + Sync + Sealed + 'static
{
    /// No number is less: −∞ for `f32`.
    const LEAST: Self;
    /// No number is greater: +∞ for `f32`.
    const GREATEST: Self;

    /// A lane's number as a value.
    fn from_index(lane: usize) -> Self;
}

macro_rules! element {
    ($elem:ty, $least:expr, $greatest:expr) => {
        impl Sealed for $elem {}
        impl Element for $elem {
            const LEAST: Self = $least;
            const GREATEST: Self = $greatest;
            #[inline(always)]
            fn from_index(lane: usize) -> Self {
                lane as $elem
            }
        }
    };
}

element!(f32, f32::NEG_INFINITY, f32::INFINITY);
element!(i32, i32::MIN, i32::MAX);
element!(u32, u32::MIN, u32::MAX);

/// All lanes of a vector, lane 0 first.
pub trait LaneArray<T>:
    Copy
    + AsRef<[T]>
    + AsMut<[T]>
    + for<'a> TryFrom<&'a [T], Error = TryFromSliceError>
    + Send
    + Sync
    + 'static
{
    /// Every lane from its number. Unlike [`core::array::from_fn`] it is always inlined, as code
    /// of a level has to be.
    fn from_fn(lane: impl Fn(usize) -> T) -> Self;
}

impl<T: Copy + Default + Send + Sync + 'static, const N: usize> LaneArray<T> for [T; N] {
    #[inline(always)]
    fn from_fn(lane: impl Fn(usize) -> T) -> Self {
        const { assert!(N <= 16, "a vector has at most sixteen lanes") };
        let mut a = [T::default(); N];
        // Written out: a loop would first have to be unrolled before the array can be registers.
        macro_rules! lanes {
            ($($i:literal)*) => {$(
                if $i < N {
                    a[$i] = lane($i);
                }
            )*};
        }
        lanes!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
        a
    }
}
