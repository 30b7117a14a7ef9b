//! Where a ray meets a curved surface, in numbers of 106 bits.
//!
//! All is computed with a bound for its error, about 2^-95 of the largest term. Where that does not
//! tell one answer from the other (the ray touches the surface, or meets it at its own end or where
//! the surface ends, so nearly that none of 30 decimals differs), the verdict is that it is too close
//! to call.

use std::cmp::Ordering;

use glam::{DMat3, DVec3, Vec3};

use super::ROUNDOFF;
use super::ball::Ball;
use crate::Ray;
use crate::geom::{Cone, Curved, Quadric};

/// What is so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meeting {
    /// The ray meets the surface first at this t, which is right to 2^-40.
    At(f64),
    /// It does not, or it goes nowhere, or a number is not finite.
    Nowhere,
    /// Too close to call.
    Unsure,
}

/// The whole truth.
#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    /// The first t within the ray's interval, both ends included, at which it meets what is left of
    /// the surface, both ends included. A ray that runs along a straight line of the surface does
    /// not meet it.
    pub meeting: Meeting,
    /// How far the ray would have to be moved for the answer to be another: until the line touches
    /// the surface, or a meeting comes to the ray's or the surface's end. In units of 2^-24 of the
    /// greatest coordinate, seen from the centre, of the origin and of the point that is nearest to the
    /// centre; of a truncated cone seen from its base, and its own size counts too. Roughly, by what the
    /// slopes there say. Not negative.
    pub band: f64,
}

/// Judges a ray and a surface.
pub fn judge(ray: &Ray, surface: &Curved) -> Verdict {
    let nowhere = Verdict { meeting: Meeting::Nowhere, band: 0.0 };
    let finite = ray.origin.is_finite() && ray.dir.is_finite();
    if !finite || ray.dir == Vec3::ZERO || ray.tmin.is_nan() || ray.tmax.is_nan() {
        return nowhere;
    }
    let scene = match *surface {
        Curved::Sphere(sphere) => {
            let radius = Ball::new(sphere.radius);
            Scene::of_quadric(ray, &sphere.into(), radius * radius)
        }
        Curved::Quadric(quadric) => Scene::of_quadric(ray, &quadric, Ball::new(quadric.level)),
        Curved::Cone(cone) => Scene::of_cone(ray, &cone),
    };
    let Some(scene) = scene else { return nowhere };
    let [a, b, c] = scene.equation;
    let discriminant = b * b - a * c;

    let (meeting, ends) = match discriminant.sign() {
        Some(Ordering::Less) => (Meeting::Nowhere, f64::INFINITY),
        Some(Ordering::Greater) => {
            let root = discriminant.sqrt();
            let q = if b.value() > 0.0 { -b - root } else { root - b };
            let near = c / q;
            match a.sign() {
                Some(Ordering::Equal) => scene.first(&[near]),
                // The other root is very far, on this side or the other.
                None => match scene.first(&[near]) {
                    (Meeting::Nowhere, ends) => (Meeting::Unsure, ends),
                    known => known,
                },
                Some(_) => {
                    let far = q / a;
                    let ordered = near.value() < far.value();
                    scene.first(&if ordered { [near, far] } else { [far, near] })
                }
            }
        }
        // The ray runs along the surface's axis: nowhere, or all the way.
        _ if a.sign() == b.sign() && b.sign() == Some(Ordering::Equal) => return nowhere,
        _ => (Meeting::Unsure, f64::INFINITY),
    };

    // The point midway between the roots is about as far from touching as the form says of it, over
    // the form's slope there.
    let (a, b, c) = (a.value(), b.value(), c.value());
    let (t, depth) = if a == 0.0 { (0.0, c) } else { (-b / a, discriminant.value() / a) };
    let origin = values(scene.from_center);
    let midway = origin + ray.dir.as_dvec3() * t;
    let slope = 2.0 * scene.normal(t).length();
    let greatest = midway.abs().max(origin.abs()).max_element().max(scene.size);
    let band = (depth / slope).abs().min(ends).min(scene.at_ends());
    Verdict { meeting, band: band / (ROUNDOFF * greatest) }
}

/// A ray and a surface.
struct Scene<'a> {
    ray: &'a Ray,
    /// a, b and c: the line meets the surface where a t² + 2 b t + c = 0.
    equation: [Ball; 3],
    /// Half the slope of the form at x is M x − g.
    matrix: DMat3,
    linear: DVec3,
    from_center: [Ball; 3],
    dir: [Ball; 3],
    /// What points are measured along, and from where to where the surface goes.
    axis: [Ball; 3],
    range: [Ball; 2],
    /// What counts as a coordinate beside those of the ray.
    size: f64,
}

impl<'a> Scene<'a> {
    /// `None` if a number is not finite.
    fn of_quadric(ray: &'a Ray, quadric: &Quadric, level: Ball) -> Option<Scene<'a>> {
        let &Quadric { center, matrix, axis, range, .. } = quadric;
        let finite = center.is_finite()
            && axis.is_finite()
            && matrix.iter().chain(&range).all(|number| number.is_finite())
            && level.value().is_finite();
        let (from_center, dir) = (minus(vector(ray.origin), vector(center)), vector(ray.dir));
        let turned = turn(matrix, dir);
        let equation = [
            dot(dir, turned),
            dot(from_center, turned),
            dot(from_center, turn(matrix, from_center)) - level,
        ];
        finite.then(|| Scene {
            ray,
            equation,
            matrix: quadric.matrix().as_dmat3(),
            linear: DVec3::ZERO,
            from_center,
            dir,
            axis: vector(axis),
            range: range.map(Ball::new),
            size: 0.0,
        })
    }

    /// With d from the base to the apex, and x from the base, the cone is where
    /// |x|² − (x · d)² / |d|² = r², and r goes from one radius to the other as x · d goes from 0 to |d|².
    fn of_cone(ray: &'a Ray, cone: &Cone) -> Option<Scene<'a>> {
        let &Cone { base, base_radius, apex, apex_radius } = cone;
        let finite = [base_radius, apex_radius].iter().all(|radius| radius.is_finite())
            && base.is_finite()
            && apex.is_finite()
            && base != apex;
        let axis = minus(vector(apex), vector(base));
        let square = dot(axis, axis);
        let (from_base, dir) = (minus(vector(ray.origin), vector(base)), vector(ray.dir));
        let (along, speed) = (dot(from_base, axis), dot(dir, axis));
        let [radius, other] = [base_radius, apex_radius].map(Ball::new);
        let widening = (other - radius) / square;
        let (there, change) = (radius + widening * along, widening * speed);
        let equation = [
            dot(dir, dir) - speed * speed / square - change * change,
            dot(from_base, dir) - along * speed / square - there * change,
            dot(from_base, from_base) - along * along / square - there * there,
        ];
        let d = values(axis);
        let (outer, widening) = (DMat3::from_cols(d * d.x, d * d.y, d * d.z), widening.value());
        finite.then(|| Scene {
            ray,
            equation,
            matrix: DMat3::IDENTITY - outer * (1.0 / square.value() + widening * widening),
            linear: d * (radius.value() * widening),
            from_center: from_base,
            dir,
            axis,
            range: [Ball::new(0.0), square],
            size: d.length().max(base_radius.max(apex_radius).into()),
        })
    }

    /// The first of the roots that counts, and how far the ray would have to be moved for any of them to
    /// come to an end.
    fn first(&self, roots: &[Ball]) -> (Meeting, f64) {
        let ends = roots.iter().map(|&t| self.to_ends(t)).fold(f64::INFINITY, f64::min);
        for &t in roots {
            match self.counts(t) {
                Some(true) if t.error() <= t.value().abs() * PRECISE => {
                    return (Meeting::At(t.value()), ends);
                }
                Some(false) => {}
                _ => return (Meeting::Unsure, ends),
            }
        }
        (Meeting::Nowhere, ends)
    }

    /// Whether the point at `t` is on what is left of ray and surface: `None` if that is too close
    /// to call.
    fn counts(&self, t: Ball) -> Option<bool> {
        let [least, greatest] = self.range;
        let along = self.along(t);
        let tmax = self.ray.tmax.clamp(-f32::MAX, f32::MAX);
        let ends =
            [t - Ball::new(self.ray.tmin), Ball::new(tmax) - t, along - least, greatest - along];
        let signs = ends.map(Ball::sign);
        if signs.contains(&Some(Ordering::Less)) {
            return Some(false);
        }
        (!signs.contains(&None)).then_some(true)
    }

    fn along(&self, t: Ball) -> Ball {
        let [x, y, z] = self.dir.map(|d| d * t);
        let [ox, oy, oz] = self.from_center;
        dot(self.axis, [ox + x, oy + y, oz + z])
    }

    /// Half the slope of the form at a point of the line.
    fn normal(&self, t: f64) -> DVec3 {
        self.matrix * (values(self.from_center) + values(self.dir) * t) - self.linear
    }

    /// How far the ray would have to be moved for the root at `t` to come to the ray's first end, or
    /// to an end of the surface.
    fn to_ends(&self, t: Ball) -> f64 {
        let (dir, axis, normal) = (values(self.dir), values(self.axis), self.normal(t.value()));
        // Where the ray is moved by w, the root moves by w − d (n · w) / (n · d).
        let speed = normal.dot(dir);
        let start = (t.value() - f64::from(self.ray.tmin)).abs() * speed.abs() / normal.length();
        let rate = axis - normal * (axis.dot(dir) / speed);
        let along = self.along(t).value();
        let across = self.range.map(|end| (along - end.value()).abs() / rate.length());
        // A surface without ends has no axis: NaN, which is never the least.
        across.into_iter().fold(start, f64::min)
    }

    /// How far from the surface the ray is where it starts, and where it passes the surface's ends. It
    /// may come there along the surface.
    fn at_ends(&self) -> f64 {
        let [a, b, c] = self.equation;
        let off = |t: Ball| {
            let depth = ((a * t + b + b) * t + c).value();
            (depth / (2.0 * self.normal(t.value()).length())).abs()
        };
        let start = Ball::new(self.ray.tmin);
        let [least, greatest] = self.range.map(Ball::value);
        let along = self.along(start).value();
        let at_start = (least..=greatest).contains(&along).then(|| off(start));
        let speed = dot(self.axis, self.dir);
        let passes = self.range.map(|end| (end - dot(self.axis, self.from_center)) / speed);
        let passes = passes.into_iter().filter(|t| t.value() >= start.value()).map(off);
        passes.chain(at_start).fold(f64::INFINITY, f64::min)
    }
}

/// How right `t` is, relative to its size.
const PRECISE: f64 = 1.0 / (1u64 << 40) as f64;

fn vector(v: Vec3) -> [Ball; 3] {
    v.to_array().map(Ball::new)
}

fn values(v: [Ball; 3]) -> DVec3 {
    DVec3::from_array(v.map(Ball::value))
}

fn minus([ax, ay, az]: [Ball; 3], [bx, by, bz]: [Ball; 3]) -> [Ball; 3] {
    [ax - bx, ay - by, az - bz]
}

fn dot([ax, ay, az]: [Ball; 3], [bx, by, bz]: [Ball; 3]) -> Ball {
    ax * bx + ay * by + az * bz
}

/// M v.
fn turn(matrix: [f32; 6], v: [Ball; 3]) -> [Ball; 3] {
    let [xx, yy, zz, yz, zx, xy] = matrix.map(Ball::new);
    [dot([xx, xy, zx], v), dot([xy, yy, yz], v), dot([zx, yz, zz], v)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Sphere;

    fn ray(origin: [f32; 3], dir: [f32; 3]) -> Ray {
        Ray::new(Vec3::from_array(origin), Vec3::from_array(dir))
    }

    #[test]
    fn a_sphere_is_met_in_its_first_root() {
        let ball = Curved::Sphere(Sphere { center: Vec3::new(0.0, 0.0, 8.0), radius: 2.0 });
        let along = ray([0.0; 3], [0.0, 0.0, 0.5]);
        let meeting = |ray: &Ray| judge(ray, &ball).meeting;
        assert_eq!(meeting(&along), Meeting::At(12.0));
        assert_eq!(meeting(&Ray { tmin: 13.0, ..along }), Meeting::At(20.0));
        assert_eq!(meeting(&Ray { tmin: 20.5, ..along }), Meeting::Nowhere);
        assert_eq!(meeting(&Ray { tmax: 11.5, ..along }), Meeting::Nowhere);
        assert_eq!(meeting(&ray([2.0, 0.0, 0.0], [0.0, 0.0, 1.0])), Meeting::Unsure, "touches");
        let off = 2f32.next_up();
        assert_eq!(meeting(&ray([off, 0.0, 0.0], [0.0, 0.0, 1.0])), Meeting::Nowhere);
        let on = 2f32.next_down();
        assert!(matches!(meeting(&ray([on, 0.0, 0.0], [0.0, 0.0, 1.0])), Meeting::At(_)));
        // A unit in the last place of 2, where the greatest coordinate is 8.
        assert!((judge(&ray([off, 0.0, 0.0], [0.0, 0.0, 1.0]), &ball).band - 0.5).abs() < 1e-3);
        assert_eq!(meeting(&ray([f32::NAN; 3], [0.0, 0.0, 1.0])), Meeting::Nowhere);
    }

    #[test]
    fn cylinders_and_cones_end_where_they_end() {
        let cylinder = Curved::Quadric(Quadric::cylinder(Vec3::ZERO, Vec3::Z, 3.0, 4.0));
        let at = |ray: Ray, surface: &Curved| judge(&ray, surface).meeting;
        assert_eq!(at(ray([5.0, 0.0, 1.0], [-1.0, 0.0, 0.0]), &cylinder), Meeting::At(2.0));
        assert_eq!(at(ray([5.0, 0.0, 4.5], [-1.0, 0.0, 0.0]), &cylinder), Meeting::Nowhere);
        // Over the rim, to the far side.
        assert_eq!(at(ray([6.0, 0.0, 8.0], [-1.0, 0.0, -1.0]), &cylinder), Meeting::At(9.0));
        assert_eq!(at(ray([0.0, 0.0, 9.0], [0.0, 0.0, -1.0]), &cylinder), Meeting::Nowhere);
        let cone = Curved::Quadric(Quadric::cone(Vec3::ZERO, Vec3::Z, 0.5, 4.0));
        assert_eq!(at(ray([5.0, 0.0, 2.0], [-1.0, 0.0, 0.0]), &cone), Meeting::At(4.0));
        assert_eq!(at(ray([5.0, 0.0, -2.0], [-1.0, 0.0, 0.0]), &cone), Meeting::Nowhere);
        // Along the side: one root only.
        assert_eq!(at(ray([1.0, 0.0, 4.0], [-1.0, 0.0, -2.0]), &cone), Meeting::At(1.5));
    }

    #[test]
    fn truncated_cones_are_cones() {
        let cone = Curved::Cone(Cone {
            base: Vec3::new(0.0, 0.0, 2.0),
            base_radius: 1.0,
            apex: Vec3::new(0.0, 0.0, 4.0),
            apex_radius: 2.0,
        });
        let at = |origin, dir| judge(&ray(origin, dir), &cone);
        assert_eq!(at([5.0, 0.0, 3.0], [-1.0, 0.0, 0.0]).meeting, Meeting::At(3.5));
        assert_eq!(at([1.0, 0.0, 3.0], [-1.0, 0.0, 0.0]).meeting, Meeting::At(2.5));
        assert_eq!(at([5.0, 0.0, 1.5], [-1.0, 0.0, 0.0]).meeting, Meeting::Nowhere);
        assert_eq!(at([5.0, 0.0, 4.5], [-1.0, 0.0, 0.0]).meeting, Meeting::Nowhere);
        // In at the wide end, to the mantle from inside.
        assert_eq!(at([0.0, 0.0, 6.0], [0.5, 0.0, -1.0]).meeting, Meeting::At(3.0));
        // Along the side: one root only.
        assert_eq!(at([0.5, 0.0, 6.0], [-1.0, 0.0, -2.0]).meeting, Meeting::At(1.75));
        // Past the mantle by 2^-10 of its width at right angles, where the greatest coordinate is 5.
        let past = at([5.0, 1.5 + 1.5 / 1024.0, 3.0], [-1.0, 0.0, 0.0]);
        assert_eq!(past.meeting, Meeting::Nowhere);
        let off = past.band * ROUNDOFF * 5.0 * 1024.0;
        assert!((1.0..2.0).contains(&off), "{off}");
    }

    #[test]
    fn the_band_at_a_rim_is_the_distance_of_the_line() {
        let cylinder = Curved::Cone(Cone {
            base: Vec3::ZERO,
            base_radius: 1.0,
            apex: Vec3::new(0.0, 0.0, 4.0),
            apex_radius: 1.0,
        });
        let past = 1.0 / 1024.0;
        for (origin, dir, distance) in [
            ([5.0, 0.0, 4.0 + past], [-1.0, 0.0, 0.0], past),
            ([5.0, 0.0, 8.0 + past], [-1.0, 0.0, -1.0], past * 0.5f32.sqrt()),
            // Along the mantle.
            ([1.0 + past, 0.0, 8.0], [0.0, 0.0, -1.0], past),
        ] {
            let band = judge(&ray(origin, dir), &cylinder).band;
            let greatest = origin.into_iter().fold(4.0, f32::max);
            let want = f64::from(distance / greatest) / ROUNDOFF;
            assert!((band / want - 1.0).abs() < 0.01, "{origin:?}: {band}, not {want}");
        }
    }

    #[test]
    fn ellipsoids_are_as_long_as_they_are() {
        let egg = Curved::Quadric(Quadric::ellipsoid(Vec3::ONE, Vec3::new(1.0, 2.0, 4.0)));
        for (axis, half) in [(0, 1.0), (1, 2.0), (2, 4.0)] {
            let mut dir = Vec3::ZERO;
            dir[axis] = 1.0;
            let from = Ray::new(Vec3::ONE - dir * 8.0, dir);
            assert_eq!(judge(&from, &egg).meeting, Meeting::At(8.0 - half));
        }
    }
}
