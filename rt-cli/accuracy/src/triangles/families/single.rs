//! One triangle, and rays for which it is hard to tell.

use glam::{DVec3, Vec3};
use rt_kernels::Ray;
use rt_kernels::geom::Triangle;

use super::{Batch, TriangleFamily};
use crate::place::Place;
use crate::{BATCH, Facts, Kind, Setting};
use rt_kernels::reference::random::Random;

pub(super) const BAND: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "band",
        about: "rays that pass an edge at 1e-8 to 1e-2 of the triangle's size, inside and outside",
        kind: Kind::Single,
        fair: false,
        setting: Setting::UNIT,
    },
    make: |random, place| {
        let [a, b, c] = fair(random);
        batch(random, place, [a, b, c], |random| {
            let edge = a.lerp(b, random.unit());
            let off = random.direction().as_dvec3() * f64::from(random.magnitude(-27, -7));
            let from = random.direction().as_dvec3() * f64::from(random.magnitude(0, 3));
            [edge + off + from, edge + off]
        })
    },
};

pub(super) const EDGE_ON: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "edge-on",
        about: "rays that nearly run in the triangle's plane, from 16 to 16,000 sizes away",
        kind: Kind::Single,
        fair: false,
        setting: Setting::UNIT,
    },
    make: |random, place| {
        let [a, b, c] = fair(random);
        let normal = (b - a).cross(c - a).normalize();
        batch(random, place, [a, b, c], |random| {
            let target = inside([a, b, c], random);
            let along = (b - a).lerp(c - a, random.unit()).normalize();
            let rise = normal * f64::from(random.magnitude(-20, -4));
            [target + (along + rise) * f64::from(random.magnitude(4, 14)), target]
        })
    },
};

pub(super) const SPAWNED: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "spawned",
        about: "rays that leave a point of the triangle, moved off by 64 roundoffs: none may meet it again",
        kind: Kind::Single,
        fair: false,
        setting: Setting::UNIT,
    },
    make: spawned,
};

pub(super) const DEGENERATE: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "degenerate",
        about: "triangles without area, or without more of it than rounding gives, from everywhere",
        kind: Kind::Broken,
        fair: false,
        setting: Setting::UNIT,
    },
    make: degenerate,
};

pub(super) const NOT_FINITE: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "not finite",
        about: "rays and corners with a NaN or an infinity in them, and rays that go nowhere",
        kind: Kind::Broken,
        fair: false,
        setting: Setting::UNIT,
    },
    make: not_finite,
};

/// A triangle of size about 1 with no sharp corner.
fn fair(random: &mut Random) -> [DVec3; 3] {
    loop {
        let [a, b, c] = [(); 3].map(|()| random.in_cube().as_dvec3());
        if (b - a).cross(c - a).length() > 0.5 {
            return [a, b, c];
        }
    }
}

/// A point inside.
fn inside([a, b, c]: [DVec3; 3], random: &mut Random) -> DVec3 {
    let [u, v, w] = [(); 3].map(|()| 0.05 + random.unit());
    (a * u + b * v + c * w) / (u + v + w)
}

/// One triangle and rays, each from an origin through a target.
fn batch(
    random: &mut Random,
    place: &mut Place,
    corners: [DVec3; 3],
    mut ray: impl FnMut(&mut Random) -> [DVec3; 2],
) -> Batch {
    let corners = corners.map(|corner| place.point(corner));
    let triangles = vec![place.triangle(corners)];
    let rays = (0..BATCH).map(|_| {
        let [origin, target] = ray(random).map(|point| place.point(point));
        place.ray(origin, target)
    });
    Batch { rays: rays.collect(), triangles }
}

/// As a renderer spawns them: from a rounded point of the plane, along the normal, in `f32`.
fn spawned(random: &mut Random, place: &mut Place) -> Batch {
    let unit = fair(random);
    let corners = unit.map(|corner| place.point(corner));
    let triangle = place.triangle(corners);
    let [a, b, c] = triangle.corners;
    let normal = (b - a).cross(c - a).normalize();
    let extent = (b - a).abs().max((c - a).abs()).max_element();
    let rays = (0..BATCH).map(|_| {
        let point = place.point(inside(unit, random));
        let side = random.pick(&[1.0, -1.0]);
        let offset = 64.0 / (1 << 24) as f32 * (point.abs().max_element() + extent);
        let dir = random.direction();
        let dir = if dir.dot(normal) * side < 0.0 { -dir } else { dir };
        place.paced(Ray::new(point + normal * (side * offset), dir))
    });
    Batch { rays: rays.collect(), triangles: vec![triangle] }
}

fn degenerate(random: &mut Random, place: &mut Place) -> Batch {
    let [a, b, _] = fair(random);
    let corners = match random.below(5) {
        0 => [a, a, b],
        1 => [a, b, a],
        2 => [a; 3],
        3 => {
            // Exactly in line.
            *place = place.clone().upright();
            let [a, b] = [a, b].map(|p| (p * 64.0).round() / 64.0);
            [a, b, a + (b - a) * random.pick(&[2.0, 0.5, -1.0])]
        }
        _ => [a, b, a.lerp(b, random.unit())],
    };
    let mut i = 0;
    batch(random, place, corners, |random| {
        i += 1;
        let target = a.lerp(b, random.unit());
        match i % 4 {
            0 => [a - (b - a), a],
            1 => [target + (b - a), target],
            _ => [target + random.direction().as_dvec3() * 2.0, target],
        }
    })
}

fn not_finite(random: &mut Random, place: &mut Place) -> Batch {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let unit = fair(random);
    let mut batch = batch(random, place, unit, |random| {
        let target = inside(unit, random);
        [target + random.direction().as_dvec3() * 4.0, target]
    });
    if random.below(2) == 0 {
        let [Triangle { corners }] = &mut batch.triangles[..] else { unreachable!() };
        corners[random.below(3)][random.below(3)] = random.pick(&bad);
        return batch;
    }
    batch.rays = (0..batch.rays.len())
        .map(|i| {
            let mut ray = batch.rays.get(i);
            match random.below(5) {
                0 => ray.dir = Vec3::new(0.0, -0.0, 0.0),
                1 | 2 => ray.origin[random.below(3)] = random.pick(&bad),
                _ => ray.dir[random.below(3)] = random.pick(&bad),
            }
            ray
        })
        .collect();
    batch
}
