//! What came of the steps, and the closing table.

use std::fmt;
use std::ops::AddAssign;
use std::time::Duration;

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
    /// Sums cargo's lines `test result: ok. 23 passed; 0 failed; 1 ignored; …`, of which there is
    /// one for each test binary and for the doc tests of each crate.
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
    /// It could not be tried.
    Skipped,
}

/// A row of the closing table.
#[derive(Debug)]
pub(crate) struct Row {
    /// The step's name.
    pub(crate) step: String,
    /// How it ended.
    pub(crate) outcome: Outcome,
    /// How long it took.
    pub(crate) time: Duration,
    /// The tests it ran, if it was to run any.
    pub(crate) tally: Option<Tally>,
    /// Why it failed or was skipped.
    pub(crate) reason: String,
}

/// All that happened.
#[derive(Debug, Default)]
pub(crate) struct Report {
    /// One row a step, in their order.
    pub(crate) rows: Vec<Row>,
}

impl Report {
    /// Whether all is well. Where `strict`, a skip is as bad as a failure.
    pub(crate) fn ok(&self, strict: bool) -> bool {
        self.rows.iter().all(|row| match row.outcome {
            Outcome::Passed => true,
            Outcome::Failed => false,
            Outcome::Skipped => !strict,
        })
    }
}

/// The table, and as the last line, for machines, the count of tests.
impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = self.rows.iter().map(|row| row.step.len()).max().unwrap_or(0);
        let mut sum = Tally::default();
        for Row { step, outcome, time, tally, reason } in &self.rows {
            let outcome = match outcome {
                Outcome::Passed => "passed",
                Outcome::Failed => "FAILED",
                Outcome::Skipped => "skipped",
            };
            let tests = tally.map_or(String::new(), |tally| tally.to_string());
            let gap = if tests.is_empty() || reason.is_empty() { "" } else { "; " };
            let line = format!(
                "{step:width$}  {outcome:7} {:6.1} s  {tests}{gap}{reason}",
                time.as_secs_f64()
            );
            writeln!(f, "{}", line.trim_end())?;
            sum += tally.unwrap_or_default();
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
    fn a_skip_is_a_failure_only_where_strict_and_a_failure_always() {
        let report = |outcomes: &[Outcome]| Report {
            rows: outcomes
                .iter()
                .map(|&outcome| Row {
                    step: "a".to_owned(),
                    outcome,
                    time: Duration::ZERO,
                    tally: Some(Tally { passed: 2, failed: 0, skipped: 1 }),
                    reason: String::new(),
                })
                .collect(),
        };
        use Outcome::{Failed, Passed, Skipped};
        assert!(report(&[Passed, Passed]).ok(true));
        assert!(report(&[Passed, Skipped]).ok(false));
        assert!(!report(&[Passed, Skipped]).ok(true));
        assert!(!report(&[Failed, Passed]).ok(false));
        let text = report(&[Passed, Skipped]).to_string();
        assert_eq!(text.lines().last(), Some("4 passed, 0 failed, 2 skipped"));
    }
}
