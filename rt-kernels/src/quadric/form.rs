//! What the methods need to know of a surface: its quadratic form and where it ends.

use simd4::math::Vec3;
use simd4::{SimdF32, SimdMask};

use super::record::{Record, Records};
use crate::geom::{Curved, Quadric};
use crate::packet::Packet;
use crate::tri::knobs::Rounding;

/// Rays and surfaces as one form sees them, and the equation a t² − 2 b t + c = 0 of each pair.
#[derive(Clone, Copy, Debug)]
pub struct Seen<V> {
    /// From the ray's origin to the point that the surface is stated about.
    pub to_center: Vec3<V>,
    /// The square of the direction, by the form.
    pub a: V,
    /// Half of the linear coefficient, negated.
    pub b: V,
    /// What the form says of the ray's origin: 0 on the surface.
    pub c: V,
}

impl<V: SimdF32> Seen<V> {
    /// a, b and c.
    #[inline(always)]
    pub(super) fn equation(&self) -> [V; 3] {
        [self.a, self.b, self.c]
    }
}

/// How a surface is stated.
pub trait Form: Send + Sync + 'static {
    /// In words.
    const NAME: &'static str;
    /// Whether `a` is greater than zero, whatever the direction.
    const DEFINITE: bool;

    /// The numbers of a surface: `None` if it cannot be stated so.
    fn record(surface: &Curved, prim: u32) -> Option<Record>;

    /// The equation.
    fn see<A: Rounding, V: SimdF32, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
    ) -> Seen<V>;

    /// How deep inside the surface the point is from which `p` leads to what it is stated about:
    /// the form, negated.
    fn depth<A: Rounding, V: SimdF32, R: Records<V>>(s: V::Simd, records: &R, p: Vec3<V>) -> V;

    /// Whether the point at `t` is where the surface is not cut off.
    fn keeps<V: SimdF32, R: Records<V>>(
        s: V::Simd,
        records: &R,
        seen: &Seen<V>,
        packet: &Packet<V>,
        t: V,
    ) -> V::Mask;
}

/// A sphere by its centre and radius.
#[derive(Clone, Copy, Debug)]
pub struct Ball;

impl Form for Ball {
    const NAME: &'static str = "sphere";
    const DEFINITE: bool = true;

    fn record(surface: &Curved, prim: u32) -> Option<Record> {
        let Curved::Sphere(sphere) = *surface else { return None };
        Some(Record::sphere(&sphere, prim))
    }

    #[inline(always)]
    fn see<A: Rounding, V: SimdF32, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
    ) -> Seen<V> {
        see_ball::<A, V>(records.center(s), records.size(s), packet)
    }

    #[inline(always)]
    fn depth<A: Rounding, V: SimdF32, R: Records<V>>(s: V::Simd, records: &R, p: Vec3<V>) -> V {
        depth_in_ball::<A, V>(records.size(s), p)
    }

    #[inline(always)]
    fn keeps<V: SimdF32, R: Records<V>>(
        s: V::Simd,
        _: &R,
        _: &Seen<V>,
        _: &Packet<V>,
        _: V,
    ) -> V::Mask {
        V::Mask::splat(s, true)
    }
}

/// The equation of a sphere.
#[inline(always)]
pub(super) fn see_ball<A: Rounding, V: SimdF32>(
    center: Vec3<V>,
    radius: V,
    packet: &Packet<V>,
) -> Seen<V> {
    let to_center = center - packet.origin;
    Seen {
        to_center,
        a: A::dot(packet.dir, packet.dir),
        b: A::dot(to_center, packet.dir),
        c: A::dot(to_center, to_center) - radius * radius,
    }
}

/// The square of the radius, less that of the distance from the centre.
#[inline(always)]
pub(super) fn depth_in_ball<A: Rounding, V: SimdF32>(radius: V, p: Vec3<V>) -> V {
    radius * radius - A::dot(p, p)
}

/// Any quadric, about its centre.
#[derive(Clone, Copy, Debug)]
pub struct Central;

impl Form for Central {
    const NAME: &'static str = "quadric";
    const DEFINITE: bool = false;

    fn record(surface: &Curved, prim: u32) -> Option<Record> {
        Some(Record::central(&quadric(surface)?, prim))
    }

    #[inline(always)]
    fn see<A: Rounding, V: SimdF32, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
    ) -> Seen<V> {
        let to_center = records.center(s) - packet.origin;
        let turned_dir = turned::<A, V, R>(s, records, packet.dir);
        let turned_center = turned::<A, V, R>(s, records, to_center);
        Seen {
            to_center,
            a: A::dot(packet.dir, turned_dir),
            b: A::dot(to_center, turned_dir),
            c: A::dot(to_center, turned_center) - records.size(s),
        }
    }

    #[inline(always)]
    fn depth<A: Rounding, V: SimdF32, R: Records<V>>(s: V::Simd, records: &R, p: Vec3<V>) -> V {
        records.size(s) - A::dot(p, turned::<A, V, R>(s, records, p))
    }

    #[inline(always)]
    fn keeps<V: SimdF32, R: Records<V>>(
        s: V::Simd,
        records: &R,
        seen: &Seen<V>,
        packet: &Packet<V>,
        t: V,
    ) -> V::Mask {
        is_within(s, records, seen, packet, t)
    }
}

/// Any quadric, multiplied out about the world's origin: the ten coefficients of
/// x · M x + 2 g · x + k = 0, each rounded once.
#[derive(Clone, Copy, Debug)]
pub struct World;

impl Form for World {
    const NAME: &'static str = "world quadric";
    const DEFINITE: bool = false;

    fn record(surface: &Curved, prim: u32) -> Option<Record> {
        Some(Record::world(&quadric(surface)?, prim))
    }

    #[inline(always)]
    fn see<A: Rounding, V: SimdF32, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
    ) -> Seen<V> {
        let zero = Vec3::splat(s, [0.0; 3]);
        let (origin, linear) = (packet.origin, records.linear(s));
        let turned_dir = turned::<A, V, R>(s, records, packet.dir);
        let turned_origin = turned::<A, V, R>(s, records, origin);
        Seen {
            to_center: zero - origin,
            a: A::dot(packet.dir, turned_dir),
            b: -A::dot(packet.dir, turned_origin + linear),
            c: A::dot(origin, turned_origin + linear + linear) - records.size(s),
        }
    }

    #[inline(always)]
    fn depth<A: Rounding, V: SimdF32, R: Records<V>>(s: V::Simd, records: &R, p: Vec3<V>) -> V {
        let linear = records.linear(s);
        records.size(s) - A::dot(p, turned::<A, V, R>(s, records, p) - linear - linear)
    }

    #[inline(always)]
    fn keeps<V: SimdF32, R: Records<V>>(
        s: V::Simd,
        records: &R,
        seen: &Seen<V>,
        packet: &Packet<V>,
        t: V,
    ) -> V::Mask {
        is_within(s, records, seen, packet, t)
    }
}

/// A surface as a quadric, if its numbers are those of one.
fn quadric(surface: &Curved) -> Option<Quadric> {
    match *surface {
        Curved::Sphere(sphere) => Some(sphere.into()),
        Curved::Quadric(quadric) => Some(quadric),
        Curved::Cone(_) => None,
    }
}

/// M v.
#[inline(always)]
fn turned<A: Rounding, V: SimdF32, R: Records<V>>(s: V::Simd, records: &R, v: Vec3<V>) -> Vec3<V> {
    let [x, y, z] = records.matrix(s);
    Vec3::new(A::dot(x, v), A::dot(y, v), A::dot(z, v))
}

/// Whether the point at `t` is between the planes that cut off the surface.
#[inline(always)]
fn is_within<V: SimdF32, R: Records<V>>(
    s: V::Simd,
    records: &R,
    seen: &Seen<V>,
    packet: &Packet<V>,
    t: V,
) -> V::Mask {
    let axis = records.axis(s);
    let along = (packet.dir * t - seen.to_center).dot(axis);
    let [least, greatest] = records.range(s);
    least.le(along) & along.le(greatest)
}

/// The choices of a kernel in words.
pub(super) fn words<S: Form, A: Rounding>() -> String {
    [S::NAME, A::NAME].into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(", ")
}
