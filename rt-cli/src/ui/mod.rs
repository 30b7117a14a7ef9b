//! Talk, all of it to stderr. Nobody may be listening: that is no reason to stop.

mod interrupt;
mod progress;

pub(crate) use interrupt::Interrupt;
pub(crate) use progress::Progress;

use std::io::{Write, stderr};

use rt_scene::Scene;

use crate::error::Error;

/// A line for the user.
pub(crate) fn say(line: &str) {
    let _ = writeln!(stderr(), "{line}");
}

/// What went wrong. What has a place begins with it, as editors expect.
pub(crate) fn error(error: &Error) {
    let lead = if error.has_place() { "" } else { "error: " };
    say(&format!("{lead}{error}"));
}

/// What the reader of a scene left out and warns of.
pub(crate) fn warnings(scene: &Scene) {
    for skipped in &scene.facts.skipped {
        say(&format!("skipped: {} × {}: {}", skipped.count, skipped.what, skipped.why));
    }
    for warning in &scene.facts.warnings {
        say(&format!("warning: {warning}"));
    }
}
