//! What the tests share.

use glam::Vec3;
use rt_render::{AccelKind, Exec, Film, Integrator, Job, Report, Silent, World, render};
use rt_scene::{Material, Scene, View};

pub(crate) fn world(scene: &Scene) -> World {
    World::build(scene.clone(), AccelKind::Bvh, 1).expect("a scene that can be rendered")
}

/// What the scene says, with a white background where it says nothing.
pub(crate) fn job(scene: &Scene, size: (u32, u32), depth: u32) -> Job {
    Job {
        size,
        crop: None,
        view: scene.view.expect("it has a view"),
        lights: scene.lights.clone(),
        background: scene.background.unwrap_or(Vec3::ONE),
        integrator: Integrator::Whitted,
        samples: 1,
        depth,
        shadows: true,
        relaxed: false,
        exec: Exec::best().expect("a level"),
        threads: 2,
    }
}

pub(crate) fn picture(world: &World, job: &Job) -> (Film, Report) {
    render(world, job, &Silent).expect("a job that can be done")
}

/// All light goes through it, and nothing else is to be seen of it.
pub(crate) fn invisible() -> Material {
    Material { diffuse: Vec3::ZERO, transmission: Vec3::ONE, ..Material::default() }
}

/// A camera that looks at a point along −z.
pub(crate) fn view(target: Vec3, distance: f32, fov_y: f32) -> Option<View> {
    Some(View { eye: target + Vec3::Z * distance, target, up: Vec3::Y, fov_y, size: None })
}
