//! What is large packets' own: rays of one origin, filtered together, and rays that wait for others or take turns.

use glam::Vec3;
use proptest::prelude::*;
use rt_kernels::geom::Sphere;
use rt_kernels::{Accelerator, Brute, Bvh, Exec, Hits, KdBuilder, KdPlan, KdTree, Layout};
use rt_kernels::{PacketSize, Plan, Primitives, Ray, Rays, Sequential, Stats};
use rt_tests::random::Random;
use rt_tests::strategies::{RayPlan, config, ray, scene};
use rt_tests::trace::{any, closest_bits};
use rt_tests::{aim, mesh::Mesh, rays};
use simd4::Level;

/// Checks every level and accelerator against brute force, one ray at a time.
fn one_answer(scene: &Primitives, rays: &Rays) {
    let first = Level::available().next().expect("scalar is always there");
    let brute = Brute::build(scene).expect("in range");
    let want = closest_bits(&brute, Exec { level: first, packet: PacketSize::Single }, rays);
    for (name, accel) in accelerators(scene) {
        for level in Level::available() {
            let exec = Exec { level, packet: PacketSize::Large };
            let (got, found) = (closest_bits(&*accel, exec, rays), any(&*accel, exec, rays));
            for (i, want) in want.iter().enumerate() {
                let ray = rays.get(i);
                assert_eq!(got[i], *want, "{name}, {level}: the closest hit of {ray:?}");
                assert_eq!(found[i], want.is_some(), "{name}, {level}: any hit of {ray:?}");
            }
        }
    }
}

/// All that have large packets.
fn accelerators(scene: &Primitives) -> Vec<(&'static str, Box<dyn Accelerator>)> {
    let wide = [Layout::Bvh4, Layout::Bvh8].map(|layout| {
        let plan = Plan { layout, ..Plan::default() };
        let bvh = Bvh::build_with(scene, plan, &Sequential).expect("in range");
        (layout.name(), Box::new(bvh) as Box<dyn Accelerator>)
    });
    let cells = KdBuilder::ALL.map(|builder| {
        let plan = KdPlan { builder, ..KdPlan::default() };
        let tree = KdTree::build_with(scene, plan, &Sequential).expect("in range");
        (builder.name(), Box::new(tree) as Box<dyn Accelerator>)
    });
    wide.into_iter().chain(cells).collect()
}

/// A bundle about a ray: directions that differ by little or nothing, from its origin.
fn bundle(ray: &Ray, count: usize, spread: f32, random: &mut Random) -> impl Iterator<Item = Ray> {
    let length = ray.dir.abs().max_element();
    let offsets: Vec<_> = (0..count)
        .map(|i| match i % 4 {
            // Every fourth in the plane of two axes, or along one.
            0 => Vec3::new(random.signed(), 0.0, 0.0),
            _ => Vec3::new(random.signed(), random.signed(), random.signed()),
        })
        .collect();
    let ray = *ray;
    offsets.into_iter().map(move |offset| Ray { dir: ray.dir + offset * (length * spread), ..ray })
}

/// Rays that fill a pyramid, or several that begin in one point, in chunks that are full or not, with
/// rays among them that hit nothing.
#[test]
fn bundles_hit_what_their_rays_hit() {
    let plans = prop::collection::vec((ray(), 1..70usize, -20..2i32), 1..5);
    proptest!(config(), |(scene in scene(), plans in plans, seed in any_seed())| {
        let mut random = Random::new(seed);
        let mut rays = Rays::new();
        for (plan, count, exponent) in &plans {
            let plan: &RayPlan = plan;
            let ray = plan.aim(&scene);
            rays.extend(bundle(&ray, *count, 2.0f32.powi(*exponent), &mut random));
            if count % 3 == 0 {
                rays.push(Ray { dir: Vec3::ZERO, ..ray });
            }
        }
        one_answer(&scene, &rays);
    });
}

/// Chunks of rays that go anywhere, which take turns, and between them chunks that go together: what rays
/// have found goes to their places, whoever is on the way when they are done.
#[test]
fn chunks_of_either_kind_keep_apart() {
    let triangles = Mesh::icosphere(4).primitives().triangles;
    let spheres = (0..9).map(|i| Sphere { center: Vec3::X * i as f32 * 0.3, radius: 0.1 });
    let scene = Primitives { triangles, spheres: spheres.collect(), ..Primitives::default() };
    let mut random = Random::new(11);
    let mut point = move || Vec3::new(random.signed(), random.signed(), random.signed());
    for chunks in 1..7 {
        let rays: Rays = (0..64 * chunks + 7)
            .map(|i| match i / 64 % 2 {
                0 => aim::at(point() * 1.5, point()),
                _ => aim::at(Vec3::new(0.3, 0.2, 5.0), point() * 0.7),
            })
            .collect();
        one_answer(&scene, &rays);
    }
}

fn any_seed() -> impl Strategy<Value = u64> {
    0..u64::MAX
}

/// A closed mesh from within: every ray of a bundle is aimed at an edge or a corner, where the filter's
/// signs are least certain, and none gets out.
#[test]
fn bundles_at_edges_do_not_escape() {
    let mesh = Mesh::icosphere(5);
    let scene = mesh.primitives();
    for at in [Vec3::ZERO, Vec3::new(1e4, -3e4, 2e4)] {
        let moved = scene.triangles.iter().map(|triangle| rt_kernels::geom::Triangle {
            corners: triangle.corners.map(|corner| corner + at),
        });
        let scene = Primitives { triangles: moved.collect(), ..Primitives::default() };
        let mut random = Random::new(7);
        // Neighbours in the mesh are neighbours in a packet.
        let mut aimed = Rays::new();
        for triangle in &scene.triangles[..rays(scene.triangles.len())] {
            let [a, b, c] = triangle.corners;
            let origin = at + Vec3::new(0.1, 0.2, -0.3);
            aimed.push(aim::at(origin, a));
            aimed.push(aim::at(origin, b + (c - b) * random.unit() as f32));
        }
        for (name, accel) in accelerators(&scene) {
            for level in Level::available() {
                let exec = Exec { level, packet: PacketSize::Large };
                let mut hits = Hits::new();
                accel.closest(exec, &aimed, &mut hits, &mut Stats::default());
                let lost = (0..aimed.len()).filter(|&i| hits.get(i).is_none()).count();
                assert_eq!(lost, 0, "{name}, {level}, at {at}: of {} rays", aimed.len());
            }
        }
    }
}

/// What large packets are for: neighbours share visits, whether they come from one origin or not.
#[test]
fn rays_that_go_together_share_visits() {
    let mesh = Mesh::icosphere(5);
    let scene = mesh.primitives();
    let mut random = Random::new(3);
    let eye = Vec3::new(0.3, 0.2, 5.0);
    let from_eye: Rays = (0..64)
        .map(|i| aim::at(eye, Vec3::new((i % 8) as f32, (i / 8) as f32, 0.0) * 0.02))
        .collect();
    let scattered: Rays = (0..4096)
        .map(|_| {
            let mut point = || Vec3::new(random.signed(), random.signed(), random.signed());
            aim::at(point() * 2.0, point())
        })
        .collect();
    let bvh = Bvh::build(&scene, &Sequential).expect("in range");
    let visits = |rays: &Rays, packet| {
        let mut stats = Stats::default();
        let exec = Exec { packet, ..Exec::best().expect("a level") };
        bvh.closest(exec, rays, &mut Hits::new(), &mut stats);
        stats.node_visits
    };
    let gain = |rays, packet| visits(rays, PacketSize::Single) / visits(rays, packet);
    let sizes = [PacketSize::Four, PacketSize::Eight, PacketSize::Sixteen, PacketSize::Large];
    let gains = sizes.map(|packet| gain(&from_eye, packet));
    assert!(gains.is_sorted_by(|a, b| a < b) && gains[3] >= 10, "{gains:?}");
    // Rays that take turns visit what is entered behind a hit too, if it was put on the stack before, but
    // not much else: a guess at the order of children is nearly as good as their distances.
    let [turns, single] =
        [PacketSize::Large, PacketSize::Single].map(|packet| visits(&scattered, packet));
    assert!(single <= turns && turns * 2 <= single * 3, "{turns} visits, {single} one by one");
    // Of kd-trees too, whose cells are smaller.
    for (name, accel) in accelerators(&scene) {
        let visits = |packet| {
            let mut stats = Stats::default();
            let exec = Exec { packet, ..Exec::best().expect("a level") };
            accel.closest(exec, &from_eye, &mut Hits::new(), &mut stats);
            stats.node_visits
        };
        let gain = visits(PacketSize::Single) / visits(PacketSize::Large);
        assert!(gain >= 5, "{name}: {gain}");
    }
}

/// How many rays a packet has where it goes.
#[test]
fn packets_are_full_where_rays_are_alike() {
    let scene = Mesh::icosphere(4).primitives();
    let eye = Vec3::new(0.3, 0.2, 5.0);
    let rays: Rays = (0..256)
        .map(|i| aim::at(eye, Vec3::new((i % 16) as f32, (i / 16) as f32, 0.0) * 0.005))
        .collect();
    for layout in Layout::ALL {
        let plan = Plan { layout, ..Plan::default() };
        let bvh = Bvh::build_with(&scene, plan, &Sequential).expect("in range");
        for packet in [PacketSize::Single, PacketSize::Four, PacketSize::Native] {
            let exec = Exec { packet, ..Exec::best().expect("a level") };
            let mut stats = Stats::default();
            bvh.closest(exec, &rays, &mut Hits::new(), &mut stats);
            let full = stats.active_rays as f64 / stats.node_visits as f64;
            let most = bvh.exec(exec).lanes() as f64;
            // Over a skip array a packet visits more than it goes on into.
            let least = if layout == Layout::Skip { 0.2 * most } else { 0.5 * most };
            assert!((least..=most).contains(&full), "{layout:?}, {packet:?}: {full} of {most}");
        }
    }
}
