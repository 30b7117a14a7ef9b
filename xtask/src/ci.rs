//! `cargo xtask ci`: everything that must hold before a change goes in.

use crate::cross::cargo;
use crate::matrix::{Build, TARGETS, Target, Tests, Tier};
use crate::programs::Programs;
use crate::report::{Done, Report};
use crate::{asm, fuzz, peers, setup, tidy};
use xshell::{Cmd, Shell, cmd};

/// The flags of `ci`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Options {
    /// Install what is missing.
    pub(crate) setup: bool,
    /// How much to do.
    pub(crate) scope: Scope,
}

/// How much to do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Scope {
    /// What no change goes in without.
    #[default]
    EveryRun,
    /// Without compiling anything.
    Tidy,
    /// The inner loop.
    Fast,
    /// Also what is tested on demand.
    All,
    /// The tests of one target.
    Only(&'static str),
}

/// A check of the source: its name, and what it does.
type Check = (&'static str, fn(&Shell, Options) -> Done);

/// What is checked, in this order: the first [`TIDY`] take seconds, the first [`QUICK`] are for the
/// inner loop, the first [`EVERY_RUN`] for every run.
const CHECKS: [Check; 9] = [
    ("format", format),
    ("rooms", rooms),
    ("arrows", arrows),
    ("clippy", clippy),
    ("docs", docs),
    ("licences", licences),
    ("fuzz targets", fuzz),
    ("benches", benches),
    ("peers", peers),
];
const TIDY: usize = 3;
const QUICK: usize = 4;
const EVERY_RUN: usize = 7;

/// The packages outside the workspace.
const NESTED: [&str; 3] =
    ["simd4/compare/Cargo.toml", "tests/fuzz/Cargo.toml", "xtask/peers/Cargo.toml"];

/// Checks, tests and reports; true if all is well.
pub(crate) fn ci(sh: &Shell, options: Options) -> bool {
    // A machine that is meant to check everything must not pass for lack of a piece.
    let strict = sh.var("CI").is_ok_and(|ci| ci == "true");
    if strict {
        // Nobody edits there and builds again: in one go it is quicker.
        sh.set_var("CARGO_INCREMENTAL", "0");
    }
    if options.setup {
        setup::components(sh);
    }
    let checks = match options.scope {
        Scope::All => &CHECKS[..],
        Scope::EveryRun => &CHECKS[..EVERY_RUN],
        Scope::Fast => &CHECKS[..QUICK],
        Scope::Tidy => &CHECKS[..TIDY],
        Scope::Only(_) => &[],
    };
    let targets: Vec<_> = TARGETS.iter().filter(|target| options.scope.includes(target)).collect();

    // The machine code, of all levels and so of no target in particular. The program as it is
    // shipped takes minutes to build: every run reads the one that the tests have built, of which
    // the compiler inlines less.
    let machine_code = matches!(options.scope, Scope::EveryRun | Scope::All);

    let total = checks.len() + usize::from(machine_code) + targets.len();
    let mut numbers = 1..=total;
    let mut announce = |name: &str| {
        println!("[{}/{total}] {name}", numbers.next().unwrap_or(total));
    };
    let mut report = Report::default();
    for (name, check) in checks {
        announce(name);
        report.step(name, "", || check(sh, options));
    }
    if machine_code {
        announce("asm");
        asm::operations(sh, &mut report, false);
        if options.scope == Scope::All {
            asm::shipped(sh, &mut report);
        }
    }
    let mut built = None;
    for target in targets {
        announce(target.name);
        test(sh, target, options, strict, &mut built, &mut report);
    }
    let ok = report.ok(strict);
    if !ok && report.ok(false) {
        println!("\nCI=true: a skip is a failure.");
    }
    println!("\n{report}");
    ok
}

impl Scope {
    /// Whether a target is to be tested.
    fn includes(self, target: &Target) -> bool {
        match self {
            Scope::EveryRun => target.tier == Tier::EveryRun,
            Scope::Fast => target.best == Tests::Everything,
            Scope::All => true,
            Scope::Tidy => false,
            Scope::Only(name) => target.name == name,
        }
    }
}

/// Builds the tests for a target, unless the target before has the same build, and runs them at
/// each level.
fn test(
    sh: &Shell,
    target: &'static Target,
    options: Options,
    strict: bool,
    built: &mut Option<(&'static Target, Programs)>,
    report: &mut Report,
) {
    let name = target.name;
    if let Some(reason) = target.elsewhere() {
        report.step(name, "", || Done::left(reason));
        return;
    }
    if let Err(reason) = setup::target(sh, target, options.setup) {
        report.step(name, "", || Done::skipped(reason));
        return;
    }
    if target.is_built_apart() && built.as_ref().is_none_or(|(of, _)| !of.shares_build(target)) {
        *built = None;
        if target.build.triple.is_some() {
            // Code that clippy does not see on the host.
            report.step(name, "clippy", || {
                let args = ["--quiet", "--locked", "-p", "simd4", "--", "-D", "warnings"];
                succeeds(cargo(sh, target, "clippy").args(args))
            });
        }
        // Where people work, the host's own programs are those that cargo builds anyway.
        let in_one_go = strict || target.build != Build::default();
        let build = || Programs::build(sh, target, in_one_go).map(|programs| (target, programs));
        report.step(name, "build", || match build() {
            Ok(programs) => {
                *built = Some(programs);
                Ok(()).into()
            }
            Err(reason) => Err(reason).into(),
        });
        if let Some(rt) = built.as_ref().and_then(|(_, programs)| programs.rt()) {
            report.step(name, "asm", || asm::binary::check(sh, rt));
        }
    }
    let none = Programs::default();
    let programs = match built {
        Some((of, programs)) if of.shares_build(target) => programs,
        // What does not build has been said.
        _ if target.is_built_apart() => return,
        _ => &none,
    };
    let levels = match programs.levels(sh, target) {
        Ok(levels) => levels,
        Err(reason) => {
            report.step(name, "levels", || Err(reason).into());
            return;
        }
    };
    let (best, others) = levels.split_last().expect("a list that is as the table demands");
    // The best level without the variable, as it is for everybody.
    report.step(name, best, || programs.run(sh, target, target.best, None));
    let others = others.iter().filter(|_| options.scope != Scope::Fast);
    for (level, tests) in others.filter_map(|level| Some((level, target.others?))) {
        report.step(name, level, || programs.run(sh, target, tests, Some(level)));
    }
}

fn rooms(sh: &Shell, _: Options) -> Done {
    tidy::rooms(sh)
}

fn arrows(sh: &Shell, _: Options) -> Done {
    tidy::arrows(sh)
}

fn fuzz(sh: &Shell, options: Options) -> Done {
    fuzz::check(sh, options.setup)
}

fn format(sh: &Shell, _: Options) -> Done {
    let mut manifests = ["Cargo.toml"].into_iter().chain(NESTED);
    let check = |manifest| {
        let command = cmd!(sh, "cargo fmt --all --check --manifest-path {manifest}").quiet();
        command.run().map_err(|error| error.to_string())
    };
    manifests.try_for_each(check).into()
}

fn clippy(sh: &Shell, _: Options) -> Done {
    let clippy = cmd!(sh, "cargo clippy --quiet --locked --keep-going --workspace --all-targets");
    succeeds(clippy.args(["--", "-D", "warnings"]))
}

fn docs(sh: &Shell, _: Options) -> Done {
    let docs = cmd!(sh, "cargo doc --quiet --locked --keep-going --workspace --no-deps");
    succeeds(docs.env("RUSTDOCFLAGS", "-D warnings"))
}

/// What deny.toml says, where there is who reads it.
fn licences(sh: &Shell, _: Options) -> Done {
    if !setup::runs(cmd!(sh, "cargo deny --version")) {
        return Done::left("no cargo-deny: cargo install --locked cargo-deny".to_owned());
    }
    // Not the advisories: they change without a change here.
    succeeds(cmd!(sh, "cargo deny --log-level error check licenses bans sources"))
}

/// Every bench runs once: that it does, and that what it computes is right. Nothing is timed.
fn benches(sh: &Shell, _: Options) -> Done {
    // Of what they measure, unoptimised code will do, and is compiled in a fraction of the time;
    // all else is shared with the tests.
    let plain = ["simd4", "rt-kernels"]
        .map(|name| format!("profile.dev.package.{name}.opt-level=0"))
        .into_iter()
        .flat_map(|setting| ["--config".to_owned(), setting]);
    let benches =
        cmd!(sh, "cargo test --quiet --locked --workspace --bench levels --bench kernels");
    succeeds(benches.args(plain).ignore_stdout())
}

/// The tests of the comparison, without what it is compared with unless that is installed.
fn peers(sh: &Shell, _: Options) -> Done {
    succeeds(peers::cargo(sh, "test", "peers"))
}

/// Passed if the command succeeds; what it prints passes through.
pub(crate) fn succeeds(command: Cmd) -> Done {
    command.quiet().run().map_err(|error| error.to_string()).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(scope: Scope) -> Vec<&'static str> {
        TARGETS.iter().filter(|target| scope.includes(target)).map(|target| target.name).collect()
    }

    #[test]
    fn the_inner_loop_is_this_machine_and_all_is_all() {
        let (every, all) = (names(Scope::EveryRun), names(Scope::All));
        assert_eq!(names(Scope::Fast), ["native"]);
        assert_eq!(names(Scope::Only("s390x")), ["s390x"]);
        assert!(every.contains(&"aarch64") && !every.contains(&"s390x"));
        assert!(all.contains(&"s390x") && all.len() == TARGETS.len());
    }
}
