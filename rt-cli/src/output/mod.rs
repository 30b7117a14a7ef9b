//! Files: whole or not at all.

mod file;
mod part;
mod picture;
mod scene;

pub(crate) use file::{Output, format, read_file, to_stdout};
pub(crate) use part::{PartFile, PartWriter};
pub(crate) use picture::picture;
pub(crate) use scene::SceneOutput;

use std::path::Path;

use crate::error::Error;

/// A place for JSON. It has the extension of JSON if any: who takes `--json` for a flag without a
/// value does not lose the scene that follows.
pub(crate) fn open_json(path: &Path) -> Result<Output, Error> {
    format(path, &["json"])?;
    Output::open(path)
}

/// JSON for people and programs: indented, with a line feed at its end.
pub(crate) fn json(value: &serde_json::Value) -> String {
    format!("{value:#}\n")
}
