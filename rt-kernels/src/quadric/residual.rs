//! The discriminant as a residual.

use std::marker::PhantomData;

use simd4::math::Vec3;
use simd4::{SimdF32, SimdMask};

use super::form::{Form, Seen, words};
use super::stable::q_roots;
use super::{Found, QuadricKernel, Record, Records, Roots};
use crate::geom::Curved;
use crate::packet::{Frame, Packet};
use crate::tri::knobs::Rounding;

/// The residual test.
///
/// **Decides** and **Parameters** as [`Textbook`](super::Textbook).
///
/// **Precision.** The discriminant is a times the depth inside the surface of that point of the ray
/// which is midway between the roots: no difference of large squares, however far the surface. The
/// roots are those of [`Stable`](super::Stable).
///
/// **Degenerate inputs.** No hit where `a` is 0: that point is at infinity.
///
/// **Operations**, for a sphere: 17 products, 15 sums, a root and three divisions.
///
/// Source: Haines, Günther, Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection",
/// Ray Tracing Gems, chapter 7. Deviation: for any quadric with a centre.
#[derive(Clone, Copy, Debug)]
pub struct Residual<S, A>(PhantomData<(S, A)>);

impl<S: Form, A: Rounding> QuadricKernel for Residual<S, A> {
    const NAME: &'static str = "residual";
    const FUSED: bool = A::FUSED;

    fn variant() -> String {
        words::<S, A>()
    }

    fn record(surface: &Curved, prim: u32) -> Option<Record> {
        S::record(surface, prim)
    }

    #[inline(always)]
    fn test<V: SimdF32, F: Frame<V>, R: Records<V>>(
        s: V::Simd,
        records: &R,
        packet: &Packet<V>,
        _: &F,
        limit: V,
    ) -> Option<Found<V>> {
        let seen = S::see::<A, V, R>(s, records, packet);
        let depth = S::depth::<A, V, R>(s, records, nearest::<A, V>(&seen, packet));
        let zero = V::splat(s, 0.0);
        let meets = if S::DEFINITE { depth.ge(zero) } else { (seen.a * depth).ge(zero) };
        if meets.none() {
            return None;
        }
        let roots = Roots { meets, t: q_roots(s, seen.equation(), (seen.a * depth).sqrt()) };
        roots.first::<S, R>(s, records, &seen, packet, limit)
    }
}

/// From the point of the ray that is midway between the roots to the centre.
#[inline(always)]
pub(super) fn nearest<A: Rounding, V: SimdF32>(seen: &Seen<V>, packet: &Packet<V>) -> Vec3<V> {
    let t = seen.b / seen.a;
    let Vec3 { x, y, z } = packet.dir;
    let to = seen.to_center;
    Vec3::new(A::nmul_add(x, t, to.x), A::nmul_add(y, t, to.y), A::nmul_add(z, t, to.z))
}
