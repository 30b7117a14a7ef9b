//! Files: whole or not at all.

mod file;
mod picture;

pub(crate) use file::{Output, to_stdout};
pub(crate) use picture::png;

/// JSON for people and programs: indented, with a line feed at its end.
pub(crate) fn json(value: &serde_json::Value) -> String {
    format!("{value:#}\n")
}
