//! Tests of curved surfaces on families, judged.

use rt_kernels::Hits;
use rt_kernels::quadric::{QuadricTest, catalogue};
use rt_kernels::reference::quadric::{Meeting, Verdict, judge};
use rt_kernels::reference::ulps;
use rt_kernels::tri::Way;

use super::families::{Batch, Family};
use crate::fold::fold;
use crate::{BATCH, Setting, Tally};

/// A kernel and a way to run it.
#[derive(Clone, Copy)]
pub struct Subject {
    /// The kernel.
    pub test: &'static dyn QuadricTest,
    /// A way in which it [runs](QuadricTest::runs).
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

/// What one subject did in one family; no rays were counted of one that is not made for the
/// family's surfaces.
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
    let tallies = fold(subjects.len(), rays.div_ceil(BATCH), |i, tallies| {
        count(subjects, &family.batch(&setting, i), tallies);
    });
    let row = |(&subject, tally)| Row { subject, family, setting, tally };
    subjects.iter().zip(tallies).map(row).collect()
}

/// One batch: judged once, then shown to every subject that is made for its surface.
fn count(subjects: &[Subject], Batch { surface, rays }: &Batch, tallies: &mut [Tally]) {
    let judged: Vec<_> = (0..rays.len()).map(|i| judge(&rays.get(i), surface)).collect();
    let mut hits = Hits::new();
    for (subject, tally) in subjects.iter().zip(tallies) {
        let Some(surfaces) = subject.test.surfaces(std::slice::from_ref(surface)) else { continue };
        subject.test.closest(subject.way, &surfaces, rays, &mut hits);
        for (i, verdict) in judged.iter().enumerate() {
            add(tally, verdict, hits.get(i).map(|hit| hit.t));
        }
    }
}

fn add(tally: &mut Tally, verdict: &Verdict, hit: Option<f32>) {
    tally.rays += 1;
    tally.nan_hits += u64::from(hit.is_some_and(f32::is_nan));
    match (verdict.meeting, hit) {
        (Meeting::Unsure, _) => tally.unsure += 1,
        (Meeting::At(t), Some(hit)) => tally.t_ulp.add(ulps(hit, t)),
        (Meeting::Nowhere, None) => {}
        (truth, _) => {
            tally.false_misses += u64::from(truth != Meeting::Nowhere);
            tally.false_hits += u64::from(truth == Meeting::Nowhere);
            tally.band = tally.band.max(verdict.band);
        }
    }
}

/// The bits of all that a subject answers to some rays of a family; none if it is not made for its
/// surfaces.
pub fn answers(
    subject: &Subject,
    family: &Family,
    setting: &Setting,
    rays: usize,
) -> Vec<Option<u32>> {
    let mut answers = Vec::new();
    let mut hits = Hits::new();
    for i in 0..rays.div_ceil(BATCH) {
        let Batch { surface, rays } = family.batch(setting, i);
        let Some(surfaces) = subject.test.surfaces(&[surface]) else { continue };
        subject.test.closest(subject.way, &surfaces, &rays, &mut hits);
        answers.extend((0..rays.len()).map(|i| hits.get(i).map(|hit| hit.t.to_bits())));
    }
    answers
}
