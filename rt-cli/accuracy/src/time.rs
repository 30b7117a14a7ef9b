//! What a test costs.

use std::time::Instant;

/// How often the loop is run for one measurement: long enough for the clock.
const REPEATS: u32 = 16;

/// Nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// The least of all rounds.
    pub least: f64,
    /// The median: half of the rounds took less.
    pub median: f64,
    /// The greatest.
    pub greatest: f64,
}

/// Times runs of so many tests by each of some subjects, in turn.
pub(crate) fn race(
    subjects: usize,
    rounds: usize,
    tests: usize,
    mut run: impl FnMut(usize),
) -> Vec<Time> {
    let mut times = vec![Vec::with_capacity(rounds); subjects];
    for round in 0..=rounds {
        for (subject, times) in times.iter_mut().enumerate() {
            let start = Instant::now();
            for _ in 0..REPEATS {
                run(subject);
            }
            let ns = start.elapsed().as_secs_f64() * 1e9;
            // The first round warms up.
            if round > 0 {
                times.push(ns / f64::from(REPEATS) / tests as f64);
            }
        }
    }
    times.into_iter().map(summary).collect()
}

fn summary(mut times: Vec<f64>) -> Time {
    times.sort_by(f64::total_cmp);
    let at = |i: usize| times.get(i).copied().unwrap_or(f64::NAN);
    Time { least: at(0), median: at(times.len() / 2), greatest: at(times.len().saturating_sub(1)) }
}
