//! Closest points, against a search that knows nothing but how to measure.

use glam::{DVec3, Vec3};
use proptest::prelude::*;
use rt_kernels::geom::{Cone, Sphere, Triangle};
use rt_kernels::{Builder, Bvh, Layout, Plan, Primitives, Sequential};
use rt_tests::random::Random;
use rt_tests::strategies::{config, scene};

/// The least of a convex function from 0 to 1, by halving where it may be.
fn least(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let (a, b) = (low + (high - low) * 0.4, low + (high - low) * 0.6);
        if f(a) <= f(b) {
            high = b;
        } else {
            low = a;
        }
    }
    [0.0, 1.0, low, high].map(f).into_iter().fold(f64::INFINITY, f64::min)
}

/// From the third corner toward each point of the edge between the others.
fn to_triangle(point: DVec3, Triangle { corners }: &Triangle) -> f64 {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    least(|along| {
        let toward = a.lerp(b, along);
        least(|out| point.distance(c.lerp(toward, out)))
    })
}

fn to_sphere(point: DVec3, sphere: &Sphere) -> f64 {
    (point.distance(sphere.center.as_dvec3()) - f64::from(sphere.radius)).abs()
}

/// To the edge that turns about the axis, on the point's side.
fn to_cone(point: DVec3, cone: &Cone) -> f64 {
    let (base, apex) = (cone.base.as_dvec3(), cone.apex.as_dvec3());
    let axis = (apex - base).normalize();
    let across = (point - base).reject_from(axis);
    let out = across.try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
    let [from, to] = [(base, cone.base_radius), (apex, cone.apex_radius)]
        .map(|(center, radius)| center + out * f64::from(radius));
    least(|along| point.distance(from.lerp(to, along)))
}

fn extent(scene: &Primitives) -> f64 {
    let corners = scene.triangles.iter().flat_map(|triangle| triangle.corners);
    let spheres = scene.spheres.iter().flat_map(|ball| [ball.center, Vec3::splat(ball.radius)]);
    let radii = |cone: &Cone| Vec3::new(cone.base_radius, cone.apex_radius, 0.0);
    let cones = scene.cones.iter().flat_map(|cone| [cone.base, cone.apex, radii(cone)]);
    corners
        .chain(spheres)
        .chain(cones)
        .fold(0.0, |most, point| point.abs().max_element().max(most))
        .into()
}

/// The distances to all primitives.
fn distances(scene: &Primitives, point: DVec3) -> Vec<f64> {
    let triangles = scene.triangles.iter().map(|triangle| to_triangle(point, triangle));
    let spheres = scene.spheres.iter().map(|sphere| to_sphere(point, sphere));
    let cones = scene.cones.iter().map(|cone| to_cone(point, cone));
    triangles.chain(spheres).chain(cones).collect()
}

fn check(scene: &Primitives, point: Vec3) {
    let exact = point.as_dvec3();
    let each = distances(scene, exact);
    let want = each.iter().copied().fold(f64::INFINITY, f64::min);
    // What f32 and a search by halves leave.
    let slack = 1e-6 * (want + extent(scene) + f64::from(point.abs().max_element()));

    let builders = Builder::ALL.map(|builder| Plan { builder, ..Plan::default() });
    let layouts = Layout::ALL.map(|layout| Plan { layout, ..Plan::default() });
    let bvhs: Vec<_> = (builders.into_iter().chain(layouts))
        .map(|plan| Bvh::build_with(scene, plan, &Sequential).expect("in range"))
        .collect();
    let Some(got) = bvhs[0].closest_point(scene, point, f32::INFINITY) else {
        assert!(scene.is_empty(), "{point}: nothing found");
        return;
    };
    assert!((f64::from(got.distance) - want).abs() <= slack, "{point}: {got:?}, not {want}");
    assert!((each[got.prim as usize] - want).abs() <= slack, "{point}: {got:?}, not {want}");
    let apart = f64::from(point.distance(got.point));
    assert!((apart - want).abs() <= slack, "{point}: {got:?} is {apart} away");
    let off = distances(scene, got.point.as_dvec3())[got.prim as usize];
    assert!(off <= slack, "{point}: {got:?} is not on it");

    for bvh in &bvhs {
        let plan = bvh.plan();
        let reach = |max| bvh.closest_point(scene, point, max);
        assert_eq!(reach(f32::INFINITY), Some(got), "{point}: {plan:?}");
        let short = got.distance - 2.0 * slack as f32;
        assert_eq!(reach(short), None, "{point}: {plan:?}");
        assert_eq!(reach(got.distance.next_up()), Some(got), "{point}: {plan:?}");
    }
}

#[test]
fn nothing_is_closer() {
    let near = prop::array::uniform3(-2.0f32..2.0);
    let config = ProptestConfig { cases: config().cases.div_ceil(8), ..config() };
    proptest!(config, |(scene in scene(), points in prop::collection::vec((near, 0..3), 1..4))| {
        let scale = extent(&scene) as f32;
        for (i, (near, kind)) in points.into_iter().enumerate() {
            let near = Vec3::from(near);
            let corner = scene.triangles.get(i).map(|triangle| triangle.corners[i % 3]);
            check(&scene, match (kind, corner) {
                (0, _) => near,
                (1, Some(corner)) => corner,
                _ => near * scale,
            });
        }
    });
}

#[test]
fn of_many_the_same_by_every_plan() {
    let mut random = Random::new(12);
    let triangle = |random: &mut Random| {
        let at = random.in_cube() * 10.0;
        Triangle { corners: [(); 3].map(|()| at + random.in_cube()) }
    };
    let cone = |random: &mut Random| {
        let base = random.in_cube() * 10.0;
        let apex = base + random.in_cube();
        let [base_radius, apex_radius] = [(); 2].map(|()| random.signed().abs());
        Cone { base, base_radius, apex, apex_radius }
    };
    let scene = Primitives {
        triangles: (0..300).map(|_| triangle(&mut random)).collect(),
        cones: (0..50).map(|_| cone(&mut random)).collect(),
        ..Primitives::default()
    };
    for _ in 0..3 {
        check(&scene, random.in_cube() * 12.0);
    }
}

#[test]
fn what_is_not_a_point_is_close_to_nothing() {
    let ball = Sphere { center: Vec3::ZERO, radius: 1.0 };
    let scene = Primitives { spheres: vec![ball], ..Primitives::default() };
    let bvh = Bvh::build(&scene, &Sequential).unwrap();
    for point in [Vec3::NAN, Vec3::INFINITY, Vec3::X * f32::NEG_INFINITY] {
        assert_eq!(bvh.closest_point(&scene, point, f32::INFINITY), None);
    }
    for reach in [f32::NAN, -1.0, 0.5] {
        assert_eq!(bvh.closest_point(&scene, Vec3::ZERO, reach), None);
    }
    // From the center every direction is as good.
    let closest = bvh.closest_point(&scene, Vec3::ZERO, 1.0).expect("its surface");
    assert_eq!((closest.distance, closest.point), (1.0, Vec3::X));
}
