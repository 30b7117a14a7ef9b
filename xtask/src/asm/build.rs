//! Assembly out of cargo.

use super::targets::Target;
use super::text::Listing;
use serde_json::Value;
use std::path::PathBuf;
use xshell::{Shell, cmd};

/// The package that is read.
const PROBE: &str = "simd4-probe";

/// Where cargo builds.
pub(crate) fn target_directory(sh: &Shell) -> Result<PathBuf, String> {
    let metadata = cmd!(sh, "cargo metadata --format-version 1 --no-deps --locked").quiet().read();
    let json = metadata.map_err(|error| error.to_string())?;
    let json: Value = serde_json::from_str(&json).map_err(|error| error.to_string())?;
    let directory = json["target_directory"].as_str().ok_or("cargo knows no target directory")?;
    Ok(directory.into())
}

/// Compiles the probe in release mode and reads its assembly. In a folder of its own, so that no build
/// waits for another.
pub(crate) fn listing(target: &Target, features: &str) -> Result<Listing, String> {
    let sh = &crate::root()?;
    let Target { triple, rustflags, .. } = target;
    let directory = target_directory(sh)?.join("asm").join(triple);
    sh.create_dir(&directory).map_err(|error| error.to_string())?;
    let file = directory.join(format!("{PROBE}{features}.s"));
    // One unit, as more would make several files. The newer mangling names the level that a
    // generic function is of. Lines' places are of no use.
    let emit = format!("asm={}", file.display());
    cmd!(sh, "cargo rustc --quiet --locked --release --lib -p {PROBE} --features={features}")
        .arg("--target-dir")
        .arg(&directory)
        .args(["--target", triple, "--", "--emit", &emit, "-Ccodegen-units=1", "-Cdebuginfo=0"])
        .args(["-Csymbol-mangling-version=v0", "-Cllvm-args=-x86-asm-syntax=intel"])
        // And so not from the environment or a configuration.
        .env("RUSTFLAGS", rustflags)
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .quiet()
        .run()
        .map_err(|error| error.to_string())?;
    let text = sh.read_file(&file).map_err(|error| {
        // Cargo does not know of the file, and takes for fresh what is there but for it.
        format!("{error}; then remove {}", directory.display())
    })?;
    Ok(Listing::parse(&text))
}
