//! Kernels on families, judged.

use rayon::prelude::*;
use rt_kernels::Hits;
use rt_kernels::reference::triangle::{Verdict, judge};
use rt_kernels::tri::{TriangleTest, Way, catalogue};

use super::families::{Batch, Family, Kind};
use crate::fold::fold;
use crate::{BATCH, Setting, Tally};

/// A kernel and a way to run it.
#[derive(Clone, Copy)]
pub struct Subject {
    /// The kernel.
    pub test: &'static dyn TriangleTest,
    /// A way in which it [runs](TriangleTest::runs).
    pub way: Way,
}

impl std::fmt::Debug for Subject {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (name, variant) = (self.test.name(), self.test.variant());
        write!(f, "{name} ({variant}), {:?} at {}", self.way.shape, self.way.level)
    }
}

/// Every kernel of the catalogue, every way it runs without emulation.
pub fn subjects() -> Vec<Subject> {
    let runs = |subject: &Subject| {
        subject.test.runs(subject.way) && !subject.test.is_emulated(subject.way)
    };
    let ways = Way::all();
    let each = |test| ways.iter().map(move |&way| Subject { test, way }).filter(runs);
    catalogue().into_iter().flat_map(each).collect()
}

/// What one subject did in one family. The keys of `rt accuracy --json` are its subject's and
/// family's names and settings, the fields of the tally, and the time of [`time`](super::time).
#[derive(Clone, Debug)]
pub struct Row {
    /// The kernel and the way it was run.
    pub subject: Subject,
    /// The family.
    pub family: &'static Family,
    /// What the family was set to.
    pub setting: Setting,
    /// The counts.
    pub tally: Tally,
}

/// Shows some rays of a family to every subject, on all threads of the current pool. The counts do
/// not depend on their number.
pub fn measure(
    subjects: &[Subject],
    family: &'static Family,
    setting: Setting,
    rays: usize,
) -> Vec<Row> {
    let batches = rays.div_ceil(BATCH);
    let none = || vec![Tally::default(); subjects.len()];
    let tallies = (0..batches)
        .into_par_iter()
        .with_min_len(batches.div_ceil(4 * rayon::current_num_threads()))
        .fold(none, |mut tallies, i| {
            count(subjects, family, &family.batch(&setting, i), &mut tallies);
            tallies
        })
        .reduce(none, |mut tallies, others| {
            tallies.iter_mut().zip(&others).for_each(|(tally, other)| tally.merge(other));
            tallies
        });
    let row = |(&subject, tally)| Row { subject, family, setting, tally };
    subjects.iter().zip(tallies).map(row).collect()
}

/// One batch: judged once, then shown to every subject, triangle by triangle, so that each answer
/// can be told.
fn count(subjects: &[Subject], family: &Family, batch: &Batch, tallies: &mut [Tally]) {
    let Batch { triangles, rays } = batch;
    let verdicts: Vec<Vec<Verdict>> = triangles
        .iter()
        .map(|triangle| (0..rays.len()).map(|i| judge(&rays.get(i), triangle.corners)).collect())
        .collect();
    let finite: Vec<bool> = (0..rays.len()).map(|i| is_finite(batch, i)).collect();
    let closed = matches!(family.kind, Kind::Closed | Kind::Natural);
    let mut hits = vec![Hits::new(); triangles.len()];
    for (subject, tally) in subjects.iter().zip(tallies) {
        closest_of_each(subject, batch, &mut hits);
        for (i, &finite) in finite.iter().enumerate() {
            let tests =
                verdicts.iter().zip(&hits).map(|(verdicts, hits)| (verdicts[i], hits.get(i)));
            tally.add(closed, finite, tests);
        }
    }
}

/// What each ray meets of each triangle alone.
fn closest_of_each(subject: &Subject, Batch { triangles, rays }: &Batch, hits: &mut [Hits]) {
    for (triangle, hits) in triangles.iter().zip(hits) {
        let records = subject.test.triangles(std::slice::from_ref(triangle));
        subject.test.closest(subject.way, &records, rays, hits);
    }
}

fn is_finite(Batch { triangles, rays }: &Batch, i: usize) -> bool {
    let ray = rays.get(i);
    let corners = triangles.iter().flat_map(|triangle| triangle.corners);
    [ray.origin, ray.dir].into_iter().chain(corners).all(|point| point.is_finite())
}

/// The bits of all that a subject answers to some rays of a family: for each test the distance and
/// the weights.
pub fn answers(
    subject: &Subject,
    family: &Family,
    setting: &Setting,
    rays: usize,
) -> Vec<[u32; 4]> {
    let mut answers = Vec::new();
    for i in 0..rays.div_ceil(BATCH) {
        let batch = family.batch(setting, i);
        let mut hits = vec![Hits::new(); batch.triangles.len()];
        closest_of_each(subject, &batch, &mut hits);
        for (hits, i) in hits.iter().flat_map(|hits| (0..hits.len()).map(move |i| (hits, i))) {
            answers.push(
                hits.get(i)
                    .map_or([0; 4], |hit| [1, hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits()]),
            );
        }
    }
    answers
}
