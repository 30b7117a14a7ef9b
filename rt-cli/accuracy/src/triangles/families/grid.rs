//! Grids of squares, each of two triangles: what CAD models and height fields are made of.

use glam::DVec3;
use rt_kernels::Ray;
use rt_kernels::geom::Triangle;

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

pub(super) const SPLIT_PLANE: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "split plane",
        about: "triangles in one plane, and rays in a plane across it that their edges lie in: where kd-trees split",
        kind: Kind::Closed,
        fair: true,
        setting: Setting::UNIT,
    },
    make: |random, place| {
        *place = place.clone().upright();
        in_planes(random, place)
    },
};

fn corner(random: &mut Random) -> f64 {
    random.below(33) as f64 - 16.0
}

/// Two by two squares about a vertex.
fn squares(place: &mut Place, [x, y]: [f64; 2]) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for (dx, dy) in [(-1.0, -1.0), (0.0, -1.0), (-1.0, 0.0), (0.0, 0.0)] {
        let at =
            |place: &Place, u: f64, v: f64| place.point(DVec3::new(x + dx + u, y + dy + v, 0.0));
        let [a, b] = [at(place, 0.0, 0.0), at(place, 1.0, 0.0)];
        let [c, d] = [at(place, 1.0, 1.0), at(place, 0.0, 1.0)];
        triangles.push(place.triangle([a, b, c]));
        triangles.push(place.triangle([a, c, d]));
    }
    triangles
}

/// Squares seen from a plane before them: by parallel rays and by others.
fn grid(random: &mut Random, place: &mut Place) -> Batch {
    let [x, y] = [(); 2].map(|()| corner(random));
    let triangles = squares(place, [x, y]);
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

/// Squares seen from points in the plane of one of their common edges, along it.
fn in_planes(random: &mut Random, place: &mut Place) -> Batch {
    let [x, y] = [(); 2].map(|()| corner(random));
    let triangles = squares(place, [x, y]);
    let rays = (0..BATCH).map(|i| {
        let dyadic = |random: &mut Random| random.below(33) as f64 / 16.0 - 1.0;
        let [from, to] = [dyadic(random) * 4.0, dyadic(random)];
        let origin = place.point(DVec3::new(x, y + from, 8.0));
        let mut ray = place.ray(origin, place.point(DVec3::new(x, y + to, 0.0)));
        if i % 2 == 0 {
            // Zeros of the other sign.
            ray.dir = ray.dir.map(|d| if d == 0.0 { -d } else { d });
        }
        ray
    });
    Batch { rays: rays.collect(), triangles }
}
