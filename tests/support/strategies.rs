//! Small scenes and rays to find fault with, for proptest.
//!
//! A ray is drawn before the scene is known, as a [`RayPlan`]: so both shrink by themselves.

use glam::Vec3;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::FileFailurePersistence;
use rt_kernels::geom::{Aabb, Cone, Sphere, Triangle};
use rt_kernels::{Primitives, Ray};

use crate::aim;
use crate::random::power;

/// Failures are saved beside the test's file and tried first from then on.
pub fn config() -> ProptestConfig {
    let saved = FileFailurePersistence::WithSource("regressions");
    ProptestConfig { failure_persistence: Some(Box::new(saved)), ..ProptestConfig::default() }
}

/// From no primitive to some forty, of all kinds, that share corners from a small pool: on an integer grid or anywhere, at any scale, near the origin or far from it.
pub fn scene() -> impl Strategy<Value = Primitives> {
    let grid = prop::array::uniform3((-3i8..=3).prop_map(f32::from));
    let anywhere = prop::array::uniform3(-1.0f32..1.0);
    let pool =
        prop_oneof![prop::collection::vec(grid, 3..9), prop::collection::vec(anywhere, 3..9)];
    (pool, place(), prop::collection::vec(shape(), 0..20)).prop_map(|(pool, place, shapes)| {
        let pool: Vec<Vec3> = pool.into_iter().map(|point| place.apply(point.into())).collect();
        let mut scene = Primitives::default();
        shapes.iter().for_each(|shape| shape.add_to(&mut scene, &pool, place.scale));
        scene
    })
}

/// Where a scene is, and how large.
#[derive(Clone, Copy, Debug)]
struct Place {
    scale: f32,
    offset: Vec3,
}

impl Place {
    fn apply(&self, point: Vec3) -> Vec3 {
        point * self.scale + self.offset
    }
}

fn place() -> impl Strategy<Value = Place> {
    let scale = prop_oneof![4 => Just(0), 1 => -20..=20i32].prop_map(power);
    let offset = prop_oneof![
        4 => Just(0.0f32),
        1 => -1000.0f32..1000.0,
        1 => -1e6f32..1e6,
        1 => Just(power(38)),
    ];
    (scale, prop::array::uniform3(offset))
        .prop_map(|(scale, offset)| Place { scale, offset: offset.into() })
}

/// One primitive, or copies of the one before.
#[derive(Clone, Debug)]
enum Shape {
    /// Any three of the pool: they may coincide.
    Triangle([Index; 3]),
    /// Three of the pool, in a plane across an axis.
    Flat([Index; 3], usize),
    /// Two of the pool, and a third corner within a few units in the last place of the line.
    Needle([Index; 2], f64, i8),
    /// About one of the pool.
    Sphere(Index, f32),
    /// From one of the pool to another, with these radii, unless they coincide.
    Cone([Index; 2], [f32; 2]),
    /// The last primitive of each kind once more, so many times.
    Copies(usize),
}

fn shape() -> impl Strategy<Value = Shape> {
    let three = any::<[Index; 3]>;
    let radius = prop_oneof![Just(1.0f32), Just(0.5), Just(1e-3), Just(30.0), 0.1f32..3.0];
    let radii = prop_oneof![
        Just([1.0, 1.0]),
        Just([0.5, 0.0]),
        Just([0.0, 2.0]),
        (0.1f32..3.0).prop_map(|radius| [radius; 2]),
        [1e-3f32..3.0, 1e-3f32..3.0],
    ];
    prop_oneof![
        6 => three().prop_map(Shape::Triangle),
        3 => (three(), 0..3usize).prop_map(|(three, axis)| Shape::Flat(three, axis)),
        2 => (any::<[Index; 2]>(), -0.2f64..1.2, -2i8..=2)
            .prop_map(|(ends, s, off)| Shape::Needle(ends, s, off)),
        3 => (any::<Index>(), radius).prop_map(|(center, radius)| Shape::Sphere(center, radius)),
        3 => (any::<[Index; 2]>(), radii).prop_map(|(ends, radii)| Shape::Cone(ends, radii)),
        1 => (1..20usize).prop_map(Shape::Copies),
    ]
}

impl Shape {
    fn add_to(&self, scene: &mut Primitives, pool: &[Vec3], scale: f32) {
        let triangle = match self {
            Shape::Triangle(three) => three.map(|i| *i.get(pool)),
            Shape::Flat(three, axis) => {
                let mut corners = three.map(|i| *i.get(pool));
                let level = corners[0][*axis];
                corners.iter_mut().for_each(|corner| corner[*axis] = level);
                corners
            }
            Shape::Needle(ends, s, off) => {
                let [a, b] = ends.map(|i| *i.get(pool));
                let mut c = aim::between(a, b, *s);
                for _ in 0..off.abs() {
                    c.x = if *off > 0 { c.x.next_up() } else { c.x.next_down() };
                }
                [a, b, c]
            }
            Shape::Sphere(center, radius) => {
                let center = *center.get(pool);
                scene.spheres.push(Sphere { center, radius: radius * scale });
                return;
            }
            Shape::Cone(ends, radii) => {
                let [base, apex] = ends.map(|i| *i.get(pool));
                let [base_radius, apex_radius] = radii.map(|radius| radius * scale);
                if base != apex {
                    scene.cones.push(Cone { base, base_radius, apex, apex_radius });
                }
                return;
            }
            Shape::Copies(count) => {
                let last = scene.clone();
                for _ in 0..*count {
                    scene.triangles.extend(last.triangles.last());
                    scene.spheres.extend(last.spheres.last());
                    scene.cones.extend(last.cones.last());
                }
                return;
            }
        };
        scene.triangles.push(Triangle { corners: triangle });
    }
}

/// A ray, but for the scene that it is aimed at.
#[derive(Clone, Debug)]
pub struct RayPlan {
    origin: Spot,
    target: Spot,
    /// Makes the direction parallel to an axis, or one component of it a special value.
    bend: Bend,
    /// The direction's length is multiplied by 2 to this.
    exponent: i32,
    /// The ends of the interval, in units of the distance to the target.
    interval: [f32; 2],
    /// What makes the ray invalid, perhaps.
    flaw: Flaw,
}

/// A place to start from or to aim at.
#[derive(Clone, Copy, Debug)]
enum Spot {
    Corner(Index, usize),
    Edge(Index, usize, f32),
    Inside(Index, f32, f32),
    BoxCorner(Index, u8),
    Near([f32; 3]),
    Far([f32; 3]),
    World,
}

#[derive(Clone, Copy, Debug)]
enum Bend {
    No,
    Along(usize),
    Component(usize, f32),
}

#[derive(Clone, Copy, Debug)]
enum Flaw {
    No,
    Origin(usize, f32),
    Dir(usize, f32),
    NoDir,
    TMin(f32),
    TMax(f32),
}

/// Any ray: most hit something, some are invalid.
pub fn ray() -> impl Strategy<Value = RayPlan> {
    let special = prop::sample::select(vec![0.0, -0.0, 1e-45, -1e-45, 1e-39, -1e-30, 1e-20]);
    let bend = prop_oneof![
        6 => Just(Bend::No),
        2 => (0..3usize).prop_map(Bend::Along),
        2 => (0..3usize, special).prop_map(|(axis, value)| Bend::Component(axis, value)),
    ];
    let exponent = prop_oneof![3 => Just(0), 1 => -15..=15i32];
    let interval = prop_oneof![
        6 => Just([0.0, f32::INFINITY]),
        1 => (0.0f32..2.0).prop_map(|end| [0.0, end]),
        1 => (0.0f32..1.5, 0.0f32..1.0).prop_map(|(start, length)| [start, start + length]),
    ];
    let infinite = || prop::sample::select(vec![f32::NAN, f32::INFINITY, f32::NEG_INFINITY]);
    let flaw = prop_oneof![
        24 => Just(Flaw::No),
        1 => (0..3usize, infinite()).prop_map(|(axis, value)| Flaw::Origin(axis, value)),
        1 => (0..3usize, infinite()).prop_map(|(axis, value)| Flaw::Dir(axis, value)),
        1 => Just(Flaw::NoDir),
        1 => prop::sample::select(vec![-1.0, -1e-45, f32::NAN, f32::NEG_INFINITY])
            .prop_map(Flaw::TMin),
        1 => prop::sample::select(vec![-1.0, f32::NAN, f32::NEG_INFINITY]).prop_map(Flaw::TMax),
    ];
    (spot(), spot(), bend, exponent, interval, flaw).prop_map(
        |(origin, target, bend, exponent, interval, flaw)| RayPlan {
            origin,
            target,
            bend,
            exponent,
            interval,
            flaw,
        },
    )
}

fn spot() -> impl Strategy<Value = Spot> {
    let cube = || prop::array::uniform3(-1.5f32..1.5);
    let one = any::<Index>;
    prop_oneof![
        3 => (one(), 0..3usize).prop_map(|(of, k)| Spot::Corner(of, k)),
        3 => (one(), 0..3usize, 0.0f32..1.0).prop_map(|(of, k, s)| Spot::Edge(of, k, s)),
        2 => (one(), 0.0f32..1.0, 0.0f32..1.0).prop_map(|(of, u, v)| Spot::Inside(of, u, v)),
        2 => (one(), 0..8u8).prop_map(|(of, k)| Spot::BoxCorner(of, k)),
        3 => cube().prop_map(Spot::Near),
        1 => cube().prop_map(Spot::Far),
        1 => Just(Spot::World),
    ]
}

impl Spot {
    /// The place in that scene. The corners of a sphere are its centre, those of a cone its ends.
    fn find(&self, scene: &Primitives) -> Vec3 {
        let boxes = || {
            let flat = scene.triangles.iter().map(Triangle::own_box);
            let round = flat.chain(scene.spheres.iter().map(Sphere::own_box));
            round.chain(scene.cones.iter().map(Cone::own_box))
        };
        let (spheres, cones) = (scene.triangles.len(), scene.triangles.len() + scene.spheres.len());
        let corners = |of: &Index| match of.index(scene.len()) {
            i if i < spheres => scene.triangles[i].corners,
            i if i < cones => [scene.spheres[i - spheres].center; 3],
            i => {
                let Cone { base, apex, .. } = scene.cones[i - cones];
                [base, apex, base]
            }
        };
        let around = |at: &[f32; 3], reach: f32| {
            let all = boxes().fold(Aabb::EMPTY, |all, one| all.union(&one));
            (all.min() + all.max()) * 0.5 + all.extent() * (0.5 * reach) * Vec3::from_array(*at)
        };
        if scene.is_empty() {
            return match self {
                Spot::Near(at) | Spot::Far(at) => Vec3::from_array(*at),
                _ => Vec3::ZERO,
            };
        }
        match self {
            Spot::Corner(of, k) => corners(of)[*k],
            Spot::Edge(of, k, s) => {
                aim::between(corners(of)[*k], corners(of)[(k + 1) % 3], f64::from(*s))
            }
            Spot::Inside(of, u, v) => {
                let [a, b, c] = corners(of);
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (*u, *v) };
                a + (b - a) * u + (c - a) * v
            }
            Spot::BoxCorner(of, k) => {
                let own = boxes().nth(of.index(scene.len())).expect("as many boxes as primitives");
                let side = |axis: usize| own.axes[axis][usize::from(k >> axis & 1)];
                Vec3::new(side(0), side(1), side(2))
            }
            Spot::Near(at) => around(at, 1.0),
            Spot::Far(at) => around(at, 1000.0),
            Spot::World => Vec3::ZERO,
        }
    }
}

impl RayPlan {
    /// The ray for that scene.
    pub fn aim(&self, scene: &Primitives) -> Ray {
        let (mut origin, target) = (self.origin.find(scene), self.target.find(scene));
        let mut dir = target - origin;
        match self.bend {
            Bend::No => {}
            Bend::Along(axis) => {
                // Exactly through the target, with zeros of both signs.
                let along = origin[axis];
                let sign = (target - origin)[axis];
                origin = target;
                origin[axis] = along;
                dir *= 0.0;
                dir[axis] = if sign == 0.0 { 1.0 } else { sign };
            }
            Bend::Component(axis, value) => dir[axis] = value,
        }
        let [tmin, tmax] = self.interval;
        let scale = power(self.exponent);
        let mut ray = Ray { origin, dir: dir * scale, tmin: tmin / scale, tmax: tmax / scale };
        match self.flaw {
            Flaw::No => {}
            Flaw::Origin(axis, value) => ray.origin[axis] = value,
            Flaw::Dir(axis, value) => ray.dir[axis] = value,
            Flaw::NoDir => ray.dir = Vec3::new(0.0, -0.0, 0.0),
            Flaw::TMin(value) => ray.tmin = value,
            Flaw::TMax(value) => ray.tmax = value,
        }
        ray
    }
}

/// Whether a ray can hit anything, by the documentation of [`Ray`].
pub fn is_valid(ray: &Ray) -> bool {
    let moves = ray.dir.x != 0.0 || ray.dir.y != 0.0 || ray.dir.z != 0.0;
    let interval = ray.tmin >= 0.0 && ray.tmin <= ray.tmax;
    ray.origin.is_finite() && ray.dir.is_finite() && moves && interval
}

/// Whether a ray's direction is in the range that the documentation of the kernels states.
pub fn is_in_range(ray: &Ray) -> bool {
    (power(-20)..=power(20)).contains(&ray.dir.abs().max_element())
}
