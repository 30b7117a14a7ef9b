//! What the builders refuse, and what they take.

use std::io::ErrorKind;

use glam::Vec3;
use rt_kernels::geom::{Cone, Sphere, Triangle};
use rt_kernels::tri::Method;
use rt_kernels::{Brute, BuildError, Builder, Bvh, Exec, Layout, Plan, Primitives};
use rt_kernels::{Rays, Sequential};
use rt_tests::aim;
use rt_tests::random::{Random, power};
use rt_tests::trace::{any, closest_bits, every_plan, ways};

fn triangle() -> Triangle {
    Triangle { corners: [Vec3::ZERO, Vec3::X, Vec3::Y] }
}

fn ball() -> Sphere {
    Sphere { center: Vec3::ZERO, radius: 1.0 }
}

fn cone() -> Cone {
    Cone { base: Vec3::ZERO, base_radius: 1.0, apex: Vec3::Z, apex_radius: 0.0 }
}

fn build(scene: &Primitives, builder: Builder) -> Result<Bvh, BuildError> {
    build_as(scene, Plan { builder, ..Plan::default() })
}

fn build_as(scene: &Primitives, plan: Plan) -> Result<Bvh, BuildError> {
    Bvh::build_with(scene, plan, &Sequential)
}

/// What building says, with and without a hierarchy.
fn refusal(scene: &Primitives) -> Option<BuildError> {
    let brute = Brute::build(scene).err();
    for builder in Builder::ALL {
        assert_eq!(build(scene, builder).err(), brute, "{builder:?} takes the same scenes");
    }
    brute
}

#[test]
fn corners_out_of_range_are_refused() {
    let limit = power(40);
    for axis in 0..3 {
        for corner in 0..3 {
            for (value, want) in [
                (f32::NAN, Some(BuildError::NotFinite { prim: 2 })),
                (f32::INFINITY, Some(BuildError::NotFinite { prim: 2 })),
                (f32::NEG_INFINITY, Some(BuildError::NotFinite { prim: 2 })),
                (f32::MAX, Some(BuildError::NotFinite { prim: 2 })),
                (2.0 * limit, Some(BuildError::OutOfRange { prim: 2 })),
                (-2.0 * limit, Some(BuildError::OutOfRange { prim: 2 })),
                (0.99 * limit, None),
            ] {
                let mut scene = Primitives {
                    triangles: vec![triangle(); 4],
                    spheres: vec![ball()],
                    cones: vec![],
                };
                scene.triangles[2].corners[corner][axis] = value;
                let why = refusal(&scene);
                // The own box of a corner near the largest number overflows: either name will do.
                let either =
                    value == f32::MAX && matches!(why, Some(BuildError::OutOfRange { prim: 2 }));
                assert!(
                    why == want || either,
                    "{value} as axis {axis} of corner {corner}: {why:?}"
                );
            }
        }
    }
}

#[test]
fn spheres_out_of_range_are_refused() {
    let cases = [
        (Vec3::ZERO, 0.0, Some(BuildError::NoRadius { prim: 3 })),
        (Vec3::ZERO, -0.0, Some(BuildError::NoRadius { prim: 3 })),
        (Vec3::ZERO, -1.0, Some(BuildError::NoRadius { prim: 3 })),
        (Vec3::ZERO, f32::NAN, Some(BuildError::NotFinite { prim: 3 })),
        (Vec3::ZERO, f32::INFINITY, Some(BuildError::NotFinite { prim: 3 })),
        (Vec3::ZERO, power(41), Some(BuildError::OutOfRange { prim: 3 })),
        (Vec3::splat(f32::NAN), 1.0, Some(BuildError::NotFinite { prim: 3 })),
        (Vec3::new(0.0, power(41), 0.0), 1.0, Some(BuildError::OutOfRange { prim: 3 })),
        (Vec3::new(0.0, 0.9 * power(40), 0.0), 1.0, None),
    ];
    for (center, radius, want) in cases {
        let spheres = vec![ball(), Sphere { center, radius }];
        let triangles = vec![triangle(); 2];
        let scene = Primitives { triangles, spheres, ..Primitives::default() };
        assert_eq!(refusal(&scene), want, "a sphere of radius {radius} at {center}");
    }
}

#[test]
fn cones_out_of_range_are_refused() {
    let limit = power(40);
    let (here, there) = (Vec3::ZERO, Vec3::Y);
    let cases = [
        (here, 1.0, here, 2.0, Some(BuildError::NoMantle { prim: 4 })),
        (here, 0.0, there, -0.0, Some(BuildError::NoMantle { prim: 4 })),
        (here, -1.0, there, 1.0, Some(BuildError::NoMantle { prim: 4 })),
        (here, 1.0, there, -1.0, Some(BuildError::NoMantle { prim: 4 })),
        (here, f32::NAN, there, 1.0, Some(BuildError::NotFinite { prim: 4 })),
        (here, 1.0, there, f32::INFINITY, Some(BuildError::NotFinite { prim: 4 })),
        (here, 1.0, Vec3::new(0.0, f32::NAN, 0.0), 1.0, Some(BuildError::NotFinite { prim: 4 })),
        (here, 2.0 * limit, there, 1.0, Some(BuildError::OutOfRange { prim: 4 })),
        (here, 1.0, Vec3::X * -2.0 * limit, 1.0, Some(BuildError::OutOfRange { prim: 4 })),
        (here, 0.0, Vec3::X * limit, limit, None),
        (here, 1.0, Vec3::new(0.0, 1e-45, 0.0), 0.0, None),
    ];
    for (base, base_radius, apex, apex_radius, want) in cases {
        let cones = vec![cone(), Cone { base, base_radius, apex, apex_radius }];
        let (triangles, spheres) = (vec![triangle(); 2], vec![ball()]);
        let scene = Primitives { triangles, spheres, cones };
        assert_eq!(
            refusal(&scene),
            want,
            "from {base_radius} at {base} to {apex_radius} at {apex}"
        );
    }
}

#[test]
fn refusals_name_the_primitive() {
    let scene = Primitives {
        triangles: vec![triangle(), Triangle { corners: [Vec3::NAN; 3] }],
        ..Primitives::default()
    };
    let why = refusal(&scene).expect("refused").to_string();
    assert!(why.contains("primitive 1") && why.contains("finite"), "{why}");
}

#[test]
fn nothing_is_hit_where_there_is_nothing() {
    let scene = Primitives::default();
    let brute = Brute::build(&scene).expect("no primitives are fine");
    let rays: Rays = (0..11).map(|_| aim::at(Vec3::ZERO, Vec3::X)).collect();
    for exec in ways() {
        assert_eq!(closest_bits(&brute, exec, &rays), [None; 11], "{exec:?}");
        assert_eq!(any(&brute, exec, &rays), [false; 11], "{exec:?}");
    }
    for plan in every_plan(Method::default()) {
        let bvh = build_as(&scene, plan).expect("no primitives are fine");
        assert_eq!((bvh.nodes(), bvh.depth(), bvh.references()), (0, 0, 0), "{plan:?}");
        for exec in ways() {
            assert_eq!(closest_bits(&bvh, exec, &rays), [None; 11], "{plan:?}, {exec:?}");
            assert_eq!(any(&bvh, exec, &rays), [false; 11], "{plan:?}, {exec:?}");
            assert!(any(&bvh, exec, &Rays::new()).is_empty(), "{plan:?}, {exec:?}: no rays");
        }
    }
}

#[test]
fn one_primitive_is_one_leaf() {
    let nothing = Primitives::default;
    for scene in [
        Primitives { triangles: vec![triangle()], ..nothing() },
        Primitives { spheres: vec![ball()], ..nothing() },
        Primitives { cones: vec![cone()], ..nothing() },
    ] {
        for plan in every_plan(Method::default()) {
            let bvh = build_as(&scene, plan).expect("in range");
            assert_eq!((bvh.nodes(), bvh.depth(), bvh.references()), (1, 1, 1), "{plan:?}");
            let rays = [aim::at(Vec3::new(0.25, 0.25, 3.0), Vec3::new(0.25, 0.25, 0.0))];
            let rays: Rays = rays.into_iter().collect();
            let exec = Exec::best().expect("a level");
            assert!(closest_bits(&bvh, exec, &rays)[0].is_some(), "{plan:?}");
        }
    }
}

/// The greatest depth that is documented.
const DEEP: usize = 100;

/// Scenes that drive a builder into depth: built on a small stack, so that a depth in
/// proportion to the number of primitives would overflow it.
#[test]
fn pathological_scenes_build_and_are_right() {
    let spaced = |i: usize| {
        let at = power(-(i as i32 % 120));
        Triangle {
            corners: [Vec3::splat(at), Vec3::new(at, 2.0 * at, at), Vec3::new(at, at, 2.0 * at)],
        }
    };
    let flat = |i: usize| {
        let at = (i % 300) as f32;
        Triangle {
            corners: [
                Vec3::new(at, 0.0, 0.0),
                Vec3::new(at + 1.0, 0.0, 0.0),
                Vec3::new(at, 1.0, 0.0),
            ],
        }
    };
    let point = |_| Triangle { corners: [Vec3::ONE; 3] };
    type Shape<'a> = &'a dyn Fn(usize) -> Triangle;
    let scenes: [(&str, usize, Shape<'_>); 5] = [
        ("identical", 20_000, &|_| triangle()),
        ("spaced by powers of two", 120, &spaced),
        ("spaced by powers of two, many of each", 20_000, &spaced),
        ("in one plane", 20_000, &flat),
        ("points", 20_000, &point),
    ];
    // Wide nodes are made of two children a node or, by insertion, of more than there is room for.
    let mut plans = every_plan(Method::default());
    plans.retain(|plan| match plan.layout {
        Layout::Skip => true,
        Layout::Bvh4 => [Builder::BinnedSah, Builder::Insertion].contains(&plan.builder),
        Layout::Bvh8 => plan.builder == Builder::BinnedSah,
    });
    let cases = scenes.iter().flat_map(|scene| plans.iter().map(move |&plan| (scene, plan)));
    for ((name, count, shape), plan) in cases {
        let scene =
            Primitives { triangles: (0..*count).map(shape).collect(), ..Primitives::default() };
        let built = std::thread::scope(|scope| {
            let thread = std::thread::Builder::new().stack_size(512 << 10);
            let build = || build_as(&scene, plan).expect("in range");
            match thread.spawn_scoped(scope, build) {
                // WebAssembly has no threads, and a stack that is no larger than it must be.
                Err(error) if error.kind() == ErrorKind::Unsupported => build(),
                thread => thread.expect("a thread").join().expect("no overflow"),
            }
        });
        let name = format!("{name}, {plan:?}");
        assert!(built.depth() <= DEEP, "{name}: {} nodes deep", built.depth());
        let mut random = Random::new(7);
        let rays: Rays = (0..24)
            .map(|_| {
                let [a, b, c] = random.pick(&scene.triangles).corners;
                aim::at(a + random.in_cube() * 3.0, (a + b + c) / 3.0)
            })
            .collect();
        let exec = Exec::best().expect("a level");
        let brute = Brute::build(&scene).expect("in range");
        let hits = closest_bits(&built, exec, &rays);
        assert_eq!(hits, closest_bits(&brute, exec, &rays), "{name}");
        assert_eq!(hits.iter().any(Option::is_some), !name.starts_with("points"), "{name}");
    }
}
