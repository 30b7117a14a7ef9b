//! Grids of squares, each of two triangles: what CAD models and height fields are made of.

use glam::DVec3;
use rt_kernels::Ray;

use super::{Batch, TriangleFamily};
use crate::place::Place;
use crate::{BATCH, Facts, Kind, Setting};
use rt_kernels::reference::random::Random;

pub(super) const EXACT: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "grid",
        about: "integer vertices, and rays exactly through them and through edges and diagonals",
        kind: Kind::Closed,
        fair: true,
        setting: Setting::UNIT,
    },
    make: |random, place| {
        *place = place.clone().upright();
        grid(random, place)
    },
};

pub(super) const ROTATED: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "rotated grid",
        about: "the same grid, rotated and rounded, by another angle in each batch",
        kind: Kind::Closed,
        fair: true,
        setting: Setting::UNIT,
    },
    make: grid,
};

/// Two by two squares about a vertex, seen from a plane before it: by parallel rays and by others.
fn grid(random: &mut Random, place: &mut Place) -> Batch {
    let corner = |random: &mut Random| (random.below(33) as f64) - 16.0;
    let (x, y) = (corner(random), corner(random));
    let mut triangles = Vec::new();
    for (dx, dy) in [(-1.0, -1.0), (0.0, -1.0), (-1.0, 0.0), (0.0, 0.0)] {
        let at =
            |place: &Place, u: f64, v: f64| place.point(DVec3::new(x + dx + u, y + dy + v, 0.0));
        let [a, b] = [at(place, 0.0, 0.0), at(place, 1.0, 0.0)];
        let [c, d] = [at(place, 1.0, 1.0), at(place, 0.0, 1.0)];
        triangles.push(place.triangle([a, b, c]));
        triangles.push(place.triangle([a, c, d]));
    }
    let tilt = DVec3::new(corner(random), corner(random), 0.0) * 0.25;
    let straight = random.below(2) == 0;
    let rays = (0..BATCH).map(|i| {
        // Dyadic, so that every point of an upright grid is exact.
        let s = random.below(17) as f64 / 16.0 - 0.5;
        let (u, v) = random.pick(&[(0.0, 0.0), (s, 0.0), (0.0, s), (s, s)]);
        let target = DVec3::new(x + u, y + v, 0.0);
        let height = DVec3::new(0.0, 0.0, 8.0);
        let origin = match i % 2 {
            _ if straight => target + height,
            0 => target + height + tilt,
            _ => DVec3::new(x, y, 0.0).round() + height + tilt,
        };
        let ray: Ray = place.ray(place.point(origin), place.point(target));
        ray
    });
    Batch { rays: rays.collect(), triangles }
}
