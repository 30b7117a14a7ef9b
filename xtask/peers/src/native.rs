//! Other crates have no levels to choose from: they are compiled for one CPU. So are all, in a second
//! build of this program, which this one runs and reads.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::report::Report;

/// What the program at `path` measures if asked the same.
pub(crate) fn run(path: &Path) -> Result<Report, String> {
    let mut child = Command::new(path);
    child.args(std::env::args_os().skip(1)).arg("--for-parent").stderr(Stdio::inherit());
    let output = child.output().map_err(|error| format!("{}: {error}", path.display()))?;
    if !output.status.success() {
        return Err(format!("{} failed", path.display()));
    }
    serde_json::from_slice(&output.stdout).map_err(|error| error.to_string())
}
