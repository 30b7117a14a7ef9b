//! `rt info`.

use std::fmt::Write as _;

use glam::Vec3;
use rt_render::Level;
use rt_render::precision::{self, Facts, Prediction};
use rt_scene::Scene;
use serde_json::{Value, json};

use super::render::{SIZE, default_view};
use crate::args::{InfoArgs, best_level};
use crate::error::Error;
use crate::{output, report};

/// Prints the facts of a scene or of the machine.
pub(crate) fn run(args: &InfoArgs) -> Result<(), Error> {
    let text = match &args.scene {
        Some(name) => {
            let scene = args.opening.open(name)?;
            let (facts, predictions) = (Facts::of(&scene), predictions(&scene));
            if args.json {
                let mut json = scene_json(&scene);
                json["precision"] = report::facts_json(&facts, &predictions);
                output::json(&json)
            } else {
                scene_text(&scene, &report::facts_lines(&facts, &predictions))
            }
        }
        None => {
            let machine = machine_json()?;
            if args.json { output::json(&machine) } else { machine_text(&machine) }
        }
    };
    output::to_stdout(text.as_bytes())
}

fn machine_json() -> Result<Value, Error> {
    let levels: Vec<_> = Level::available().map(Level::name).collect();
    Ok(json!({
        "arch": std::env::consts::ARCH,
        "levels": levels,
        "default_level": best_level()?.name(),
    }))
}

fn machine_text(machine: &Value) -> String {
    let levels: Vec<_> = Level::available().map(Level::name).collect();
    format!(
        "architecture: {}\nlevels: {}\ndefault level: {}\n",
        machine["arch"].as_str().unwrap_or_default(),
        levels.join(", "),
        machine["default_level"].as_str().unwrap_or_default(),
    )
}

fn scene_json(scene: &Scene) -> Value {
    let bounds = scene.bounds();
    let corner = |pick: fn((Vec3, Vec3)) -> Vec3| bounds.map(|bounds| pick(bounds).to_array());
    let skipped: Vec<_> = scene
        .facts
        .skipped
        .iter()
        .map(|s| json!({ "what": s.what, "why": s.why, "count": s.count }))
        .collect();
    json!({
        "triangles": scene.mesh.triangles.len(),
        "primitives": scene.facts.stated,
        "vertices": scene.mesh.positions.len(),
        "materials": scene.materials.len(),
        "lights": scene.lights.len(),
        "bounds": { "min": corner(|(min, _)| min), "max": corner(|(_, max)| max) },
        "skipped": skipped,
        "warnings": scene.facts.warnings,
    })
}

/// What each triangle test gets wrong, for the scene's camera or the one that `rt render` fits.
fn predictions(scene: &Scene) -> Vec<Prediction> {
    let size = scene.view.and_then(|view| view.size).unwrap_or(SIZE);
    let fitted = || default_view(&rt_render::bounds(scene), size);
    precision::predict(scene, &scene.view.unwrap_or_else(fitted), size).to_vec()
}

fn scene_text(scene: &Scene, more: &[(&str, String)]) -> String {
    let mut text = format!("{}\n", scene.name);
    let stated: Vec<_> = scene.facts.stated.keys().map(|kind| report::plural(kind)).collect();
    let width = stated.iter().map(String::len).fold("degenerate".len(), usize::max) + 2;
    let mut line = |what: &str, value: String| {
        let _ = writeln!(text, "  {what:<width$}{value}");
    };
    for (kinds, count) in stated.iter().zip(scene.facts.stated.values()) {
        line(kinds, count.to_string());
    }
    line("triangles", scene.mesh.triangles.len().to_string());
    line("vertices", scene.mesh.positions.len().to_string());
    line("materials", scene.materials.len().to_string());
    line("lights", scene.lights.len().to_string());
    if let Some((min, max)) = scene.bounds() {
        line("bounds", format!("{min} to {max}"));
        line("extent", (max - min).to_string());
    }
    if let Some(view) = &scene.view {
        line("view", report::flags(view));
        if let Some((width, height)) = view.size {
            line("size", format!("{width}x{height}"));
        }
    }
    for (what, value) in more {
        line(what, value.clone());
    }
    for skipped in &scene.facts.skipped {
        line("skipped", format!("{} × {}: {}", skipped.count, skipped.what, skipped.why));
    }
    for warning in &scene.facts.warnings {
        line("warning", warning.clone());
    }
    text
}
