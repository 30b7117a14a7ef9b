//! `cargo xtask fuzz`: random input for what reads untrusted input, guided by coverage.
//!
//! libFuzzer, without cargo-fuzz: a stable toolchain and a C++ compiler are enough, because the
//! instrumentation is plain flags of rustc.

use crate::report::Done;
use crate::{cross, setup};
use std::env::consts::{EXE_SUFFIX, OS};
use std::path::PathBuf;
use xshell::{Shell, cmd};

/// The targets, files in tests/fuzz/targets.
const TARGETS: [&str; 10] =
    ["obj", "mtl", "texture", "nff", "aff", "ply", "png", "pfm", "exr", "part"];

/// What makes LLVM count the edges that a run takes, as cargo-fuzz does, and checks arithmetic.
const FLAGS: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters \
    -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares \
    --cfg fuzzing -Cdebug-assertions";

/// The arguments of `fuzz`, understood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Options {
    /// One of [`TARGETS`].
    target: String,
    /// How long to try.
    seconds: u32,
}

impl Options {
    /// Understands the arguments after `fuzz`.
    pub(crate) fn parse(args: &[&str]) -> Result<Options, String> {
        let (target, seconds) = match args {
            [target] => (target, Ok(60)),
            [target, "--seconds", seconds] => (target, seconds.parse()),
            _ => return Err("fuzz takes a target, and perhaps --seconds N".to_owned()),
        };
        if !TARGETS.contains(target) {
            return Err(format!("there is no target {target:?}, but {}", TARGETS.join(", ")));
        }
        let seconds = seconds.map_err(|error| format!("--seconds: {error}"))?;
        Ok(Options { target: (*target).to_owned(), seconds })
    }
}

/// Tries random input for a while; what it learns and what it finds stays in target/fuzz.
pub(crate) fn fuzz(sh: &Shell, options: &Options) -> Result<(), String> {
    let programs = build(sh, &[])?;
    let (folder, name) = (programs.join("../../corpus").join(&options.target), &options.target);
    sh.create_dir(&folder).map_err(|error| error.to_string())?;
    let (time, program) = (
        format!("-max_total_time={}", options.seconds),
        programs.join(format!("{name}{EXE_SUFFIX}")),
    );
    let found = format!("-artifact_prefix={}/", programs.join("../..").display());
    cmd!(sh, "{program} {time} {found} {folder}").run().map_err(|error| error.to_string())
}

/// Whether all targets build and take some input.
pub(crate) fn check(sh: &Shell, install: bool) -> Done {
    if OS != "linux" {
        return Done::left("not for this machine: it takes Linux".to_owned());
    }
    if let Err(reason) = setup::program(sh, "c++", &["g++"], install) {
        return Done::skipped(reason);
    }
    let all = || {
        // Quicker to compile, and fast enough for a few seconds.
        let programs = build(sh, &["--config", "profile.dev.opt-level=1"])?;
        let found = format!("-artifact_prefix={}/", programs.join("../..").display());
        for name in TARGETS {
            let program = programs.join(name);
            // The same input every time.
            let command = cmd!(sh, "{program} -seed=1 -runs=5000 {found}").quiet();
            command.ignore_stderr().run().map_err(|error| format!("{name}: {error}"))?;
        }
        Ok(())
    };
    all().into()
}

/// Builds the targets; the folder in which they are.
fn build(sh: &Shell, config: &[&str]) -> Result<PathBuf, String> {
    let (host, target_dir) = (cross::host(sh), sh.current_dir().join("target").join("fuzz"));
    let manifest = "tests/fuzz/Cargo.toml";
    // With `--target` the flags are for the programs alone, and not for what runs in the build.
    cmd!(sh, "cargo build --quiet --locked --manifest-path {manifest} --target {host}")
        .arg("--target-dir")
        .arg(&target_dir)
        .args(config)
        .env("RUSTFLAGS", FLAGS)
        .run()
        .map_err(|error| error.to_string())?;
    Ok(target_dir.join(host).join("debug"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_target_and_a_time_are_understood() {
        let options = |target: &str, seconds| Ok(Options { target: target.to_owned(), seconds });
        assert_eq!(Options::parse(&["obj"]), options("obj", 60));
        assert_eq!(Options::parse(&["nff", "--seconds", "5"]), options("nff", 5));
        for args in [&[][..], &["jpg"], &["obj", "--seconds"], &["obj", "--seconds", "x"]] {
            assert!(Options::parse(args).is_err(), "{args:?}");
        }
    }
}
