//! `rt bench`.

use std::ffi::OsStr;
use std::path::Path;

use glam::Vec3;
use rt_render::measure::{self, Row, Way};
use rt_render::{AccelKind, Exec, Integrator, Job, Level, Method, PacketSize, World};
use rt_scene::View;
use serde_json::{Value, json};

use super::render::default_view;
use crate::args::{BenchArgs, best_level};
use crate::error::Error;
use crate::output;

/// Times every scene in turn; what is done is shown at once.
pub(crate) fn run(args: &BenchArgs) -> Result<(), Error> {
    let json = args.json.as_deref().map(output::open_json).transpose()?;
    let table = args.json.as_deref() != Some(Path::new("-"));
    let show = |text: &str| if table { output::to_stdout(text.as_bytes()) } else { Ok(()) };
    let execs = match args.kernels {
        true => vec![Exec::at(best_level()?)],
        false => {
            let one = Exec { level: scalar(), packet: PacketSize::Single };
            [one].into_iter().chain(Level::available().map(Exec::at)).collect()
        }
    };
    let methods = if args.kernels { &Method::ALL[..] } else { &Method::ALL[..1] };

    let width = args.scenes.iter().map(|name| name_width(name)).max().unwrap_or(0);
    show(&format!("{:<width$} {}\n", "scene", head(args.kernels)))?;
    let mut rows = Vec::new();
    for name in &args.scenes {
        let mut scene = rt_scene::open(name)?;
        let view = scene.view.take();
        let scene_name = scene.name.clone();
        let worlds = methods
            .iter()
            .map(|&method| World::build_with(scene.clone(), AccelKind::Bvh, method, 1))
            .collect::<Result<Vec<_>, _>>()?;
        let view = view.unwrap_or_else(|| default_view(worlds[0].bounds(), args.size));
        let job = job(view, args.size, execs[0]);
        let ways: Vec<_> = worlds
            .iter()
            .flat_map(|world| execs.iter().map(move |&exec| Way { world, exec }))
            .collect();
        let measured = measure::primary(&job, &ways, args.rounds.into())?;
        for (row, way) in measured.iter().zip(&ways) {
            if row.differing > 0 && row.method == measured[0].method {
                let way = format!("{} × {}", row.exec.level, row.exec.lanes());
                return Err(Error::Differ { scene: scene_name, differing: row.differing, way });
            }
            show(&format!("{scene_name:<width$} {}\n", line(row, &measured, args.kernels)))?;
            rows.push(row_json(&scene_name, way.world, row));
        }
    }
    match json {
        Some(json) => json.write(output::json(&json!({ "rows": rows })).as_bytes()),
        None => Ok(()),
    }
}

/// The level that every CPU has.
fn scalar() -> Level {
    Level::available().next().expect("scalar is always there")
}

/// About how long the name of a scene will be once it is opened.
fn name_width(name: &OsStr) -> usize {
    let computed = name.as_encoded_bytes().starts_with(b"spd:");
    let size = if computed { ":10".len() } else { 0 };
    Path::new(name).file_name().map_or(0, |base| base.to_string_lossy().chars().count()) + size
}

/// The primary rays of a picture; of the rest nothing matters.
fn job(view: View, size: (u32, u32), exec: Exec) -> Job {
    Job {
        size,
        view,
        lights: Vec::new(),
        background: Vec3::ZERO,
        integrator: Integrator::Depth,
        depth: 0,
        shadows: false,
        exec,
        threads: 1,
    }
}

fn mrays_per_s(row: &Row) -> f64 {
    row.rays as f64 / row.time.as_secs_f64() / 1e6
}

/// The columns' names.
fn head(kernels: bool) -> String {
    match kernels {
        true => format!(
            "{:<16}{:>9}{:>14}{:>14}{:>11}",
            "kernel", "Mray/s", "× watertight", "other hits/M", "tests/ray"
        ),
        false => format!(
            "{:<7}{:>7}{:>9}{:>8}{:>10}{:>11}{:>11}",
            "level", "packet", "Mray/s", "× one", "× scalar", "nodes/ray", "tests/ray"
        ),
    }
}

/// A row of the table; `measured` begins with one ray at a time and the scalar level, or with the
/// watertight kernel.
fn line(row: &Row, measured: &[Row], kernels: bool) -> String {
    let times = |other: &Row| other.time.as_secs_f64() / row.time.as_secs_f64();
    let per_ray = |count: u64| count as f64 / row.rays as f64;
    if kernels {
        return format!(
            "{:<16}{:>9.2}{:>14.3}{:>14.1}{:>11.1}",
            row.method.name(),
            mrays_per_s(row),
            times(&measured[0]),
            per_ray(row.differing) * 1e6,
            per_ray(row.stats.triangle_tests + row.stats.sphere_tests),
        );
    }
    format!(
        "{:<7}{:>7}{:>9.2}{:>8.2}{:>10.2}{:>11.1}{:>11.1}",
        row.exec.level,
        row.exec.lanes(),
        mrays_per_s(row),
        times(&measured[0]),
        times(&measured[1]),
        per_ray(row.stats.box_tests),
        per_ray(row.stats.triangle_tests + row.stats.sphere_tests),
    )
}

fn row_json(scene: &str, world: &World, row: &Row) -> Value {
    let per_ray = |count: u64| count as f64 / row.rays as f64;
    json!({
        "what": "trace",
        "scene": scene,
        "kind": "primary",
        "level": row.exec.level.name(),
        "kernel": row.method.name(),
        "accel": world.accel_kind().name(),
        "layout": world.accel_kind().layout(),
        "packet": row.exec.lanes().to_string(),
        "ns": row.time.as_secs_f64() * 1e9 / row.rays as f64,
        "mrays_per_s": mrays_per_s(row),
        "nodes_per_ray": per_ray(row.stats.box_tests),
        "tests_per_ray": per_ray(row.stats.triangle_tests + row.stats.sphere_tests),
        "bytes": world.accel_bytes(),
    })
}
