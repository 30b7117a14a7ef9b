//! What is the kd-tree's own: cells that cut primitives, bounds of depth and size, mailboxes.

use glam::Vec3;
use rt_kernels::geom::{Sphere, Triangle};
use rt_kernels::kd::GROWTH;
use rt_kernels::tri::Method;
use rt_kernels::{Accelerator, Brute, Exec, Hits, KdBuilder, KdPlan, KdTree, Mailbox, PacketSize};
use rt_kernels::{Primitives, Ray, Rays, Sequential, Stats};
use rt_tests::mesh::Mesh;
use rt_tests::random::{Random, power};
use rt_tests::trace::{Threads, any, bits, closest, closest_bits, every_kd_plan};
use rt_tests::{aim, rays};

fn build(scene: &Primitives, builder: KdBuilder) -> KdTree {
    let plan = KdPlan { builder, ..KdPlan::default() };
    KdTree::build_with(scene, plan, &Sequential).expect("in range")
}

fn flat(triangles: Vec<Triangle>) -> Primitives {
    Primitives { triangles, ..Primitives::default() }
}

const PACKETS: [PacketSize; 4] =
    [PacketSize::Single, PacketSize::Four, PacketSize::Sixteen, PacketSize::Large];

fn best() -> Exec {
    Exec::best().expect("a level")
}

/// Checks closest and any of every tree, in packets and ray by ray, against brute force. How many
/// rays hit.
fn one_answer(scene: &Primitives, rays: &Rays) -> usize {
    let mut hits = 0;
    for method in Method::ALL {
        let brute = Brute::build_with(scene, method).expect("in range");
        let want = closest_bits(&brute, best(), rays);
        hits = want.iter().flatten().count();
        for plan in every_kd_plan(method) {
            let tree = KdTree::build_with(scene, plan, &Sequential).expect("in range");
            for packet in PACKETS {
                let exec = Exec { packet, ..best() };
                let (got, found) = (closest_bits(&tree, exec, rays), any(&tree, exec, rays));
                for (i, want) in want.iter().enumerate() {
                    let ray = rays.get(i);
                    assert_eq!(got[i], *want, "{plan:?}, {exec:?}: ray {i}, {ray:?}");
                    assert_eq!(found[i], want.is_some(), "{plan:?}, {exec:?}: ray {i}, {ray:?}");
                }
            }
        }
    }
    hits
}

/// A triangle of any shape: now and then long, or a needle, or in a plane across an axis, far away or
/// tiny.
fn shape(random: &mut Random) -> Triangle {
    let mut reach = Vec3::ONE;
    for _ in 0..2 {
        reach[random.below(3)] = random.pick(&[1.0, 1.0, 0.1, 1e-3, 1e-6, 0.0]);
    }
    let away = random.pick(&[0.0, 0.0, 10.0, 1e4]) * random.in_cube();
    let size = random.pick(&[1.0, 1.0, 1e-3, 1e3]);
    let [a, b, mut c] = [random.in_cube(), random.in_cube(), random.in_cube()];
    if random.below(4) == 0 {
        c = aim::between(a, b, random.unit()) + random.in_cube() * random.magnitude(-24, -3);
    }
    Triangle { corners: [a, b, c].map(|corner| corner * reach * size + away) }
}

/// Triangles seen from their edges, whose computed `t` may be anywhere in their depth, among small
/// ones that make it pay to cut them, and a screen just before or behind the hit: were pieces smaller
/// than the argument has them, or distances not widened, the screen would hide those whose cells begin
/// behind the hit.
#[test]
fn a_screen_hides_no_cell() {
    let exec = Exec { packet: PacketSize::Single, ..best() };
    let (mut tried, mut cut) = (0, 0);
    for seed in 0..rays(600) as u64 {
        let mut random = Random::new(seed);
        let large = shape(&mut random);
        let [a, b, c] = large.corners;
        let on = |[u, v]: [f64; 2]| aim::between(aim::between(a, b, u), c, v);
        let extent = (a.max(b).max(c) - a.min(b).min(c)).max_element();
        let aimed: Rays = (0..64)
            .map(|_| {
                let far = f64::from(random.magnitude(-6, 10));
                let mut origin = on([far * f64::from(random.signed()), 2.0 * random.unit()]);
                if random.below(3) == 0 {
                    origin += random.in_cube() * extent * random.magnitude(-22, 0);
                }
                let near = random.pick(&[1e-4, 1e-2, 1.0]);
                aim::at(origin, on([near * random.unit(), random.unit()]))
            })
            .collect();
        let alone = Brute::build(&flat(vec![large])).expect("in range");
        let mut triangles = vec![large; 2];
        let mut shown = Rays::new();
        for (i, hit) in closest(&alone, exec, &aimed).into_iter().enumerate() {
            let (ray, Some(t)) = (aimed.get(i), hit.map(|hit| hit.t)) else { continue };
            let step = power(-3 - random.below(20) as i32) * random.pick(&[-1.0, 1.0, 1.0, 1.0]);
            let at = ray.at(t * (1.0 + step));
            let (u, v) = ray.dir.normalize_or(Vec3::X).any_orthonormal_pair();
            let corners = [u, v, -u - v].map(|side| at + side * (0.01 * extent));
            triangles.push(Triangle { corners });
            shown.push(ray);
        }
        for _ in 0..60 {
            let at = on([random.unit(), random.unit()]) + random.in_cube() * (0.3 * extent);
            let mut corner = || at + random.in_cube() * (0.02 * extent);
            triangles.push(Triangle { corners: [corner(), corner(), corner()] });
        }
        let scene = flat(triangles);
        let brute = Brute::build(&scene).expect("in range");
        let want = closest_bits(&brute, best(), &shown);
        for builder in KdBuilder::ALL {
            let tree = build(&scene, builder);
            tried += 1;
            cut += usize::from(tree.references() > scene.len());
            for exec in PACKETS.map(|packet| Exec { packet, ..best() }) {
                let got = closest_bits(&tree, exec, &shown);
                for (i, want) in want.iter().enumerate() {
                    let ray = shown.get(i);
                    assert_eq!(got[i], *want, "seed {seed}, {builder:?}, {exec:?}: {ray:?}");
                }
            }
        }
    }
    assert!(2 * cut > tried, "{cut} of {tried} trees have something cut");
}

/// Walls in the planes across the axes, each of two triangles, on a grid of which many planes are
/// splits; and balls. Rays start on the grid, run in its planes and along its lines, and have zeros of
/// both signs and subnormal numbers in their directions.
#[test]
fn walls_are_met_in_their_own_planes() {
    let mut random = Random::new(7);
    let mut scene = Primitives::default();
    let grid = |random: &mut Random| (random.in_cube() * 4.0).round() * 0.25;
    for _ in 0..150 {
        let (low, axis) = (grid(&mut random), random.below(3));
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let [mut u, mut v] = [Vec3::ZERO; 2];
        (u[i], v[j]) = (0.25 * (1 + random.below(3)) as f32, 0.25 * (1 + random.below(3)) as f32);
        let corners = [low, low + u, low + u + v, low + v];
        let [a, b, c, d] = corners;
        scene.triangles.extend([[a, b, c], [a, c, d]].map(|corners| Triangle { corners }));
    }
    scene.spheres.extend((0..20).map(|_| Sphere { center: grid(&mut random), radius: 0.25 }));
    let special = [0.0, -0.0, 1e-45, -1e-45, 1e-39, -1e-38, 1e-30, -1e-20];
    let aimed: Rays = (0..rays(3_000))
        .map(|i| {
            let origin = if i % 4 == 0 { random.in_cube() * 2.0 } else { grid(&mut random) };
            let mut dir = grid(&mut random) - origin;
            for _ in 0..i % 3 {
                dir[random.below(3)] = random.pick(&special);
            }
            Ray::new(origin, dir)
        })
        .collect();
    let hits = one_answer(&scene, &aimed);
    assert!(2 * hits > aimed.len(), "{hits} of {} rays hit", aimed.len());
}

/// All in one plane, and all in one point.
#[test]
fn flat_scenes_have_trees() {
    let mut random = Random::new(8);
    for axis in 0..3 {
        let point = |random: &mut Random| {
            let mut point = random.in_cube();
            point[axis] = 0.5;
            point
        };
        let triangles = (0..200).map(|_| {
            let at = point(&mut random) * 8.0;
            Triangle { corners: [0; 3].map(|_| point(&mut random) + at) }
        });
        let scene = flat(triangles.collect());
        let aimed: Rays = (0..rays(500))
            .map(|_| {
                let target = random.pick(&scene.triangles).corners[0];
                let mut origin = random.in_cube() * 9.0;
                if random.below(2) == 0 {
                    origin[axis] = target[axis];
                }
                aim::at(origin, target)
            })
            .collect();
        assert!(one_answer(&scene, &aimed) > 0);
    }
    let nothing = flat(vec![Triangle { corners: [Vec3::ZERO; 3] }; 50]);
    assert_eq!(one_answer(&nothing, &[aim::at(Vec3::X, Vec3::ZERO)].into_iter().collect()), 0);
}

/// Every million rays, from inside a closed mesh at its edges and vertices, finds it.
#[test]
fn closed_meshes_hold() {
    let mut random = Random::new(9);
    for (size, center) in [(1.0, Vec3::ZERO), (1e-3, Vec3::ONE), (1.0, Vec3::new(1e4, -3e4, 7.0))] {
        let mut jitter = Random::new(2);
        let mesh = Mesh::icosphere(5).map(|v| v * (1.0 + 0.05 * jitter.signed()) * size + center);
        let (tree, edges) =
            (KdTree::build(&mesh.primitives(), &Sequential).expect("in range"), mesh.edges());
        let aimed: Rays = (0..rays(100_000))
            .map(|i| {
                let [a, b] = random.pick(&edges).map(|i| mesh.vertices[i as usize]);
                let target = if i % 2 == 0 { a } else { aim::between(a, b, random.unit()) };
                aim::at(center + random.in_ball() * (0.8 * size), target)
            })
            .collect();
        for exec in PACKETS.map(|packet| Exec { packet, ..best() }) {
            let leaks = any(&tree, exec, &aimed).into_iter().filter(|found| !found).count();
            assert_eq!(leaks, 0, "of {} rays, {exec:?}, at {center}", aimed.len());
        }
    }
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
    let aimed: Rays = (0..rays(500))
        .map(|_| aim::at(random.in_cube() * 3.0, random.pick(&mesh.vertices)))
        .collect();
    for builder in KdBuilder::ALL {
        let plan = KdPlan { builder, ..KdPlan::default() };
        let one = KdTree::build_with(&scene, plan, &Sequential);
        let many = KdTree::build_with(&scene, plan, &Threads);
        let [one, many] = [one, many].map(|tree| {
            let tree = tree.expect("in range");
            let (mut hits, mut stats) = (Hits::new(), Stats::default());
            tree.closest(best(), &aimed, &mut hits, &mut stats);
            (tree.nodes(), tree.depth(), tree.references(), stats, hits)
        });
        assert!(one == many, "{builder:?}");
    }
}

/// Triangles through each other, all as large as the scene, and one within the other.
#[test]
fn depth_and_size_are_bounded() {
    let mut random = Random::new(4);
    let crossing: Vec<_> = (0..3_000)
        .map(|_| Triangle { corners: [0; 3].map(|_| random.in_cube().normalize_or(Vec3::X)) })
        .collect();
    let nested = (0..3_000).map(|i| {
        let corners = [Vec3::ZERO, Vec3::new(1.0, 0.0, 0.5), Vec3::new(0.5, 1.0, 1.0)];
        Triangle { corners: corners.map(|corner| corner * power(i % 100 - 60)) }
    });
    for triangles in [crossing, nested.collect()] {
        let scene = flat(triangles);
        for builder in KdBuilder::ALL {
            let tree = build(&scene, builder);
            let (depth, size) = (tree.depth(), tree.references());
            assert!(depth <= 8 + (3_000u32.ilog2() as usize * 13).div_ceil(10) + 1, "{depth}");
            assert!(size <= scene.len() * (1 + GROWTH), "{builder:?}: {size}");
            assert!(size > scene.len(), "{builder:?}: {size}");
        }
    }
}

/// Long triangles are in many cells, and a ray along them meets them again and again.
#[test]
fn mailboxes_spare_tests() {
    let mut random = Random::new(5);
    let mut triangles: Vec<_> = (0..2_000)
        .map(|_| {
            let at = random.in_cube();
            Triangle { corners: [0; 3].map(|_| at + random.in_cube() * 0.02) }
        })
        .collect();
    for i in 0..40 {
        let y = i as f32 / 20.0 - 1.0;
        let corners = [Vec3::new(-1.0, y, -1.0), Vec3::new(1.0, y, -1.0), Vec3::new(0.0, y, 1.0)];
        triangles.push(Triangle { corners });
    }
    let tree = build(&flat(triangles), KdBuilder::Sweep);
    let aimed: Rays = (0..500).map(|_| aim::at(random.in_cube() * 3.0, random.in_cube())).collect();
    for packet in PACKETS {
        mailboxes_spare(&tree, &aimed, Exec { packet, ..best() });
    }
}

fn mailboxes_spare(tree: &KdTree, aimed: &Rays, exec: Exec) {
    let work = |mailbox| {
        let (tree, mut stats) = (tree.clone().with_mailbox(mailbox), Stats::default());
        let mut hits = Hits::new();
        tree.closest(exec, aimed, &mut hits, &mut stats);
        let hits: Vec<_> = (0..aimed.len()).map(|i| hits.get(i).map(bits)).collect();
        (stats, hits)
    };
    let (none, hits) = work(Mailbox::None);
    assert_eq!(none.mailed, 0, "{exec:?}");
    let mut spared = Vec::new();
    for mailbox in [Mailbox::Stamps, Mailbox::Hashed(16), Mailbox::Hashed(2), Mailbox::Inverse] {
        let (stats, same) = work(mailbox);
        assert_eq!(same, hits, "{mailbox:?}");
        assert_eq!(stats.triangle_tests + stats.mailed, none.triangle_tests, "{mailbox:?}");
        assert_eq!(stats.node_visits, none.node_visits, "{mailbox:?}");
        spared.push(stats.mailed);
    }
    let [stamps, large, small, inverse] = spared[..] else { unreachable!() };
    assert!(large > none.triangle_tests / 20 && stamps <= large && stamps > 0, "{spared:?}");
    // Rays that a large packet leaves alone take over its stamps.
    assert!(stamps == large || exec.packet == PacketSize::Large, "{exec:?}: {spared:?}");
    assert!(small < large && small > 0 && inverse < large && inverse > 0, "{spared:?}");
}
