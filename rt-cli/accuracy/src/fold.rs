//! Batches on all threads.

use rayon::prelude::*;

use super::tally::Tally;

/// Has `count` add batch after batch to the tallies of all subjects, on all threads of the current
/// pool. The counts do not depend on their number.
pub(super) fn fold(
    subjects: usize,
    batches: usize,
    count: impl Fn(usize, &mut [Tally]) + Sync,
) -> Vec<Tally> {
    let none = || vec![Tally::default(); subjects];
    (0..batches)
        .into_par_iter()
        .with_min_len(batches.div_ceil(4 * rayon::current_num_threads()))
        .fold(none, |mut tallies, i| {
            count(i, &mut tallies);
            tallies
        })
        .reduce(none, |mut tallies, others| {
            tallies.iter_mut().zip(&others).for_each(|(tally, other)| tally.merge(other));
            tallies
        })
}
