//! `rt paper geimer-mueller`.
//!
//! Geimer and Müller, "A Cross-Platform Framework for Interactive Ray Tracing", 2003: Figure 2, and
//! what Section 3 says in words. Where our algorithm is another than theirs, as the triangle test is,
//! ours is on both sides of every ratio.

use std::path::Path;

use glam::Vec3;
use rt_render::measure::{self, Extent};
use rt_render::{
    AccelKind, Builder, Exec, Integrator, Job, Layout, Level, PacketSize, Plan, World,
};
use rt_scene::{SPD_RESOLUTION, spd, tessellate};
use serde_json::json;

use super::{cachegrind, report};
use crate::args::{GeimerMuellerArgs, best_level};
use crate::cmd::render::default_view;
use crate::error::Error;
use crate::output;

/// The paper's scenes: the size for their number of triangles, one for the impatient, and one for a
/// simulator.
const SCENES: [(&str, [u32; 3]); 3] =
    [("balls", [4, 2, 3]), ("rings", [7, 3, 4]), ("tree", [11, 6, 8])];

/// Measures one scene after the other; what is done is shown at once.
pub(crate) fn run(args: &GeimerMuellerArgs) -> Result<(), Error> {
    let level = best_level()?;
    if let Some((scene, extent)) = &args.frame {
        return one_frame(scene, *extent, args.size, level);
    }
    let json = args.json.as_deref().map(output::open_json).transpose()?;
    let table = args.json.as_deref() != Some(Path::new("-"));
    let show = |text: &str| if table { output::to_stdout(text.as_bytes()) } else { Ok(()) };
    show(report::HEAD)?;
    let mut rows = Vec::new();
    for (name, [full, small, _]) in SCENES {
        let (world, job) =
            prepared(name, if args.quick { small } else { full }, Builder::Insertion, args.size)?;
        show(&report::scene(&world))?;

        let mut ways: Vec<_> = execs().into_iter().map(|exec| (exec, Extent::Tile)).collect();
        ways.push((Exec { level, packet: PacketSize::Four }, Extent::Picture));
        let frames = measure::frames(&world, &job, &ways, args.rounds.into())?;
        show(&report::frames(&ways, &frames, level))?;
        rows.extend(
            ways.iter()
                .zip(&frames)
                .map(|(way, times)| report::frame_json(&world, &job, *way, times)),
        );

        let rays = measure::primary(&world, &job)?;
        let traversals = measure::traversals(&world, &rays, level, args.rounds.into())?;
        if let Some(row) = traversals.iter().find(|row| row.differing > 0) {
            let way = format!("{}, {}", row.order, row.box_test);
            return Err(Error::Differ {
                scene: world.name().into(),
                differing: row.differing,
                way,
            });
        }
        show(&report::traversals(&traversals, level))?;
        rows.extend(traversals.iter().map(|row| report::traversal_json(&world, level, row)));
    }
    if args.cachegrind {
        show(cachegrind::HEAD)?;
        for (name, [.., size]) in SCENES {
            let misses = cachegrind::compare(&format!("{name}:{size}"), args.size)?;
            show(&misses.line())?;
            rows.extend(misses.json());
        }
    }
    match json {
        Some(json) => json.write(output::json(&json!({ "rows": rows })).as_bytes()),
        None => Ok(()),
    }
}

/// One ray at a time in plain scalar code, and every level with packets of four, as in the paper, and
/// with its own.
fn execs() -> Vec<Exec> {
    let four = |level| Exec { level, packet: PacketSize::Four };
    let single = Level::available().next().map(|level| Exec { level, packet: PacketSize::Single });
    let native = |level: Level| (level.lanes() != 4).then(|| Exec::at(level));
    let lanes = Level::available().flat_map(|level| [Some(four(level)), native(level)]);
    single.into_iter().chain(lanes.flatten()).collect()
}

/// A scene of triangles, and its picture by primary rays and Phong shading.
fn prepared(
    name: &str,
    size: u32,
    builder: Builder,
    picture: (u32, u32),
) -> Result<(World, Job), Error> {
    let mut scene = tessellate(spd::generate(name, Some(size))?, SPD_RESOLUTION)?;
    let (view, lights) = (scene.view.take(), scene.lights.clone());
    let background = scene.background.unwrap_or(Vec3::ZERO);
    let plan = Plan { builder, layout: Layout::Skip, ..Plan::default() };
    let world = World::build_with(scene, AccelKind::Bvh, plan, 1)?;
    let job = Job {
        size: picture,
        crop: None,
        view: view.unwrap_or_else(|| default_view(world.bounds(), picture)),
        lights,
        background,
        integrator: Integrator::Whitted,
        samples: 1,
        depth: 0,
        shadows: false,
        relaxed: false,
        exec: Exec::at(best_level()?),
        threads: 1,
    };
    Ok((world, job))
}

/// What is run in the simulator: builds a scene of that name and size, quickly, and makes one frame
/// of it, or none.
fn one_frame(
    scene: &str,
    extent: Option<Extent>,
    picture: (u32, u32),
    level: Level,
) -> Result<(), Error> {
    let (name, size) = scene.split_once(':').unwrap_or((scene, "0"));
    let size = size.parse().unwrap_or(0);
    let (world, job) = prepared(name, size, Builder::default(), picture)?;
    if let Some(extent) = extent {
        measure::frames(&world, &job, &[(Exec::at(level), extent)], 0)?;
    }
    Ok(())
}
