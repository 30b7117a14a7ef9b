//! Finds, and where allowed installs, what the steps need beside cargo.
//!
//! Whatever can't be had is named in one line that ends in the command that helps.

use crate::matrix::{Emulator, Target};
use std::path::Path;
use xshell::{Cmd, Shell, cmd};

/// Adds the parts of the toolchain that a minimal rustup profile leaves out. If that fails, the
/// steps that need them say so.
pub(crate) fn components(sh: &Shell) {
    if !runs(cmd!(sh, "cargo fmt --version")) || !runs(cmd!(sh, "cargo clippy --version")) {
        let _ = cmd!(sh, "rustup component add rustfmt clippy").run();
    }
}

/// Makes sure that programs for the target can be built and run: adds the target through rustup,
/// and with `install` the emulator through apt-get.
pub(crate) fn target(sh: &Shell, target: &Target, install: bool) -> Result<(), String> {
    if let Some(reason) = target.impossible() {
        return Err(reason);
    }
    if let Some(found) = target.emulator {
        emulator(sh, found, install)?;
    }
    target.triple.map_or(Ok(()), |triple| standard_library(sh, triple))
}

/// Makes sure that there is an emulator.
fn emulator(sh: &Shell, emulator: Emulator, install: bool) -> Result<(), String> {
    let Emulator { program, package } = emulator;
    let there = || runs(cmd!(sh, "{program} --version"));
    if there() {
        return Ok(());
    }
    if install && let Some((env, to_env)) = env_as_root(sh) {
        // The update may fail for one source of several and the install still succeed: what
        // counts is the program, so both may fail.
        let apt = |args: &[&str]| {
            let noninteractive = "DEBIAN_FRONTEND=noninteractive";
            let _ = cmd!(sh, "{env} {to_env...} {noninteractive} apt-get -qq {args...}").run();
        };
        apt(&["update"]);
        apt(&["install", "-y", "--no-install-recommends", package]);
        if there() {
            return Ok(());
        }
    }
    Err(format!("no {program}: sudo apt-get install {package}"))
}

/// Makes sure that the toolchain has a target's standard library.
fn standard_library(sh: &Shell, triple: &str) -> Result<(), String> {
    // Asked of rustc rather than rustup: it costs no network, and a toolchain that did not come
    // from rustup may have the target too.
    let libs = cmd!(sh, "rustc --print target-libdir --target {triple}").quiet().read();
    if libs.is_ok_and(|dir| Path::new(&dir).is_dir()) {
        return Ok(());
    }
    if !runs(cmd!(sh, "rustup --version")) {
        return Err(format!("no target {triple}, no rustup to add it with: see https://rustup.rs"));
    }
    cmd!(sh, "rustup target add {triple}")
        .run()
        .map_err(|_| format!("no target {triple}, and this failed: rustup target add {triple}"))
}

/// The program, and its first arguments, that is `env` run as root; `None` without apt-get or
/// without the rights.
fn env_as_root(sh: &Shell) -> Option<(&'static str, &'static [&'static str])> {
    if !runs(cmd!(sh, "apt-get --version")) {
        None
    } else if cmd!(sh, "id -u").quiet().read().is_ok_and(|id| id == "0") {
        Some(("env", &[]))
    } else {
        runs(cmd!(sh, "sudo -n true")).then_some(("sudo", &["-n", "env"]))
    }
}

/// Whether a command is there and succeeds. Silent.
fn runs(cmd: Cmd) -> bool {
    cmd.quiet().ignore_stdout().ignore_stderr().run().is_ok()
}
