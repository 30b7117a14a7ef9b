//! Timing of ways that take turns, on a machine that others use too.
//!
//! What counts is the time that the thread has a processor, so what others take does not; that they
//! also slow down caches and clock is what rounds are for.

use std::time::Duration;

use rustix::time::{ClockId, clock_gettime};

use crate::peer::Way;

/// What each way took: seconds, round by round.
pub(crate) struct Times(Vec<Vec<f64>>);

impl Times {
    /// Lets all ways run once a round, one after the other, starting with another one each time.
    pub(crate) fn race(ways: &mut [Box<dyn Way + '_>], rounds: usize) -> Times {
        let mut times = vec![Vec::with_capacity(rounds); ways.len()];
        for round in 0..rounds {
            for turn in 0..ways.len() {
                let who = (round + turn) % ways.len();
                ways[who].reset();
                let start = thread_time();
                ways[who].run();
                times[who].push((thread_time() - start).as_secs_f64());
            }
        }
        Times(times)
    }

    /// A way's median time.
    pub(crate) fn median(&self, way: usize) -> f64 {
        median(self.0[way].clone())
    }

    /// How many times as fast one way is as another: the median over the rounds.
    pub(crate) fn ratio(&self, way: usize, other: usize) -> f64 {
        median(self.0[other].iter().zip(&self.0[way]).map(|(other, own)| other / own).collect())
    }
}

/// How long this thread has had a processor.
fn thread_time() -> Duration {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

/// The middle one; of two the mean.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    if values.len() % 2 == 1 { values[half] } else { (values[half - 1] + values[half]) / 2.0 }
}

/// The mean of the logarithms, as a number again.
pub(crate) fn geometric_mean(values: &[f64]) -> f64 {
    (values.iter().map(|value| value.ln()).sum::<f64>() / values.len() as f64).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle() {
        assert_eq!(median(vec![9.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![9.0, 1.0, 2.0, 4.0]), 3.0);
    }

    #[test]
    fn twice_as_fast_and_half_as_fast_is_even() {
        assert!((geometric_mean(&[2.0, 0.5]) - 1.0).abs() < 1e-12);
        assert!((geometric_mean(&[1.0, 8.0, 1.0]) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_ratio_is_of_rounds_and_not_of_medians() {
        // The machine is three times as slow in the second round.
        let times = Times(vec![vec![1.0, 3.0, 1.0], vec![2.0, 6.0, 2.0]]);
        assert_eq!(times.ratio(0, 1), 2.0);
        assert_eq!(times.ratio(1, 0), 0.5);
        assert_eq!(times.median(1), 2.0);
    }
}
