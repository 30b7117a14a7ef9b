//! `rt paper wald-2001`.
//!
//! Wald, Slusallek, Benthin, Wagner, "Interactive Rendering with Coherent Ray Tracing", 2001. Their
//! figures, of a Pentium III at 800 MHz, stand beside ours. A file for each table.

mod growth;
mod mailboxes;
mod overhead;
mod structures;
mod tests;
mod traffic;

use std::path::Path;

use rt_render::measure::terrain;
use rt_render::{AccelKind, Exec, Job, KdBuilder, Level, Mailbox, World};
use rt_scene::Scene;
use serde_json::{Value, json};

use crate::args::{Wald2001Args, Wald2001Part, best_level};
use crate::chart::Lines;
use crate::cmd::render::default_view;
use crate::error::Error;
use crate::output::{self, Output};

/// The numbers of triangles of the paper's scenes in its Table 2.
const COHERENT: [usize; 3] = [800, 34_000, 280_000];

/// Measures one part after the other; what is done is shown at once.
pub(crate) fn run(args: &Wald2001Args) -> Result<(), Error> {
    let level = best_level()?;
    if let Some((scene, packet)) = &args.trace {
        return traffic::trace(scene, *packet, level);
    }
    let json = args.json.as_deref().map(output::open_json).transpose()?;
    let most = (args.triangles as usize).min(if args.quick { 300_000 } else { usize::MAX });
    let table = args.json.as_deref() != Some(Path::new("-"));
    let mut paper = Paper { args, level, most, table, rows: Vec::new() };
    let parts = match &*args.parts {
        [] => &Wald2001Part::USUAL,
        parts => parts,
    };
    for part in parts {
        match part {
            Wald2001Part::Tests => tests::run(&mut paper)?,
            Wald2001Part::Overhead => overhead::run(&mut paper)?,
            Wald2001Part::Structures => structures::run(&mut paper)?,
            Wald2001Part::Mailboxes => mailboxes::run(&mut paper)?,
            Wald2001Part::Growth => growth::run(&mut paper)?,
            Wald2001Part::Traffic => traffic::run(&mut paper)?,
        }
    }
    match json {
        Some(json) => json.write(output::json(&json!({ "rows": paper.rows })).as_bytes()),
        None => Ok(()),
    }
}

/// What is asked for, and what was measured.
struct Paper<'a> {
    args: &'a Wald2001Args,
    level: Level,
    /// The most triangles of a computed scene.
    most: usize,
    /// Whether tables are shown.
    table: bool,
    rows: Vec<Value>,
}

impl Paper<'_> {
    fn rounds(&self) -> usize {
        self.args.rounds.into()
    }

    fn show(&self, text: &str) -> Result<(), Error> {
        if self.table { output::to_stdout(format!("{text}\n").as_bytes()) } else { Ok(()) }
    }

    /// Writes a chart, if charts are wanted.
    fn chart(&self, name: &str, lines: &Lines<'_>) -> Result<(), Error> {
        let Some(folder) = &self.args.charts else { return Ok(()) };
        let path = folder.join(name);
        Output::open(&path)?.write(lines.svg().as_bytes())?;
        self.show(&format!("{}", path.display()))
    }

    /// The scenes that were asked for, after the terrains of these numbers of triangles.
    fn scenes(&self, sizes: impl Iterator<Item = usize>) -> Result<Vec<Scene>, Error> {
        let named = self.args.scenes.iter().map(|name| Ok(rt_scene::open(name)?));
        sizes.map(terrain).map(Ok).chain(named).collect()
    }
}

/// Rays of the paper's pictures: nothing but what is seen.
fn job(scene: &Scene, world: &World, size: (u32, u32), exec: Exec) -> Job {
    let view = scene.view.unwrap_or_else(|| default_view(world.bounds(), size));
    Job::seen(view, size, exec)
}

fn kd(builder: KdBuilder) -> AccelKind {
    AccelKind::Kd { builder, mailbox: Mailbox::default() }
}

/// The best level whose registers have four lanes, as the paper's have, or the one that there is.
fn four_lanes(best: Level) -> Level {
    match best.lanes() {
        0..4 => best,
        _ => Level::available().rfind(|level| level.lanes() == 4).unwrap_or(best),
    }
}
