//! Which axis is "forward".

use simd4::math::Vec3;
use simd4::{Lanes, SimdF32, SimdMask};

/// A choice of one axis, in all lanes or lane by lane. It goes last, as z, and the other two before
/// it in cyclic order.
pub trait Axes<V: SimdF32>: Copy {
    /// A vector with the chosen axis as its z.
    fn last(self, v: Vec3<V>) -> Vec3<V>;
}

/// The same axis in all lanes.
#[derive(Clone, Copy, Debug)]
pub struct SameAxis([usize; 3]);

/// The axes in the order that puts each last; a fourth for whoever masks instead of comparing.
const ORDERS: [[usize; 3]; 4] = [[1, 2, 0], [2, 0, 1], [0, 1, 2], [0, 1, 2]];

impl SameAxis {
    /// Puts that axis, 0 to 2, last.
    #[inline(always)]
    pub fn new(last: usize) -> Self {
        SameAxis(ORDERS[last % 4])
    }

    /// The axes that become x, y and z.
    #[inline(always)]
    pub(crate) fn order(self) -> [usize; 3] {
        self.0
    }
}

impl Default for SameAxis {
    /// z.
    fn default() -> Self {
        SameAxis::new(2)
    }
}

impl<V: SimdF32> Axes<V> for SameAxis {
    #[inline(always)]
    fn last(self, v: Vec3<V>) -> Vec3<V> {
        match self.0[2] {
            0 => Vec3::new(v.y, v.z, v.x),
            1 => Vec3::new(v.z, v.x, v.y),
            _ => v,
        }
    }
}

/// An axis for each lane: those whose axis is x, and those where it is y.
#[derive(Clone, Copy, Debug)]
pub struct OwnAxes<M>(pub(crate) [M; 2]);

impl<V: SimdF32> Axes<V> for OwnAxes<<V as Lanes>::Mask> {
    #[inline(always)]
    fn last(self, v: Vec3<V>) -> Vec3<V> {
        let [x, y] = self.0;
        Vec3::new(
            x.select(v.y, y.select(v.z, v.x)),
            x.select(v.z, y.select(v.x, v.y)),
            x.select(v.x, y.select(v.y, v.z)),
        )
    }
}
