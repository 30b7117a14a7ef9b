//! Families of rays and boxes that are hard on slab tests.
//!
//! Numbers stay in the range for which the kernels promise anything: the greatest component of a
//! direction is between 2^-20 and 2^20, and an origin that is not on a plane is no nearer to it
//! than rounding makes it.

use glam::{DVec3, Vec3};
use rt_kernels::geom::Aabb;
use rt_kernels::{Ray, Rays};

use crate::place::Place;
use crate::{BATCH, Facts, Kind, Setting};
use rt_kernels::reference::aim;
use rt_kernels::reference::random::{Random, power};

/// Some rays, each of which is tested against one box.
#[derive(Clone, Debug)]
pub struct Batch {
    /// The box.
    pub aabb: Aabb,
    /// The rays: [`BATCH`] of them.
    pub rays: Rays,
}

/// A generator of rays and boxes.
#[derive(Clone, Copy, Debug)]
pub struct BoxFamily {
    pub(super) facts: Facts,
    aabb: fn(&mut Random, &Place) -> Aabb,
    ray: fn(&mut Random, &Aabb) -> Ray,
}

impl BoxFamily {
    pub(super) const ALL: [BoxFamily; 15] = [
        BoxFamily {
            facts: Facts {
                name: "interior",
                about: "rays from outside through the inside",
                kind: Kind::Natural,
                fair: true,
                setting: Setting::UNIT,
            },
            aabb: solid,
            ray: |random, aabb| {
                let target = inside(random, aabb);
                at_any_pace(around(random, aabb, target, 1, 6), target, random)
            },
        },
        BoxFamily {
            facts: Facts {
                name: "random",
                about: "rays between any two points: what happens by nature",
                kind: Kind::Natural,
                fair: true,
                setting: Setting::UNIT,
            },
            aabb: solid,
            ray: |random, aabb| {
                let center = (aabb.min() + aabb.max()) * 0.5;
                let size = aabb.extent().max_element();
                let [from, to] = [(); 2].map(|()| center + random.in_cube() * (2.0 * size));
                at_any_pace(from, to, random)
            },
        },
        BoxFamily {
            facts: Facts {
                name: "edge",
                about: "rays aimed at points of an edge, past two sides of the box",
                kind: Kind::Single,
                fair: true,
                setting: Setting::UNIT,
            },
            aabb: solid,
            ray: past_edge,
        },
        BoxFamily {
            facts: Facts {
                name: "corner",
                about: "rays aimed at a corner, where three sides meet",
                kind: Kind::Single,
                fair: true,
                setting: Setting::UNIT,
            },
            aabb: solid,
            ray: |random, aabb| {
                let target = on(random, aabb, 3);
                at_any_pace(around(random, aabb, target, -2, 8), target, random)
            },
        },
        BoxFamily {
            facts: Facts {
                name: "band",
                about: "rays that pass an edge at 1e-8 to 1e-2 of the box's size, inside and outside",
                kind: Kind::Single,
                fair: true,
                setting: Setting::UNIT,
            },
            aabb: solid,
            ray: |random, aabb| {
                let size = aabb.extent().max_element();
                let off = random.direction() * (size * random.magnitude(-27, -7));
                let target = on(random, aabb, 2) + off;
                at_any_pace(around(random, aabb, target, 0, 6), target, random)
            },
        },
        BoxFamily {
            facts: Facts {
                name: "far",
                about: "edges and corners of a box of size 1 that is 220,000 from the world's origin",
                kind: Kind::Single,
                fair: true,
                setting: Setting { offset: 2.2e5, ..Setting::UNIT },
            },
            aabb: solid,
            ray: past_edge,
        },
        BoxFamily {
            facts: Facts {
                name: "very far",
                about: "the same at a million, where coordinates are rounded to a sixteenth",
                kind: Kind::Single,
                fair: true,
                setting: Setting { offset: 1e6, ..Setting::UNIT },
            },
            aabb: solid,
            ray: past_edge,
        },
        BoxFamily {
            facts: Facts {
                name: "tiny",
                about: "edges and corners of a box of size 1e-6",
                kind: Kind::Single,
                fair: true,
                setting: Setting { scale: 1e-6, ..Setting::UNIT },
            },
            aabb: solid,
            ray: past_edge,
        },
        BoxFamily {
            facts: Facts {
                name: "immense",
                about: "edges and corners of a box of size 2^38, near the end of the range",
                kind: Kind::Single,
                fair: true,
                setting: Setting { scale: (1u64 << 38) as f32, ..Setting::UNIT },
            },
            aabb: solid,
            ray: past_edge,
        },
        BoxFamily {
            facts: Facts {
                name: "flat",
                about: "boxes without extent on one axis or two, hit in their inside and at their edges",
                kind: Kind::Single,
                fair: true,
                setting: Setting::UNIT,
            },
            aabb: flat,
            ray: |random, aabb| {
                let target = match random.below(3) {
                    0 => on(random, aabb, 2),
                    _ => inside(random, aabb),
                };
                at_any_pace(around(random, aabb, target, -1, 6), target, random)
            },
        },
        BoxFamily {
            facts: Facts {
                name: "axis",
                about: "rays along an axis, with zeros of both signs, in sides, along edges and beside them",
                kind: Kind::Single,
                fair: true,
                setting: Setting::UNIT,
            },
            aabb: solid_or_flat,
            ray: |random, aabb| {
                let sides = random.below(3);
                let target = on(random, aabb, sides);
                let axis = random.below(3);
                let mut origin = target;
                origin[axis] += aabb.extent().max_element() * random.magnitude(0, 6);
                let mut ray = aim::at(origin, target);
                for k in 0..3 {
                    if k != axis {
                        ray.dir[k] = random.pick(&[0.0, -0.0]);
                        if random.below(4) == 0 {
                            ray.origin[k] =
                                random.pick(&[origin[k].next_up(), origin[k].next_down()]);
                        }
                    }
                }
                ray
            },
        },
        BoxFamily {
            facts: Facts {
                name: "on plane",
                about: "origins in the plane of a side, where 0 · ∞ is NaN: directions along it, ±0 or subnormal",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            aabb: solid_or_flat,
            ray: |random, aabb| {
                let sides = 1 + random.below(2);
                let mut target = inside(random, aabb);
                let mut origin = around(random, aabb, target, -1, 3);
                let first = random.below(3);
                let mut ray = aim::at(origin, target);
                for k in [first, (first + 1) % 3].into_iter().take(sides) {
                    let side = aabb.axes[k][random.below(2)];
                    (origin[k], target[k]) = (side, side);
                    ray = aim::at(origin, target);
                }
                for k in [first, (first + 1) % 3].into_iter().take(sides) {
                    let subnormal = f32::from_bits(1 + random.below(1 << 22) as u32);
                    ray.dir[k] = random.pick(&[0.0, -0.0, subnormal, -subnormal]);
                }
                ray
            },
        },
        BoxFamily {
            facts: Facts {
                name: "slow",
                about: "directions of which a component or two are 2^-149 to 2^-20: reciprocals that overflow",
                kind: Kind::Single,
                fair: false,
                setting: Setting::UNIT,
            },
            aabb: solid,
            ray: |random, aabb| {
                let sides = random.below(3);
                let target = on(random, aabb, sides);
                let origin = around(random, aabb, target, -1, 3);
                let mut ray = aim::at(origin, target);
                let first = random.below(3);
                let some = 1 + random.below(2);
                for k in [first, (first + 1) % 3].into_iter().take(some) {
                    let exponent = random.below(130) as i32;
                    // In two steps, for the subnormal ones.
                    let least = random.magnitude(-20 - exponent.min(100), -20);
                    ray.dir[k] = least * power(-(exponent - 100).max(0));
                    if random.below(2) == 0 {
                        ray.origin[k] = target[k];
                    }
                }
                ray
            },
        },
        BoxFamily {
            facts: Facts {
                name: "inside",
                about: "rays that start inside, on a side, an edge or a corner, and stay or leave",
                kind: Kind::Single,
                fair: true,
                setting: Setting::UNIT,
            },
            aabb: solid,
            ray: |random, aabb| {
                let sides = random.below(4);
                let from = on(random, aabb, sides);
                at_any_pace(from, from + random.direction() * aabb.extent().max_element(), random)
            },
        },
        BoxFamily {
            facts: Facts {
                name: "ends",
                about: "rays that end where they enter the box or start where they leave it",
                kind: Kind::Single,
                fair: true,
                setting: Setting::UNIT,
            },
            aabb: solid,
            ray: |random, aabb| {
                let target = on(random, aabb, 1);
                let origin = around(random, aabb, target, -1, 4);
                let ray = at_any_pace(origin, target, random);
                // About where the target is.
                let axis = ray.dir.abs().max_position();
                let t = (target[axis] - origin[axis]) / ray.dir[axis];
                let t = random.pick(&[t, t.next_up(), t.next_down(), t * 0.5]).max(0.0);
                if random.below(2) == 0 { Ray { tmax: t, ..ray } } else { Ray { tmin: t, ..ray } }
            },
        },
    ];

    /// Batch number `i`.
    pub fn batch(&self, setting: &Setting, i: usize) -> Batch {
        let mut random = setting.stream(i);
        let place = Place::new(setting, &mut random).upright();
        let aabb = (self.aabb)(&mut random, &place);
        Batch { rays: (0..BATCH).map(|_| (self.ray)(&mut random, &aabb)).collect(), aabb }
    }
}

/// Through a point of an edge.
fn past_edge(random: &mut Random, aabb: &Aabb) -> Ray {
    let target = on(random, aabb, 2);
    let origin = around(random, aabb, target, -2, 8);
    at_any_pace(origin, target, random)
}

/// A box of size 1/64 to 1 on each axis.
fn solid(random: &mut Random, place: &Place) -> Aabb {
    let a = random.in_cube().as_dvec3();
    let size = [(); 3].map(|()| f64::from(random.magnitude(-6, -1)));
    spanned(place, a, a + DVec3::from_array(size))
}

/// One without extent on one axis or two.
fn flat(random: &mut Random, place: &Place) -> Aabb {
    let Aabb { mut axes } = solid(random, place);
    let first = random.below(3);
    for axis in [first, (first + 1) % 3].into_iter().take(1 + random.below(2)) {
        axes[axis][1] = axes[axis][0];
    }
    Aabb { axes }
}

fn solid_or_flat(random: &mut Random, place: &Place) -> Aabb {
    if random.below(2) == 0 { solid(random, place) } else { flat(random, place) }
}

fn spanned(place: &Place, a: DVec3, b: DVec3) -> Aabb {
    Aabb::point(place.point(a)).union(&Aabb::point(place.point(b)))
}

/// A point well within the box, on the axes on which there is a within.
fn inside(random: &mut Random, aabb: &Aabb) -> Vec3 {
    let at = |random: &mut Random| 0.05 + 0.9 * random.unit();
    Vec3::from_array(aabb.axes.map(|[low, high]| between(low, high, at(random))))
}

/// A point of the box that is exactly on so many sides.
fn on(random: &mut Random, aabb: &Aabb, sides: usize) -> Vec3 {
    let mut point = inside(random, aabb);
    let first = random.below(3);
    for k in [first, (first + 1) % 3, (first + 2) % 3].into_iter().take(sides) {
        point[k] = random.pick(&aabb.axes[k]);
    }
    point
}

fn between(low: f32, high: f32, s: f64) -> f32 {
    let (a, b) = (f64::from(low), f64::from(high));
    (a + (b - a) * s) as f32
}

/// A point in any direction from another, 2^`low` to 2^`high` sizes of the box away.
fn around(random: &mut Random, aabb: &Aabb, point: Vec3, low: i32, high: i32) -> Vec3 {
    let away = aabb.extent().max_element() * random.magnitude(low, high);
    point + random.direction() * away
}

/// From one point through another, at any pace in the range.
fn at_any_pace(origin: Vec3, target: Vec3, random: &mut Random) -> Ray {
    aim::paced(aim::at(origin, target), random.pick(&[-20, -3, 0, 0, 0, 5, 19]))
}
