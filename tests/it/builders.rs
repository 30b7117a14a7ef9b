//! What is each builder's own: trees that do not depend on threads, and boxes that are cut.

use glam::Vec3;
use rt_kernels::geom::{Sphere, Triangle};
use rt_kernels::tri::Method;
use rt_kernels::{Accelerator, Brute, Builder, Bvh, Exec, Hits, Join, PacketSize};
use rt_kernels::{Plan, Primitives, Rays, Sequential, Stats};
use rt_tests::mesh::Mesh;
use rt_tests::oracle::plane;
use rt_tests::random::Random;
use rt_tests::trace::{Threads, any, closest, closest_bits, every_plan};
use rt_tests::{aim, rays};

fn build(scene: &Primitives, builder: Builder, join: &impl Join) -> Bvh {
    Bvh::build_with(scene, Plan { builder, ..Plan::default() }, join).expect("in range")
}

/// Long triangles and slabs across the axes, askew too, among many small ones; balls of all sizes.
fn beams() -> Primitives {
    let mut random = Random::new(17);
    let mut scene = Primitives::default();
    for i in 0..900 {
        let at = random.in_cube();
        let mut reach = Vec3::splat(0.02);
        if i % 9 == 0 {
            reach[random.below(3)] = 1.5;
            reach[random.below(3)] = random.pick(&[0.0, 1e-4, 1.0]);
        }
        let mut corner = || at + random.in_cube() * reach;
        scene.triangles.push(Triangle { corners: [corner(), corner(), corner()] });
    }
    for i in 0..60 {
        let radius = if i % 10 == 0 { 0.7 } else { 0.03 };
        scene.spheres.push(Sphere { center: random.in_cube(), radius });
    }
    scene
}

/// The trees are compared by the work that rays do in them and the hits that they find.
#[test]
fn threads_do_not_change_the_tree() {
    if cfg!(target_family = "wasm") {
        return;
    }
    let mesh = Mesh::icosphere(5).map(|v| v * (1.0 + 0.1 * (9.0 * v.x).sin()));
    let scene = mesh.primitives();
    let mut random = Random::new(3);
    let rays: Rays = (0..rays(500))
        .map(|_| aim::at(random.in_cube() * 3.0, random.pick(&mesh.vertices)))
        .collect();
    for builder in Builder::ALL {
        let [one, many] = [build(&scene, builder, &Sequential), build(&scene, builder, &Threads)]
            .map(|bvh| {
                let (mut hits, mut stats) = (Hits::new(), Stats::default());
                bvh.closest(Exec::best().expect("a level"), &rays, &mut hits, &mut stats);
                (bvh.nodes(), bvh.depth(), bvh.references(), stats, hits)
            });
        assert!(one == many, "{builder:?}");
    }
}

#[test]
fn only_spatial_splits_cut_and_within_a_bound() {
    let scene = beams();
    for builder in Builder::ALL {
        let references = build(&scene, builder, &Sequential).references();
        let most = scene.len() * 13 / 10;
        let cut = builder == Builder::Spatial;
        assert_eq!(references > scene.len(), cut, "{builder:?}: {references} references");
        assert!(references <= most, "{builder:?}: {references} references");
    }
}

/// Rays that run in the planes of long triangles, where `t` may be anywhere in their depth, and along
/// the axes, where they meet the very planes that boxes are cut by.
#[test]
fn cut_boxes_lose_no_hit() {
    let scene = beams();
    let long: Vec<_> = scene.triangles.iter().step_by(9).collect();
    let mut random = Random::new(5);
    let mut rays: Rays = (0..rays(20_000))
        .map(|i| {
            let [a, b, c] = random.pick(&long).corners;
            let inside = aim::between(a, aim::between(b, c, random.unit()), random.unit());
            let origin = match i % 3 {
                0 => aim::between(inside, a, -4.0 * random.unit() - 1.0),
                1 => aim::between(b, c, 3.0 * random.unit()),
                _ => random.in_cube() * 2.0,
            };
            aim::at(origin, inside)
        })
        .collect();
    // Borders of bins of the whole scene, of its halves, and so on.
    let whole = scene
        .triangles
        .iter()
        .fold(scene.triangles[0].own_box(), |all, one| all.union(&one.own_box()));
    let whole = scene.spheres.iter().fold(whole, |all, one| all.union(&one.own_box()));
    for axis in 0..3 {
        let [low, high] = whole.axes[axis];
        let step = (high - low) / 16.0;
        for i in 1..16 {
            for _ in 0..20 {
                let (mut origin, mut target) = (random.in_cube() * 2.0, random.in_cube());
                let plane = low + step * i as f32;
                let plane = random.pick(&[plane, plane.next_up(), plane.next_down()]);
                (origin[axis], target[axis]) = (plane, plane);
                if i % 2 == 0 {
                    origin[(axis + 1) % 3] = target[(axis + 1) % 3];
                }
                rays.push(aim::at(origin, target));
            }
        }
    }

    let best = Exec::best().expect("a level");
    let cut = |plan: &Plan| plan.builder == Builder::Spatial;
    for plan in Method::ALL.into_iter().flat_map(every_plan).filter(cut) {
        let brute = Brute::build_with(&scene, plan.method).expect("in range");
        let bvh = Bvh::build_with(&scene, plan, &Sequential).expect("in range");
        let want = closest_bits(&brute, best, &rays);
        assert!(want.iter().flatten().count() * 2 > want.len(), "most rays hit");
        for exec in [best, Exec { packet: PacketSize::Single, ..best }] {
            let (got, found) = (closest_bits(&bvh, exec, &rays), any(&bvh, exec, &rays));
            for (i, want) in want.iter().enumerate() {
                let ray = rays.get(i);
                assert_eq!(got[i], *want, "{plan:?}, {exec:?}: ray {i}, {ray:?}");
                assert_eq!(found[i], want.is_some(), "{plan:?}, {exec:?}: ray {i}, {ray:?}");
            }
        }
    }
}

/// Triangles seen from their edges, of which the computed `t` is far off, among small ones that make
/// it pay to cut them; and a screen just behind the hit. Were pieces as small as the parts of a
/// triangle in them, the screen would hide those whose entry lies behind the hit: once in 20,000
/// scenes, and with the first of these seeds.
#[test]
fn a_screen_hides_no_piece() {
    let exec = Exec { packet: PacketSize::Single, ..Exec::best().expect("a level") };
    let (mut tried, mut cut) = (0, 0);
    for seed in 979..979 + rays(16) as u64 {
        let mut random = Random::new(seed);
        let [a, b, c] = [random.in_cube(), random.in_cube(), random.in_cube()];
        let large = Triangle { corners: [a, b, c] };
        let on = |[u, v]: [f64; 2]| aim::between(aim::between(a, b, u), c, v);
        let rays: Rays = (0..256)
            .map(|_| {
                let origin = on([5.0 * random.signed(), 2.0 * random.signed()].map(f64::from));
                let near = random.pick(&[1e-4, 1e-2, 1.0]);
                let inside = on([near * random.unit(), random.unit()]);
                aim::at(origin, inside)
            })
            .collect();
        let alone = Primitives { triangles: vec![large], ..Primitives::default() };
        let found = closest(&Brute::build(&alone).expect("in range"), exec, &rays);
        for (i, hit) in found.into_iter().enumerate() {
            let ray = rays.get(i);
            let exact = plane(&ray, large.corners).map_or(f64::NAN, |meeting| meeting.t);
            let Some(t) = hit.map(|hit| hit.t) else { continue };
            if (f64::from(t) - exact).abs() < 1e-3 * exact {
                continue;
            }
            let behind = ray.at(t * (1.0 + random.pick(&[1e-5, 1e-3, 1e-2])));
            let (u, v) = ray.dir.normalize().any_orthonormal_pair();
            let screen = Triangle { corners: [u, v, -u - v].map(|side| behind + side * 0.05) };
            let mut triangles = vec![screen; 2];
            for _ in 0..80 {
                let at = on([random.unit(), random.unit()]) + random.in_cube() * 0.3;
                let mut corner = || at + random.in_cube() * 0.02;
                triangles.push(Triangle { corners: [corner(), corner(), corner()] });
            }
            triangles.extend([large; 4]);
            let scene = Primitives { triangles, ..Primitives::default() };
            let bvh = build(&scene, Builder::Spatial, &Sequential);
            tried += 1;
            cut += usize::from(bvh.references() > scene.len());
            let ray: Rays = [ray].into_iter().collect();
            let brute = Brute::build(&scene).expect("in range");
            let (got, want) = (closest_bits(&bvh, exec, &ray), closest_bits(&brute, exec, &ray));
            assert_eq!(got, want, "seed {seed}: {:?}", ray.get(0));
        }
    }
    assert!(3 * cut > tried && tried > 0, "{cut} of {tried} scenes have something cut");
}
