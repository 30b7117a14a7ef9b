//! `cargo xtask peers`: our kernels beside those of others.
//!
//! The comparison is a package of its own, xtask/peers: nothing else needs what it is compared with.
//! It is built twice. Our kernels and Embree choose their instructions at run time, and are limited
//! to the same ones in a build for any CPU; other crates have those that the compiler is told to use,
//! so they come in a build for this CPU, which the first one runs.

use std::env::consts::EXE_SUFFIX;
use std::path::PathBuf;
use std::process;
use xshell::{Cmd, Shell, cmd};

/// Builds it and hands it the arguments; whether it succeeds. If it does not it has said why.
pub(crate) fn peers(sh: &Shell, args: &[String]) -> Result<bool, String> {
    let program = build(sh, "peers", &[], "")?;
    let mut command = cmd!(sh, "{program}").args(args);
    if wants_native(args) {
        let native = build(sh, "peers-native", &["--features", "crates"], "-Ctarget-cpu=native")?;
        command = command.arg("--native").arg(native);
    }
    let status = process::Command::from(command).status().map_err(|error| error.to_string())?;
    Ok(status.success())
}

/// Builds the package; the program.
fn build(sh: &Shell, folder: &str, features: &[&str], flags: &str) -> Result<PathBuf, String> {
    let build = cargo(sh, "build", folder).arg("--release").args(features).env("RUSTFLAGS", flags);
    build.quiet().run().map_err(|error| error.to_string())?;
    let program = format!("release/rt-peers{EXE_SUFFIX}");
    Ok(sh.current_dir().join("target").join(folder).join(program))
}

/// A command of cargo's for the package, which builds in a folder of that name.
pub(crate) fn cargo<'a>(sh: &'a Shell, command: &str, folder: &str) -> Cmd<'a> {
    let target_dir = sh.current_dir().join("target").join(folder);
    let manifest = "xtask/peers/Cargo.toml";
    cmd!(
        sh,
        "cargo {command} --quiet --locked --manifest-path {manifest} --target-dir {target_dir}"
    )
}

/// Whether other crates are to take part: they do unless other levels are named, or help is asked for.
fn wants_native(args: &[String]) -> bool {
    if args.iter().any(|arg| ["-h", "--help"].contains(&arg.as_str())) {
        return false;
    }
    let mut named = args.iter().enumerate().filter_map(|(i, arg)| match arg.split_once('=') {
        Some(("--isa", names)) => Some(names),
        None if arg == "--isa" => args.get(i + 1).map(String::as_str),
        _ => None,
    });
    named.next().is_none_or(|names| names.split(',').any(|name| name == "native"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_build_is_made_where_it_is_needed() {
        let wants = |args: &[&str]| {
            wants_native(&args.iter().map(|&arg| arg.to_owned()).collect::<Vec<_>>())
        };
        assert!(wants(&[]) && wants(&["--quick"]));
        assert!(wants(&["--isa", "avx2,native"]) && wants(&["--isa=native"]));
        assert!(!wants(&["--isa", "avx2"]) && !wants(&["--isa=sse4,avx2", "--quick"]));
        assert!(!wants(&["--help"]));
    }
}
