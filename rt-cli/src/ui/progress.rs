//! How far the work is.

use std::io::{IsTerminal, stderr};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::say;
use crate::args::ProgressKind;

/// Shows the progress of a picture, in the way that was asked for.
pub(crate) enum Progress {
    None,
    /// Shows nothing where stderr is no terminal.
    Bar(ProgressBar),
    /// When the last line was written.
    Lines(Mutex<Instant>),
    Json(Mutex<Instant>),
}

/// The least time between lines.
const PAUSE: Duration = Duration::from_secs(2);

impl Progress {
    /// For a picture that is about to be made.
    pub(crate) fn new(kind: ProgressKind, quiet: bool) -> Progress {
        let terminal = stderr().is_terminal() && std::env::var_os("CI").is_none();
        match kind {
            _ if quiet => Progress::None,
            ProgressKind::None => Progress::None,
            ProgressKind::Auto if !terminal => Progress::Lines(Mutex::new(Instant::now())),
            ProgressKind::Lines => Progress::Lines(Mutex::new(Instant::now())),
            ProgressKind::Json => Progress::Json(Mutex::new(Instant::now())),
            ProgressKind::Auto | ProgressKind::Bar => Progress::Bar(bar()),
        }
    }

    /// Clears what is left of a bar.
    pub(crate) fn finish(&self) {
        if let Progress::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let style = "{bar:40} {percent:>3} %  {elapsed_precise} elapsed, {eta_precise} to go";
    let style = ProgressStyle::with_template(style).expect("a template without faults");
    ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr()).with_style(style)
}

/// Whether a line is due; then the pause begins anew. The last line is always due.
fn due(last: &Mutex<Instant>, finished: bool) -> bool {
    let mut last = last.lock().expect("no thread panics while it looks at the time");
    let due = finished || last.elapsed() >= PAUSE;
    if due {
        *last = Instant::now();
    }
    due
}

impl rt_render::Progress for Progress {
    fn tiles(&self, done: usize, total: usize) {
        match self {
            Progress::None => {}
            Progress::Bar(bar) => {
                bar.set_length(total as u64);
                bar.set_position(done as u64);
            }
            Progress::Lines(last) => {
                if due(last, false) {
                    say(&format!("rendered {} %", done * 100 / total));
                }
            }
            Progress::Json(last) => {
                if due(last, done == total) {
                    let event =
                        serde_json::json!({ "event": "tiles", "done": done, "total": total });
                    say(&event.to_string());
                }
            }
        }
    }
}
