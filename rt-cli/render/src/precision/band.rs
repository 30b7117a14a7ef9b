//! How far from an edge a ray may still be misjudged, as a camera sees it.

use glam::DVec3;
use rt_scene::{Scene, View};

use super::table::{ERRORS, Errors, ROUNDOFF};
use crate::Method;
use crate::fit::half_height;
use crate::world::corners;

/// What a method gets wrong in a picture, at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The triangle test.
    pub method: Method,
    /// The widest band of any edge, in units of the scene.
    pub band: f64,
    /// The farthest that a surface is found before or behind itself, along its normal, in units of
    /// the scene.
    pub depth: f64,
    /// The greater of the two where it looms largest, in pixels.
    pub pixels: f64,
}

/// The predictions for all methods, in the order of [`ERRORS`].
pub fn predict(scene: &Scene, view: &View, size: (u32, u32)) -> [Prediction; ERRORS.len()] {
    let sight = Sight::new(view, size);
    let mut all = ERRORS.map(|errors| Prediction {
        method: errors.method,
        band: 0.0,
        depth: 0.0,
        pixels: 0.0,
    });
    for triangle in &scene.mesh.triangles {
        let Some(seen) = Seen::new(corners(scene, triangle).map(|x| x.as_dvec3()), &sight) else {
            continue;
        };
        for (worst, errors) in all.iter_mut().zip(&ERRORS) {
            let (band, depth) = (seen.band(errors), seen.depth(errors));
            worst.band = worst.band.max(band);
            worst.depth = worst.depth.max(depth);
            worst.pixels = worst.pixels.max(band.max(depth) * seen.pixels);
        }
    }
    all
}

/// A camera.
struct Sight {
    eye: DVec3,
    /// The greatest coordinate of the eye.
    coordinate: f64,
    /// Pixels for each unit of length at distance 1, where the picture stretches them most: in its
    /// corners.
    pixels: f64,
}

impl Sight {
    fn new(view: &View, (width, height): (u32, u32)) -> Sight {
        let half = f64::from(half_height(view.fov_y));
        let half_width = half * f64::from(width) / f64::from(height);
        let stretch = 1.0 + half * half + half_width * half_width;
        Sight {
            eye: view.eye.as_dvec3(),
            coordinate: f64::from(view.eye.abs().max_element()),
            pixels: f64::from(height) / (2.0 * half) * stretch,
        }
    }
}

/// A triangle seen from an eye.
struct Seen {
    /// From the eye to the farthest corner.
    reach: f64,
    /// The greatest coordinate of triangle and eye.
    coordinate: f64,
    /// What the bands of the two edges at the first corner, and of the third, are multiplied by
    /// when they are seen end on: the cosecant of the least angle to a ray that meets the edge.
    cosecants: [f64; 2],
    /// What the band of the third edge is multiplied by, if it is what the others leave.
    remainder: f64,
    /// The longest edge over the least height.
    aspect: f64,
    /// The longest that a band can be: no ray that meets the own box is farther from the triangle,
    /// and none that meets the triangle farther inside.
    longest: f64,
    /// Pixels for each unit of length, at the nearest point.
    pixels: f64,
}

/// √3 and a bit: the diagonal of a cube, padded.
const DIAGONAL: f64 = 1.74;

impl Seen {
    /// `None` if two corners coincide, which no test hits.
    fn new(corners: [DVec3; 3], sight: &Sight) -> Option<Seen> {
        // Seen from the eye.
        let [a, b, c] = corners.map(|corner| corner - sight.eye);
        let (ab, ac, bc) = (b - a, c - a, c - b);
        let [ab_length, ac_length, bc_length] = [ab, ac, bc].map(DVec3::length);
        if ab_length.min(ac_length).min(bc_length) == 0.0 {
            return None;
        }
        let farthest = a.length().max(b.length()).max(c.length());
        let cosecant = |p: DVec3, q: DVec3, length: f64| {
            let off_line = p.cross(q).length() / length;
            p.length().max(q.length()) / off_line
        };
        let at_first = cosecant(a, b, ab_length).max(cosecant(a, c, ac_length));
        let third = cosecant(b, c, bc_length);

        let normal = ab.cross(ac);
        let area = normal.length();
        let longest = ab_length.max(ac_length).max(bc_length);
        let [low, high] = [a.min(b).min(c), a.max(b).max(c)];
        let off_box = low.max(-high).max(DVec3::ZERO).length();
        let off_plane = if area > 0.0 { a.dot(normal).abs() / area } else { 0.0 };
        let nearest = off_box.max(off_plane);
        let greatest = corners.map(|corner| corner.abs().max_element());
        Some(Seen {
            reach: farthest,
            coordinate: greatest.into_iter().fold(sight.coordinate, f64::max),
            cosecants: [at_first, third],
            remainder: (ab_length + ac_length) / bc_length,
            aspect: longest * longest / area,
            longest,
            pixels: sight.pixels / nearest,
        })
    }

    /// The widest band of an edge.
    fn band(&self, errors: &Errors) -> f64 {
        let base = self.roundings(errors.reach, errors);
        let [at_first, third] = if errors.end_on { self.cosecants } else { [1.0; 2] };
        let remainder = if errors.remainder { self.remainder } else { 1.0 };
        // What the first two edges are off, the third is off too.
        let widest = at_first.max(remainder.max(1.0) * at_first.max(third));
        (base * widest).min(DIAGONAL * self.longest + base)
    }

    /// How far the plane may seem to be from where it is.
    fn depth(&self, errors: &Errors) -> f64 {
        let base = self.roundings(errors.depth, errors);
        let slimness = if errors.slim { self.aspect } else { 1.0 };
        (base * slimness).min(DIAGONAL * self.longest + base)
    }

    fn roundings(&self, reach: f64, errors: &Errors) -> f64 {
        ROUNDOFF * (reach * self.reach + errors.coordinate * self.coordinate)
    }
}
