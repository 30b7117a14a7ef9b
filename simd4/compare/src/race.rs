//! Timing of contestants that take turns, on a machine that others use too.
//!
//! A round lets every contestant run for a few dozen microseconds, one after the other, starting
//! with another one each time. What disturbs the machine for longer than a round slows all of
//! them, and what is shorter spoils single rounds; so the ratio of two contestants is taken in
//! every round, and the median of these ratios is what counts.

use std::time::{Duration, Instant};

use crate::io::Io;

/// What runs.
pub(crate) type Run<'a> = Box<dyn Fn(&mut Io) + 'a>;

const ROUNDS: usize = 301;
const TURN: Duration = Duration::from_micros(30);

/// A contestant's time as a multiple of the first one's.
#[derive(Clone, Copy)]
pub(crate) struct Ratio {
    /// The median over the rounds.
    pub(crate) median: f64,
    /// Half the distance between the quartiles: how much a round's ratio varies.
    pub(crate) spread: f64,
    /// Of the shortest turns of both.
    pub(crate) of_minima: f64,
}

/// Lets them take turns. The first one's time of a call in nanoseconds, and each one's ratio.
pub(crate) fn race(io: &mut Io, contestants: &[Run]) -> (f64, Vec<Ratio>) {
    let calls: Vec<u32> = contestants.iter().map(|run| calls(io, run)).collect();
    let mut times = vec![Vec::with_capacity(ROUNDS); contestants.len()];
    for round in 0..ROUNDS {
        for turn in 0..contestants.len() {
            let who = (round + turn) % contestants.len();
            times[who].push(time(io, &contestants[who], calls[who]));
        }
    }
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let ratios = times.iter().map(|of| {
        let ratios = sorted(of.iter().zip(&times[0]).map(|(a, b)| a / b).collect());
        Ratio {
            median: ratios[ROUNDS / 2],
            spread: (ratios[ROUNDS * 3 / 4] - ratios[ROUNDS / 4]) / 2.0,
            of_minima: least(of) / least(&times[0]),
        }
    });
    let ratios = ratios.collect();
    (sorted(times.swap_remove(0))[ROUNDS / 2], ratios)
}

/// How many calls fill a turn.
fn calls(io: &mut Io, run: &Run) -> u32 {
    let mut calls = 1;
    while time(io, run, calls) * f64::from(calls) < TURN.as_nanos() as f64 {
        calls *= 2;
    }
    calls
}

/// Nanoseconds a call.
fn time(io: &mut Io, run: &Run, calls: u32) -> f64 {
    let start = Instant::now();
    for _ in 0..calls {
        run(std::hint::black_box(io));
    }
    start.elapsed().as_nanos() as f64 / f64::from(calls)
}

fn sorted(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    values
}
