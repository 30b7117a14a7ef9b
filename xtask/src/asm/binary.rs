//! The symbols of the program `rt`.

use super::build::target_directory;
use super::gates::is_intrinsic;
use super::none;
use super::text::path;
use crate::report::Done;
use object::{Object, ObjectSymbol};
use std::env::consts::{EXE_SUFFIX, OS};
use std::path::{Path, PathBuf};
use xshell::{Shell, cmd};

/// Builds it as it is shipped.
pub(crate) fn shipped(sh: &Shell) -> Result<PathBuf, String> {
    cmd!(sh, "cargo build --quiet --locked --release -p rt-cli")
        .quiet()
        .run()
        .map_err(|error| error.to_string())?;
    Ok(target_directory(sh)?.join(format!("release/rt{EXE_SUFFIX}")))
}

/// Whether no intrinsic is a function of a program that has all kernels.
pub(crate) fn check(sh: &Shell, program: &Path) -> Done {
    if OS == "windows" {
        return Done::left("not for this machine: its programs have no symbols".to_owned());
    }
    intrinsics(sh, program).and_then(none).into()
}

fn intrinsics(sh: &Shell, program: &Path) -> Result<Vec<String>, String> {
    let bytes = sh.read_binary_file(program).map_err(|error| error.to_string())?;
    let object = object::File::parse(&*bytes).map_err(|error| error.to_string())?;
    let names: Vec<String> =
        object.symbols().filter_map(|symbol| symbol.name().ok()).map(path).collect();
    // A program that was stripped would pass too.
    if !names.iter().any(|name| name.contains("rt_kernels::")) {
        return Err(format!("{} has no symbols to check", program.display()));
    }
    let found = names.into_iter().filter(|name| is_intrinsic(name));
    Ok(found.map(|name| format!("an intrinsic is not inlined: {name}")).collect())
}
