//! The project's own commands, run as `cargo xtask …`; [`USAGE`] lists them.
//!
//! A script is an xtask: what a person or a machine needs to do to this repository is a
//! subcommand here, in Rust and without dependencies on the workspace that it judges.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "it talks to a person in a terminal")]

mod asm;
mod ci;
mod coverage;
mod cross;
mod fuzz;
mod levels;
mod matrix;
mod peers;
mod programs;
mod report;
mod setup;
mod tidy;

use ci::Scope;
use matrix::Target;
use std::path::Path;
use std::process::ExitCode;
use xshell::{Shell, cmd};

/// What `--help` says.
const USAGE: &str = "\
usage: cargo xtask <command>

  ci [--setup] [--fast | --all | --target NAME]
                    everything that must hold: format, lints, docs, and the tests on every
                    target of the table in xtask/src/matrix.rs, at every level
       --setup      first install what is missing: components and targets of the toolchain
                    through rustup, system packages through apt-get
       --fast       the inner loop: format, lints, tests at the best level of this CPU
       --all        also the targets that are tested on demand
       --target     that target's tests and nothing else
  cross --target NAME [--setup] [--run] [CARGO ARGUMENTS] [-- ARGUMENTS]
                    cargo test, or with --run cargo run, on a target of the table, for any
                    package; SIMD4_LEVEL in the environment caps the level:
                      cargo xtask cross --target aarch64 -p simd4 -- special_values
                      cargo xtask cross --target haswell --run -p rt-cli -- info
  asm [--bless]     read the machine code of every operation at every level, and of rt: no
                    intrinsic that is a function, no call in a hot loop, no legacy SSE among
                    VEX instructions, and the instructions that the documentation states
       --bless      state in the documentation what is compiled now
  tidy              the checks of ci that compile nothing: format, which words stand in which
                    rooms, and which crate uses which
  fuzz TARGET [--seconds N]
                    random input for a reader, guided by coverage, for a minute or so long
  peers [ARGUMENTS] our kernels beside Embree's and those of other crates, on the same rays; Embree
                    is loaded from what `pip install embreex` installs. peers --help has more:
                      cargo xtask peers --scenes bunny --isa avx2 --rays primary --size 512
  coverage          which lines the tests of this machine reach
  bless             let the golden tests rewrite tests/golden; read the diff afterwards

Exit codes: 0 all passed, 1 something failed (or was skipped, where CI=true), 2 usage.";

/// A command line, understood.
#[derive(Debug, PartialEq, Eq)]
enum Command {
    /// `ci`
    Ci(ci::Options),
    /// `cross`
    Cross(cross::Options),
    /// `asm`
    Asm {
        /// Whether the instruction table is to be written.
        bless: bool,
    },
    /// `fuzz`
    Fuzz(fuzz::Options),
    /// `peers`, with arguments of its own
    Peers(Vec<String>),
    /// `coverage`
    Coverage,
    /// `bless`
    Bless,
    /// `--help`, alone or after a command
    Help,
}

impl Command {
    /// Understands the arguments after the program's name, or says which of them it does not.
    fn parse(args: &[&str]) -> Result<Command, String> {
        let (&name, rest) = args.split_first().ok_or("which command?")?;
        if name == "peers" {
            return Ok(Command::Peers(rest.iter().map(|&arg| arg.to_owned()).collect()));
        }
        // What comes after `--` is for another program.
        let own = rest.split(|arg| *arg == "--").next().unwrap_or_default();
        if [name].iter().chain(own).any(|arg| ["--help", "-h"].contains(arg)) {
            return Ok(Command::Help);
        }
        let mut command = match name {
            "ci" => Command::Ci(ci::Options::default()),
            "tidy" if rest.is_empty() => {
                return Ok(Command::Ci(ci::Options { scope: Scope::Tidy, setup: false }));
            }
            "cross" => return cross::Options::parse(rest).map(Command::Cross),
            "fuzz" => return fuzz::Options::parse(rest).map(Command::Fuzz),
            "asm" => Command::Asm { bless: false },
            "coverage" => Command::Coverage,
            "bless" => Command::Bless,
            _ => return Err(format!("there is no command {name:?}")),
        };
        let mut rest = rest.iter();
        while let Some(&arg) = rest.next() {
            match (&mut command, arg) {
                (Command::Ci(options), "--setup") => options.setup = true,
                (Command::Ci(ci::Options { scope: scope @ Scope::EveryRun, .. }), _)
                    if ["--fast", "--all", "--target"].contains(&arg) =>
                {
                    *scope = match arg {
                        "--fast" => Scope::Fast,
                        "--all" => Scope::All,
                        _ => Scope::Only(Target::named(rest.next().unwrap_or(&""))?.name),
                    };
                }
                (Command::Asm { bless }, "--bless") => *bless = true,
                _ => return Err(format!("{name} knows no argument {arg:?} here")),
            }
        }
        Ok(command)
    }
}

fn main() -> ExitCode {
    let args: Vec<String> =
        std::env::args_os().skip(1).map(|arg| arg.to_string_lossy().into_owned()).collect();
    let command = match Command::parse(&args.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(command) => command,
        Err(wrong) => {
            eprintln!("error: {wrong}\n\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    let done = root().and_then(|sh| match command {
        Command::Ci(options) => Ok(ci::ci(&sh, options)),
        Command::Cross(options) => cross::cross(&sh, &options).map(|()| true),
        Command::Asm { bless } => Ok(asm::asm(&sh, bless)),
        Command::Fuzz(options) => fuzz::fuzz(&sh, &options).map(|()| true),
        Command::Peers(args) => peers::peers(&sh, &args),
        Command::Coverage => coverage::coverage(&sh).map(|()| true),
        Command::Bless => bless(&sh).map(|()| true),
        Command::Help => {
            println!("{USAGE}");
            Ok(true)
        }
    });
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// A shell at the root of the repository, from wherever in it `cargo xtask` was called.
fn root() -> Result<Shell, String> {
    let sh = Shell::new().map_err(|error| error.to_string())?;
    // cargo sets it; asked at run time, because a moved checkout keeps its built xtask.
    let here = sh.var_os("CARGO_MANIFEST_DIR").unwrap_or(env!("CARGO_MANIFEST_DIR").into());
    sh.change_dir(Path::new(&here).parent().ok_or("xtask is in no folder")?);
    Ok(sh)
}

/// Lets the golden tests write what they would otherwise compare.
fn bless(sh: &Shell) -> Result<(), String> {
    let command = cmd!(sh, "cargo test --quiet --locked -p rt-tests golden").env("RT_BLESS", "1");
    command.run().map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_arguments_are_understood_in_any_order() {
        let ci = |setup, scope| Ok(Command::Ci(ci::Options { setup, scope }));
        assert_eq!(Command::parse(&["ci"]), ci(false, Scope::EveryRun));
        assert_eq!(Command::parse(&["ci", "--setup"]), ci(true, Scope::EveryRun));
        assert_eq!(Command::parse(&["ci", "--fast", "--setup"]), ci(true, Scope::Fast));
        assert_eq!(Command::parse(&["ci", "--setup", "--all"]), ci(true, Scope::All));
        assert_eq!(Command::parse(&["ci", "--target", "s390x"]), ci(false, Scope::Only("s390x")));
        assert_eq!(Command::parse(&["asm"]), Ok(Command::Asm { bless: false }));
        assert_eq!(Command::parse(&["asm", "--bless"]), Ok(Command::Asm { bless: true }));
        assert_eq!(Command::parse(&["tidy"]), ci(false, Scope::Tidy));
        assert_eq!(Command::parse(&["bless"]), Ok(Command::Bless));
        let args = ["--quick", "--help"];
        let peers = Ok(Command::Peers(args.map(str::to_owned).to_vec()));
        assert_eq!(Command::parse(&["peers", "--quick", "--help"]), peers);
    }

    #[test]
    fn help_is_found_alone_and_after_a_command() {
        for args in
            [&["--help"][..], &["-h"], &["ci", "--help"], &["ci", "--fast", "-h"], &["cross", "-h"]]
        {
            assert_eq!(Command::parse(args), Ok(Command::Help), "{args:?}");
        }
    }

    #[test]
    fn anything_else_is_named_in_the_error() {
        for (args, named) in [
            (&[][..], "which command"),
            (&["c"], "\"c\""),
            (&["frob", "--setup"], "\"frob\""),
            (&["--setup", "ci"], "\"--setup\""),
            (&["ci", "--quick"], "\"--quick\""),
            (&["ci", "--setup=yes"], "\"--setup=yes\""),
            (&["ci", "bless"], "\"bless\""),
            (&["ci", "--fast", "--all"], "\"--all\""),
            (&["ci", "--target"], "no target \"\""),
            (&["ci", "--target", "vax"], "\"vax\""),
            (&["cross", "-p", "simd4"], "--target"),
            (&["tidy", "--fast"], "tidy"),
            (&["fuzz", "gif"], "\"gif\""),
            (&["coverage", "--html"], "\"--html\""),
            (&["cross", "-p", "simd4", "--target"], "--target"),
            (&["bless", "--fast"], "\"--fast\""),
        ] {
            let wrong = Command::parse(args).expect_err("not a command line");
            assert!(wrong.contains(named), "{args:?}: {wrong}");
        }
    }
}
