//! What rays see: the backs of one-sided surfaces are not there for them.

use rt_kernels::{Hit, Hits, Rays};

use super::RayKind;
use crate::exec::{Tally, TileJob};
use crate::shade::Surface;

/// The closest hits of a batch of rays, but for backs that nobody sees.
#[derive(Default)]
pub(super) struct Seen {
    hits: Hits,
    /// All of them, where there are one-sided surfaces; else none.
    replaced: Vec<Option<Hit>>,
    onward: Rays,
    /// Whose each of those is.
    places: Vec<usize>,
}

impl Seen {
    /// What the ray of that number sees.
    #[inline(always)]
    pub(super) fn get(&self, i: usize) -> Option<Hit> {
        match self.replaced.get(i) {
            Some(&hit) => hit,
            None => self.hits.get(i),
        }
    }

    /// Finds what rays see. A ray that meets the back of a one-sided surface goes on, and counts once
    /// more.
    pub(super) fn find(
        &mut self,
        job: &TileJob<'_>,
        kind: RayKind,
        rays: &Rays,
        tally: &mut Tally,
    ) {
        let Seen { hits, replaced, onward, places } = self;
        replaced.clear();
        tally.closest(job, kind, rays, hits);
        if !job.world.has_one_sided() {
            return;
        }
        replaced.extend((0..rays.len()).map(|i| hits.get(i)));
        places.clear();
        places.extend(0..rays.len());
        loop {
            onward.clear();
            places.retain(|&i| {
                let Some(hit) = replaced[i] else { return false };
                let mut ray = rays.get(i);
                let surface = Surface::at(job.world, &ray, &hit);
                if surface.point.front || !job.world.is_one_sided(surface.point.material) {
                    return false;
                }
                // The same ray meets it at the same place: this is beyond, by as little as can be.
                ray.tmin = hit.t.next_up();
                onward.push(ray);
                true
            });
            if places.is_empty() {
                return;
            }
            tally.closest(job, kind, onward, hits);
            for (nth, &i) in places.iter().enumerate() {
                replaced[i] = hits.get(nth);
            }
        }
    }
}
