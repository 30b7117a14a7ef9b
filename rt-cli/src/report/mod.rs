//! What was done, in a line and in JSON.

mod identity;
mod precision;
mod words;

pub(crate) use identity::identity;
pub(crate) use precision::{Kernel, facts_json, facts_lines};
pub(crate) use words::{count, crop, flags, number_of, plural, time};

use std::path::Path;
use std::time::Duration;

use rt_render::{Crop, Job, KindReport, Report, World};
use rt_scene::Scene;
use serde_json::{Value, json};

/// The primitives that a file states, by kind.
pub(crate) fn stated(scene: &Scene) -> Value {
    json!(scene.facts.stated)
}

/// What is in a scene, in a line.
pub(crate) fn contents(scene: &Scene) -> String {
    number_of(&[
        ("triangle", scene.mesh.triangles.len()),
        ("sphere", scene.spheres.len()),
        ("cone", scene.cones.len()),
        ("material", scene.materials.len()),
        ("light", scene.lights.len()),
    ])
}

/// How a world was built, in a line.
pub(crate) fn built(world: &World) -> String {
    let by = world.builder().map_or(String::new(), |builder| format!(" by {builder}"));
    let kilobytes = |bytes: usize| bytes.div_ceil(1024);
    format!(
        "{}, {}: built in {}{by}; {} KiB beside {} KiB of scene",
        world.accel_kind().name(),
        world.layout(),
        time(world.build_time()),
        kilobytes(world.accel_bytes()),
        kilobytes(world.scene_bytes()),
    )
}

/// A picture that was made.
pub(crate) struct Rendered<'a> {
    pub(crate) name: &'a str,
    pub(crate) output: &'a Path,
    pub(crate) world: &'a World,
    pub(crate) job: &'a Job,
    pub(crate) kernel: &'a Kernel,
    pub(crate) made: Report,
}

impl Rendered<'_> {
    /// The closing line.
    pub(crate) fn line(&self) -> String {
        let (world, made) = (self.world, &self.made);
        let kinds = [
            ("primary", made.primary),
            ("shadow", made.shadow),
            ("reflection", made.reflection),
            ("refraction", made.refraction),
        ];
        let speeds: Vec<_> = kinds
            .into_iter()
            .filter_map(|(kind, report)| Some(format!("{kind} {:.1}", report.mrays_per_s()?)))
            .collect();
        let output = match self.output.display().to_string() {
            stdout if stdout == "-" => "standard output".to_owned(),
            file => file,
        };
        let Crop { width, height, .. } = self.job.area();
        format!(
            "{output}: {width}x{height}{}, {}; {} built in {}, rendered in {} (tracing {}); Mray/s: {}; {}, {}; {}",
            match self.job.crop {
                Some(_) => format!(" of {}x{}", self.job.size.0, self.job.size.1),
                None => String::new(),
            },
            number_of(&[
                ("triangle", world.triangles()),
                ("sphere", world.spheres()),
                ("cone", world.cones()),
            ]),
            world.accel_kind().name(),
            time(world.build_time()),
            time(made.total),
            time(made.all().time),
            speeds.join(", "),
            self.job.exec.level,
            count(self.job.threads, "thread"),
            self.kernel.words(),
        )
    }

    /// What each kind of ray took, and the work for it.
    pub(crate) fn details(&self) -> Vec<String> {
        let (made, exec) = (&self.made, self.job.exec);
        let kinds = [
            ("primary rays", made.primary),
            ("shadow rays", made.shadow),
            ("reflected rays", made.reflection),
            ("refracted rays", made.refraction),
        ];
        let rays = kinds.into_iter().filter(|(_, report)| report.rays > 0);
        let mut lines: Vec<_> = rays
            .map(|(kind, report)| {
                let (time, alone) = (time(report.time), report.alone);
                format!("{kind}: {}, traced in {time}; {alone} went on alone", report.rays)
            })
            .collect();
        let each = |count: u64| count as f64 / made.all().rays.max(1) as f64;
        let stats = &made.stats;
        lines.push(format!(
            "a ray on average: {:.1} nodes, {:.1} boxes, {:.1} triangles, {:.1} spheres, {:.1} cones",
            each(stats.node_visits),
            each(stats.box_tests),
            each(stats.triangle_tests),
            each(stats.sphere_tests),
            each(stats.cone_tests),
        ));
        lines.push(format!(
            "shaded in {}; {} rays together over {}",
            time(made.shading),
            exec.lanes(),
            self.world.layout(),
        ));
        lines
    }

    /// The same facts and more.
    pub(crate) fn json(&self, stated: Value) -> Value {
        let (world, job, made) = (self.world, self.job, &self.made);
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        let speed = |kind: KindReport| kind.mrays_per_s();
        json!({
            "scene": self.name,
            "output": self.output.display().to_string(),
            "width": job.size.0,
            "height": job.size.1,
            "crop": job.crop.map(|crop| [crop.left, crop.top, crop.width, crop.height]),
            "triangles": world.triangles(),
            "primitives": stated,
            "integrator": job.integrator.name(),
            "isa": job.exec.level.name(),
            "threads": job.threads,
            "accel": world.accel_kind().name(),
            "builder": world.builder(),
            "layout": world.layout(),
            "packet": job.exec.lanes().to_string(),
            "kernel": self.kernel.method().name(),
            "relaxed": job.relaxed,
            "tolerance": self.kernel.json(),
            "build_ms": ms(world.build_time()),
            "trace_ms": ms(made.all().time),
            "shade_ms": ms(made.shading),
            "total_ms": ms(world.build_time() + made.total),
            "memory": { "scene_bytes": world.scene_bytes(), "accel_bytes": world.accel_bytes() },
            "rays": {
                "primary": made.primary.rays,
                "shadow": made.shadow.rays,
                "reflection": made.reflection.rays,
                "refraction": made.refraction.rays,
            },
            "rays_alone": {
                "primary": made.primary.alone,
                "shadow": made.shadow.alone,
                "reflection": made.reflection.alone,
                "refraction": made.refraction.alone,
            },
            "mrays_per_s": speed(made.all()),
            "mrays_per_s_by_kind": {
                "primary": speed(made.primary),
                "shadow": speed(made.shadow),
                "reflection": speed(made.reflection),
                "refraction": speed(made.refraction),
            },
            "node_visits": made.stats.node_visits,
            "box_tests": made.stats.box_tests,
            "triangle_tests": made.stats.triangle_tests,
            "sphere_tests": made.stats.sphere_tests,
            "cone_tests": made.stats.cone_tests,
        })
    }
}
