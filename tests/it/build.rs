//! What the builder refuses, and what it takes.

use std::io::ErrorKind;

use glam::Vec3;
use rt_kernels::geom::{Sphere, Triangle};
use rt_kernels::{Brute, BuildError, Bvh, Exec, Primitives, Rays, Sequential};
use rt_tests::aim;
use rt_tests::random::{Random, power};
use rt_tests::trace::{any, closest_bits, ways};

fn triangle() -> Triangle {
    Triangle { corners: [Vec3::ZERO, Vec3::X, Vec3::Y] }
}

fn ball() -> Sphere {
    Sphere { center: Vec3::ZERO, radius: 1.0 }
}

/// What building says, with and without a hierarchy.
fn refusal(scene: &Primitives) -> Option<BuildError> {
    let bvh = Bvh::build(scene, &Sequential).err();
    assert_eq!(Brute::build(scene).err(), bvh, "both accelerators take the same scenes");
    bvh
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
                let mut scene =
                    Primitives { triangles: vec![triangle(); 4], spheres: vec![ball()] };
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
        let scene = Primitives { triangles: vec![triangle(); 2], spheres };
        assert_eq!(refusal(&scene), want, "a sphere of radius {radius} at {center}");
    }
}

#[test]
fn refusals_name_the_primitive() {
    let scene = Primitives {
        triangles: vec![triangle(), Triangle { corners: [Vec3::NAN; 3] }],
        spheres: vec![],
    };
    let why = refusal(&scene).expect("refused").to_string();
    assert!(why.contains("primitive 1") && why.contains("finite"), "{why}");
}

#[test]
fn nothing_is_hit_where_there_is_nothing() {
    let scene = Primitives::default();
    let (brute, bvh) = (Brute::build(&scene), Bvh::build(&scene, &Sequential));
    let (brute, bvh) =
        (brute.expect("no primitives are fine"), bvh.expect("no primitives are fine"));
    assert_eq!(bvh.nodes(), 0);
    let rays: Rays = (0..11).map(|_| aim::at(Vec3::ZERO, Vec3::X)).collect();
    for exec in ways() {
        assert_eq!(closest_bits(&bvh, exec, &rays), [None; 11], "{exec:?}");
        assert_eq!(closest_bits(&brute, exec, &rays), [None; 11], "{exec:?}");
        assert_eq!(any(&bvh, exec, &rays), [false; 11], "{exec:?}");
        assert_eq!(any(&brute, exec, &rays), [false; 11], "{exec:?}");
        assert!(any(&bvh, exec, &Rays::new()).is_empty(), "{exec:?}: no rays");
    }
}

/// Scenes that drive a top-down builder into depth: built on a small stack, so that a depth in
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
        ("identical", 100_000, &|_| triangle()),
        ("spaced by powers of two", 120, &spaced),
        ("spaced by powers of two, many of each", 100_000, &spaced),
        ("in one plane", 100_000, &flat),
        ("points", 100_000, &point),
    ];
    for (name, count, shape) in scenes {
        let scene = Primitives { triangles: (0..count).map(shape).collect(), spheres: vec![] };
        let built = std::thread::scope(|scope| {
            let builder = std::thread::Builder::new().stack_size(512 << 10);
            let build = || Bvh::build(&scene, &Sequential).expect("in range");
            match builder.spawn_scoped(scope, build) {
                // WebAssembly has no threads, and a stack that is no larger than it must be.
                Err(error) if error.kind() == ErrorKind::Unsupported => build(),
                thread => thread.expect("a thread").join().expect("no overflow"),
            }
        });
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
        assert_eq!(hits.iter().any(Option::is_some), name != "points", "{name}");
    }
}
