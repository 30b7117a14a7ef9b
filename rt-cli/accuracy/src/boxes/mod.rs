//! Boxes.
//!
//! A slab test that misses a box which is hit (a false miss) costs the picture; one that hits what
//! is missed (a false hit) costs time. In tallies `t` is where a ray enters the box, and the band is
//! that of false misses.

mod ceilings;
mod families;
mod time;

use rt_kernels::reference::aabb::{Verdict, judge};
use rt_kernels::reference::ulps;
use rt_kernels::slab::{BoxSet, BoxTest, Crossings, catalogue};

use crate::{Ceiling, Facts, Family, Row, Setting, Subject, Tally, Time};
pub use families::{Batch, BoxFamily};
pub use time::{Likeness, time};

/// What is listed.
type Kernel = dyn BoxTest;

impl Family for BoxFamily {
    type Kernel = Kernel;
    const SORT: &'static str = "box";

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
        time(subjects, Likeness::Alike, rounds)
    }

    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn count(
        &self,
        setting: &Setting,
        i: usize,
        subjects: &[Subject<Kernel>],
        tallies: &mut [Tally],
    ) {
        let Batch { aabb, rays } = self.batch(setting, i);
        let judged = |ray: rt_kernels::Ray| (judge(&ray, &aabb), f64::from(ray.tmin));
        let judged: Vec<_> = (0..rays.len()).map(|i| judged(rays.get(i))).collect();
        let boxes = BoxSet::new(&[aabb]);
        let mut crossings = Crossings::new();
        for (subject, tally) in subjects.iter().zip(tallies) {
            subject.kernel.cross(subject.way, &boxes, &rays, &mut crossings);
            for (i, (verdict, tmin)) in judged.iter().enumerate() {
                add(tally, verdict, *tmin, crossings.get(i));
            }
        }
    }

    fn answers(&self, setting: &Setting, i: usize, subject: &Subject<Kernel>) -> Vec<[u32; 4]> {
        let Batch { aabb, rays } = self.batch(setting, i);
        let mut crossings = Crossings::new();
        subject.kernel.cross(subject.way, &BoxSet::new(&[aabb]), &rays, &mut crossings);
        let answer = |(count, enter): (u32, f32)| {
            let enter = if enter.is_nan() { f32::NAN } else { enter };
            [count, if count > 0 { enter.to_bits() } else { 0 }, 0, 0]
        };
        (0..rays.len()).map(|i| answer(crossings.get(i))).collect()
    }

    fn broken_promise(row: &Row<Self>) -> Option<String> {
        let tally = &row.tally;
        let kept = tally.false_misses == 0
            && tally.nan_hits == 0
            && (!row.family.facts().fair || tally.t_p99() <= 4.0);
        (!kept).then(|| format!("{row:?}"))
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
