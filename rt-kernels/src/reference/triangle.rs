//! What a ray exactly does to a triangle.

use glam::Vec3;

use super::ROUNDOFF;
use super::determinant::determinant;
use crate::Ray;

/// Where a ray passes a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Beside it, or it is behind the ray's origin, or the ray runs in its plane, or it has no area,
    /// or a number is not finite.
    Outside,
    /// Through its inside.
    Inside,
    /// Exactly through an edge or a vertex.
    Boundary,
}

/// The whole truth.
#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    /// Where the ray passes: exact, for any finite numbers. The interval of the ray is of no
    /// account: it goes from its origin, included, to infinity.
    pub place: Place,
    /// Where the line of the ray meets the plane, with a relative error of at most 2^-39; NaN if it
    /// runs in the plane.
    pub t: f64,
    /// How far the line passes from the edge that decides, in units of 2^-24 of the greatest
    /// coordinate of ray and triangle: to about 2^-10. Not negative.
    pub band: f64,
    /// The same in units of 2^-24 of the distance from the ray's origin to the farthest corner.
    pub band_of_reach: f64,
}

impl Verdict {
    /// What is said of numbers that are none, and where nothing else can be said.
    const NONE: Verdict =
        Verdict { place: Place::Outside, t: f64::NAN, band: 0.0, band_of_reach: 0.0 };

    /// Whether the ray meets the closed triangle.
    pub fn hits(&self) -> bool {
        self.place != Place::Outside
    }
}

/// Judges a ray and a triangle.
pub fn judge(ray: &Ray, corners: [Vec3; 3]) -> Verdict {
    let (origin, dir) = (ray.origin, [ray.dir, Vec3::ZERO]);
    if !(origin.is_finite() && ray.dir.is_finite() && corners.iter().all(|c| c.is_finite())) {
        return Verdict::NONE;
    }
    let [a, b, c] = corners;
    // Of the plane: its distance from the origin and the speed at which the ray comes nearer, both
    // in the same unknown unit.
    let distance = determinant([[a, origin], [b, a], [c, a]], PRECISE);
    let speed = determinant([dir, [b, a], [c, a]], PRECISE);
    if speed == 0.0 {
        return Verdict::NONE;
    }
    // The volumes that the direction spans with each edge: positive where the ray passes it on the
    // inner side.
    let edges = [[a, b], [b, c], [c, a]];
    let sides =
        edges.map(|[p, q]| determinant([dir, [p, origin], [q, origin]], COARSE) * speed.signum());
    let ahead = distance * speed.signum() >= 0.0;
    let place = if sides.iter().any(|&side| side < 0.0) || !ahead {
        Place::Outside
    } else if sides.contains(&0.0) {
        Place::Boundary
    } else {
        Place::Inside
    };

    let dir = ray.dir.as_dvec3();
    let off = |side: f64, [p, q]: [Vec3; 2]| {
        // The distance of two lines; none if they are parallel.
        side / (q.as_dvec3() - p.as_dvec3()).cross(dir).length()
    };
    let nearest = (0..3).map(|i| off(sides[i], edges[i])).fold(f64::INFINITY, f64::min).abs();
    let greatest = corners.iter().fold(origin.abs(), |max, corner| max.max(corner.abs()));
    let reach = corners.map(|corner| corner.as_dvec3().distance(origin.as_dvec3()));
    let band_in = |unit: f64| nearest / (ROUNDOFF * unit);
    Verdict {
        place,
        t: distance / speed,
        band: band_in(greatest.max_element().into()),
        band_of_reach: band_in(reach.into_iter().fold(0.0, f64::max)),
    }
}

/// What `t` needs.
const PRECISE: f64 = 1.0 / (1u64 << 40) as f64;

/// What a sign needs, and the width of a band.
const COARSE: f64 = 1.0 / (1 << 10) as f64;

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [Vec3; 3] =
        [Vec3::new(0.0, 0.0, 8.0), Vec3::new(4.0, 0.0, 8.0), Vec3::new(0.0, 4.0, 8.0)];

    fn at(x: f32, y: f32) -> Verdict {
        judge(&Ray::new(Vec3::new(x, y, 0.0), Vec3::Z), CORNERS)
    }

    #[test]
    fn places_are_exact() {
        let below = 2f32.next_down();
        for (x, y, want) in [
            (1.0, 1.0, Place::Inside),
            (2.0, 2.0, Place::Boundary),
            (2.0, below, Place::Inside),
            (2.0, 2f32.next_up(), Place::Outside),
            (0.0, 0.0, Place::Boundary),
            (4.0, 0.0, Place::Boundary),
            (-1e-45, 1.0, Place::Outside),
            (1e-45, 1.0, Place::Inside),
        ] {
            assert_eq!(at(x, y).place, want, "({x}, {y})");
        }
    }

    #[test]
    fn distances_and_bands_are_what_they_are() {
        let verdict = at(1.0, 1.0);
        assert_eq!(verdict.t, 8.0);
        // The nearest edge is 1 away, and the greatest coordinate is 8.
        assert_eq!(verdict.band, (1 << 21) as f64);
        assert_eq!(at(-3.0, 1.0).band, 3.0 * (1 << 21) as f64);
        // From (1, 1, 0) the farthest corners are √74 away.
        let of_reach = (1 << 24) as f64 / 74f64.sqrt();
        assert!((verdict.band_of_reach / of_reach - 1.0).abs() < COARSE);
        let slow = Ray::new(Vec3::new(1.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 1e-30));
        let exact = 8.0 / f64::from(1e-30f32);
        assert!((judge(&slow, CORNERS).t / exact - 1.0).abs() < PRECISE);
    }

    #[test]
    fn what_cannot_be_hit_is_not() {
        let [a, b, c] = CORNERS;
        let ray = Ray::new(Vec3::new(1.0, 1.0, 0.0), Vec3::Z);
        assert!(judge(&ray, CORNERS).hits());
        assert!(judge(&ray, [a, c, b]).hits(), "both sides");
        assert!(!judge(&Ray { dir: -ray.dir, ..ray }, CORNERS).hits(), "behind");
        assert!(!judge(&ray, [a, b, b]).hits(), "no area");
        let on = Ray { origin: Vec3::new(1.0, 1.0, 8.0), ..ray };
        assert!(judge(&on, CORNERS).hits(), "from the surface itself");
        assert!(!judge(&Ray { dir: Vec3::X, ..on }, CORNERS).hits(), "in the plane");
        assert!(!judge(&Ray { dir: Vec3::ZERO, ..ray }, CORNERS).hits(), "going nowhere");
        for bad in [f32::NAN, f32::INFINITY] {
            assert!(!judge(&Ray { dir: Vec3::new(bad, 0.0, 1.0), ..ray }, CORNERS).hits());
            assert!(!judge(&ray, [a, b, Vec3::splat(bad)]).hits());
        }
    }
}
