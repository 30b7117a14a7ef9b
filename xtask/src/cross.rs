//! How cargo builds for a target, and what runs what it builds; `cargo xtask cross`.

use crate::matrix::{Build, Link, Run, Target, Tests};
use crate::setup;
use std::path::Path;
use xshell::{Cmd, Shell, cmd};

/// The arguments of `cross`, understood.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Options {
    /// The row of the table.
    pub(crate) target: String,
    /// Whether to run a program instead of tests.
    pub(crate) run: bool,
    /// Whether to install what is missing.
    pub(crate) setup: bool,
    /// What goes to cargo as it is.
    pub(crate) cargo: Vec<String>,
    /// What goes to the program.
    pub(crate) program: Vec<String>,
}

impl Options {
    /// Understands the arguments after `cross`.
    pub(crate) fn parse(args: &[&str]) -> Result<Options, String> {
        let mut options = Options::default();
        let mut args = args.iter();
        while let Some(&arg) = args.next() {
            match arg {
                "--target" => options.target = args.next().map_or("", |name| name).to_owned(),
                "--run" => options.run = true,
                "--setup" => options.setup = true,
                "--" => options.program = args.by_ref().map(|&arg| arg.to_owned()).collect(),
                _ => options.cargo.push(arg.to_owned()),
            }
        }
        if options.target.is_empty() {
            return Err("cross needs --target NAME".to_owned());
        }
        Ok(options)
    }
}

/// Tests or runs any package on a target.
pub(crate) fn cross(sh: &Shell, options: &Options) -> Result<(), String> {
    let target = Target::named(&options.target)?;
    if let Some(reason) = target.elsewhere() {
        return Err(reason);
    }
    setup::target(sh, target, options.setup)?;
    let subcommand = if options.run { "run" } else { "test" };
    let mut command = cargo(sh, target, subcommand).args(&options.cargo);
    let runner = runner(sh, target);
    if !runner.is_empty() {
        // As an array, because a path may have blanks in it.
        let words: Vec<_> = runner.iter().map(|word| format!("{word:?}")).collect();
        let triple = triple(sh, target.build);
        let config = format!("target.{triple}.runner=[{}]", words.join(","));
        command = command.args(["--config", &config]);
        // The tests of a program start it themselves.
        command = command.env("RT_RUNNER", runner.join(" "));
    }
    // Any test may be asked for, also one that needs more than the fewest.
    let tests = if target.best == Tests::Dispatch { Tests::Brief } else { target.best };
    if let Some(cases) = target.cases(tests).filter(|_| sh.var_os("PROPTEST_CASES").is_none()) {
        command = command.env("PROPTEST_CASES", cases);
    }
    command.arg("--").args(&options.program).run().map_err(|error| error.to_string())
}

/// Cargo with a subcommand, told how to build for a target. Its output goes to the folder of the
/// target and, since flags are part of a crate's name, no build disturbs another.
pub(crate) fn cargo<'a>(sh: &'a Shell, target: &Target, subcommand: &str) -> Cmd<'a> {
    let Target { build, run, .. } = target;
    let mut command = match run {
        Run::Miri => cmd!(sh, "cargo +nightly miri {subcommand}"),
        _ => cmd!(sh, "cargo {subcommand}"),
    };
    if build.triple.is_some() || !build.rustflags.is_empty() {
        // With `--target` the flags are for the target alone: what runs during the build is shared.
        command = command.args(["--target", &triple(sh, *build)]);
    }
    if !build.rustflags.is_empty() {
        command = command.env("RUSTFLAGS", build.rustflags);
    }
    if let (Some(triple), Some(linker)) = (build.triple, linker(build.link)) {
        command = command.args(["--config", &format!("target.{triple}.linker={linker:?}")]);
    }
    command
}

/// What links, if not rustc's own choice.
pub(crate) fn linker(link: Link) -> Option<String> {
    match link {
        Link::Own => None,
        Link::Lld => Some("rust-lld".to_owned()),
        Link::Gcc(gnu, _) => Some(format!("{gnu}-gcc")),
    }
}

/// The words before a program's name that make it run.
pub(crate) fn runner(sh: &Shell, target: &Target) -> Vec<String> {
    match target.run {
        Run::Directly | Run::Miri => vec![],
        Run::Qemu { arch, cpu } => {
            let mut words = vec![format!("qemu-{arch}"), "-cpu".to_owned(), cpu.to_owned()];
            if let Link::Gcc(gnu, _) = target.build.link {
                // Where Debian puts the C library of another architecture.
                words.extend(["-L".to_owned(), format!("/usr/{gnu}")]);
            }
            words
        }
        Run::Node => {
            let script = sh.current_dir().join(Path::new("xtask").join("wasi.mjs"));
            // Node 20's optimiser crashes over our largest functions, now and then at the exit.
            let flags = ["node", "--no-warnings", "--no-wasm-tier-up"].map(str::to_owned);
            [&flags[..], &[script.display().to_string()]].concat()
        }
    }
}

/// What rustc calls the target of a build.
pub(crate) fn triple(sh: &Shell, build: Build) -> String {
    build.triple.map_or_else(|| host(sh), str::to_owned)
}

/// What rustc calls this machine.
pub(crate) fn host(sh: &Shell) -> String {
    cmd!(sh, "rustc --print host-tuple").quiet().read().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(name: &str) -> String {
        let sh = Shell::new().expect("a folder to be in");
        runner(&sh, Target::named(name).expect("a row")).join(" ")
    }

    #[test]
    fn what_is_not_for_xtask_is_for_cargo_or_for_the_program() {
        let line = ["-p", "rt-cli", "--run", "--target", "aarch64", "-r", "--", "info", "--run"];
        let options = Options::parse(&line).expect("a command line");
        assert_eq!((options.target.as_str(), options.run, options.setup), ("aarch64", true, false));
        assert_eq!(options.cargo, ["-p", "rt-cli", "-r"]);
        assert_eq!(options.program, ["info", "--run"]);
    }

    #[test]
    fn a_cpu_is_chosen_and_a_foreign_c_library_found() {
        assert_eq!(words("native"), "");
        assert_eq!(words("nehalem"), "qemu-x86_64 -cpu Nehalem");
        assert_eq!(words("s390x"), "qemu-s390x -cpu max -L /usr/s390x-linux-gnu");
        assert!(words("wasm32").ends_with("wasi.mjs"));
    }

    #[test]
    fn cargo_is_told_how_to_build() {
        let sh = Shell::new().expect("a folder to be in");
        let line = |name| cargo(&sh, Target::named(name).expect("a row"), "test").to_string();
        assert_eq!(line("native"), "cargo test");
        assert_eq!(line("qemu64"), "cargo test");
        let aarch64 = line("aarch64");
        assert!(aarch64.starts_with("cargo test --target aarch64-unknown-linux-musl --config"));
        assert!(aarch64.contains("rust-lld"), "{aarch64}");
        assert!(line("x86-64-v3").contains(&host(&sh)));
        assert!(line("miri-s390x").starts_with("cargo +nightly miri test --target s390x"));
    }
}
