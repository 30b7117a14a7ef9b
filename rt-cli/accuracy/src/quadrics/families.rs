//! Families of rays and curved surfaces for which the roots are hard to have.

use glam::{DVec3, Vec3};
use rt_kernels::geom::{Cone, Curved, Quadric, Sphere};
use rt_kernels::{Ray, Rays};

use crate::place::Place;
use crate::{BATCH, Facts, Kind, Setting};
use rt_kernels::reference::aim;
use rt_kernels::reference::random::Random;

/// Some rays, each of which is tested against one surface.
#[derive(Clone, Debug)]
pub struct Batch {
    /// The surface.
    pub surface: Curved,
    /// The rays: [`BATCH`] of them.
    pub rays: Rays,
}

/// What the surfaces of a family are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// Spheres, for every test.
    Sphere,
    /// Others, for the tests that take any.
    Quadric,
    /// Truncated cones and cylinders as scenes state them, for the test that takes them so.
    Cone,
}

/// A generator of rays and curved surfaces.
#[derive(Clone, Copy, Debug)]
pub struct QuadricFamily {
    pub(super) facts: Facts,
    /// What its surfaces are.
    pub shape: Surface,
    surface: fn(&mut Random, &Place) -> Curved,
    ray: fn(&mut Random, &Curved) -> Ray,
}

impl QuadricFamily {
    pub(super) const ALL: [QuadricFamily; 17] = [
        QuadricFamily {
            facts: Facts {
                name: "random",
                about: "a sphere seen from 2 to 16 radii away, by rays that hit it and rays that do not",
                kind: Kind::Natural,
                fair: true,
                setting: Setting::UNIT,
            },
            shape: Surface::Sphere,

            surface: sphere,
            ray: |random, surface| {
                let (reach, off) =
                    (2.0 + 14.0 * random.unit(), random.pick(&[0.95, 1.05, 1.5]) * random.unit());
                at_sphere(random, surface, reach, off)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "distant",
                about: "the same from 3 to 100,000 radii: the square of the radius against that of the distance",
                kind: Kind::Single,
                fair: true,
                setting: Setting::UNIT,
            },
            shape: Surface::Sphere,

            surface: sphere,
            ray: |random, surface| {
                let (reach, off) = (distant(random), 0.9 * random.unit());
                at_sphere(random, surface, reach, off)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "past",
                about: "from 3 to 100,000 radii, by rays that pass at 1.1 to 4 radii",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Sphere,

            surface: sphere,
            ray: |random, surface| {
                let (reach, off) = (distant(random), 1.1 + 2.9 * random.unit());
                at_sphere(random, surface, reach, off)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "grazing",
                about: "rays that pass the rim at 2^-20 to a half of the radius, inside and outside, from 3 to 100,000 radii",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Sphere,

            surface: sphere,
            ray: |random, surface| {
                let (reach, off) = (distant(random), 1.0 + f64::from(random.magnitude(-20, -2)));
                at_sphere(random, surface, reach, off)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "inside",
                about: "rays from within a sphere: one root ahead, one behind",
                kind: Kind::Single,
                fair: true,
                setting: Setting::UNIT,
            },
            shape: Surface::Sphere,

            surface: sphere,
            ray: |random, surface| {
                let (reach, off) = (0.9 * random.unit(), 2.0 * random.unit());
                at_sphere(random, surface, reach, off)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "near surface",
                about: "rays that start 2^-18 to a sixteenth of the radius off the surface: a root that is next to nothing",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Sphere,

            surface: sphere,
            ray: |random, surface| {
                let (reach, off) =
                    (1.0 + f64::from(random.magnitude(-18, -5)), 0.9 * random.unit());
                at_sphere(random, surface, reach, off)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "far",
                about: "a sphere of radius 1 at 220,000 from the world's origin, seen from nearby",
                kind: Kind::Single,
                fair: true,
                setting: Setting { offset: 2.2e5, ..Setting::UNIT },
            },
            shape: Surface::Sphere,

            surface: sphere,
            ray: |random, surface| {
                let (reach, off) = (2.0 + 14.0 * random.unit(), 0.9 * random.unit());
                at_sphere(random, surface, reach, off)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "ellipsoid",
                about: "half axes of 1/32 to 1, seen from 2 to 1,000 of them",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Quadric,

            surface: ellipsoid,
            ray: |random, surface| {
                let quadric = quadric(surface);
                let [x, y, z, ..] = quadric.matrix;
                let half = Vec3::new(x, y, z).map(|x| 1.0 / x.sqrt());
                let target = quadric.center + random.in_cube() * half;
                let away = half.max_element() * random.magnitude(1, 9);
                at_any_pace(target + random.direction() * away, target, random)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "cylinder",
                about: "cylinders of any direction, hit from outside and from within",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Quadric,

            surface: cylinder,
            ray: |random, surface| {
                let quadric = quadric(surface);
                let size = size(&quadric);
                let along = quadric.axis * (size * 2.0 * random.signed());
                let target = quadric.center + along + random.in_cube() * (0.5 * size);
                let away = size * random.magnitude(-2, 6).abs();
                at_any_pace(target + random.direction() * away, target, random)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "along axis",
                about: "rays along the axis of a cylinder, off it by 2^-30 to 1/2: a quadratic coefficient next to 0, or 0",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Quadric,

            surface: cylinder,
            ray: |random, surface| {
                let quadric = quadric(surface);
                let size = size(&quadric);
                let tilt = random.magnitude(-30, -2);
                let tilt = random.pick(&[0.0, tilt]);
                let from = quadric.center
                    + quadric.axis * (size * random.magnitude(1, 4))
                    + random.in_cube() * (0.5 * size);
                let to = if (from - quadric.center).dot(quadric.axis) > 0.0 { -1.0 } else { 1.0 };
                let dir = quadric.axis * to + random.direction() * tilt;
                at_any_pace(from, from + dir * size, random)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "clipped",
                about: "rays over the rim of a cylinder or cone: the first root is cut off, the second counts",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Quadric,

            surface: |random, place| {
                if random.below(2) == 0 { cylinder(random, place) } else { cone(random, place) }
            },
            ray: |random, surface| {
                let quadric = quadric(surface);
                let size = size(&quadric);
                // A point of the rim, or nearly so.
                let end = random.pick(&quadric.range);
                let side = random.direction().cross(quadric.axis).normalize();
                let width = if quadric.level == 0.0 { 0.5 * end } else { size };
                let rim = quadric.center + quadric.axis * end + side * width;
                let target = rim + random.direction() * (size * random.magnitude(-24, -2));
                at_any_pace(
                    target + random.direction() * (size * random.magnitude(0, 5)),
                    target,
                    random,
                )
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "cone",
                about: "cones of any direction, hit from outside and from within",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Quadric,

            surface: cone,
            ray: |random, surface| {
                let quadric = quadric(surface);
                let size = size(&quadric);
                let along = quadric.axis * (size * random.unit() as f32);
                let target = quadric.center + along + random.in_cube() * (0.25 * size);
                let away = size * random.magnitude(-2, 6).abs();
                at_any_pace(target + random.direction() * away, target, random)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "apex",
                about: "rays aimed at the apex of a cone, where both roots are one, or past it by 2^-24 to 1/4",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Quadric,

            surface: cone,
            ray: |random, surface| {
                let quadric = quadric(surface);
                let size = size(&quadric);
                let off = random.direction() * (size * random.magnitude(-24, -2));
                let target = quadric.center + off;
                at_any_pace(
                    target + random.direction() * (size * random.magnitude(-1, 5)),
                    target,
                    random,
                )
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "truncated cone",
                about: "truncated cones and cylinders seen from 2 to 16 times their size away, by rays that hit them and rays that do not",
                kind: Kind::Natural,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Cone,

            surface: truncated_cone,
            ray: |random, surface| {
                let (along, off) = (random.unit() as f32, random.magnitude(-2, 0));
                let away = 2.0 + 14.0 * random.unit();
                at_mantle(random, surface, along, off, away)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "distant cone",
                about: "the same from 3 to 100,000 times their size",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Cone,

            surface: truncated_cone,
            ray: |random, surface| {
                let (along, off) = (random.unit() as f32, random.magnitude(-2, 0));
                let away = distant(random);
                at_mantle(random, surface, along, off, away)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "side of a cone",
                about: "rays that touch the mantle, or pass it at 2^-24 to 1/4 of its size",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Cone,

            surface: truncated_cone,
            ray: |random, surface| {
                let (along, off) = (random.unit() as f32, random.magnitude(-24, -2));
                let away = f64::from(random.magnitude(0, 5).abs());
                at_mantle(random, surface, along, off, away)
            },
        },
        QuadricFamily {
            facts: Facts {
                name: "rim of a cone",
                about: "the same at its ends, tips too",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            shape: Surface::Cone,

            surface: truncated_cone,
            ray: |random, surface| {
                let (along, off) = (random.pick(&[0.0, 1.0]), random.magnitude(-24, -2));
                let away = f64::from(random.magnitude(0, 5).abs());
                at_mantle(random, surface, along, off, away)
            },
        },
    ];

    /// Batch number `i`.
    pub fn batch(&self, setting: &Setting, i: usize) -> Batch {
        let mut random = setting.stream(i);
        let place = Place::new(setting, &mut random).upright();
        let surface = (self.surface)(&mut random, &place);
        Batch { rays: (0..BATCH).map(|_| (self.ray)(&mut random, &surface)).collect(), surface }
    }
}

/// How far away a distant origin is, in radii: from 3 to 100,000.
fn distant(random: &mut Random) -> f64 {
    // 3 · 2^15.02 is 100,000.
    3.0 * f64::from(random.magnitude(0, 14).abs())
}

/// Somewhere near the middle of things.
fn centered(random: &mut Random) -> DVec3 {
    random.in_cube().as_dvec3() * random.pick(&[0.0, 1.0])
}

/// How long the unit of the place is.
fn scale(place: &Place) -> f32 {
    (place.point(DVec3::X) - place.point(DVec3::ZERO)).abs().max_element()
}

fn sphere(random: &mut Random, place: &Place) -> Curved {
    let radius = random.magnitude(-2, 0).abs() * scale(place);
    Curved::Sphere(Sphere { center: place.point(centered(random)), radius })
}

fn ellipsoid(random: &mut Random, place: &Place) -> Curved {
    let half = [(); 3].map(|()| random.magnitude(-5, -1).abs() * scale(place));
    Curved::Quadric(Quadric::ellipsoid(place.point(centered(random)), Vec3::from_array(half)))
}

/// Twice as long as it is wide.
fn cylinder(random: &mut Random, place: &Place) -> Curved {
    let radius = random.magnitude(-2, 0).abs() * scale(place);
    let axis = axis(random);
    let center = place.point(centered(random));
    Curved::Quadric(Quadric::cylinder(center, axis, radius, 2.0 * radius))
}

/// As wide as it is high.
fn cone(random: &mut Random, place: &Place) -> Curved {
    let height = random.magnitude(-2, 0).abs() * scale(place);
    let axis = axis(random);
    Curved::Quadric(Quadric::cone(place.point(centered(random)), axis, 0.5, height))
}

/// A tip at the apex, or a cylinder, or any.
fn truncated_cone(random: &mut Random, place: &Place) -> Curved {
    let [length, base_radius, other] =
        [(); 3].map(|()| random.magnitude(-3, 0).abs() * scale(place));
    let base = place.point(centered(random));
    let apex = base + axis(random) * length;
    let apex_radius = random.pick(&[0.0, base_radius, other]);
    Curved::Cone(Cone { base, base_radius, apex, apex_radius })
}

/// Any direction, or that of an axis.
fn axis(random: &mut Random) -> Vec3 {
    let any = random.direction();
    random.pick(&[any, Vec3::X, Vec3::NEG_Y, Vec3::Z])
}

fn quadric(surface: &Curved) -> Quadric {
    match *surface {
        Curved::Sphere(sphere) => sphere.into(),
        Curved::Quadric(quadric) => quadric,
        Curved::Cone(_) => unreachable!("its families have rays of their own"),
    }
}

/// The radius of a cylinder, the height of a cone.
fn size(quadric: &Quadric) -> f32 {
    if quadric.level > 0.0 { quadric.level.sqrt() } else { quadric.range[1] }
}

/// A ray that starts `reach` radii from a sphere's centre and is aimed `off` radii past it.
fn at_sphere(random: &mut Random, surface: &Curved, reach: f64, off: f64) -> Ray {
    let quadric = quadric(surface);
    let radius = size(&quadric);
    let (from, across) = (random.direction(), random.direction());
    let across = across.cross(from).normalize();
    let origin = quadric.center + from * (radius * reach as f32);
    let target = quadric.center + across * (radius * off as f32);
    at_any_pace(origin, target, random)
}

/// A ray to a point of the mantle, that far `along` from the base to the apex, or `off` it by as many
/// sizes, from as many sizes `away`: where it comes from is any side.
fn at_mantle(random: &mut Random, surface: &Curved, along: f32, off: f32, away: f64) -> Ray {
    let &Curved::Cone(cone) = surface else { unreachable!("a family of cones has cones") };
    let (axis, radii) = (cone.apex - cone.base, [cone.base_radius, cone.apex_radius]);
    let size = axis.length().max(radii[0]).max(radii[1]);
    let side = random.direction().cross(axis).normalize();
    let radius = radii[0] + (radii[1] - radii[0]) * along;
    let target = cone.base + axis * along + side * radius + random.direction() * (size * off);
    let from = random.direction();
    // Half of them graze: they come at right angles to what points outwards.
    let from = random.pick(&[from, from.cross(side).normalize()]);
    at_any_pace(target + from * (size * away as f32), target, random)
}

/// From one point through another.
fn at_any_pace(origin: Vec3, target: Vec3, random: &mut Random) -> Ray {
    let exponent = random.below(9) as i32 - 4;
    aim::paced(aim::at(origin, target), exponent)
}
