//! Timing of those who take turns, on a machine that others use too.
//!
//! What counts is the time that a thread has a processor, so what others take does not. That they
//! slow down caches and the clock too is what rounds are for.

/// What each contestant took: seconds, round by round.
pub(crate) struct Times(Vec<Vec<f64>>);

impl Times {
    /// Lets all run once a round, one after the other, starting with another one each time. `run`
    /// runs the contestant of that number and says how long it took.
    pub(crate) fn race(
        contestants: usize,
        rounds: usize,
        mut run: impl FnMut(usize) -> f64,
    ) -> Times {
        let mut times = vec![Vec::with_capacity(rounds); contestants];
        for round in 0..rounds {
            for turn in 0..contestants {
                let who = (round + turn) % contestants;
                times[who].push(run(who));
            }
        }
        Times(times)
    }

    /// A contestant's median time.
    pub(crate) fn median(&self, who: usize) -> f64 {
        median(self.0[who].clone())
    }

    /// How many times as fast one is as another: the median over the rounds.
    pub(crate) fn ratio(&self, who: usize, other: usize) -> f64 {
        median(self.0[other].iter().zip(&self.0[who]).map(|(other, own)| other / own).collect())
    }
}

/// The middle one; of two the mean.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    if values.len() % 2 == 1 { values[half] } else { (values[half - 1] + values[half]) / 2.0 }
}

/// The mean of the logarithms, as a number again; none of none.
pub(crate) fn geometric_mean(values: &[f64]) -> Option<f64> {
    let sum: f64 = values.iter().map(|value| value.ln()).sum();
    (!values.is_empty()).then(|| (sum / values.len() as f64).exp())
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
        let mean = |values: &[f64]| geometric_mean(values).expect("of some");
        assert!((mean(&[2.0, 0.5]) - 1.0).abs() < 1e-12);
        assert!((mean(&[1.0, 8.0, 1.0]) - 2.0).abs() < 1e-12);
        assert_eq!(geometric_mean(&[]), None);
    }

    #[test]
    fn all_run_once_a_round_and_each_begins_one() {
        let mut order = Vec::new();
        let times = Times::race(3, 3, |who| {
            order.push(who);
            order.len() as f64
        });
        assert_eq!(order, [0, 1, 2, 1, 2, 0, 2, 0, 1]);
        assert_eq!(times.0[0], [1.0, 6.0, 8.0]);
    }

    #[test]
    fn a_ratio_is_of_rounds_and_not_of_medians() {
        // The machine is slow in the second round, and the other one in the last.
        let times = Times(vec![vec![1.0, 3.0, 1.0], vec![2.0, 6.0, 9.0]]);
        assert_eq!(times.ratio(0, 1), 2.0);
        assert_eq!(times.ratio(1, 0), 0.5);
        assert_eq!(times.median(1), 6.0);
    }
}
