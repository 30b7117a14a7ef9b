//! The project's own commands, run as `cargo xtask …`; [`USAGE`] lists them.
//!
//! A script is an xtask: what a person or a machine needs to do to this repository is a
//! subcommand here, in Rust and without dependencies on the workspace that it judges.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "it talks to a person in a terminal")]

mod asm;
mod ci;
mod levels;
mod matrix;
mod report;
mod setup;

use std::process::ExitCode;
use xshell::{Shell, cmd};

/// What `--help` says.
const USAGE: &str = "\
usage: cargo xtask <command>

  ci [--setup] [--fast]   format, lints, docs, tests at every level of this CPU, and aarch64
       --setup            first install what is missing: components and targets of the
                          toolchain through rustup, system packages through apt-get
       --fast             format, lints, and tests at the best level of this CPU only
  asm [--bless]           read the machine code of every operation and kernel at every level:
                          no intrinsic that is a function, no call in a hot loop, no legacy SSE
                          among VEX instructions, and the instructions that the docs state
       --bless            write simd4/INSTRUCTIONS.md instead of checking it
  bless                   let the golden tests rewrite tests/golden; read the diff afterwards

Exit codes: 0 all passed, 1 something failed (or was skipped, where CI=true), 2 usage.";

/// A command line, understood.
#[derive(Debug, PartialEq, Eq)]
enum Command {
    /// `ci`
    Ci(ci::Options),
    /// `asm`
    Asm {
        /// Whether the instruction table is to be written.
        bless: bool,
    },
    /// `bless`
    Bless,
    /// `--help`, alone or after a command
    Help,
}

impl Command {
    /// Understands the arguments after the program's name, or says which of them it does not.
    fn parse(args: &[&str]) -> Result<Command, String> {
        let (&name, rest) = args.split_first().ok_or("which command?")?;
        if ["--help", "-h"].contains(&name) || rest.iter().any(|arg| ["--help", "-h"].contains(arg))
        {
            return Ok(Command::Help);
        }
        let mut command = match name {
            "ci" => Command::Ci(ci::Options::default()),
            "asm" => Command::Asm { bless: false },
            "bless" => Command::Bless,
            _ => return Err(format!("there is no command {name:?}")),
        };
        for &arg in rest {
            match (&mut command, arg) {
                (Command::Ci(options), "--setup") => options.setup = true,
                (Command::Ci(options), "--fast") => options.fast = true,
                (Command::Asm { bless }, "--bless") => *bless = true,
                _ => return Err(format!("{name} knows no argument {arg:?}")),
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
        Command::Asm { bless } => Ok(asm::asm(&sh, bless)),
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
fn root() -> xshell::Result<Shell> {
    let sh = Shell::new()?;
    // cargo sets it; asked at run time, because a moved checkout keeps its built xtask.
    let here = sh.var_os("CARGO_MANIFEST_DIR").unwrap_or(env!("CARGO_MANIFEST_DIR").into());
    sh.change_dir(here);
    sh.change_dir("..");
    Ok(sh)
}

/// Lets the golden tests write what they would otherwise compare.
fn bless(sh: &Shell) -> xshell::Result<()> {
    cmd!(sh, "cargo test --quiet --locked -p rt-tests golden").env("RT_BLESS", "1").run()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_arguments_are_understood_in_any_order() {
        let ci = |setup, fast| Ok(Command::Ci(ci::Options { setup, fast }));
        assert_eq!(Command::parse(&["ci"]), ci(false, false));
        assert_eq!(Command::parse(&["ci", "--setup"]), ci(true, false));
        assert_eq!(Command::parse(&["ci", "--fast", "--setup"]), ci(true, true));
        assert_eq!(Command::parse(&["asm"]), Ok(Command::Asm { bless: false }));
        assert_eq!(Command::parse(&["asm", "--bless"]), Ok(Command::Asm { bless: true }));
        assert_eq!(Command::parse(&["bless"]), Ok(Command::Bless));
    }

    #[test]
    fn help_is_found_alone_and_after_a_command() {
        for args in [&["--help"][..], &["-h"], &["ci", "--help"], &["ci", "--fast", "-h"]] {
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
            (&["bless", "--fast"], "\"--fast\""),
        ] {
            let wrong = Command::parse(args).expect_err("not a command line");
            assert!(wrong.contains(named), "{args:?}: {wrong}");
        }
    }
}
