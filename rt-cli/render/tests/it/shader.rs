//! Shaders from outside the crate.

use glam::Vec3;
use rt_render::{Finish, Integrator, Job, Point, Shader};
use rt_scene::{Light, Material, Scene, Sphere};

use crate::support::{job, picture, view, world};

/// A ball in front of the camera, lit from there.
fn ball() -> Scene {
    Scene {
        spheres: vec![Sphere { center: Vec3::ZERO, radius: 1.0, material: 0 }],
        materials: vec![Material::default()],
        lights: vec![Light { position: Vec3::new(0.0, 0.0, 50.0), color: Vec3::ONE }],
        view: view(Vec3::ZERO, 5.0, 20.0),
        background: Some(Vec3::ZERO),
        ..Scene::default()
    }
}

struct Halves;

impl Shader for Halves {
    fn finish(&self, at: &Point) -> Finish {
        assert!((at.position.length() - 1.0).abs() < 1e-5, "{at:?}");
        assert!(at.front && at.material == 0 && at.normal.dot(at.dir) <= 0.0);
        let left = at.position.x < 0.0;
        Finish { diffuse: if left { Vec3::X } else { Vec3::Z }, ..Finish::default() }
    }
}

#[test]
fn a_pattern_is_where_it_says() {
    let scene = ball();
    let mut world = world(&scene);
    world.set_shader(0, Halves);
    for integrator in [Integrator::Whitted, Integrator::Eyelight] {
        let (film, _) = picture(&world, &Job { integrator, ..job(&scene, (40, 40), 0) });
        for (i, pixel) in film.pixels().iter().enumerate() {
            let left = i % 40 < 20;
            assert!(if left { pixel.z == 0.0 } else { pixel.x == 0.0 }, "{i}: {pixel}");
            assert_eq!(pixel.y, 0.0);
        }
        assert!(film.pixels()[20 * 40 + 19].x > 0.9 && film.pixels()[20 * 40 + 20].z > 0.9);
    }
}

/// All light, however it arrives.
struct Flat;

impl Shader for Flat {
    fn finish(&self, _: &Point) -> Finish {
        Finish { own_light: true, ..Finish::default() }
    }

    fn light(&self, at: &Point, finish: &Finish, to_light: Vec3) -> Vec3 {
        assert!(to_light.dot(at.true_normal) > 0.0);
        assert_eq!(finish.normal, at.normal);
        Vec3::new(0.25, 0.5, 0.75)
    }
}

#[test]
fn a_shader_may_do_its_own_light() {
    let scene = ball();
    let mut world = world(&scene);
    world.set_shader(0, Flat);
    let (film, report) = picture(&world, &job(&scene, (40, 40), 0));
    let lit = film.pixels().iter().filter(|&&pixel| pixel == Vec3::new(0.25, 0.5, 0.75)).count();
    let dark = film.pixels().iter().filter(|&&pixel| pixel == Vec3::ZERO).count();
    assert!(lit > 900 && lit + dark == 1600, "{lit} lit, {dark} dark");
    assert_eq!(report.shadow.rays, lit as u64);
}

/// The default of [`Shader::light`] is what is computed for many points at once.
struct Asked(Material);

impl Shader for Asked {
    fn finish(&self, _: &Point) -> Finish {
        Finish { own_light: true, ..Finish::from(&self.0) }
    }
}

#[test]
fn phong_in_lanes_is_phong() {
    let mut scene = ball();
    let material = Material {
        diffuse: Vec3::new(0.1, 0.4, 0.3),
        specular: Vec3::new(0.9, 0.5, 0.7),
        shininess: 12.5,
        ..Material::default()
    };
    scene.materials[0] = material.clone();
    scene.lights[0].position = Vec3::new(5.0, 3.0, 9.0);
    let job = job(&scene, (75, 50), 0);
    let mut world = world(&scene);
    let (lanes, _) = picture(&world, &job);
    world.set_shader(0, Asked(material));
    let (points, _) = picture(&world, &job);
    let brightest = lanes.pixels().iter().fold(Vec3::ZERO, |a, &b| a.max(b));
    assert!(brightest.x > 0.8, "there is a highlight: {brightest}");
    for (lanes, points) in lanes.pixels().iter().zip(points.pixels()) {
        assert!((*lanes - *points).abs().max_element() < 1e-6, "{lanes} {points}");
    }
}
