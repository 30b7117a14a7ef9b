//! The table of targets that the tests run on. How a target links and which runner cargo starts
//! its programs with is in `.cargo/config.toml`.

use std::env::consts::{ARCH, OS};

/// A kind of machine that the tests run on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    /// Its architecture, which names it in reports.
    pub(crate) arch: &'static str,
    /// What `--target` is given; without it the host's own target.
    pub(crate) triple: Option<&'static str>,
    /// What runs its programs here, if the host can't.
    pub(crate) emulator: Option<Emulator>,
}

/// A program that runs the programs of another architecture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emulator {
    /// Its command.
    pub(crate) program: &'static str,
    /// The Debian and Ubuntu package that has it.
    pub(crate) package: &'static str,
}

/// The machine that this program was built for.
pub(crate) const HOST: Target = Target { arch: ARCH, triple: None, emulator: None };

/// The targets beside the host. musl, because it links with what rustup ships.
const FOREIGN: [Target; 1] = [Target {
    arch: "aarch64",
    triple: Some("aarch64-unknown-linux-musl"),
    emulator: Some(Emulator { program: "qemu-aarch64", package: "qemu-user" }),
}];

/// The targets that this host does not cover by itself.
pub(crate) fn foreign() -> impl Iterator<Item = Target> {
    FOREIGN.into_iter().filter(|target| target.arch != ARCH)
}

impl Target {
    /// Why no program could make this host run it, if so.
    pub(crate) fn impossible(&self) -> Option<String> {
        let emulator = self.emulator.filter(|_| OS != "linux")?;
        Some(format!("{} runs Linux programs on Linux only, and this is {OS}", emulator.program))
    }

    /// The arguments with which cargo builds for it.
    pub(crate) fn cargo_args(&self) -> impl Iterator<Item = &'static str> {
        self.triple.into_iter().flat_map(|triple| ["--target", triple])
    }
}
