//! Questions about one ray, against each primitive by itself.

use proptest::prelude::*;
use rt_kernels::tri::Method;
use rt_kernels::{
    Accelerator, Brute, Builder, Bvh, Exec, Hit, Layout, Plan, Primitives, Ray, Rays, Sequential,
};
use rt_tests::strategies::{config, ray, scene};
use rt_tests::trace::{bits, closest};

/// What a ray hits of every primitive when there is no other, in order.
fn hits_of_each(scene: &Primitives, method: Method, ray: &Ray) -> Vec<Hit> {
    let triangles = scene
        .triangles
        .iter()
        .map(|&triangle| Primitives { triangles: vec![triangle], ..Primitives::default() });
    let spheres = scene
        .spheres
        .iter()
        .map(|&sphere| Primitives { spheres: vec![sphere], ..Primitives::default() });
    let cones =
        scene.cones.iter().map(|&cone| Primitives { cones: vec![cone], ..Primitives::default() });
    let rays: Rays = [*ray].into_iter().collect();
    let mut hits: Vec<Hit> = (0..)
        .zip(triangles.chain(spheres).chain(cones))
        .filter_map(|(prim, alone)| {
            let brute = Brute::build_with(&alone, method).expect("in range");
            let hit = closest(&brute, Exec::best().expect("a level"), &rays)[0]?;
            Some(Hit { prim, ..hit })
        })
        .collect();
    hits.sort_by(|a, b| (a.t, a.prim).partial_cmp(&(b.t, b.prim)).expect("no NaN"));
    hits
}

fn check(accel: &dyn Accelerator, ray: &Ray, want: &[Hit], name: &str) {
    let all: Vec<_> = want.iter().copied().map(bits).collect();
    let got: Vec<_> = accel.all_hits(ray).into_iter().map(bits).collect();
    assert_eq!(got, all, "{name}: all hits of {ray:?}");
    assert_eq!(accel.intersect(ray).map(bits), all.first().copied(), "{name}: {ray:?}");
    assert_eq!(accel.occluded(ray), !all.is_empty(), "{name}: {ray:?}");
    for refused in 0..4 {
        let keep = |hit: &Hit| hit.prim % 4 != refused;
        let want = want.iter().copied().find(keep).map(bits);
        let got = accel.intersect_where(ray, &mut |hit| keep(hit)).map(bits);
        assert_eq!(got, want, "{name}, not every fourth from {refused}: {ray:?}");
    }
}

#[test]
fn one_ray_has_the_hits_of_each_primitive_alone() {
    proptest!(config(), |(scene in scene(), plans in prop::collection::vec(ray(), 1..10))| {
        for method in Method::ALL {
            let brute = Brute::build_with(&scene, method).expect("in range");
            let build = |plan| Bvh::build_with(&scene, plan, &Sequential).expect("in range");
            let builders = Builder::ALL.map(|builder| Plan { builder, ..Plan::default() });
            // Wide ones have the default test, whatever is asked for.
            let layouts = Layout::ALL.map(|layout| Plan { layout, ..Plan::default() });
            let all = builders.into_iter().chain(layouts).map(|plan| Plan { method, ..plan });
            let bvhs: Vec<_> = all.map(build).collect();
            for ray in plans.iter().map(|plan| plan.aim(&scene)) {
                let want = hits_of_each(&scene, method, &ray);
                check(&brute, &ray, &want, "brute force");
                for bvh in &bvhs {
                    check(bvh, &ray, &want, &format!("{:?}", bvh.plan()));
                }
            }
        }
    });
}

/// The visitor's limit is kept to, and a negative one is the end.
#[test]
fn a_visitor_is_shown_no_more_than_it_asks_for() {
    proptest!(config(), |(scene in scene(), plan in ray())| {
        let ray = plan.aim(&scene);
        for layout in Layout::ALL {
        let plan = Plan { layout, ..Plan::default() };
        let bvh = Bvh::build_with(&scene, plan, &Sequential).expect("in range");
        let (mut limit, mut shown) = (f32::INFINITY, 0);
        bvh.visit(&ray, &mut |hit| {
            assert!(hit.t <= limit && ray.tmin <= hit.t && hit.t <= ray.tmax, "{hit:?}, {limit}");
            // A greater one than before changes nothing.
            if hit.prim % 2 == 0 {
                limit = hit.t;
                limit
            } else {
                f32::INFINITY
            }
        });
        bvh.visit(&ray, &mut |_| {
            shown += 1;
            -1.0
        });
        prop_assert_eq!(shown, u32::from(bvh.occluded(&ray)));
        }
    });
}
