//! Assembly out of cargo.

use super::levels::Target;
use super::text::Listing;
use std::path::{Path, PathBuf};
use xshell::{Shell, cmd};

/// Whether the toolchain can compile for a target, or what to do about it.
pub(crate) fn available(sh: &Shell, triple: &str) -> Result<(), String> {
    let libs = cmd!(sh, "rustc --print target-libdir --target {triple}").quiet().ignore_stderr();
    match libs.read() {
        Ok(dir) if Path::new(&dir).is_dir() => Ok(()),
        _ => Err(format!("no target {triple}: rustup target add {triple}")),
    }
}

/// Where cargo builds; said to cargo too, so that both mean the same.
pub(crate) fn target_directory(sh: &Shell) -> PathBuf {
    sh.current_dir().join(sh.var_os("CARGO_TARGET_DIR").unwrap_or("target".into()))
}

/// Compiles a library of the workspace in release mode and reads its assembly. `features` are the
/// package's, for cargo.
pub(crate) fn listing(
    sh: &Shell,
    target: &Target,
    package: &str,
    features: &str,
) -> Result<Listing, String> {
    let Target { triple, rustflags, .. } = target;
    // Cargo does not know of the file, and so takes it for fresh if only the file is gone; in its
    // own folder only `cargo clean` removes it, and cargo's memory with it.
    let directory = target_directory(sh).join("asm");
    sh.create_dir(&directory).map_err(|error| error.to_string())?;
    let file = directory.join(format!("{package}{features}-{triple}.s"));
    // One unit, as more would make several files. The newer mangling names the level that a
    // generic function is of. Lines' places are of no use.
    let emit = format!("asm={}", file.display());
    cmd!(sh, "cargo rustc --quiet --locked --release --lib -p {package} --features={features}")
        .args(["--target", triple, "--", "--emit", &emit, "-C", "codegen-units=1"])
        .args(["-C", "symbol-mangling-version=v0", "-C", "debuginfo=0"])
        .args(["-C", "llvm-args=-x86-asm-syntax=intel"])
        .env("RUSTFLAGS", rustflags)
        .env("CARGO_TARGET_DIR", target_directory(sh))
        .quiet()
        .run()
        .map_err(|error| error.to_string())?;
    let text = sh.read_file(&file).map_err(|error| {
        format!(
            "{error}; if you have removed it: cargo clean --release --target {triple} -p {package}"
        )
    })?;
    Ok(Listing::parse(&text))
}
