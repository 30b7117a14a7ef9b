//! Every accelerator gives the same bits as every other, however it is run.

use glam::Vec3;
use proptest::prelude::*;
use rt_kernels::bvh::traverse::catalogue;
use rt_kernels::geom::Triangle;
use rt_kernels::tri::Method;
use rt_kernels::{Accelerator, Brute, Builder, Bvh, Exec, Hits, KdBuilder, KdTree, Layout};
use rt_kernels::{Mailbox, PacketSize, Plan, Primitives};
use rt_kernels::{Ray, Rays, Sequential, Stats};
use rt_tests::mesh::Mesh;
use rt_tests::oracle::entry;
use rt_tests::random::{Random, power};
use rt_tests::strategies::{RayPlan, config, is_in_range, is_valid, ray, scene};
use rt_tests::trace::{
    Bits, any as found_any, bits, closest, closest_bits, every_kd_plan, every_plan, every_way, ways,
};
use rt_tests::{aim, rays};
use simd4::Level;

/// Everything else is compared with this: no hierarchy, no lanes.
fn plainest() -> Exec {
    let level = Level::available().next().expect("scalar is always there");
    Exec { level, packet: PacketSize::Single }
}

/// The most unlike it.
fn widest() -> Exec {
    Exec { packet: PacketSize::Eight, ..Exec::best().expect("a level") }
}

/// Of where not all ways are tried every so many: a number prime to theirs.
const SOME: usize = 11;

/// The plainest way, the widest, and some of all others: which, hangs on `turn`.
fn some_ways(turn: usize) -> Vec<Exec> {
    let some = every_way().into_iter().skip(turn % SOME).step_by(SOME);
    [plainest(), widest()].into_iter().chain(some).collect()
}

/// Checks closest and any of all accelerators, all ways and with every triangle test, against the
/// plainest, and returns that with the default test. From turn to turn every builder comes to be run
/// every way.
fn one_answer(scene: &Primitives, rays: &Rays, turn: usize) -> Vec<Option<rt_kernels::Hit>> {
    let mut methods = Method::ALL.into_iter();
    let default = methods.next().expect("there is a default");
    let hits = one_answer_with(default, scene, rays, turn);
    methods.for_each(|method| drop(one_answer_with(method, scene, rays, turn)));
    hits
}

fn one_answer_with(
    method: Method,
    scene: &Primitives,
    rays: &Rays,
    turn: usize,
) -> Vec<Option<rt_kernels::Hit>> {
    let brute = Brute::build_with(scene, method).expect("a scene in range");
    let hits = closest(&brute, plainest(), rays);
    let want: Vec<Bits> = hits.iter().map(|hit| hit.map(bits)).collect();
    let name = method.name();
    for exec in ways() {
        same(&want, &format!("{name}, brute force"), &brute, exec, rays);
    }
    for plan in every_plan(method) {
        let bvh = Bvh::build_with(scene, plan, &Sequential).expect("a scene in range");
        let default = plan.builder == Builder::default();
        let execs = if default { every_way() } else { some_ways(turn) };
        for exec in execs {
            let (builder, layout) = (plan.builder.name(), plan.layout.name());
            same(&want, &format!("{name}, {builder}, {layout}"), &bvh, exec, rays);
        }
    }
    for plan in every_kd_plan(method) {
        let kd = KdTree::build_with(scene, plan, &Sequential).expect("a scene in range");
        let default = plan.builder == KdBuilder::default() && plan.mailbox == Mailbox::default();
        let execs = if default { every_way() } else { some_ways(turn) };
        for exec in execs {
            same(&want, &format!("{plan:?}"), &kd, exec, rays);
        }
    }
    if method == Method::default() {
        same_compared(&want, scene, rays);
    }
    hits
}

/// The traversals that are there to be compared, over children in either order.
fn same_compared(want: &[Bits], scene: &Primitives, rays: &Rays) {
    let plan = Plan { builder: Builder::Insertion, layout: Layout::Skip, ..Plan::default() };
    let sorted = Bvh::build_with(scene, plan, &Sequential).expect("a scene in range");
    let unsorted = Bvh::build_unsorted(scene, plan.builder, &Sequential).expect("a scene in range");
    for (traversal, bvh) in
        catalogue().into_iter().flat_map(|one| [(one, &sorted), (one, &unsorted)])
    {
        for level in Level::available() {
            let mut hits = Hits::new();
            traversal.closest(level, bvh, rays, &mut hits, &mut Stats::default());
            for (i, want) in want.iter().enumerate() {
                let (order, test) = (traversal.order(), traversal.box_test());
                let got = hits.get(i).map(bits);
                assert_eq!(got, *want, "{order}, {test}, {level}: ray {i}, {:?}", rays.get(i));
            }
        }
    }
}

fn same(want: &[Bits], name: &str, accel: &impl Accelerator, exec: Exec, rays: &Rays) {
    let (got, found) = (closest_bits(accel, exec, rays), found_any(accel, exec, rays));
    for (i, want) in want.iter().enumerate() {
        let ray = rays.get(i);
        assert_eq!(got[i], *want, "{name}, {exec:?}: the closest hit of ray {i}, {ray:?}");
        assert_eq!(found[i], want.is_some(), "{name}, {exec:?}: any hit of ray {i}, {ray:?}");
    }
}

/// Rays whose interval ends or begins at a hit, or just short of it.
fn cut(ray: Ray, t: f32) -> [Ray; 4] {
    [
        Ray { tmax: t, ..ray },
        Ray { tmax: t.next_down(), ..ray },
        Ray { tmin: t, ..ray },
        Ray { tmin: t.next_up(), ..ray },
    ]
}

#[test]
fn closest_and_any_are_one() {
    proptest!(config(), |(scene in scene(), plans in prop::collection::vec(ray(), 1..40))| {
        let aimed: Rays = plans.iter().map(|plan: &RayPlan| plan.aim(&scene)).collect();
        let turn = scene.len() + plans.len();
        let hits = one_answer(&scene, &aimed, turn);

        let mut cuts = Rays::new();
        let mut want = Vec::new();
        for (i, hit) in hits.iter().enumerate() {
            let ray = aimed.get(i);
            let Some(hit) = hit else { continue };
            prop_assert!(is_valid(&ray), "{ray:?} is invalid and hits");
            prop_assert!(hit.t >= ray.tmin && hit.t <= ray.tmax, "{hit:?} is outside of {ray:?}");
            // What is out of range has one answer too, but it need not make sense.
            if is_in_range(&ray) {
                let weights = hit.u >= 0.0 && hit.v >= 0.0 && hit.u + hit.v <= 1.0 + 1e-6;
                prop_assert!(hit.t.is_finite() && weights, "{hit:?} of {ray:?}");
                cuts.extend(cut(ray, hit.t));
                want.push(*hit);
            }
        }
        for (cut, want) in one_answer(&scene, &cuts, turn).chunks(4).zip(want) {
            prop_assert_eq!(cut[0].map(bits), Some(bits(want)), "the interval's end is in it");
            prop_assert_eq!(cut[1], None, "nothing is closer than the closest hit");
            prop_assert!(cut[3].is_none_or(|hit| hit.t > want.t), "{:?} is before the start", cut[3]);
        }
    });
}

/// The hits do not depend on which rays are traced together, nor on what the buffers held before.
#[test]
fn batches_do_not_matter() {
    let plans = || prop::collection::vec(ray(), 1..40);
    proptest!(config(), |(scene in scene(), plans in plans(), turn in any::<prop::sample::Index>())| {
        let bvh = Bvh::build(&scene, &Sequential).expect("a scene in range");
        let aimed: Vec<Ray> = plans.iter().map(|plan| plan.aim(&scene)).collect();
        let n = aimed.len();
        let turn = turn.index(n);
        let permuted: Vec<usize> = (0..n).rev().map(|i| (i + turn) % n).collect();
        let prefix: Vec<usize> = (0..turn).collect();
        for exec in ways() {
            let all: Rays = aimed.iter().copied().collect();
            let want = closest_bits(&bvh, exec, &all);
            let (mut hits, mut found) = (Hits::new(), vec![true; 3]);
            bvh.closest(exec, &all, &mut hits, &mut Stats::default());
            for order in [&permuted, &prefix] {
                let some: Rays = order.iter().map(|&i| aimed[i]).collect();
                bvh.closest(exec, &some, &mut hits, &mut Stats::default());
                bvh.any(exec, &some, &mut found, &mut Stats::default());
                prop_assert_eq!((hits.len(), found.len()), (some.len(), some.len()));
                for (at, &i) in order.iter().enumerate() {
                    let got = hits.get(at).map(bits);
                    prop_assert_eq!(got, want[i], "{:?}: ray {} at {}", exec, i, at);
                    prop_assert_eq!(found[at], want[i].is_some(), "{:?}: ray {}", exec, i);
                }
            }
        }
    });
}

/// Closed meshes in planes across the axes, and flat ones full of needles, from near and far: the
/// distance of many a hit would fall before the entry into its own box, were it not held there, and
/// what is found would depend on what was found before.
#[test]
fn meshes_aimed_at_edges_and_vertices() {
    let far = Vec3::new(1000.0, -70000.0, 0.0);
    let mut random = Random::new(1);
    let spiky = Mesh::icosphere(2).map(|v| v * (1.0 + 0.2 * random.signed()));
    let flat = Vec3::new(1.0, 1e-6, 1.0);
    let meshes = [
        ("a cube", Mesh::cube(6), Vec3::ONE),
        ("a cube, far", Mesh::cube(6).map(|v| v + far), Vec3::ONE),
        ("spiky", spiky.clone(), Vec3::ONE),
        ("spiky and flat", spiky.clone().map(|v| v * flat), flat),
        ("spiky and flat, aside", spiky.map(|v| v * 100.0 * flat + Vec3::X * 1000.0), 100.0 * flat),
    ];
    for (turn, (name, mesh, shape)) in meshes.into_iter().enumerate() {
        let (scene, edges) = (mesh.primitives(), mesh.edges());
        let rays: Rays = (0..rays(2_000))
            .map(|i| {
                let [a, b] = random.pick(&edges).map(|i| mesh.vertices[i as usize]);
                let target = if i % 2 == 0 { a } else { aim::between(a, b, random.unit()) };
                let reach = random.magnitude(-2, 16);
                aim::at(mesh.vertices[0] + random.in_cube() * shape * reach, target)
            })
            .collect();
        let hits = one_answer(&scene, &rays, turn);
        let share = hits.iter().flatten().count() as f64 / hits.len() as f64;
        assert!(share > 0.5, "{name}: only {share} of the rays hit");
    }
}

/// A needle, seen from its edge and askew to all axes, whose hit rounding would move to before the
/// entry into its own box; and just before the entry, a screen that is visited first. A hit in
/// front of its box would be found by brute force, and be hidden from a hierarchy by the screen.
#[test]
fn a_screen_hides_the_boxes_behind_it() {
    let mut random = Random::new(2);
    let mut tried = 0;
    let (right, up) = (Vec3::new(0.8, 0.36, -0.48), Vec3::new(-0.6, 0.48, -0.64));
    let thin = |v: Vec3| right * v.x + up * v.y + right.cross(up) * (v.z * 1e-7);
    for _ in 0..rays(2_000) {
        let [a, b] = [random.in_cube(), random.in_cube()];
        let needle = Triangle { corners: [a, b, b + random.in_cube() * 0.1].map(thin) };
        let [a, b, _] = needle.corners;
        let rays: Rays = (0..64)
            .map(|_| aim::at(thin(random.in_cube()), aim::between(a, b, random.unit())))
            .collect();
        let alone = Primitives { triangles: vec![needle], ..Primitives::default() };
        let alone = closest(&Brute::build(&alone).expect("in range"), plainest(), &rays);
        for (i, hit) in alone.into_iter().enumerate() {
            let ray = rays.get(i);
            let Some(entry) = hit.map(|hit| hit.t).filter(|t| *t == entry(&ray, &needle.own_box()))
            else {
                continue;
            };
            tried += 1;
            let nearer = entry * (1.0 - power(-2 - (tried % 16)));
            let screen = screen(&ray, nearer, needle.own_box().extent().max_element());
            let scene = Primitives {
                triangles: vec![screen, screen, screen, screen, needle],
                ..Primitives::default()
            };
            one_answer(&scene, &[ray].into_iter().collect(), tried as usize);
        }
    }
    assert!(tried > 0, "no hit is held at the entry into its own box");
}

/// A triangle across the axis that the ray runs along most, at `t`, and larger than `extent`.
fn screen(ray: &Ray, t: f32, extent: f32) -> Triangle {
    let axis = ray.dir.abs().max_position();
    let corner = |[u, v]: [f32; 2]| {
        let mut corner = ray.at(t);
        corner[(axis + 1) % 3] += u * extent;
        corner[(axis + 2) % 3] += v * extent;
        corner
    };
    Triangle { corners: [[-2.0, -2.0], [3.0, -1.0], [0.0, 3.0]].map(corner) }
}
