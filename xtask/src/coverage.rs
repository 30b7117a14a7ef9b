//! `cargo xtask coverage`: which lines the tests of this machine reach.

use crate::cross;
use crate::matrix::{TARGETS, Tests};
use crate::programs::Programs;
use crate::report::Outcome;
use std::path::Path;
use xshell::{Shell, cmd};

/// Runs all tests with counters in them, and prints a table of files.
pub(crate) fn coverage(sh: &Shell) -> Result<(), String> {
    let said = |error: xshell::Error| error.to_string();
    let host = cross::host(sh);
    // rustup's component llvm-tools puts them there; others than the compiler's own may not
    // understand the counters.
    let libs = cmd!(sh, "rustc --print target-libdir").quiet().read().map_err(said)?;
    let tools = Path::new(&libs).with_file_name("bin");
    let (profdata, cov) = (tools.join("llvm-profdata"), tools.join("llvm-cov"));
    if !profdata.with_extension(std::env::consts::EXE_EXTENSION).exists() {
        return Err("no llvm-profdata: rustup component add llvm-tools".to_owned());
    }
    let counts = sh.current_dir().join("target").join("coverage");
    sh.remove_path(&counts).map_err(said)?;
    sh.create_dir(&counts).map_err(said)?;
    let _flags = sh.push_env("RUSTFLAGS", "-Cinstrument-coverage");
    let _counts = sh.push_env("LLVM_PROFILE_FILE", counts.join("%p-%m.profraw"));

    let build = cmd!(sh, "cargo test --locked --no-run --workspace --target {host}");
    let programs = Programs::made_by(build)?;
    let native = TARGETS.iter().find(|target| target.best == Tests::Everything);
    let native = native.ok_or("there is no row for this machine")?;
    let done = programs.run(sh, native, Tests::Workspace, None);
    if done.outcome != Outcome::Passed {
        return Err(done.reason);
    }

    let all = counts.join("all.profdata");
    let raw = sh.read_dir(&counts).map_err(said)?;
    cmd!(sh, "{profdata} merge --sparse --output {all} {raw...}").quiet().run().map_err(said)?;
    let objects =
        programs.tests.iter().flat_map(|test| ["--object".as_ref(), test.file.as_os_str()]);
    cmd!(sh, "{cov} report --instr-profile {all}")
        .args(objects)
        // Not what comes from outside, nor the tests.
        .args(["--ignore-filename-regex", r"\.cargo|rustc|/tests/|/xtask/"])
        .quiet()
        .run()
        .map_err(said)
}
