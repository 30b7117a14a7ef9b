//! `rt bench`.

use std::ffi::OsStr;
use std::path::Path;
use std::time::Duration;

use rt_render::World;
use rt_render::measure::{self, Row, Way};
use rt_render::{Builder, Exec, Job, Layout, Level, Method, PacketSize, Plan};
use rt_scene::Scene;
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
    let compared = Compared::of(args);
    let single = |level| Exec { level, packet: PacketSize::Single };
    let execs = match compared {
        Compared::Levels => {
            [single(scalar())].into_iter().chain(Level::available().map(Exec::at)).collect()
        }
        Compared::Layouts => vec![single(best_level()?), Exec::at(best_level()?)],
        _ => vec![Exec::at(best_level()?)],
    };

    let width = args.scenes.iter().map(|name| name_width(name)).max().unwrap_or(0);
    show(&format!("{:<width$} {}\n", "scene", compared.head()))?;
    let mut rows = Vec::new();
    for name in &args.scenes {
        let mut scene = args.opening.open(name)?;
        let view = scene.view.take();
        let scene_name = scene.name.clone();
        let worlds = worlds(&scene, args, compared)?;
        let view = view.unwrap_or_else(|| default_view(worlds[0].world.bounds(), args.size));
        let job = Job::seen(view, args.size, execs[0]);
        let (mut builts, mut ways) = (Vec::new(), Vec::new());
        for built in &worlds {
            let world = &built.world;
            for &exec in &execs {
                builts.push(built);
                ways.push(Way { world, exec });
            }
        }
        let mut kinds = vec![measure::primary(&worlds[0].world, &job)?];
        if compared == Compared::Layouts {
            kinds.push(measure::diffuse(&worlds[0].world, &kinds[0], execs[0]));
        }
        for rays in &kinds {
            let measured = measure::trace(rays, &ways, args.rounds.into());
            for (row, built) in measured.iter().zip(&builts) {
                if row.differing > 0 && row.method == measured[0].method {
                    let (level, lanes) = (row.exec.level, row.exec.lanes());
                    let (builder, layout) = (built.builder(), built.world.layout());
                    let way = format!("{level} × {lanes}, {builder}, {layout}");
                    return Err(Error::Differ { scene: scene_name, differing: row.differing, way });
                }
                let line = compared.line(rays.kind, row, &measured, built, &worlds[0]);
                show(&format!("{scene_name:<width$} {line}\n"))?;
                rows.push(row_json(&scene_name, rays.kind, built, row));
            }
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

fn mrays_per_s(row: &Row) -> f64 {
    row.rays as f64 / row.time.as_secs_f64() / 1e6
}

/// A world, and how long it takes to build.
struct Built {
    world: World,
    /// The median of all rounds.
    time: Duration,
}

impl Built {
    fn builder(&self) -> &'static str {
        self.world.builder().unwrap_or_default()
    }

    /// What the hierarchy takes for each primitive, and its copy of that.
    fn bytes_per_primitive(&self) -> f64 {
        let primitives = self.world.triangles() + self.world.spheres() + self.world.cones();
        self.world.accel_bytes() as f64 / primitives as f64
    }
}

/// The worlds that are compared. Builders are timed: once a round for each in turn.
fn worlds(scene: &Scene, args: &BenchArgs, compared: Compared) -> Result<Vec<Built>, Error> {
    let plan = args.build.plan();
    let choices = match compared {
        Compared::Levels => vec![plan],
        Compared::Kernels => {
            // In the layout that all have.
            let plan = Plan { layout: Layout::Skip, ..plan };
            Method::ALL.map(|method| Plan { method, ..plan }).to_vec()
        }
        Compared::Builders => Builder::ALL.map(|builder| Plan { builder, ..plan }).to_vec(),
        Compared::Layouts => Layout::ALL.map(|layout| Plan { layout, ..plan }).to_vec(),
    };
    let rounds = if matches!(compared, Compared::Builders) { args.rounds } else { 1 };
    let (mut worlds, mut times) = (Vec::new(), vec![Vec::new(); choices.len()]);
    for _ in 0..rounds {
        worlds.clear();
        for (&plan, times) in choices.iter().zip(&mut times) {
            let world = World::build_with(scene.clone(), args.build.accel(), plan, 1)?;
            times.push(world.build_time());
            worlds.push(world);
        }
    }
    let built = worlds.into_iter().zip(times).map(|(world, mut times)| {
        times.sort_unstable();
        Built { world, time: times[times.len() / 2] }
    });
    Ok(built.collect())
}

/// What the rows of a table differ in.
#[derive(Clone, Copy, PartialEq)]
enum Compared {
    Levels,
    Kernels,
    Builders,
    Layouts,
}

impl Compared {
    fn of(args: &BenchArgs) -> Compared {
        match (args.kernels, args.builders, args.layouts) {
            (true, _, _) => Compared::Kernels,
            (_, true, _) => Compared::Builders,
            (_, _, true) => Compared::Layouts,
            _ => Compared::Levels,
        }
    }

    /// The columns' names.
    fn head(self) -> String {
        match self {
            Compared::Levels => format!(
                "{:<7}{:>7}{:>9}{:>8}{:>10}{:>11}{:>11}",
                "level", "packet", "Mray/s", "× one", "× scalar", "nodes/ray", "tests/ray"
            ),
            Compared::Kernels => format!(
                "{:<16}{:>9}{:>14}{:>14}{:>11}",
                "kernel", "Mray/s", "× watertight", "other hits/M", "tests/ray"
            ),
            Compared::Builders => format!(
                "{:<10}{:>10}{:>7}{:>9}{:>7}{:>11}{:>11}",
                "builder", "build ms", "×", "Mray/s", "×", "nodes/ray", "tests/ray"
            ),
            Compared::Layouts => format!(
                "{:<8}{:<7}{:>6}{:>8}{:>7}{:>10}{:>10}{:>8}",
                "rays", "layout", "packet", "Mray/s", "×", "boxes/ray", "tests/ray", "bytes"
            ),
        }
    }

    /// A row of the table; `measured` begins with one ray at a time and the scalar level, with the
    /// watertight kernel, or with the default builder or layout, whose world is `first`.
    fn line(self, kind: &str, row: &Row, measured: &[Row], built: &Built, first: &Built) -> String {
        let times = |other: &Row| other.time.as_secs_f64() / row.time.as_secs_f64();
        let per_ray = |count: u64| count as f64 / row.rays as f64;
        let tests = per_ray(row.stats.primitive_tests());
        match self {
            Compared::Levels => format!(
                "{:<7}{:>7}{:>9.2}{:>8.2}{:>10.2}{:>11.1}{:>11.1}",
                row.exec.level,
                row.exec.lanes(),
                mrays_per_s(row),
                times(&measured[0]),
                times(&measured[1]),
                per_ray(row.stats.box_tests),
                tests,
            ),
            Compared::Kernels => format!(
                "{:<16}{:>9.2}{:>14.3}{:>14.1}{:>11.1}",
                row.method.name(),
                mrays_per_s(row),
                times(&measured[0]),
                per_ray(row.differing) * 1e6,
                tests,
            ),
            Compared::Builders => format!(
                "{:<10}{:>10.1}{:>7.2}{:>9.2}{:>7.2}{:>11.1}{:>11.1}",
                built.builder(),
                built.time.as_secs_f64() * 1e3,
                built.time.as_secs_f64() / first.time.as_secs_f64(),
                mrays_per_s(row),
                times(&measured[0]),
                per_ray(row.stats.box_tests),
                tests,
            ),
            Compared::Layouts => format!(
                "{kind:<8}{:<7}{:>6}{:>8.2}{:>7.2}{:>10.1}{:>10.1}{:>8.1}",
                built.world.layout(),
                row.exec.lanes(),
                mrays_per_s(row),
                times(&measured[0]),
                per_ray(row.stats.box_tests),
                tests,
                built.bytes_per_primitive(),
            ),
        }
    }
}

fn row_json(scene: &str, kind: &str, built: &Built, row: &Row) -> Value {
    let world = &built.world;
    let per_ray = |count: u64| count as f64 / row.rays as f64;
    json!({
        "what": "trace",
        "scene": scene,
        "kind": kind,
        "level": row.exec.level.name(),
        "kernel": row.method.name(),
        "accel": world.accel_kind().name(),
        "builder": built.builder(),
        "layout": world.layout(),
        "packet": row.exec.lanes().to_string(),
        "ns": row.time.as_secs_f64() * 1e9 / row.rays as f64,
        "mrays_per_s": mrays_per_s(row),
        "nodes_per_ray": per_ray(row.stats.box_tests),
        "tests_per_ray": per_ray(row.stats.primitive_tests()),
        "build_ms": built.time.as_secs_f64() * 1e3,
        "bytes": world.accel_bytes(),
    })
}
