//! How far the work is.

use std::io::{IsTerminal, stderr};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::json;

use super::say;
use crate::args::ProgressKind;
use crate::report::time;

/// Shows the progress of a picture, in the way that was asked for.
pub(crate) struct Progress {
    shown: Shown,
    /// When the work began, and the tiles that were done then.
    start: OnceLock<(Instant, usize)>,
}

enum Shown {
    Nothing,
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
        let shown = match kind {
            _ if quiet => Shown::Nothing,
            ProgressKind::None => Shown::Nothing,
            ProgressKind::Auto if !terminal => Shown::Lines(Mutex::new(Instant::now())),
            ProgressKind::Lines => Shown::Lines(Mutex::new(Instant::now())),
            ProgressKind::Json => Shown::Json(Mutex::new(Instant::now())),
            ProgressKind::Auto | ProgressKind::Bar => Shown::Bar(bar()),
        };
        Progress { shown, start: OnceLock::new() }
    }

    /// Clears what is left of a bar.
    pub(crate) fn finish(&self) {
        if let Shown::Bar(bar) = &self.shown {
            bar.finish_and_clear();
        }
    }

    /// Shows that `done` of `total` tiles are finished.
    pub(crate) fn show(&self, done: usize, total: usize) {
        let (start, before) = *self.start.get_or_init(|| (Instant::now(), done));
        match &self.shown {
            Shown::Nothing => {}
            Shown::Bar(bar) => {
                if done == before {
                    bar.set_length(total as u64);
                    bar.set_position(done as u64);
                    bar.reset_eta();
                }
                bar.set_position(done as u64);
            }
            Shown::Lines(last) => {
                if due(last, false) {
                    let elapsed = start.elapsed();
                    let left = left(elapsed, done - before, total - done);
                    let left = left.map_or(String::new(), |left| format!(", {} to go", time(left)));
                    let percent = done * 100 / total;
                    say(&format!("rendered {percent} %, {} elapsed{left}", time(elapsed)));
                }
            }
            Shown::Json(last) => {
                if due(last, done == total) {
                    let elapsed = start.elapsed();
                    let left = left(elapsed, done - before, total - done);
                    let event = json!({
                        "event": "tiles",
                        "done": done,
                        "total": total,
                        "elapsed_s": elapsed.as_secs_f64(),
                        "left_s": left.map(|left| left.as_secs_f64()),
                    });
                    say(&event.to_string());
                }
            }
        }
    }
}

/// The time for the rest, if it goes on as it went so far.
fn left(elapsed: Duration, done: usize, rest: usize) -> Option<Duration> {
    (done > 0).then(|| elapsed.mul_f64(rest as f64 / done as f64))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_takes_as_long_as_what_was_done() {
        let second = Duration::from_secs(1);
        assert_eq!(left(second, 0, 5), None);
        assert_eq!(left(second, 2, 6), Some(3 * second));
        assert_eq!(left(second, 4, 0), Some(Duration::ZERO));
    }
}
