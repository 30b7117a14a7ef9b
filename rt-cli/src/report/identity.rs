//! What a picture is of: all that its pixels depend on.

use rt_render::{Integrator, Job, World};

use super::words::{crop, flags, list};

/// A line for each, the same for the same pixels.
pub(crate) fn identity(world: &World, job: &Job) -> Vec<String> {
    let Job {
        size,
        crop: area,
        view,
        lights,
        background,
        integrator,
        samples,
        depth,
        shadows,
        relaxed,
        // The pixels do not depend on these.
        exec: _,
        threads: _,
    } = job;
    let mut lines = vec![
        format!("rt {}", env!("CARGO_PKG_VERSION")),
        format!("scene {}, {:016x}", world.name(), world.fingerprint()),
        format!("size {}x{}", size.0, size.1),
        format!("crop {}", area.map_or("none".to_owned(), crop)),
        format!("view {}", flags(view)),
        format!("background {}", list(*background)),
        format!("integrator {}", integrator.name()),
        format!("samples {samples}"),
        format!("depth {depth}"),
        format!("shadows {shadows}"),
        format!("relaxed {relaxed}"),
        format!("kernel {}", world.method().name()),
    ];
    if *integrator == Integrator::Heat {
        let (kind, builder) = (world.accel_kind().name(), world.builder().unwrap_or("none"));
        lines.push(format!("accel {kind}, {builder}, {}", world.layout()));
    }
    lines.extend(
        lights.iter().map(|light| format!("light {},{}", list(light.position), list(light.color))),
    );
    lines
}
