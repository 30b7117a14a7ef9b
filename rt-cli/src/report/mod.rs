//! What was done, in a line and in JSON.

mod precision;
mod words;

pub(crate) use precision::{Kernel, facts_json, facts_lines};
pub(crate) use words::{count, flags, number_of, plural, time};

use std::path::Path;
use std::time::Duration;

use rt_render::{Job, KindReport, Report, World};
use rt_scene::Scene;
use serde_json::{Value, json};

/// The primitives that a file states, by kind.
pub(crate) fn stated(scene: &Scene) -> Value {
    json!(scene.facts.stated)
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
        let kinds =
            [("primary", made.primary), ("shadow", made.shadow), ("reflection", made.reflection)];
        let speeds: Vec<_> = kinds
            .into_iter()
            .filter_map(|(kind, report)| Some(format!("{kind} {:.1}", report.mrays_per_s()?)))
            .collect();
        let output = match self.output.display().to_string() {
            stdout if stdout == "-" => "standard output".to_owned(),
            file => file,
        };
        format!(
            "{output}: {}x{}, {}; {} built in {}, rendered in {} (tracing {}); Mray/s: {}; {}, {}; {}",
            self.job.size.0,
            self.job.size.1,
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
                "refraction": 0,
            },
            "mrays_per_s": speed(made.all()),
            "mrays_per_s_by_kind": {
                "primary": speed(made.primary),
                "shadow": speed(made.shadow),
                "reflection": speed(made.reflection),
            },
            "node_visits": made.stats.node_visits,
            "box_tests": made.stats.box_tests,
            "triangle_tests": made.stats.triangle_tests,
            "sphere_tests": made.stats.sphere_tests,
            "cone_tests": made.stats.cone_tests,
        })
    }
}
