//! `cargo xtask ci`: everything that must hold before a change goes in.

use crate::levels::Levels;
use crate::matrix::{self, Emulator, HOST, Target};
use crate::report::{Outcome, Report, Row, Tally};
use crate::setup;
use std::process::{Command, Stdio};
use std::time::Instant;
use xshell::{Cmd, Shell, cmd};

/// The flags of `ci`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Options {
    /// Install what is missing.
    pub(crate) setup: bool,
    /// The inner loop only.
    pub(crate) fast: bool,
}

/// A line of the plan.
struct Step<'a> {
    /// Its name in the report.
    name: String,
    /// What to do.
    action: Action<'a>,
    /// The step without whose success this one makes no sense.
    needs: Option<String>,
}

impl<'a> Step<'a> {
    /// A step that needs no other.
    fn new(name: impl Into<String>, action: Action<'a>) -> Step<'a> {
        Step { name: name.into(), action, needs: None }
    }
}

/// What a step does.
enum Action<'a> {
    /// Succeeds if the command does.
    Run(Cmd<'a>),
    /// The same, and counts the tests in its output.
    Test(Cmd<'a>),
    /// Fails for a reason already known.
    Fail(String),
    /// Is skipped for a reason already known.
    Skip(String),
}

/// Plans, runs and reports; true if all is well.
pub(crate) fn ci(sh: &Shell, options: Options) -> bool {
    // A machine that is meant to check everything must not pass for lack of a piece.
    let strict = sh.var("CI").is_ok_and(|ci| ci == "true");
    let steps = plan(sh, options);
    let mut report = Report::default();
    let total = steps.len();
    for (i, step) in steps.into_iter().enumerate() {
        println!("[{}/{total}] {}", i + 1, step.name);
        let row = run(step, &report);
        if row.outcome != Outcome::Passed {
            println!("      {}", row.reason);
        }
        report.rows.push(row);
    }
    let ok = report.ok(strict);
    if !ok && report.ok(false) {
        println!("\nCI=true: a skip is a failure.");
    }
    println!("\n{report}");
    ok
}

/// All steps, in order. Asks the machines for their levels, for which it builds `rt`.
fn plan(sh: &Shell, Options { setup, fast }: Options) -> Vec<Step<'_>> {
    if setup {
        setup::components(sh);
    }
    let clippy = cmd!(sh, "cargo clippy --quiet --locked --keep-going --workspace --all-targets");
    let docs = cmd!(sh, "cargo doc --quiet --locked --keep-going --workspace --no-deps");
    let mut steps = vec![
        Step::new("format", Action::Run(cmd!(sh, "cargo fmt --all --check"))),
        Step::new("clippy", Action::Run(clippy.args(["--", "-D", "warnings"]))),
    ];
    if fast {
        let name = format!("test, {}, best level", HOST.arch);
        steps.push(Step::new(name, Action::Test(cargo_test(sh, &HOST))));
        return steps;
    }
    steps.push(Step::new("docs", Action::Run(docs.env("RUSTDOCFLAGS", "-D warnings"))));
    steps.extend(tests(sh, &HOST));
    for target in matrix::foreign() {
        match setup::target(sh, &target, setup) {
            Ok(()) => steps.extend(tests(sh, &target)),
            Err(reason) => {
                steps.push(Step::new(format!("test, {}", target.arch), Action::Skip(reason)));
            }
        }
    }
    steps
}

/// All tests on one target: built once, run at the best level and then at each other.
fn tests<'a>(sh: &'a Shell, target: &Target) -> Vec<Step<'a>> {
    let arch = target.arch;
    println!("building rt for {arch}, which knows the levels there");
    let levels = Levels::of(sh, target);
    // So that what does not build is said once, not for each level.
    let build = format!("build tests, {arch}");
    let test = |level: &str, cmd| Step {
        name: format!("test, {arch}, {level}"),
        action: Action::Test(cmd),
        needs: Some(build.clone()),
    };
    let mut steps =
        vec![Step::new(build.clone(), Action::Run(cargo_test(sh, target).arg("--no-run")))];
    match levels {
        Ok(Levels { default, others }) => {
            // The best level without the variable, as it is for everybody.
            steps.push(test(&format!("level {default}"), cargo_test(sh, target)));
            steps.extend(others.iter().map(|level| {
                test(&format!("level {level}"), cargo_test(sh, target).env("SIMD4_LEVEL", level))
            }));
        }
        Err(reason) => {
            steps.push(Step::new(format!("levels, {arch}"), Action::Fail(reason)));
            steps.push(test("best level", cargo_test(sh, target)));
        }
    }
    steps
}

/// The command that runs all tests, doc tests too, on a target at its best level.
fn cargo_test<'a>(sh: &'a Shell, target: &Target) -> Cmd<'a> {
    let cmd = cmd!(sh, "cargo test --quiet --locked --workspace --no-fail-fast")
        .args(target.cargo_args())
        // Either would change what the tests check.
        .env_remove("SIMD4_LEVEL")
        .env_remove("RT_BLESS");
    match target.emulator {
        // xtask is a tool of the host. The others find in the environment how to start `rt`, and
        // how many random cases to try: an emulator is slower by a factor of ten and more.
        Some(Emulator { program, .. }) => {
            cmd.args(["--exclude", "xtask"]).env("RT_RUNNER", program).env("PROPTEST_CASES", "32")
        }
        None => cmd.env_remove("RT_RUNNER"),
    }
}

/// Does one step, unless the rows so far rule it out.
fn run(step: Step, before: &Report) -> Row {
    let start = Instant::now();
    let failed = |name: &String| {
        before.rows.iter().any(|row| row.step == *name && row.outcome != Outcome::Passed)
    };
    let (outcome, tally, reason) = match (step.needs.filter(failed), step.action) {
        (Some(needs), _) => (Outcome::Skipped, None, format!("needs: {needs}")),
        (None, Action::Skip(reason)) => (Outcome::Skipped, None, reason),
        (None, Action::Fail(reason)) => (Outcome::Failed, None, reason),
        (None, Action::Run(cmd)) => {
            let (outcome, _, reason) = execute(cmd);
            (outcome, None, reason)
        }
        (None, Action::Test(cmd)) => {
            let (outcome, stdout, reason) = execute(cmd);
            let mut tally = Tally::of(&stdout);
            if outcome == Outcome::Failed && tally.failed == 0 {
                // A test binary that crashed counts nothing; "0 failed" would be a lie.
                tally.failed = 1;
            }
            (outcome, Some(tally), reason)
        }
    };
    Row { step: step.name, outcome, time: start.elapsed(), tally, reason }
}

/// Runs a command: how it ended, its standard output, and if it failed, how. Cargo's errors pass
/// through as they come; its standard output, which holds the tests' own, only on failure.
fn execute(cmd: Cmd) -> (Outcome, String, String) {
    let mut shown = cmd.to_string();
    let mut command = Command::from(cmd);
    for (name, value) in command.get_envs() {
        if let Some(value) = value {
            // As a shell takes it: the line is there to be pasted.
            shown = format!("{}={value:?} {shown}", name.display());
        }
    }
    match command.stdin(Stdio::null()).stderr(Stdio::inherit()).output() {
        Err(error) => (Outcome::Failed, String::new(), format!("{error}: {shown}")),
        Ok(output) => {
            let stdout = String::from_utf8_lossy(&output.stdout).into_owned();
            if output.status.success() {
                return (Outcome::Passed, stdout, String::new());
            }
            print!("{stdout}");
            (Outcome::Failed, stdout, format!("{}: {shown}", output.status))
        }
    }
}
