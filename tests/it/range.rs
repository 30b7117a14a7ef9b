//! One answer at every scale.

use glam::Vec3;
use rt_kernels::geom::{Cone, Sphere};
use rt_kernels::{Bvh, Exec, Hit, Rays, Sequential};
use rt_render::{AccelKind, Film, Integrator, Job, Silent, World, fitted_view, render};
use rt_scene::Scene;
use rt_tests::mesh::Mesh;
use rt_tests::random::{Random, power};
use rt_tests::scenes::{bumpy, room, scaled};
use rt_tests::trace::closest;
use rt_tests::{aim, rays};

const SIZE: (u32, u32) = (60, 40);

fn picture(scene: &Scene, integrator: Integrator) -> Film {
    let world = World::build(scene.clone(), AccelKind::Bvh, 1).expect("a scene of any scale");
    let job = Job {
        size: SIZE,
        crop: None,
        view: scene.view.unwrap_or_else(|| fitted_view(world.bounds(), SIZE, Vec3::Y, 40.0)),
        lights: scene.lights.clone(),
        background: Vec3::splat(0.125),
        integrator,
        samples: 1,
        depth: 3,
        shadows: true,
        relaxed: false,
        exec: Exec::best().expect("a level"),
        threads: 1,
    };
    render(&world, &job, &Silent).expect("a job that can be done").0
}

/// Far outside the range of the kernels, a scene is brought in by a power of two, and no pixel
/// tells. (Where the view is fitted, that is scaled too.)
#[test]
fn pictures_do_not_depend_on_the_unit_of_length() {
    for scene in [room(), bumpy()] {
        for integrator in
            [Integrator::Whitted, Integrator::Eyelight, Integrator::Normals, Integrator::Depth]
        {
            let want = picture(&scene, integrator);
            for exponent in [-100, -60, -21, -3, 7, 21, 60, 80] {
                let got = picture(&scaled(scene.clone(), power(exponent)), integrator);
                let name = format!("{}, {}", scene.name, integrator.name());
                assert!(got == want, "{name}: times 2^{exponent} it is another picture");
            }
        }
    }
}

/// The hits of rays from inside a cube of that size around a ball and a cone, of which the greatest component
/// of the direction is near 2^`pace`; distances in units that make them the same for all.
fn hits(size: i32, pace: i32, with_cone: bool) -> Vec<Option<Hit>> {
    let mesh = Mesh::cube(2).map(|v| v * power(size));
    let mut scene = mesh.primitives();
    scene.spheres.push(Sphere { center: Vec3::ZERO, radius: power(size - 2) });
    if with_cone {
        let end = Vec3::new(0.25, -0.5, 0.75) * power(size);
        let [base_radius, apex_radius] = [power(size - 3), power(size - 5)];
        scene.cones.push(Cone { base: -end, base_radius, apex: end, apex_radius });
    }
    let bvh = Bvh::build(&scene, &Sequential).expect("in range");
    let mut random = Random::new(41);
    let rays: Rays = (0..rays(4_000))
        .map(|_| {
            let [a, b] = mesh.edges()[random.below(mesh.edges().len())];
            let (a, b) = (mesh.vertices[a as usize], mesh.vertices[b as usize]);
            let target = aim::between(a, b, [0.0, 0.5, random.unit()][random.below(3)]);
            let target = aim::between(target, Vec3::ZERO, random.pick(&[0.0, 0.0, 1.0, 0.75]));
            let origin = random.in_cube() * (0.9 * power(size));
            aim::paced(aim::at(origin, target), pace)
        })
        .collect();
    let unit = power(pace) / power(size);
    let exec = Exec::best().expect("a level");
    let scaled = |hit: Hit| Hit { t: hit.t * unit, ..hit };
    closest(&bvh, exec, &rays).into_iter().map(|hit| hit.map(scaled)).collect()
}

/// From one end of the documented range to the other: coordinates up to 2^40, primitives down to
/// 2^-40, directions from 2^-20 to 2^20.
#[test]
fn hits_do_not_depend_on_the_unit_of_length() {
    let wants = [false, true].map(|with_cone| hits(0, 0, with_cone));
    assert!(wants.iter().flatten().all(Option::is_some), "rays from inside a cube hit it");
    for size in [-38, -30, -10, 10, 30, 39] {
        for pace in [-20, -7, 0, 7, 19] {
            // Cones have narrower limits.
            let with_cone = size - 5 + pace > -50;
            let want = &wants[usize::from(with_cone)];
            for (i, (got, want)) in hits(size, pace, with_cone).into_iter().zip(want).enumerate() {
                let same = got.zip(*want).is_some_and(|(got, want)| {
                    let t = (got.t - want.t).abs() <= 4.0 * f32::EPSILON * want.t;
                    let weights = (got.u - want.u).abs().max((got.v - want.v).abs()) < 1e-6;
                    got.prim == want.prim && t && weights
                });
                assert!(same, "ray {i}, size 2^{size}, pace 2^{pace}: {got:?}, not {want:?}");
            }
        }
    }
}
