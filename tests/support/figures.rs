//! What is said of many errors.

/// The errors of one kind, gathered.
#[derive(Clone, Debug, Default)]
pub struct Errors(Vec<f64>);

impl Errors {
    /// Adds one; its sign does not matter.
    pub fn add(&mut self, error: f64) {
        self.0.push(error.abs());
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Checks that no more than one in a hundred is greater than `p99`, and none than `max`.
    ///
    /// # Panics
    /// If not so, with the figures; if there are none; if one is NaN.
    pub fn within(mut self, what: &str, p99: f64, max: f64) {
        assert!(
            !self.0.is_empty() && !self.0.iter().any(|error| error.is_nan()),
            "{what}: {self:?}"
        );
        self.0.sort_by(f64::total_cmp);
        let at = |share: f64| self.0[((self.0.len() - 1) as f64 * share) as usize];
        let got = [at(0.5), at(0.99), at(1.0)];
        assert!(got[1] <= p99 && got[2] <= max, "{what}: p50, p99 and maximum are {got:?}");
    }
}
