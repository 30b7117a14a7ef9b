//! `rt bench`.

use std::ffi::OsStr;
use std::path::Path;

use glam::Vec3;
use rt_render::measure::{self, Row};
use rt_render::{AccelKind, Exec, Integrator, Job, Level, PacketSize, World};
use rt_scene::View;
use serde_json::{Value, json};

use super::render::default_view;
use crate::args::BenchArgs;
use crate::error::Error;
use crate::output;

/// Times every scene in turn; what is done is shown at once.
pub(crate) fn run(args: &BenchArgs) -> Result<(), Error> {
    let json = args.json.as_deref().map(output::open_json).transpose()?;
    let table = args.json.as_deref() != Some(Path::new("-"));
    let show = |text: &str| if table { output::to_stdout(text.as_bytes()) } else { Ok(()) };
    let mut ways = vec![Exec { level: scalar(), packet: PacketSize::Single }];
    ways.extend(Level::available().map(Exec::at));

    let width = args.scenes.iter().map(|name| name_width(name)).max().unwrap_or(0);
    show(&format!(
        "{:<width$} {:<7}{:>7}{:>9}{:>8}{:>10}{:>11}{:>11}\n",
        "scene", "level", "packet", "Mray/s", "× one", "× scalar", "nodes/ray", "tests/ray"
    ))?;
    let mut rows = Vec::new();
    for name in &args.scenes {
        let mut scene = rt_scene::open(name)?;
        let view = scene.view.take();
        let scene_name = scene.name.clone();
        let world = World::build(scene, AccelKind::Bvh, 1)?;
        let view = view.unwrap_or_else(|| default_view(&world, args.size));
        let job = job(view, args.size, ways[0]);
        let measured = measure::primary(&world, &job, &ways, args.rounds.into())?;
        for row in &measured {
            if row.differing > 0 {
                let way = format!("{} × {}", row.exec.level, row.exec.lanes());
                return Err(Error::Differ { scene: scene_name, differing: row.differing, way });
            }
            show(&format!("{scene_name:<width$} {}\n", line(row, &measured)))?;
            rows.push(row_json(&scene_name, &world, row));
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

/// A row of the table; `measured` begins with one ray at a time and the scalar level.
fn line(row: &Row, measured: &[Row]) -> String {
    let times = |other: &Row| other.time.as_secs_f64() / row.time.as_secs_f64();
    let per_ray = |count: u64| count as f64 / row.rays as f64;
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
        "kernel": "watertight",
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
