//! What a ray exactly does to a box.
//!
//! A ray meets a box if at some t with `tmin <= t <= tmax` its point `origin + t · dir` is in all
//! three slabs, whose planes belong to them. Along an axis where the direction is 0, of either sign,
//! it is in the slab always or never: always, if the origin is between the planes or on one. A `tmax`
//! of ∞ counts as the greatest `f32`, beyond which kernels cannot tell one distance from another. A
//! box whose least side is greater than its greatest holds no point; numbers that are not finite, and
//! rays whose direction is 0 on all axes, hit nothing.

use super::ROUNDOFF;
use super::expansion::Expansion;
use crate::Ray;
use crate::geom::Aabb;

/// The whole truth.
#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    /// Whether the ray meets the closed box: exact, for any finite numbers.
    pub hits: bool,
    /// The least t at which it is in the box, to 2^-51; of no meaning if it never is.
    pub enter: f64,
    /// How far the line passes from the edge, or the ray's end from the side, that decides: in units
    /// of 2^-24 of the greatest coordinate of ray and box. Not negative.
    pub band: f64,
}

/// `t >= bound / speed`, or `<=`: exact numbers.
#[derive(Clone, Copy)]
struct Bound {
    /// The axis of the plane; of the ray's own ends, 3 and 4.
    axis: usize,
    /// The bound is the difference of these.
    difference: [f64; 2],
    /// The speed along the axis, greater than zero.
    speed: f64,
}

impl Bound {
    /// Where on the ray it is.
    fn t(&self) -> f64 {
        (self.difference[0] - self.difference[1]) / self.speed
    }

    /// By how much `self <= upper` holds, multiplied with both speeds: with its exact sign.
    fn up_to(&self, upper: &Bound) -> f64 {
        // Products of two f32: exact.
        let products = [
            upper.difference[0] * self.speed,
            -upper.difference[1] * self.speed,
            -self.difference[0] * upper.speed,
            self.difference[1] * upper.speed,
        ];
        let (sum, most) = products
            .iter()
            .fold((0.0, 0.0), |(sum, most), product| (sum + product, most + product.abs()));
        if f64::abs(sum) > 4.0 * f64::EPSILON * most {
            return sum;
        }
        let mut sum = Expansion::default();
        products.into_iter().for_each(|product| sum.add(product));
        sum.value()
    }

    /// What the product of two speeds is to be divided by, for a length in space.
    fn scale(&self, other: &Bound) -> f64 {
        match (self.axis < 3, other.axis < 3) {
            (true, true) => self.speed.hypot(other.speed),
            _ => 1.0,
        }
    }
}

/// Judges a ray and a box.
pub fn judge(ray: &Ray, aabb: &Aabb) -> Verdict {
    let missed = Verdict { hits: false, enter: f64::NAN, band: 0.0 };
    let (o, d) = (ray.origin.to_array(), ray.dir.to_array());
    let finite = |numbers: &[f32]| numbers.iter().all(|number| number.is_finite());
    if !(finite(&o) && finite(&d) && finite(aabb.axes.as_flattened()) && ray.tmin.is_finite())
        || ray.tmax.is_nan()
        || d == [0.0; 3]
        || aabb.axes.iter().any(|[low, high]| low > high)
    {
        return missed;
    }
    // By how much every condition holds, as lengths in space.
    let mut margins = Vec::with_capacity(16);
    let mut lower = vec![own_end(3, ray.tmin)];
    let mut upper = vec![own_end(4, ray.tmax.clamp(-f32::MAX, f32::MAX))];
    for axis in 0..3 {
        let [low, high] = aabb.axes[axis].map(f64::from);
        let origin = f64::from(o[axis]);
        let speed = f64::from(d[axis]).abs();
        if speed == 0.0 {
            margins.push((origin - low).min(high - origin));
            continue;
        }
        let bound = |difference| Bound { axis, difference, speed };
        if d[axis] > 0.0 {
            lower.push(bound([low, origin]));
            upper.push(bound([high, origin]));
        } else {
            lower.push(bound([origin, high]));
            upper.push(bound([origin, low]));
        }
    }
    let mut ends = true;
    for low in &lower {
        for high in &upper {
            let holds = low.up_to(high);
            if low.axis == 3 && high.axis == 4 {
                ends = holds >= 0.0;
            } else if low.axis != high.axis {
                margins.push(holds / low.scale(high));
            }
        }
    }
    let least = |least: f64, margin: &f64| least.min(*margin);
    let margin = margins.iter().fold(f64::INFINITY, least);
    let hits = ends && margin >= 0.0;
    let greatest = aabb.axes.as_flattened().iter().chain(&o).fold(0f32, |g, x| g.max(x.abs()));
    let band = margin.abs() / (ROUNDOFF * f64::from(greatest));
    let enter = lower.iter().map(Bound::t).fold(f64::NEG_INFINITY, f64::max);
    Verdict { hits, enter, band }
}

/// One end of the ray.
fn own_end(axis: usize, t: f32) -> Bound {
    Bound { axis, difference: [t.into(), 0.0], speed: 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    const CUBE: Aabb = Aabb { axes: [[1.0, 2.0]; 3] };

    fn hits(origin: [f32; 3], dir: [f32; 3]) -> bool {
        judge(&Ray::new(Vec3::from_array(origin), Vec3::from_array(dir)), &CUBE).hits
    }

    #[test]
    fn edges_and_corners_belong_to_the_box() {
        assert!(hits([0.0, 1.0, 1.5], [1.0, 0.0, 0.0]), "along a side");
        assert!(hits([0.0, 1.0, 2.0], [1.0, -0.0, 0.0]), "along an edge");
        assert!(!hits([0.0, 1.0f32.next_down(), 2.0], [1.0, 0.0, 0.0]));
        assert!(hits([0.0, 0.0, 1.5], [1.0, 2.0, 0.0]), "through an edge");
        assert!(!hits([0.0, 0.0, 1.5], [1.0, 2f32.next_up(), 0.0]), "past an edge");
        assert!(hits([0.0, 0.0, 3.0], [1.0, 1.0, -1.0]), "through a corner");
        assert!(hits([2.0, 2.0, 2.0], [1.0, 1.0, 1.0]), "away from a corner");
        assert!(!hits([2.0f32.next_up(), 2.0, 2.0], [1.0, 1.0, 1.0]), "behind");
    }

    #[test]
    fn extreme_numbers_are_exact_as_well() {
        let tiny = f32::from_bits(1);
        assert!(hits([2.0, 1.5, 1.5], [tiny, 0.0, 0.0]), "on the plane, leaving");
        // It would take 2^148 and more to get there.
        assert!(!hits([0.0, 1.5, 1.5], [tiny, 0.0, 0.0]));
        assert!(hits([0.0, 1.5, 1.5], [1e-30, 0.0, 0.0]));
        assert!(hits([0.0, 1.0, 1.5], [1e20, tiny, 0.0]), "rises by nothing worth speaking of");
        assert!(!hits([0.0, 1.0, 1.5], [1e20, -tiny, 0.0]), "sinks by as little");
    }

    #[test]
    fn ends_and_distances_are_what_they_are() {
        let ray = Ray::new(Vec3::new(0.0, 1.5, 1.5), Vec3::X * 0.5);
        let verdict = judge(&ray, &CUBE);
        assert_eq!((verdict.hits, verdict.enter), (true, 2.0));
        assert!(judge(&Ray { tmax: 2.0, ..ray }, &CUBE).hits);
        assert!(!judge(&Ray { tmax: 2f32.next_down(), ..ray }, &CUBE).hits);
        assert_eq!(judge(&Ray { tmin: 3.0, ..ray }, &CUBE).enter, 3.0);
        assert!(judge(&Ray { tmin: 4.0, ..ray }, &CUBE).hits);
        assert!(!judge(&Ray { tmin: 4f32.next_up(), ..ray }, &CUBE).hits);
        assert!(!judge(&Ray { tmin: 3.5, tmax: 3.0, ..ray }, &CUBE).hits);
        // Half a unit from the edges, with a greatest coordinate of 2.
        assert_eq!(verdict.band, (1 << 22) as f64);
    }

    #[test]
    fn what_is_no_number_and_no_box_is_not_hit() {
        assert!(!hits([f32::NAN, 1.5, 1.5], [1.0, 0.0, 0.0]));
        assert!(!hits([0.0, 1.5, 1.5], [f32::INFINITY, 0.0, 0.0]));
        assert!(!hits([1.5; 3], [0.0, -0.0, 0.0]), "goes nowhere");
        let ray = Ray::new(Vec3::splat(1.5), Vec3::X);
        assert!(!judge(&ray, &Aabb::EMPTY).hits);
        assert!(!judge(&ray, &Aabb { axes: [[2.0, 1.0], [1.0, 2.0], [1.0, 2.0]] }).hits);
        let point = Aabb::point(Vec3::new(2.0, 1.5, 1.5));
        assert!(judge(&ray, &point).hits, "a point that the ray passes through");
    }
}
