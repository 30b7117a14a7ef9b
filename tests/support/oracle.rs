//! Naive tests of one ray against one thing, to judge the kernels by. All are one ray at a time, in
//! plain scalar code, and none knows of boxes but [`entry`].

use glam::{DVec3, Vec3};
use rt_kernels::Ray;
use rt_kernels::geom::{Aabb, Cone, Sphere};
pub use rt_kernels::reference::{ROUNDOFF, ulps};

/// The triangle test that everybody writes first, in `f32` and without a tolerance (Möller and
/// Trumbore 1997). It leaks: that is what it is here for.
pub fn moller_trumbore(ray: &Ray, [a, b, c]: [Vec3; 3]) -> Option<f32> {
    let (ab, ac) = (b - a, c - a);
    let p = ray.dir.cross(ac);
    let det = ab.dot(p);
    if det == 0.0 {
        return None;
    }
    let s = ray.origin - a;
    let u = s.dot(p) / det;
    let q = s.cross(ab);
    let v = ray.dir.dot(q) / det;
    let t = ac.dot(q) / det;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= ray.tmin && t <= ray.tmax).then_some(t)
}

/// Where a line meets a triangle's plane.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    /// The distance, in units of the direction's length.
    pub t: f64,
    /// The weights of the corners: none is negative inside the triangle.
    pub weights: [f64; 3],
    /// How far outside the triangle the line passes, seen along the ray, in units of the greatest
    /// distance of a corner from the origin; negative inside.
    pub outside: f64,
    /// The cosine of the angle between the ray and the normal.
    pub cosine: f64,
}

/// The plane of a triangle by volumes in `f64`: `None` if the ray runs in the plane or the triangle
/// has no area.
pub fn plane(ray: &Ray, corners: [Vec3; 3]) -> Option<Meeting> {
    let d = ray.dir.as_dvec3();
    let [a, b, c] = corners.map(|corner| corner.as_dvec3() - ray.origin.as_dvec3());
    // Twice the area of the triangle that an edge makes with the origin, seen along the ray.
    let areas = [b.cross(c).dot(d), c.cross(a).dot(d), a.cross(b).dot(d)];
    let normal = (b - a).cross(c - a);
    let det = areas.iter().sum::<f64>();
    if det == 0.0 || normal == DVec3::ZERO {
        return None;
    }
    let across = |edge: DVec3| edge.cross(d).length();
    let scale = a.length().max(b.length()).max(c.length());
    let outside = [(areas[0], c - b), (areas[1], a - c), (areas[2], b - a)]
        .map(|(area, edge)| -area * det.signum() / (across(edge) * scale));
    Some(Meeting {
        t: a.dot(normal) / d.dot(normal),
        weights: areas.map(|area| area / det),
        outside: outside.into_iter().fold(f64::NEG_INFINITY, f64::max),
        cosine: d.dot(normal).abs() / (d.length() * normal.length()),
    })
}

/// A hit of the naive watertight test.
#[derive(Clone, Copy, Debug)]
pub struct Award {
    /// The distance, exact for the sheared corners but for `f64`.
    pub t: f64,
    /// By how much a computation in `f32` may miss `t`.
    pub slack: f64,
}

/// The test of Woop, Benthin and Wald 2013 with exact signs and without a box: the corners are
/// sheared in `f32`, which defines the answer, and all else is done in `f64`, where the products of
/// two `f32` are exact. Takes the whole line: `t` may be negative.
pub fn woop(ray: &Ray, corners: [Vec3; 3]) -> Option<Award> {
    let (o, d) = (ray.origin.to_array(), ray.dir.to_array());
    let z = (1..3).fold(0, |best, k| if d[k].abs() > d[best].abs() { k } else { best });
    let (x, y) = ((z + 1) % 3, (z + 2) % 3);
    let sheared = corners.map(|corner| {
        let p = corner.to_array();
        let along = p[z] - o[z];
        let (slope_x, slope_y) = (d[x] / d[z], d[y] / d[z]);
        [(p[x] - o[x]) - slope_x * along, (p[y] - o[y]) - slope_y * along, along].map(f64::from)
    });
    let (mut edges, mut products) = ([0.0; 3], [0.0; 3]);
    for i in 0..3 {
        let ([px, py, _], [qx, qy, _]) = (sheared[(i + 1) % 3], sheared[(i + 2) % 3]);
        edges[i] = px * qy - py * qx;
        products[i] = (px * qy).abs() + (py * qx).abs();
    }
    if edges.iter().any(|&e| e < 0.0) && edges.iter().any(|&e| e > 0.0) {
        return None;
    }
    let det: f64 = edges.iter().sum();
    if det == 0.0 {
        return None;
    }
    let weighted = |weights: [f64; 3]| (0..3).map(|i| weights[i] * sheared[i][2]).sum::<f64>();
    let along = weighted(edges) / det;
    // Each edge function is off by the rounding of its products and of their difference; then
    // come a dozen roundings of what is made of them.
    let from_edges = (0..3).map(|i| 2.0 * products[i] * (sheared[i][2] - along).abs()).sum::<f64>();
    let greatest = sheared.iter().fold(0.0, |max: f64, corner| max.max(corner[2].abs()));
    let relative = ROUNDOFF * (from_edges / det.abs() + 12.0 * greatest);
    // Of needles next to nothing wide, products underflow.
    let absolute = 8.0 * f64::from(f32::from_bits(1)) * (1.0 + greatest) / det.abs();
    let slack = (relative + absolute) / f64::from(d[z]).abs();
    Some(Award { t: along / f64::from(d[z]), slack })
}

/// Where a line enters a box, axis by axis: what the documentation of the crate says of a hit's
/// least `t`.
pub fn entry(ray: &Ray, aabb: &Aabb) -> f32 {
    let (o, d) = (ray.origin.to_array(), ray.dir.to_array());
    let mut entry = f32::NEG_INFINITY;
    for k in 0..3 {
        let near = aabb.axes[k][usize::from(d[k].is_sign_negative())];
        let t = (near - o[k]) * (1.0 / d[k]);
        // A NaN is a ray in the plane of a side: it enters through others.
        if t > entry {
            entry = t;
        }
    }
    entry
}

/// Where a line meets a sphere.
#[derive(Clone, Copy, Debug)]
pub struct Roots {
    /// Entry and exit; NaN if the line passes by.
    pub t: [f64; 2],
    /// The line's distance from the centre, in radii.
    pub passes: f64,
}

/// The schoolbook's roots, in `f64`.
pub fn sphere(ray: &Ray, sphere: &Sphere) -> Roots {
    let d = ray.dir.as_dvec3();
    let l = sphere.center.as_dvec3() - ray.origin.as_dvec3();
    let radius = f64::from(sphere.radius);
    let nearest = l.dot(d) / d.length_squared();
    let passes = l.cross(d).length() / d.length() / radius;
    let half = radius * (1.0 - passes * passes).sqrt() / d.length();
    Roots { t: [nearest - half, nearest + half], passes }
}

/// How a ray meets a cone or cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encounter {
    /// Where it first does.
    pub t: Option<f64>,
    /// Whether it is inside where it comes between the ends, or starts there.
    pub inside: bool,
}

/// By the schoolbook's roots, in `f64`, of a ray that is moved by so much.
pub fn cone(ray: &Ray, moved: DVec3, cone: &Cone) -> Encounter {
    let (base, apex) = (cone.base.as_dvec3(), cone.apex.as_dvec3());
    let axis = (apex - base).normalize();
    let [base_radius, apex_radius] = [cone.base_radius, cone.apex_radius].map(f64::from);
    let height = (apex - base).length();
    let slope = (apex_radius - base_radius) / height;
    let (place, dir) = (ray.origin.as_dvec3() + moved - base, ray.dir.as_dvec3());
    let (z, dz) = (place.dot(axis), dir.dot(axis));
    let (p, e) = (place - axis * z, dir - axis * dz);
    // |p + e t|² = (base_radius + slope (z + dz t))²
    let (width, widening) = (base_radius + slope * z, slope * dz);
    let a = e.dot(e) - widening * widening;
    let b = p.dot(e) - width * widening;
    let c = p.dot(p) - width * width;
    let root = (b * b - a * c).sqrt();
    let q = -(b + root.copysign(b));
    let counts = |t: &f64| *t >= f64::from(ray.tmin) && (0.0..=height).contains(&(z + dz * t));
    let t = [c / q, q / a].into_iter().filter(counts).min_by(f64::total_cmp);

    let first_end = if dz > 0.0 { -z / dz } else { (height - z) / dz };
    let start = first_end.max(ray.tmin.into());
    Encounter { t, inside: (p + e * start).length() < width + widening * start }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::aim;

    #[test]
    fn all_agree_on_a_plain_hit() {
        let corners = [Vec3::ZERO, Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 4.0, 0.0)];
        let ray = aim::at(Vec3::new(1.0, 2.0, 8.0), Vec3::new(1.0, 2.0, 4.0));
        assert_eq!(moller_trumbore(&ray, corners), Some(2.0));
        let meeting = plane(&ray, corners).expect("not parallel");
        assert_eq!((meeting.t, meeting.weights), (2.0, [0.25, 0.25, 0.5]));
        assert!(meeting.outside < 0.0);
        let award = woop(&ray, corners).expect("a hit");
        assert!(award.t == 2.0 && award.slack < 1e-5, "{award:?}");
        let past = aim::at(Vec3::new(3.0, 2.0, 8.0), Vec3::new(3.0, 2.0, 4.0));
        assert_eq!(moller_trumbore(&past, corners), None);
        assert!(plane(&past, corners).expect("not parallel").outside > 0.0);
        assert!(woop(&past, corners).is_none());
    }

    #[test]
    fn sphere_and_box() {
        let ray = aim::at(Vec3::new(0.0, 3.0, -10.0), Vec3::new(0.0, 3.0, -8.0));
        let roots = sphere(&ray, &Sphere { center: Vec3::ZERO, radius: 5.0 });
        assert_eq!((roots.t, roots.passes), ([3.0, 7.0], 0.6));
        let unit = Aabb::new(Vec3::splat(-4.0), Vec3::splat(4.0));
        assert_eq!(entry(&ray, &unit), 3.0);
        assert_eq!(ulps(1.0f32.next_up(), 1.0), 1.0);
    }
}
