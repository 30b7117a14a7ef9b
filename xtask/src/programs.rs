//! The programs of a build: made once, run on every machine and at every level that they are for.

use crate::cross::{cargo, runner};
use crate::matrix::{Build, CORE, DISPATCHED, LONG, OF_THE_DEFINITION, Run, Target, Tests};
use crate::report::{Done, Tally, skips};
use serde_json::Value;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;
use xshell::{Cmd, Shell, cmd};

/// What cargo has built.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Programs {
    /// The programs that are made of tests.
    pub(crate) tests: Vec<TestProgram>,
    /// The example of `simd4` that lists the levels.
    levels: Option<PathBuf>,
    /// All others, which tests may run.
    pub(crate) others: Vec<PathBuf>,
    /// What cargo was told to build them so.
    settings: Vec<(&'static str, String)>,
}

/// A program made of tests.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct TestProgram {
    /// The folder of its package, in which it is to run.
    pub(crate) folder: PathBuf,
    /// Itself.
    pub(crate) file: PathBuf,
}

/// Spares LLVM, where it inlines, to note which references were known to be apart. Kernels are all
/// inlined, by value: the notes are a quarter of the work, and nothing comes of them.
const WITHOUT_NOTES: &str = "-Cllvm-args=-enable-noalias-to-md-conversion=false";

/// How cargo is told to build what nobody edits and builds again in a loop, or debugs: in one go,
/// without benches, the places of lines and notes for LLVM.
fn settings_in_one_go(sh: &Shell, rustflags: &str) -> Vec<(&'static str, String)> {
    let probe = cmd!(sh, "rustc {WITHOUT_NOTES} --crate-type rlib --emit metadata=- -");
    // LLVM's flags come and go.
    let known = probe.stdin("").quiet().ignore_stdout().ignore_stderr().run().is_ok();
    let without_notes = if known { WITHOUT_NOTES } else { "" };
    let flags = [rustflags, "--cfg without_benches", without_notes];
    vec![
        ("CARGO_INCREMENTAL", "0".to_owned()),
        ("CARGO_PROFILE_DEV_DEBUG", "0".to_owned()),
        ("RUSTFLAGS", flags.join(" ").trim().to_owned()),
    ]
}

impl TestProgram {
    /// The arguments by which it runs no more than those tests.
    fn filters(&self, tests: Tests) -> Vec<&'static str> {
        match tests {
            Tests::Brief => LONG.into_iter().flat_map(|name| ["--skip", name]).collect(),
            Tests::Dispatch if self.folder.ends_with("tests") => DISPATCHED.to_vec(),
            Tests::Dispatch => vec!["--skip", OF_THE_DEFINITION],
            _ => vec![],
        }
    }
}

impl Programs {
    /// Builds all that any target with this build runs; as cargo does it anyway, or `in_one_go`.
    pub(crate) fn build(sh: &Shell, target: &Target, in_one_go: bool) -> Result<Programs, String> {
        let mut command = cargo(sh, target, "test").args(["--locked", "--no-run"]);
        command = match target.of_workspace() {
            true => command.arg("--workspace"),
            false => command.args(CORE.iter().flat_map(|name| ["-p", name])),
        };
        let mut settings = match in_one_go {
            true => settings_in_one_go(sh, target.build.rustflags),
            false => vec![],
        };
        if target.build != Build::default() {
            // As users build. What the host's own programs assert takes much longer to compile.
            settings.push(("CARGO_PROFILE_DEV_DEBUG_ASSERTIONS", "false".to_owned()));
            settings.push(("CARGO_PROFILE_DEV_OVERFLOW_CHECKS", "false".to_owned()));
            if let Run::Directly = target.run {
                // To optimise across the units of a crate takes longer than tests gain by it, but
                // for emulators.
                settings.push(("CARGO_PROFILE_DEV_LTO", "off".to_owned()));
            }
        }
        command = command.envs(settings.iter().cloned());
        if target.of_workspace() && target.build.triple.is_some() {
            // A tool of the host.
            command = command.args(["--exclude", "xtask"]);
        }
        Ok(Programs { settings, ..Programs::made_by(command)? })
    }

    /// Runs a cargo command that builds, and picks what it made out of its messages.
    pub(crate) fn made_by(command: Cmd) -> Result<Programs, String> {
        let command = command.args(["--quiet", "--message-format", "json-render-diagnostics"]);
        let shown = command.to_string();
        let messages = command.quiet().read().map_err(|_| format!("this failed: {shown}"))?;
        Ok(Programs::of(&messages))
    }

    /// The program `rt`, if it is among them.
    pub(crate) fn rt(&self) -> Option<&Path> {
        let is_rt = |file: &&PathBuf| file.file_stem().is_some_and(|name| name == "rt");
        self.others.iter().find(is_rt).map(PathBuf::as_path)
    }

    /// Picks the programs out of cargo's messages, one JSON object a line.
    fn of(messages: &str) -> Programs {
        let mut programs = Programs::default();
        for line in messages.lines() {
            let Ok(message) = serde_json::from_str::<Value>(line) else { continue };
            let text = |value: &Value| value.as_str().map(PathBuf::from);
            let Some(file) = text(&message["executable"]) else { continue };
            if message["profile"]["test"] == true {
                let manifest = text(&message["manifest_path"]).unwrap_or_default();
                let folder = manifest.parent().unwrap_or(Path::new("")).to_owned();
                programs.tests.push(TestProgram { folder, file });
            } else if message["target"]["name"] == "levels" {
                programs.levels = Some(file);
            } else {
                programs.others.push(file);
            }
        }
        programs
    }

    /// The levels that a program finds on the target, if they are those that the table demands.
    pub(crate) fn levels(&self, sh: &Shell, target: &Target) -> Result<Vec<String>, String> {
        let said = if let Run::Miri = target.run {
            let args = ["--quiet", "--locked", "-p", "simd4", "--example", "levels"];
            let command = cargo(sh, target, "run").args(args).quiet();
            command.env("MIRIFLAGS", MIRIFLAGS).env_remove("SIMD4_LEVEL").read()
        } else {
            let program = self.levels.as_ref().ok_or("there is no example `levels`")?;
            let words = words(sh, target, program);
            let (program, args) = words.split_first().expect("the program itself");
            let command = cmd!(sh, "{program}").args(args).quiet().ignore_stderr();
            command.env_remove("SIMD4_LEVEL").read()
        };
        target.levels.check(&said.map_err(|error| error.to_string())?)
    }

    /// Runs tests on the target; at a level other than the best if one is named.
    pub(crate) fn run(
        &self,
        sh: &Shell,
        target: &Target,
        tests: Tests,
        level: Option<&str>,
    ) -> Done {
        let mut commands: Vec<Command> = match (target.run, tests) {
            (Run::Miri, _) => vec![miri_test(sh, target)],
            _ => {
                let command = |test| {
                    let mut command = self.command(sh, target, test);
                    command.args(test.filters(tests));
                    command
                };
                self.chosen(tests).map(command).collect()
            }
        };
        if tests == Tests::Everything {
            let docs = cmd!(sh, "cargo test --quiet --locked --workspace --doc");
            commands.push(docs.envs(self.settings.iter().cloned()).into());
        }
        for command in &mut commands {
            // Each would change what the tests check.
            command.env_remove("RT_BLESS").env_remove("SIMD4_LEVEL");
            if let Some(level) = level {
                command.env("SIMD4_LEVEL", level);
            }
            if let Some(cases) = target.cases(tests) {
                command.env("PROPTEST_CASES", cases);
            }
        }
        let (mut sum, mut skipped, mut wrong) = (Tally::default(), Vec::new(), Vec::new());
        let mut add = |(tally, skips, failure): Tested| {
            sum += tally;
            skipped.extend(skips);
            wrong.extend(failure);
        };
        if matches!(tests, Tests::Brief | Tests::Dispatch) {
            // What is longest in one program leaves room for others.
            thread::scope(|scope| {
                let run = |command| scope.spawn(move || test(command));
                let running: Vec<_> = commands.iter_mut().map(run).collect();
                running.into_iter().for_each(|run| add(run.join().expect("it does not panic")));
            });
        } else {
            commands.iter_mut().map(test).for_each(add);
        }
        match tests {
            Tests::Brief => {
                skipped.extend(LONG.map(|name| format!("{name}: too long to repeat here")));
            }
            Tests::Dispatch => {
                skipped.push("most tests of kernels: run on another CPU or level".into())
            }
            _ => {}
        }
        if sum.passed == 0 && wrong.is_empty() {
            wrong.push("no test was run".to_owned());
        }
        let passed = wrong.is_empty();
        let done = if passed { Done::passed(sum) } else { Done::failed(sum, wrong.join("; ")) };
        Done { skips: skipped, ..done }
    }

    /// The test programs that are asked for.
    fn chosen(&self, tests: Tests) -> impl Iterator<Item = &TestProgram> {
        let folders: &[&str] = match tests {
            Tests::Everything | Tests::Workspace => &[""],
            Tests::Brief | Tests::Dispatch => &["simd4", "tests"],
            Tests::Conformance => &["simd4"],
        };
        let asked_for =
            |test: &&TestProgram| folders.iter().any(|name| test.folder.ends_with(name));
        self.tests.iter().filter(asked_for)
    }

    /// What runs one of them on the target.
    fn command(&self, sh: &Shell, target: &Target, test: &TestProgram) -> Command {
        let words = words(sh, target, &test.file);
        let (program, args) = words.split_first().expect("the program itself");
        let mut command = Command::new(program);
        // A test that skips something says so, and is not heard unless it fails or this is asked.
        command.args(args).arg("--show-output").current_dir(&test.folder);
        if let Run::Node = target.run {
            // There a panic is the end, and what it said would be lost.
            command.arg("--nocapture");
        }
        // Where cargo would say so, and where the tests of a program learn how to start it.
        command.env("CARGO_MANIFEST_DIR", &test.folder);
        command.env("RT_RUNNER", runner(sh, target).join(" "));
        command
    }
}

/// proptest asks for the current folder.
const MIRIFLAGS: &str = "-Zmiri-disable-isolation";

/// Miri on the tests of conformance: it builds what it runs.
fn miri_test(sh: &Shell, target: &Target) -> Command {
    let args = ["--locked", "-p", "simd4", "--test", "conformance", "--", "--show-output"];
    cargo(sh, target, "test").args(args).env("MIRIFLAGS", MIRIFLAGS).into()
}

/// A program and what makes it run.
fn words(sh: &Shell, target: &Target, program: &Path) -> Vec<OsString> {
    let runner = runner(sh, target).into_iter().map(OsString::from);
    runner.chain([program.into()]).collect()
}

/// What came of a program of tests: the count, why any were skipped, and what went wrong.
type Tested = (Tally, Vec<String>, Option<String>);

/// Runs tests. Their output is shown only if one fails.
fn test(command: &mut Command) -> Tested {
    let mut shown = format!("{command:?}");
    for variable in ["SIMD4_LEVEL", "PROPTEST_CASES"] {
        let set = command.get_envs().find(|(name, _)| *name == variable);
        if let Some((_, Some(value))) = set
            && !shown.contains(variable)
        {
            shown = format!("{variable}={value:?} {shown}");
        }
    }
    match command.stdin(Stdio::null()).output() {
        Err(error) => (Tally::default(), vec![], Some(format!("{error}: {shown}"))),
        Ok(output) => {
            let stdout = String::from_utf8_lossy(&output.stdout);
            let stderr = String::from_utf8_lossy(&output.stderr);
            let mut tally = Tally::of(&stdout);
            let skipped = skips(&stdout).chain(skips(&stderr)).collect();
            if output.status.success() {
                return (tally, skipped, None);
            }
            let passed = |line: &&str| line.starts_with("test ") && line.ends_with(" ... ok");
            for line in stdout.lines().filter(|line| !passed(line)).chain(stderr.lines()) {
                println!("{line}");
            }
            // A program that crashed counts nothing; "0 failed" would be a lie.
            tally.failed = tally.failed.max(1);
            (tally, skipped, Some(format!("{}: {shown}", output.status)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_are_picked_out_of_the_messages() {
        let messages = r#"
{"reason":"compiler-artifact","manifest_path":"/w/simd4/Cargo.toml","target":{"name":"simd4"},"profile":{"test":false},"executable":null}
{"reason":"compiler-artifact","manifest_path":"/w/simd4/Cargo.toml","target":{"name":"conformance"},"profile":{"test":true},"executable":"/w/target/c"}
{"reason":"compiler-artifact","manifest_path":"/w/rt-cli/Cargo.toml","target":{"name":"cli"},"profile":{"test":true},"executable":"/w/target/cli"}
{"reason":"compiler-artifact","manifest_path":"/w/rt-cli/Cargo.toml","target":{"name":"rt"},"profile":{"test":false},"executable":"/w/target/rt"}
{"reason":"compiler-artifact","manifest_path":"/w/simd4/Cargo.toml","target":{"name":"levels"},"profile":{"test":false},"executable":"/w/target/levels"}
{"reason":"build-finished","success":true}
not JSON"#;
        let programs = Programs::of(messages);
        let test =
            |folder: &str, file: &str| TestProgram { folder: folder.into(), file: file.into() };
        assert_eq!(programs.levels, Some("/w/target/levels".into()));
        assert_eq!(programs.rt(), Some("/w/target/rt".as_ref()));
        assert_eq!(
            programs.tests,
            [test("/w/simd4", "/w/target/c"), test("/w/rt-cli", "/w/target/cli")]
        );
        let core: Vec<_> = programs.chosen(Tests::Brief).collect();
        assert_eq!(core, [&programs.tests[0]]);
        assert_eq!(programs.chosen(Tests::Workspace).count(), 2);
    }
}
