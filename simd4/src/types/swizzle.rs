//! Orders of lanes that are known when compiling.

/// An order of lanes, for [`Lanes::swizzle`](crate::Lanes::swizzle).
pub trait Swizzle {
    /// For each lane of the result the lane that it comes from; as many as the vector has. An
    /// order that does not fit the vector does not compile.
    const INDEX: &'static [usize];
}

/// Lanes in an order that stands in place: `swizzle!(v, [2, 1, 0, 3])`.
///
/// ```
/// use simd4::{f32x4, prelude::*, swizzle};
///
/// let v = f32x4::from([1.0, 2.0, 3.0, 4.0]);
/// assert_eq!(swizzle!(v, [2, 1, 0, 0]).to_array(), [3.0, 2.0, 1.0, 1.0]);
/// ```
///
/// An index that the vector lacks is an error of the compiler:
///
/// ```compile_fail
/// use simd4::{f32x4, prelude::*, swizzle};
///
/// swizzle!(f32x4::from(1.0), [0, 1, 2, 4]);
/// ```
#[macro_export]
macro_rules! swizzle {
    ($v:expr, $index:expr) => {{
        struct Order;
        impl $crate::Swizzle for Order {
            const INDEX: &'static [usize] = &$index;
        }
        $crate::Lanes::swizzle::<Order>($v)
    }};
}

/// Stops the compiler at an order that does not fit.
pub(super) const fn check(index: &[usize], lanes: usize) {
    assert!(index.len() == lanes, "a swizzle names as many lanes as the vector has");
    let mut i = 0;
    while i < lanes {
        assert!(index[i] < lanes, "a swizzle names a lane that the vector lacks");
        i += 1;
    }
}
