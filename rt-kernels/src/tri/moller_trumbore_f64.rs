//! The test of Möller and Trumbore in `f64`: a yardstick.

use glam::DVec3;
use simd4::math::Vec3;
use simd4::{SimdF32, SimdMask};

use super::{Found, Record, Records, TriangleKernel};
use crate::geom::Triangle;
use crate::packet::{Frame, Packet};

/// Möller and Trumbore's test in `f64`, lane by lane: what twice the digits buy.
///
/// **Decides**, **parameters** and **source** are those of
/// [`MollerTrumbore`](super::MollerTrumbore), but the record is the corners, of which it takes the
/// differences in `f64`.
///
/// **Precision.** `t` is right but for its own rounding to `f32`. Not watertight: a ray that lies
/// exactly on an edge may be lost.
///
/// **Degenerate inputs.** As with `f32`: no hit.
///
/// **Operations**: as with `f32` and 6 subtractions and 19 conversions more, a lane at a time.
#[derive(Clone, Copy, Debug)]
pub struct MollerTrumboreF64;

impl TriangleKernel for MollerTrumboreF64 {
    const NAME: &'static str = "moller-trumbore-f64";
    const EXACT: bool = true;
    const SCALAR: bool = true;

    fn variant() -> String {
        "division".into()
    }

    fn record(triangle: &Triangle, prim: u32) -> Record {
        Record::corners(triangle, prim)
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        _: &F,
        limit: V,
    ) -> Option<Found<V>> {
        let (a, b, c) = (records.vec3(s, 0), records.vec3(s, 1), records.vec3(s, 2));
        let mut t = V::splat(s, f32::NAN).to_array();
        let (mut u, mut v) = (t, t);
        let mut i = 0;
        while i < V::LANES {
            let corners = [lane(a, i), lane(b, i), lane(c, i)];
            if let Some(found) = one(lane(packet.origin, i), lane(packet.dir, i), corners) {
                [t.as_mut()[i], u.as_mut()[i], v.as_mut()[i]] = found;
            }
            i += 1;
        }
        let (t, u, v) = (V::from_array(s, t), V::from_array(s, u), V::from_array(s, v));
        let mask = packet.tmin.le(t) & t.le(limit);
        mask.any().then_some(Found { mask, t, u, v })
    }
}

/// One lane, with all its digits.
#[inline(always)]
fn lane<V: SimdF32>(of: Vec3<V>, i: usize) -> DVec3 {
    DVec3::new(of.x.lane(i).into(), of.y.lane(i).into(), of.z.lane(i).into())
}

/// `t` and the weights of the second and the third corner.
#[inline(always)]
fn one(origin: DVec3, dir: DVec3, [a, b, c]: [DVec3; 3]) -> Option<[f32; 3]> {
    let (ab, ac, from_a) = (b - a, c - a, origin - a);
    let p = dir.cross(ac);
    let inv_det = 1.0 / ab.dot(p);
    let u = from_a.dot(p) * inv_det;
    let q = from_a.cross(ab);
    let v = dir.dot(q) * inv_det;
    if !(u >= 0.0 && v >= 0.0 && u + v <= 1.0) {
        return None;
    }
    Some([(ac.dot(q) * inv_det) as f32, u as f32, v as f32])
}
