//! The program `rt` as it is shipped.

use super::build::target_directory;
use super::gates::is_intrinsic;
use super::text::path;
use object::{Object, ObjectSymbol};
use std::env::consts::EXE_SUFFIX;
use xshell::{Shell, cmd};

/// The intrinsics that are functions of the release build of `rt`: there should be none.
pub(crate) fn intrinsics(sh: &Shell) -> Result<Vec<String>, String> {
    cmd!(sh, "cargo build --quiet --locked --release -p rt-cli")
        .quiet()
        .run()
        .map_err(|error| error.to_string())?;
    let file = target_directory(sh)?.join(format!("release/rt{EXE_SUFFIX}"));
    let bytes = sh.read_binary_file(&file).map_err(|error| error.to_string())?;
    let object = object::File::parse(&*bytes).map_err(|error| error.to_string())?;
    let names: Vec<String> =
        object.symbols().filter_map(|symbol| symbol.name().ok()).map(path).collect();
    // A program that was stripped would pass too.
    if !names.iter().any(|name| name.contains("rt_kernels::")) {
        return Err(format!("{} has no symbols to check", file.display()));
    }
    let found = names.into_iter().filter(|name| is_intrinsic(name));
    Ok(found.map(|name| format!("an intrinsic is not inlined: {name}")).collect())
}
