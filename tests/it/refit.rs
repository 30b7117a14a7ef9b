//! A hierarchy with new positions is as right as a new one.

use glam::Vec3;
use proptest::prelude::*;
use rt_kernels::geom::Triangle;
use rt_kernels::tri::Method;
use rt_kernels::{Brute, BuildError, Bvh, Exec, Plan, Primitives, Rays, RefitError, Sequential};
use rt_tests::mesh::Mesh;
use rt_tests::random::Random;
use rt_tests::strategies::{config, ray, scene};
use rt_tests::trace::{any as found_any, closest_bits, every_plan};
use rt_tests::{aim, rays};

fn build(scene: &Primitives, plan: Plan) -> Bvh {
    Bvh::build_with(scene, plan, &Sequential).expect("in range")
}

#[track_caller]
fn same(scene: &Primitives, bvh: &Bvh, rays: &Rays, name: &str) {
    let exec = Exec::best().expect("a level");
    let brute = Brute::build_with(scene, bvh.plan().method).expect("in range");
    assert_eq!(closest_bits(bvh, exec, rays), closest_bits(&brute, exec, rays), "{name}");
    assert_eq!(found_any(bvh, exec, rays), found_any(&brute, exec, rays), "{name}");
}

/// Everything somewhere else: the last triangle where the first was, and so on.
fn turned_around(scene: &Primitives) -> Primitives {
    let mut moved = scene.clone();
    moved.triangles.reverse();
    moved.spheres.reverse();
    moved.cones.reverse();
    moved
}

#[test]
fn hits_are_those_of_the_new_positions() {
    proptest!(config(), |(scene in scene(), plans in prop::collection::vec(ray(), 1..40))| {
        let moved = turned_around(&scene);
        let rays: Rays = plans.iter().map(|plan| plan.aim(&moved)).collect();
        for plan in Method::ALL.into_iter().flat_map(every_plan) {
            let mut bvh = build(&scene, plan);
            let before = (bvh.nodes(), bvh.depth(), bvh.references());
            bvh.refit(&moved).expect("as many");
            prop_assert_eq!((bvh.nodes(), bvh.depth(), bvh.references()), before);
            same(&moved, &bvh, &rays, &format!("{plan:?}"));
        }
    });
}

#[test]
fn a_mesh_that_bends_is_followed() {
    let bent = |bend: f32| Mesh::icosphere(3).map(|v| v + Vec3::X * (bend * v.y * v.y));
    let mut random = Random::new(9);
    for plan in every_plan(Method::default()) {
        let mut bvh = build(&bent(0.0).primitives(), plan);
        for bend in [0.5, 3.0, 0.0] {
            let mesh = bent(bend);
            let rays: Rays = (0..rays(1_000))
                .map(|_| aim::at(random.in_cube() * 3.0, random.pick(&mesh.vertices)))
                .collect();
            bvh.refit(&mesh.primitives()).expect("as many");
            same(&mesh.primitives(), &bvh, &rays, &format!("{plan:?}, bent by {bend}"));
        }
    }
}

#[test]
fn other_scenes_are_refused_and_change_nothing() {
    let scene = Mesh::cube(2).primitives();
    for plan in every_plan(Method::default()) {
        refuses_others(&scene, build(&scene, plan));
    }
}

fn refuses_others(scene: &Primitives, mut bvh: Bvh) {
    let built = [scene.triangles.len(), 0, 0];

    let mut more = scene.clone();
    more.triangles.push(Triangle { corners: [Vec3::ZERO, Vec3::X, Vec3::Y] });
    let given = [built[0] + 1, 0, 0];
    let refused = bvh.refit(&more).expect_err("one more");
    assert_eq!(refused, RefitError::Counts { built, given });
    assert!(
        refused.to_string().contains(&format!("{} triangles, 0 spheres and 0 cones", built[0]))
    );
    let refused = bvh.refit(&Primitives::default()).expect_err("none");
    assert_eq!(refused, RefitError::Counts { built, given: [0; 3] });

    let mut bad = scene.clone();
    bad.triangles[3].corners[1].y = f32::NAN;
    let refused = bvh.refit(&bad).expect_err("not a number");
    assert_eq!(refused, RefitError::Build(BuildError::NotFinite { prim: 3 }));

    let rays: Rays =
        scene.triangles.iter().map(|t| aim::at(Vec3::splat(0.1), t.corners[0])).collect();
    same(scene, &bvh, &rays, "as before");
}
