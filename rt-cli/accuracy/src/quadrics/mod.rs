//! Curved surfaces.

mod ceilings;
mod families;
mod time;

use rt_kernels::Hits;
use rt_kernels::quadric::{QuadricTest, catalogue};
use rt_kernels::reference::quadric::{Meeting, Verdict, judge};
use rt_kernels::reference::ulps;

use crate::{Ceiling, Facts, Family, Row, Setting, Subject, Tally, Time};
pub use families::{Batch, QuadricFamily, Surface};

/// What is listed.
type Kernel = dyn QuadricTest;

impl Family for QuadricFamily {
    type Kernel = Kernel;
    const SORT: &'static str = "quadric";

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

    /// Subjects that are not made for the family's surfaces count nothing.
    fn count(
        &self,
        setting: &Setting,
        i: usize,
        subjects: &[Subject<Kernel>],
        tallies: &mut [Tally],
    ) {
        let Batch { surface, rays } = self.batch(setting, i);
        let judged: Vec<_> = (0..rays.len()).map(|i| judge(&rays.get(i), &surface)).collect();
        let mut hits = Hits::new();
        for (subject, tally) in subjects.iter().zip(tallies) {
            let Some(surfaces) = subject.kernel.surfaces(&[surface]) else { continue };
            subject.kernel.closest(subject.way, &surfaces, &rays, &mut hits);
            for (i, verdict) in judged.iter().enumerate() {
                add(tally, verdict, hits.get(i).map(|hit| hit.t));
            }
        }
    }

    fn answers(&self, setting: &Setting, i: usize, subject: &Subject<Kernel>) -> Vec<[u32; 4]> {
        let Batch { surface, rays } = self.batch(setting, i);
        let Some(surfaces) = subject.kernel.surfaces(&[surface]) else { return vec![] };
        let mut hits = Hits::new();
        subject.kernel.closest(subject.way, &surfaces, &rays, &mut hits);
        let answer = |t: f32| [1, if t.is_nan() { f32::NAN } else { t }.to_bits(), 0, 0];
        (0..rays.len()).map(|i| hits.get(i).map_or([0; 4], |hit| answer(hit.t))).collect()
    }

    /// Who touches a surface or comes near to its end is in doubt, within the band; no one else is.
    fn broken_promise(row: &Row<Self>) -> Option<String> {
        let (facts, tally) = (row.family.facts(), &row.tally);
        let cones = row.family.shape == Surface::Cone;
        let in_doubt = cones || facts.name == "grazing" || facts.name == "near surface";
        let kept = tally.nan_hits == 0
            && tally.band <= if cones { CONE_BAND } else { 2.0 }
            && (!facts.fair || tally.t_p99() <= 4.0)
            && (in_doubt || tally.false_hits + tally.false_misses == 0);
        (!kept).then(|| format!("{row:?}"))
    }
}

/// What rays at cones are misjudged within, at most. (More than 2 are 11 of a million that are aimed at
/// rims: they run along the mantle.)
const CONE_BAND: f64 = 8.0;

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
