//! Triangles.
//!
//! What a kernel must not do is leak: let a ray pass between two triangles that share an edge or a
//! vertex.
//!
//! The **band** in which a ray is misjudged is told in two units, roundoffs of the greatest coordinate
//! and of the ray's reach. The errors of a test that is relative to the ray grow with its reach. In a
//! mesh about the origin a ray may reach 2√3 times as far as any coordinate says, so that what the
//! first unit shows there, in needles above all, is the place and not the test; far from the origin it
//! shows nothing. The default promises 2 of the second everywhere, and of the first in the family
//! that is made for it, where rays reach as far as their coordinates.

mod ceilings;
mod families;
mod time;

use rt_kernels::Hits;
use rt_kernels::reference::triangle::{Verdict, judge};
use rt_kernels::tri::{TriangleTest, catalogue};

use crate::{Ceiling, Facts, Family, Kind, Row, Setting, Subject, Tally, Time};
pub use families::{Batch, TriangleFamily};

/// What is listed.
type Kernel = dyn TriangleTest;

impl Family for TriangleFamily {
    type Kernel = Kernel;
    const SORT: &'static str = "triangle";

    fn all() -> &'static [Self] {
        &Self::ALL
    }

    // Not inlined: here the kernels are compiled, once.
    #[inline(never)]
    fn kernels() -> Vec<&'static Kernel> {
        catalogue()
    }

    fn ceilings() -> &'static [Ceiling] {
        &ceilings::CEILINGS
    }

    fn time(subjects: &[Subject<Kernel>], rounds: usize) -> Vec<Time> {
        time::time(subjects, rounds)
    }

    fn facts(&self) -> &Facts {
        &self.facts
    }

    /// Triangle by triangle, so that each answer can be told.
    fn count(
        &self,
        setting: &Setting,
        i: usize,
        subjects: &[Subject<Kernel>],
        tallies: &mut [Tally],
    ) {
        let batch = self.batch(setting, i);
        let rays = (0..batch.rays.len()).map(|i| batch.rays.get(i));
        let judged = |corners| rays.clone().map(|ray| judge(&ray, corners)).collect();
        let verdicts: Vec<Vec<Verdict>> =
            batch.triangles.iter().map(|triangle| judged(triangle.corners)).collect();
        let finite: Vec<bool> = (0..batch.rays.len()).map(|i| is_finite(&batch, i)).collect();
        let closed = matches!(self.facts.kind, Kind::Closed | Kind::Natural);
        let mut hits = vec![Hits::new(); batch.triangles.len()];
        for (subject, tally) in subjects.iter().zip(tallies) {
            closest_of_each(subject, &batch, &mut hits);
            for (i, &finite) in finite.iter().enumerate() {
                let tests =
                    verdicts.iter().zip(&hits).map(|(verdicts, hits)| (verdicts[i], hits.get(i)));
                tally.add(closed, finite, tests);
            }
        }
    }

    fn answers(&self, setting: &Setting, i: usize, subject: &Subject<Kernel>) -> Vec<[u32; 4]> {
        let batch = self.batch(setting, i);
        let mut hits = vec![Hits::new(); batch.triangles.len()];
        closest_of_each(subject, &batch, &mut hits);
        let each = hits.iter().flat_map(|hits| (0..hits.len()).map(move |i| hits.get(i)));
        each.map(|hit| hit.map_or([0; 4], |hit| [1, bits(hit.t), bits(hit.u), bits(hit.v)]))
            .collect()
    }

    fn broken_promise(row: &Row<Self>) -> Option<String> {
        let (facts, tally) = (row.family.facts(), &row.tally);
        let kept = tally.leaks == 0
            && tally.nan_hits == 0
            && (!facts.fair || tally.t_p99() <= 4.0)
            && (facts.name != "band" || tally.band <= 2.0)
            && (facts.kind == Kind::Broken || tally.band_of_reach <= 2.0)
            && (facts.name != "spawned" || tally.false_hits == 0);
        (!kept).then(|| format!("{row:?}"))
    }
}

fn bits(x: f32) -> u32 {
    if x.is_nan() { f32::NAN.to_bits() } else { x.to_bits() }
}

/// What each ray meets of each triangle alone.
fn closest_of_each(
    subject: &Subject<Kernel>,
    Batch { triangles, rays }: &Batch,
    hits: &mut [Hits],
) {
    for (triangle, hits) in triangles.iter().zip(hits) {
        let records = subject.kernel.triangles(std::slice::from_ref(triangle));
        subject.kernel.closest(subject.way, &records, rays, hits);
    }
}

fn is_finite(Batch { triangles, rays }: &Batch, i: usize) -> bool {
    let ray = rays.get(i);
    let corners = triangles.iter().flat_map(|triangle| triangle.corners);
    [ray.origin, ray.dir].into_iter().chain(corners).all(|point| point.is_finite())
}
