//! Talk, all of it to stderr.
#![allow(clippy::print_stderr, reason = "this is the one place that talks")]

mod progress;

pub(crate) use progress::Progress;

use rt_scene::Scene;

/// A line for the user.
pub(crate) fn say(line: &str) {
    eprintln!("{line}");
}

/// What went wrong.
pub(crate) fn error(error: &crate::error::Error) {
    eprintln!("error: {error}");
}

/// What the reader of a scene left out and warns of.
pub(crate) fn warnings(scene: &Scene) {
    for skipped in &scene.facts.skipped {
        eprintln!("skipped: {} × {}: {}", skipped.count, skipped.what, skipped.why);
    }
    for warning in &scene.facts.warnings {
        eprintln!("warning: {warning}");
    }
}
