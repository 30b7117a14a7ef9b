//! What is counted of a kernel's answers.

use crate::BATCH;
use rt_kernels::Hit;
use rt_kernels::reference::triangle::{Place, Verdict};
use rt_kernels::reference::ulps;

/// Counts of rays that a kernel got wrong, and how wrong.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// All rays.
    pub rays: u64,
    /// Rays that exactly meet one of the triangles at least and were said to meet none. (Not
    /// counted where the family is not of a closed surface.)
    pub leaks: u64,
    /// Rays that were said to meet more triangles than they do, and more than one; neighbours met in
    /// the same point of their edge count once.
    pub double_hits: u64,
    /// Rays that were said to meet a triangle that they pass by.
    pub false_hits: u64,
    /// Rays that were said to pass by a triangle that they meet.
    pub false_misses: u64,
    /// Rays that were said to meet something though numbers are NaN or infinite, or at a NaN.
    pub nan_hits: u64,
    /// Rays of which the oracle cannot tell: they count for nothing else.
    pub unsure: u64,
    /// How far, at most, from an edge a ray was misjudged: in units of 2^-24 of the greatest
    /// coordinate.
    pub band: f64,
    /// The same, of triangles alone, in units of 2^-24 of the distance from the ray's origin to the
    /// farthest corner.
    pub band_of_reach: f64,
    /// Errors of `t`, in units in the last place of the exact value.
    pub t_ulp: Quantiles,
}

impl Tally {
    /// Counts one ray: whether its family is of a closed surface, whether it and all triangles are
    /// finite, and for each triangle the truth and the answer.
    pub(crate) fn add(
        &mut self,
        closed: bool,
        finite: bool,
        tests: impl Iterator<Item = (Verdict, Option<Hit>)>,
    ) {
        let (mut hits, mut inside, mut boundary) = (0, 0, 0);
        let [mut false_hit, mut false_miss, mut nan_hit] = [false; 3];
        for (verdict, hit) in tests {
            inside += u32::from(verdict.place == Place::Inside);
            boundary += u32::from(verdict.place == Place::Boundary);
            if let Some(hit) = hit {
                hits += 1;
                nan_hit |= !finite || hit.t.is_nan();
                if verdict.hits() {
                    self.t_ulp.add(ulps(hit.t, verdict.t));
                }
            }
            if hit.is_some() != verdict.hits() {
                false_hit |= hit.is_some();
                false_miss |= hit.is_none();
                self.band = self.band.max(verdict.band);
                self.band_of_reach = self.band_of_reach.max(verdict.band_of_reach);
            }
        }
        self.rays += 1;
        self.leaks += u64::from(closed && hits == 0 && inside + boundary > 0);
        self.double_hits += u64::from(hits > 1 && hits > inside + boundary.min(1));
        self.false_hits += u64::from(false_hit);
        self.false_misses += u64::from(false_miss);
        self.nan_hits += u64::from(nan_hit);
    }

    /// What 99 % of the errors of `t` are no greater than; 0 if there are too few of them to tell.
    pub fn t_p99(&self) -> f64 {
        if self.t_ulp.count() < 1_000 { 0.0 } else { self.t_ulp.at(0.99) }
    }

    /// The same, as far as so few rays can tell it of all: what a share of the errors exceeds that is
    /// by four standard deviations more than 1 %, if the rays of a batch stand and fall together.
    pub(crate) fn t_p99_at_least(&self) -> f64 {
        let deviation = (0.01 * 0.99 * BATCH as f64 / self.t_ulp.count().max(1) as f64).sqrt();
        self.t_p99().min(self.t_ulp.at((0.99 - 4.0 * deviation).max(0.0)))
    }

    /// Adds the counts of other rays.
    pub(crate) fn merge(&mut self, other: &Tally) {
        self.rays += other.rays;
        self.leaks += other.leaks;
        self.double_hits += other.double_hits;
        self.false_hits += other.false_hits;
        self.false_misses += other.false_misses;
        self.nan_hits += other.nan_hits;
        self.unsure += other.unsure;
        self.band = self.band.max(other.band);
        self.band_of_reach = self.band_of_reach.max(other.band_of_reach);
        self.t_ulp.merge(&other.t_ulp);
    }
}

/// Errors by size, to 3 %: which share of them is no greater than what.
#[derive(Clone, Debug, Default)]
pub struct Quantiles {
    /// How many there are in each bin: 32 to a doubling, from 2^-10 on.
    bins: Vec<u64>,
    max: f64,
}

/// Where the first bin ends.
const LEAST: f32 = 1.0 / 1024.0;

/// The bits of an `f32` that do not count for its bin.
const BIN: u32 = 23 - 5;

impl Quantiles {
    pub(crate) fn add(&mut self, error: f64) {
        let bits = (error as f32).clamp(LEAST, f32::MAX).to_bits() - LEAST.to_bits();
        let bin = (bits >> BIN) as usize;
        if bin >= self.bins.len() {
            self.bins.resize(bin + 1, 0);
        }
        self.bins[bin] += 1;
        self.max = self.max.max(error);
    }

    fn merge(&mut self, other: &Quantiles) {
        if self.bins.len() < other.bins.len() {
            self.bins.resize(other.bins.len(), 0);
        }
        for (bin, more) in self.bins.iter_mut().zip(&other.bins) {
            *bin += more;
        }
        self.max = self.max.max(other.max);
    }

    /// What that share of the errors is no greater than, rounded up by at most 3 %; 0 if there are
    /// none.
    pub fn at(&self, share: f64) -> f64 {
        let mut rest = (self.count() as f64 * share).ceil() as u64;
        for (bin, count) in (1..).zip(&self.bins) {
            if rest <= *count && rest > 0 {
                let end = f32::from_bits(LEAST.to_bits() + (bin << BIN));
                return f64::from(end).min(self.max);
            }
            rest -= rest.min(*count);
        }
        self.max
    }

    /// How many there are.
    pub fn count(&self) -> u64 {
        self.bins.iter().sum()
    }

    /// The greatest.
    pub fn max(&self) -> f64 {
        self.max
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_what_they_say() {
        let [mut low, mut high] = [Quantiles::default(), Quantiles::default()];
        for i in 1..=1000 {
            if i % 3 == 0 { &mut low } else { &mut high }.add(f64::from(i) / 10.0);
        }
        low.merge(&high);
        for (share, want) in [(0.5, 50.0), (0.99, 99.0), (1.0, 100.0)] {
            let got = low.at(share);
            assert!((want..=want * 1.04).contains(&got), "{share}: {got}, not {want}");
        }
        assert_eq!(low.max(), 100.0);
        assert_eq!(Quantiles::default().at(0.99), 0.0);
    }

    #[test]
    fn every_count_counts_its_own() {
        let verdict = |place| Verdict { place, t: 2.0, band: 3.0, band_of_reach: 1.0 };
        let at = |t| Some(Hit { t, prim: 0, u: 0.0, v: 0.0 });
        let hit = at(2.0);
        let count = |tests: &[(Place, Option<Hit>)]| {
            let mut tally = Tally::default();
            tally.add(true, true, tests.iter().map(|&(place, hit)| (verdict(place), hit)));
            let Tally { leaks, double_hits, false_hits, false_misses, nan_hits, .. } = tally;
            ([leaks, double_hits, false_hits, false_misses, nan_hits], tally.band)
        };
        use Place::{Boundary, Inside, Outside};
        assert_eq!(count(&[(Inside, hit), (Outside, None)]), ([0; 5], 0.0));
        assert_eq!(count(&[(Inside, None), (Outside, None)]), ([1, 0, 0, 1, 0], 3.0));
        assert_eq!(count(&[(Inside, None), (Outside, hit)]), ([0, 0, 1, 1, 0], 3.0));
        assert_eq!(count(&[(Inside, hit), (Outside, hit)]), ([0, 1, 1, 0, 0], 3.0));
        assert_eq!(count(&[(Boundary, hit), (Boundary, hit)]), ([0, 1, 0, 0, 0], 0.0));
        assert_eq!(count(&[(Boundary, hit), (Boundary, None)]), ([0, 0, 0, 1, 0], 3.0));
        assert_eq!(count(&[(Outside, None), (Outside, None)]), ([0; 5], 0.0));
        assert_eq!(count(&[(Outside, at(f32::NAN))]), ([0, 0, 1, 0, 1], 3.0));
    }
}
