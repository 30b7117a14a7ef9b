//! `cargo xtask peers`: our kernels beside those of others.
//!
//! The comparison is a package of its own, xtask/peers: nothing else needs what it is compared with.

use xshell::{Shell, cmd};

/// Builds it and hands it the arguments.
pub(crate) fn peers(sh: &Shell, args: &[String]) -> Result<(), String> {
    let target_dir = sh.current_dir().join("target").join("peers");
    let manifest = "xtask/peers/Cargo.toml";
    cmd!(sh, "cargo run --quiet --locked --release --manifest-path {manifest}")
        .arg("--target-dir")
        .arg(&target_dir)
        .arg("--")
        .args(args)
        .quiet()
        .run()
        .map_err(|error| error.to_string())
}
