//! `cargo xtask coverage`: which lines the tests of this machine reach.

use crate::cross;
use crate::matrix::FEWER_CASES;
use crate::programs::Programs;
use std::path::Path;
use xshell::{Shell, cmd};

/// A disk that is full is full for the counters too; and of all kernels, each with counters in its
/// lanes, a test would think that they hang.
const NOT_COUNTED: [&str; 2] =
    ["output::a_full_disk_leaves_what_was_there", "accuracy::every_kernel_is_shown"];

/// Runs all tests but [`NOT_COUNTED`] with counters in them, and prints a table of files.
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
    // Programs that count run at a fraction of their speed, and more cases reach no more lines.
    let _cases = sh.push_env("PROPTEST_CASES", FEWER_CASES);
    for test in &programs.tests {
        let (folder, file) = (&test.folder, &test.file);
        let _folder = sh.push_dir(folder);
        let skips = NOT_COUNTED.iter().flat_map(|name| ["--skip", name]);
        let run = cmd!(sh, "{file} --quiet").args(skips).env("CARGO_MANIFEST_DIR", folder);
        run.ignore_stdout().run().map_err(said)?;
    }

    let all = counts.join("all.profdata");
    let raw = sh.read_dir(&counts).map_err(said)?;
    cmd!(sh, "{profdata} merge --sparse --output {all} {raw...}").quiet().run().map_err(said)?;
    let files = programs.tests.iter().map(|test| &test.file).chain(&programs.others);
    let objects = files.flat_map(|file| ["--object".as_ref(), file.as_os_str()]);
    cmd!(sh, "{cov} report --instr-profile {all}")
        .args(objects)
        // Not what comes from outside, nor the tests.
        .args(["--ignore-filename-regex", r"\.cargo|rustc|/tests/|/examples/|/xtask/"])
        .quiet()
        .run()
        .map_err(said)
}
