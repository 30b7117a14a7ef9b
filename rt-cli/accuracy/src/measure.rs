//! Kernels on families, judged.

use rayon::prelude::*;

use crate::{BATCH, Family, Setting, Subject, Tally};

/// What one subject did in one family.
pub struct Row<F: Family> {
    /// The kernel and the way it was run.
    pub subject: Subject<F::Kernel>,
    /// The family.
    pub family: &'static F,
    /// What the family was set to.
    pub setting: Setting,
    /// The counts. None are of a kernel that is not made for the family's primitives.
    pub tally: Tally,
}

impl<F: Family> Row<F> {
    /// That many of its rays as a share of a million.
    pub fn per_million(&self, count: u64) -> f64 {
        count as f64 * 1e6 / self.tally.rays.max(1) as f64
    }
}

impl<F: Family> Clone for Row<F> {
    fn clone(&self) -> Self {
        Row { tally: self.tally.clone(), ..*self }
    }
}

impl<F: Family> std::fmt::Debug for Row<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Row { subject, setting, tally, .. } = self;
        write!(f, "{subject:?}, {}, {setting:?}: {tally:?}", self.family.facts().name)
    }
}

/// Shows some rays of a family to every subject, on all threads of the current pool. The counts do
/// not depend on their number.
pub fn measure<F: Family>(
    subjects: &[Subject<F::Kernel>],
    family: &'static F,
    setting: Setting,
    rays: usize,
) -> Vec<Row<F>> {
    let batches = rays.div_ceil(BATCH);
    let none = || vec![Tally::default(); subjects.len()];
    let tallies = (0..batches)
        .into_par_iter()
        .with_min_len(batches.div_ceil(4 * rayon::current_num_threads()))
        .fold(none, |mut tallies, i| {
            family.count(&setting, i, subjects, &mut tallies);
            tallies
        })
        .reduce(none, |mut tallies, others| {
            tallies.iter_mut().zip(&others).for_each(|(tally, other)| tally.merge(other));
            tallies
        });
    let row = |(&subject, tally)| Row { subject, family, setting, tally };
    subjects.iter().zip(tallies).map(row).collect()
}

/// The bits of all that a subject answers to some rays of a family.
pub fn answers<F: Family>(
    subject: &Subject<F::Kernel>,
    family: &F,
    setting: &Setting,
    rays: usize,
) -> Vec<[u32; 4]> {
    (0..rays.div_ceil(BATCH)).flat_map(|i| family.answers(setting, i, subject)).collect()
}
