//! Finds, and where allowed installs, what the steps need beside cargo.
//!
//! Whatever can't be had is named in one line that ends in the command that helps.

use crate::cross::{linker, triple};
use crate::matrix::{Link, Run, Target};
use std::path::Path;
use xshell::{Cmd, Shell, cmd};

/// Adds the parts of the toolchain that a minimal rustup profile leaves out. If that fails, the
/// steps that need them say so.
pub(crate) fn components(sh: &Shell) {
    if !runs(cmd!(sh, "cargo fmt --version")) || !runs(cmd!(sh, "cargo clippy --version")) {
        let _ = cmd!(sh, "rustup component add rustfmt clippy").run();
    }
}

/// Makes sure that programs for the target can be built and run: adds what it takes through
/// rustup, and with `install` what else it takes through apt-get.
pub(crate) fn target(sh: &Shell, target: &Target, install: bool) -> Result<(), String> {
    match target.run {
        Run::Directly => {}
        Run::Qemu { arch, .. } => {
            program(sh, &format!("qemu-{arch}"), &["qemu-user"], install)?;
            let check = || is_right(arch, &version_of(sh, arch), &codename(sh));
            if check().is_err() && install {
                let backports = format!("{}-backports", codename(sh));
                apt_install(sh, &["--target-release", &backports, "qemu-user"]);
            }
            check()?;
        }
        Run::Node => program(sh, "node", &["nodejs"], install)?,
        Run::Miri => return miri(sh, install),
    }
    if let (Link::Gcc(_, debian), Some(gcc)) = (target.build.link, linker(target.build.link)) {
        let packages = [&gcc_package(&gcc), &format!("libc6-dev-{debian}-cross")];
        program(sh, &gcc, &packages.map(String::as_str), install)?;
    }
    target.build.triple.map_or(Ok(()), |_| standard_library(sh, &triple(sh, target.build)))
}

/// Emulators that are of no use before a version of QEMU, and why.
const WRONG_BEFORE: [(&str, [u32; 2], &str); 2] = [
    ("x86_64", [7, 2], "has no AVX"),
    ("s390x", [8, 1], "makes 160 of 3 times 5 (mdebr: two f32 to one f64)"),
];

/// What an emulator says of itself.
fn version_of(sh: &Shell, arch: &str) -> String {
    cmd!(sh, "qemu-{arch} --version").quiet().read().unwrap_or_default()
}

/// What Debian calls the release that this machine runs.
fn codename(sh: &Shell) -> String {
    let release = sh.read_file("/etc/os-release").unwrap_or_default();
    let name = release.lines().find_map(|line| line.strip_prefix("VERSION_CODENAME="));
    name.unwrap_or("stable").to_owned()
}

/// Whether an emulator of that version does what the CPU would.
fn is_right(arch: &str, version: &str, debian: &str) -> Result<(), String> {
    // "qemu-s390x version 7.2.22 (Debian …)"
    let number = version.split(' ').nth(2).unwrap_or_default();
    let mut parts = number.split('.').map(|part| part.parse().unwrap_or(0));
    let found: [u32; 2] = [parts.next().unwrap_or(0), parts.next().unwrap_or(0)];
    match WRONG_BEFORE.iter().find(|(name, first, _)| *name == arch && found < *first) {
        Some((_, [major, minor], why)) => Err(format!(
            "qemu-{arch} {number} {why}: take {major}.{minor} or later, as with {debian}-backports \
             among its sources: sudo apt-get install -t {debian}-backports qemu-user"
        )),
        None => Ok(()),
    }
}

/// The package that has a cross compiler.
fn gcc_package(gcc: &str) -> String {
    let gnu = gcc.strip_suffix("-gcc").unwrap_or(gcc);
    format!("gcc-{gnu}")
}

/// Makes sure that there is a program, which is in those packages of Debian and Ubuntu.
pub(crate) fn program(
    sh: &Shell,
    program: &str,
    packages: &[&str],
    install: bool,
) -> Result<(), String> {
    let there = || runs(cmd!(sh, "{program} --version"));
    if there() {
        return Ok(());
    }
    if install {
        apt_install(sh, packages);
        if there() {
            return Ok(());
        }
    }
    Err(format!("no {program}: sudo apt-get install {}", packages.join(" ")))
}

/// Installs packages, if it can. The update may fail for one source of several and the install still
/// succeed: what counts is what is there afterwards, so both may fail.
fn apt_install(sh: &Shell, args: &[&str]) {
    let Some((env, to_env)) = env_as_root(sh) else { return };
    let apt = |args: &[&str]| {
        let noninteractive = "DEBIAN_FRONTEND=noninteractive";
        let _ = cmd!(sh, "{env} {to_env...} {noninteractive} apt-get -qq {args...}").run();
    };
    apt(&["update"]);
    apt(&[&["install", "-y", "--no-install-recommends"], args].concat());
}

/// Makes sure that the toolchain has a target's standard library.
pub(crate) fn standard_library(sh: &Shell, triple: &str) -> Result<(), String> {
    // Asked of rustc rather than rustup: it costs no network, and a toolchain that did not come
    // from rustup may have the target too.
    let libs = cmd!(sh, "rustc --print target-libdir --target {triple}").quiet().read();
    if libs.is_ok_and(|dir| Path::new(&dir).is_dir()) {
        return Ok(());
    }
    // Debian has a recent toolchain for its own architectures, under these names.
    let debian = "Debian has its own: apt-get install rustc-web libstd-rust-web-dev:arm64 (or \
                  another architecture)";
    if !runs(cmd!(sh, "rustup --version")) {
        return Err(format!(
            "no target {triple}, no rustup to add it with: https://rustup.rs; {debian}"
        ));
    }
    cmd!(sh, "rustup target add {triple}").run().map_err(|_| {
        format!("no target {triple}, this failed: rustup target add {triple}; {debian}")
    })
}

/// Makes sure that there is Miri, which is in the nightly toolchain alone.
fn miri(sh: &Shell, install: bool) -> Result<(), String> {
    let there = || runs(cmd!(sh, "cargo +nightly miri --version"));
    let add = "rustup toolchain install nightly --component miri --component rust-src";
    if !there() && install {
        let _ = Cmd::run(&cmd!(sh, "rustup").args(add.split(' ').skip(1)));
    }
    if there() { Ok(()) } else { Err(format!("no Miri: {add}")) }
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
pub(crate) fn runs(cmd: Cmd) -> bool {
    cmd.quiet().ignore_stdout().ignore_stderr().run().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn emulators_that_err_are_refused() {
        let old = "qemu-s390x version 7.2.22 (Debian 1:7.2+dfsg-7+deb12u18+b3)\nCopyright";
        let new = "qemu-s390x version 10.0.2 (Debian 1:10.0.2+ds-2+deb13u1)\nCopyright";
        let error = is_right("s390x", old, "bookworm").expect_err("it is known to be wrong");
        assert!(error.contains("7.2.22") && error.contains("8.1"), "{error}");
        assert!(error.ends_with("install -t bookworm-backports qemu-user"), "{error}");
        assert_eq!(is_right("s390x", new, "bookworm"), Ok(()));
        assert_eq!(is_right("x86_64", old, "bookworm"), Ok(()));
        assert_eq!(is_right("aarch64", "", "bookworm"), Ok(()));
    }
}
