//! What lanes are made of, and the arrays of them.

use core::array::TryFromSliceError;
use core::fmt::Debug;

use crate::simd::sealed::Sealed;

/// Does something for the number of every lane, in their order. Written out: a loop would first
/// have to be unrolled before arrays can be registers, and the compiler gets lost in kernels that
/// are made of thousands of them.
macro_rules! each_lane {
    ($lanes:expr, |$i:ident| $body:expr) => {{
        const { assert!($lanes <= 16, "a vector has at most sixteen lanes") };
        each_lane!(@ $lanes, $i, $body, 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15)
    }};
    (@ $lanes:expr, $i:ident, $body:expr, $($number:literal)*) => {{$(
        if $number < $lanes {
            let $i = $number;
            $body;
        }
    )*}};
}

/// An array of lanes, each from its number, without a closure.
macro_rules! lanes {
    ($lanes:expr, |$i:ident| $lane:expr) => {{
        // A constant: to repeat a value takes a loop, and every operation would have one.
        let mut lanes = const { [$crate::types::array::Lane::NOTHING; $lanes] };
        each_lane!($lanes, |$i| lanes[$i] = $lane);
        lanes
    }};
}

pub(crate) use {each_lane, lanes};

/// A number that fits in a lane of 32 bits.
pub trait Element: Lane + Default + PartialEq + PartialOrd + Debug + Sealed {
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
        impl Lane for $elem {
            const NOTHING: Self = 0 as $elem;
        }
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

/// What a lane holds: a number or truth.
pub trait Lane: Copy + Send + Sync + 'static {
    /// All bits 0.
    const NOTHING: Self;
}

impl Lane for bool {
    const NOTHING: bool = false;
}

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

impl<T: Lane, const N: usize> LaneArray<T> for [T; N] {
    #[inline(always)]
    fn from_fn(lane: impl Fn(usize) -> T) -> Self {
        lanes!(N, |i| lane(i))
    }
}
