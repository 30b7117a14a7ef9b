//! What came of the steps, and the closing table.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::AddAssign;
use std::time::{Duration, Instant};

/// A count of tests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    /// Tests that passed.
    pub(crate) passed: u64,
    /// Tests that failed.
    pub(crate) failed: u64,
    /// Tests that were ignored.
    pub(crate) skipped: u64,
}

impl Tally {
    /// Sums the lines `test result: ok. 23 passed; 0 failed; 1 ignored; …`, of which there is one
    /// for each test program and for the documentation of each crate.
    pub(crate) fn of(stdout: &str) -> Tally {
        let mut sum = Tally::default();
        for line in stdout.lines().filter_map(|line| line.strip_prefix("test result: ")) {
            for part in line.split(['.', ';']) {
                match part.trim().split_once(' ').map(|(n, what)| (n.parse().unwrap_or(0), what)) {
                    Some((n, "passed")) => sum.passed += n,
                    Some((n, "failed")) => sum.failed += n,
                    Some((n, "ignored")) => sum.skipped += n,
                    _ => {}
                }
            }
        }
        sum
    }
}

/// Why tests were skipped: one reason for each that is marked so, and for each that says so itself.
pub(crate) fn skips(output: &str) -> impl Iterator<Item = String> {
    output.lines().filter_map(|line| {
        let marked = line.split_once(" ... ignored, ");
        let said = || line.split_once("skipped: ");
        let (before, why) = marked.or_else(said)?;
        // Without capture, what a test says comes after its name.
        let named = before.is_empty() || before.starts_with("test ");
        named.then(|| why.to_owned())
    })
}

impl AddAssign for Tally {
    fn add_assign(&mut self, other: Tally) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.skipped += other.skipped;
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} passed, {} failed, {} skipped", self.passed, self.failed, self.skipped)
    }
}

/// How a step ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// It did what it should.
    Passed,
    /// It did not.
    Failed,
    /// It could not be tried for lack of something that this machine could have.
    Skipped,
    /// It is nothing that must be tried on this machine.
    Left,
}

/// What came of a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Done {
    /// How it ended.
    pub(crate) outcome: Outcome,
    /// The tests that it ran, if it was to run any.
    pub(crate) tally: Option<Tally>,
    /// Why it ended as it did, if it did not pass.
    pub(crate) reason: String,
    /// Why tests were skipped, each of them.
    pub(crate) skips: Vec<String>,
}

impl Done {
    /// All those tests passed.
    pub(crate) fn passed(tally: Tally) -> Done {
        Done { outcome: Outcome::Passed, tally: Some(tally), reason: String::new(), skips: vec![] }
    }

    /// Not all did.
    pub(crate) fn failed(tally: Tally, reason: String) -> Done {
        Done { outcome: Outcome::Failed, tally: Some(tally), reason, skips: vec![] }
    }

    /// There is something missing.
    pub(crate) fn skipped(reason: String) -> Done {
        Done { outcome: Outcome::Skipped, tally: None, reason, skips: vec![] }
    }

    /// It need not be tried here.
    pub(crate) fn left(reason: String) -> Done {
        Done { outcome: Outcome::Left, tally: None, reason, skips: vec![] }
    }
}

/// Passed, or failed for that reason.
impl From<Result<(), String>> for Done {
    fn from(result: Result<(), String>) -> Done {
        let outcome = if result.is_ok() { Outcome::Passed } else { Outcome::Failed };
        Done { outcome, tally: None, reason: result.err().unwrap_or_default(), skips: vec![] }
    }
}

/// A row of the closing table.
#[derive(Debug)]
struct Row {
    step: String,
    level: String,
    done: Done,
    time: Duration,
}

/// All that happened.
#[derive(Debug, Default)]
pub(crate) struct Report {
    /// One row a step, in their order.
    rows: Vec<Row>,
}

impl Report {
    /// Does a step and writes down what came of it; true if it passed.
    pub(crate) fn step(&mut self, step: &str, level: &str, act: impl FnOnce() -> Done) -> bool {
        if !level.is_empty() {
            println!("      {level}");
        }
        let start = Instant::now();
        let done = act();
        let (time, passed) = (start.elapsed(), done.outcome == Outcome::Passed);
        if !passed {
            println!("      {}", done.reason);
        }
        self.rows.push(Row { step: step.to_owned(), level: level.to_owned(), done, time });
        passed
    }

    /// Whether all is well. Where `strict`, a skip is as bad as a failure.
    pub(crate) fn ok(&self, strict: bool) -> bool {
        self.rows.iter().all(|row| match row.done.outcome {
            Outcome::Passed | Outcome::Left => true,
            Outcome::Failed => false,
            Outcome::Skipped => !strict,
        })
    }
}

/// The table, and as the last line, for machines, the count of tests.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = |of: fn(&Row) -> &str| self.rows.iter().map(|row| of(row).len()).max();
        let (steps, levels) = (width(|row| &row.step), width(|row| &row.level));
        let (steps, levels) = (steps.unwrap_or(0).max(6), levels.unwrap_or(0).max(5));
        writeln!(
            f,
            "{:steps$}  {:levels$}  {:7}  {:>6}  {:>6}  {:>7}  {:>7}",
            "target", "level", "", "passed", "failed", "skipped", "seconds"
        )?;
        let mut sum = Tally::default();
        let mut skipped = BTreeMap::<&str, (u64, BTreeSet<&str>)>::new();
        for Row { step, level, done, time } in &self.rows {
            let Done { outcome, tally, reason, skips } = done;
            for why in skips {
                let (count, steps) = skipped.entry(why).or_default();
                *count += 1;
                steps.insert(step);
            }
            let outcome = match outcome {
                Outcome::Passed => "passed",
                Outcome::Failed => "FAILED",
                Outcome::Skipped => "skipped",
                Outcome::Left => "-",
            };
            let count = |of: fn(&Tally) -> u64| {
                tally.as_ref().map_or(String::new(), |tally| of(tally).to_string())
            };
            let counts = [count(|t| t.passed), count(|t| t.failed), count(|t| t.skipped)];
            let line = format!(
                "{step:steps$}  {level:levels$}  {outcome:7}  {:>6}  {:>6}  {:>7}  {:7.1}  {reason}",
                counts[0],
                counts[1],
                counts[2],
                time.as_secs_f64()
            );
            writeln!(f, "{}", line.trim_end())?;
            sum += tally.unwrap_or_default();
        }
        for (why, (count, steps)) in skipped {
            let steps = Vec::from_iter(steps).join(", ");
            writeln!(f, "skipped {count} times: {why} ({steps})")?;
        }
        write!(f, "{sum}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_result_line_counts_and_no_other() {
        let stdout = "\nrunning 3 tests\n..i\n\
            test result: ok. 2 passed; 0 failed; 1 ignored; 0 measured; 7 filtered out; finished in 0.01s\n\n\
            running 12 tests\ntest a ... FAILED\nassertion: 99 passed; 99 failed\n\
            test result: FAILED. 10 passed; 2 failed; 0 ignored; 3 measured; 0 filtered out; finished in 1.50s\n\
            expected `test result: ok. 50 passed; 1 failed`\n";
        assert_eq!(Tally::of(stdout), Tally { passed: 12, failed: 2, skipped: 1 });
        assert_eq!(Tally::of("error: could not compile"), Tally::default());
    }

    #[test]
    fn who_skips_a_test_says_why() {
        let captured = "test a::b ... ok\ntest a::c ... ignored, minutes\n\nsuccesses:\n\n\
            ---- a::b stdout ----\nskipped: no device: none\n1 line skipped: no\n";
        assert_eq!(Vec::from_iter(skips(captured)), ["minutes", "no device: none"]);
        assert_eq!(Vec::from_iter(skips("test a::b ... skipped: no device\n")), ["no device"]);
    }

    #[test]
    fn a_skip_is_a_failure_only_where_strict_and_a_failure_always() {
        let tally = Tally { passed: 2, failed: 0, skipped: 1 };
        let passed = || Done::passed(tally);
        let failed = || Done::failed(tally, "why".to_owned());
        let skipped = || Done::skipped("no tool".to_owned());
        let left = || Done::left("not here".to_owned());
        let report = |dones: [Done; 2]| {
            let mut report = Report::default();
            for done in dones {
                report.step("a", "", || done);
            }
            report
        };
        assert!(report([passed(), left()]).ok(true));
        assert!(report([passed(), skipped()]).ok(false));
        assert!(!report([passed(), skipped()]).ok(true));
        assert!(!report([failed(), passed()]).ok(false));
        assert!(!report([passed(), Err("why".to_owned()).into()]).ok(false));
    }

    #[test]
    fn the_table_says_all_and_its_last_line_is_the_sum() {
        let mut report = Report::default();
        assert!(report.step("format", "", || Ok(()).into()));
        let tally = Tally { passed: 40, failed: 2, skipped: 1 };
        let failed = Done::failed(tally, "exit 101".to_owned());
        let skips = vec!["no device".to_owned(); 2];
        assert!(!report.step("aarch64", "neon", || Done { skips, ..failed }));
        let table = report.to_string();
        let lines: Vec<_> = table.lines().collect();
        assert_eq!(lines.len(), 5);
        for word in ["aarch64", "neon", "FAILED", "40", "2", "1", "exit 101"] {
            assert!(lines[2].contains(word), "{word} is not in {:?}", lines[2]);
        }
        assert_eq!(lines[3], "skipped 2 times: no device (aarch64)");
        assert_eq!(lines[4], "40 passed, 2 failed, 1 skipped");
    }
}
