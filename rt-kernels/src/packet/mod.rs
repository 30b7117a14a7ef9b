//! Rays in bulk: streams in memory, packets in registers.
//!
//! A [`Packet`] holds as many rays as a register has lanes. A [`Frame`] says how it looks at the
//! axes: [`Coherent`] if all rays agree, [`Mixed`] if not. A [`Query`] says what is asked of it:
//! the [`Closest`] hit, or [either](Either) that or whether there is any, also of a [`Single`] ray in
//! all lanes.

mod alone;
mod axes;
mod boxes;
mod buckets;
mod chunk;
mod column;
mod frame;
mod large;
mod query;
mod single;
mod stream;

pub use alone::Alone;
pub use axes::{Axes, OwnAxes, SameAxis};
pub use boxes::{Boxes, OwnBoxes};
pub use buckets::Buckets;
pub use chunk::{Chunk, Class};
pub use column::LARGE;
pub use frame::{Coherent, Frame, Mixed};
pub use large::{Beam, Bounds, GroupQuery, LargePacket, Reach};
pub use query::{Closest, Either, Query};
pub use single::{Ask, Single};
pub use stream::{Hits, Rays};

use simd4::math::Vec3;
use simd4::{SimdF32, SimdMask};

use crate::Ray;

/// Rays in lanes, with what all kernels derive from them.
///
/// A lane without a ray, or with one that [hits nothing](crate::Ray), has an empty interval:
/// nothing it is tested against can accept it.
#[derive(Clone, Copy, Debug)]
pub struct Packet<V> {
    /// Origins.
    pub origin: Vec3<V>,
    /// Directions.
    pub dir: Vec3<V>,
    /// The reciprocal of each component of the directions, exactly rounded; ±inf for ±0.
    pub inv: Vec3<V>,
    /// The least `t`; +inf in lanes that hit nothing.
    pub tmin: V,
    /// The greatest `t`, never +inf: nothing is hit there. −inf in lanes that hit nothing.
    pub tmax: V,
}

impl<V: SimdF32> Packet<V> {
    /// The rays from `first` on, as many as there are lanes; lanes beyond the last ray hit nothing.
    #[inline(always)]
    pub fn load(s: V::Simd, rays: &Rays, first: usize) -> Self {
        Packet::load_part(s, &rays.part(first, rays.len() - first), 0)
    }

    /// The same from these components of some rays, which are as many of each.
    #[inline(always)]
    pub(crate) fn load_part(s: V::Simd, components: &[&[f32]; 8], first: usize) -> Self {
        if components[0].len() - first >= V::LANES {
            Packet::load_with::<Whole>(s, components, first)
        } else {
            Packet::load_with::<Part>(s, components, first)
        }
    }

    #[inline(always)]
    fn load_with<L: Load>(s: V::Simd, components: &[&[f32]; 8], first: usize) -> Self {
        let [x, y, z, dx, dy, dz, tmin, tmax] = components;
        let origin = Vec3::new(L::load(s, x, first), L::load(s, y, first), L::load(s, z, first));
        let dir = Vec3::new(L::load(s, dx, first), L::load(s, dy, first), L::load(s, dz, first));
        Packet::new(s, origin, dir, L::load(s, tmin, first), L::load(s, tmax, first))
    }

    /// One ray in all lanes.
    #[inline(always)]
    pub fn splat(s: V::Simd, ray: &Ray) -> Self {
        let origin = Vec3::splat(s, ray.origin.to_array());
        let dir = Vec3::splat(s, ray.dir.to_array());
        Packet::new(s, origin, dir, V::splat(s, ray.tmin), V::splat(s, ray.tmax))
    }

    #[inline(always)]
    fn new(s: V::Simd, origin: Vec3<V>, dir: Vec3<V>, tmin: V, tmax: V) -> Self {
        let (zero, infinity) = (V::splat(s, 0.0), V::splat(s, f32::INFINITY));
        let moves = dir.x.ne(zero) | dir.y.ne(zero) | dir.z.ne(zero);
        let hits = finite(s, origin) & finite(s, dir) & moves & tmin.ge(zero) & tmin.le(tmax);

        let one = V::splat(s, 1.0);
        Packet {
            origin,
            dir,
            inv: Vec3::new(one / dir.x, one / dir.y, one / dir.z),
            tmin: hits.select(tmin, infinity),
            tmax: hits.select(tmax.min(V::splat(s, f32::MAX)), -infinity),
        }
    }

    /// The lanes that can hit something.
    #[inline(always)]
    pub fn active(&self) -> V::Mask {
        self.tmin.le(self.tmax)
    }
}

/// One component of the rays from `first` on.
trait Load {
    fn load<V: SimdF32>(s: V::Simd, component: &[f32], first: usize) -> V;
}

/// There are as many rays as lanes.
struct Whole;

/// There are fewer: NaN in the lanes beyond the last.
struct Part;

impl Load for Whole {
    #[inline(always)]
    fn load<V: SimdF32>(s: V::Simd, component: &[f32], first: usize) -> V {
        V::load(s, &component[first..])
    }
}

impl Load for Part {
    #[inline(always)]
    fn load<V: SimdF32>(s: V::Simd, component: &[f32], first: usize) -> V {
        V::load_prefix(s, &component[first..], f32::NAN)
    }
}

#[inline(always)]
fn finite<V: SimdF32>(s: V::Simd, v: Vec3<V>) -> V::Mask {
    // 0 times what is not finite is NaN.
    let zero = V::splat(s, 0.0);
    (v.x * zero + v.y * zero + v.z * zero).eq(zero)
}
