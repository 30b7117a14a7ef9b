//! Slab tests on families, judged.

use rt_kernels::reference::aabb::{Verdict, judge};
use rt_kernels::reference::ulps;
use rt_kernels::slab::{BoxSet, BoxTest, Crossings, catalogue};
use rt_kernels::tri::Way;

use super::families::{Batch, Family};
use crate::fold::fold;
use crate::{BATCH, Setting, Tally};

/// A kernel and a way to run it.
#[derive(Clone, Copy)]
pub struct Subject {
    /// The kernel.
    pub test: &'static dyn BoxTest,
    /// A way in which it [runs](BoxTest::runs).
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

/// What one subject did in one family. In the tally, `t` is where a ray enters the box, and the band
/// is that of false misses: false hits are what a test is for.
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

/// One batch: judged once, then shown to every subject.
fn count(subjects: &[Subject], Batch { aabb, rays }: &Batch, tallies: &mut [Tally]) {
    let judged: Vec<_> = (0..rays.len())
        .map(|i| rays.get(i))
        .map(|ray| (judge(&ray, aabb), f64::from(ray.tmin)))
        .collect();
    let boxes = BoxSet::new(std::slice::from_ref(aabb));
    let mut crossings = Crossings::new();
    for (subject, tally) in subjects.iter().zip(tallies) {
        subject.test.cross(subject.way, &boxes, rays, &mut crossings);
        for (i, (verdict, tmin)) in judged.iter().enumerate() {
            add(tally, verdict, *tmin, crossings.get(i));
        }
    }
}

fn add(tally: &mut Tally, verdict: &Verdict, tmin: f64, (count, enter): (u32, f32)) {
    let hit = count > 0;
    tally.rays += 1;
    tally.false_hits += u64::from(hit && !verdict.hits);
    tally.nan_hits += u64::from(hit && enter.is_nan());
    if !hit && verdict.hits {
        tally.false_misses += 1;
        tally.band = tally.band.max(verdict.band);
    }
    if hit && verdict.hits && verdict.enter > tmin {
        tally.t_ulp.add(ulps(enter, verdict.enter));
    }
}

/// The bits of all that a subject answers to some rays of a family: whether it hits, and where it
/// enters. All NaNs are one.
pub fn answers(
    subject: &Subject,
    family: &Family,
    setting: &Setting,
    rays: usize,
) -> Vec<[u32; 2]> {
    let mut answers = Vec::new();
    let mut crossings = Crossings::new();
    for i in 0..rays.div_ceil(BATCH) {
        let Batch { aabb, rays } = family.batch(setting, i);
        subject.test.cross(subject.way, &BoxSet::new(&[aabb]), &rays, &mut crossings);
        answers.extend((0..rays.len()).map(|i| {
            let (count, enter) = crossings.get(i);
            let enter = if enter.is_nan() { f32::NAN } else { enter };
            [count, if count > 0 { enter.to_bits() } else { 0 }]
        }));
    }
    answers
}
