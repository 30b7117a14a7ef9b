//! Rays that wait for others of their class.

use super::{Chunk, Rays};

/// Signs of three axes times dominant axes.
const CLASSES: usize = 8 * 3;

/// The rays of a batch whose neighbours differ from them, by class: once there are enough of one, they
/// are traced together.
#[derive(Default)]
pub struct Buckets {
    buckets: [Vec<u32>; CLASSES],
    waiting: usize,
    /// Those of the bucket that was emptied last, and their places in the batch.
    rays: Rays,
    places: Vec<u32>,
}

impl Buckets {
    /// Takes all rays of a chunk that begins at `first` of the batch.
    pub fn put(&mut self, chunk: &mut Chunk, first: usize) {
        while let Some(class) = chunk.next_class() {
            let bucket = &mut self.buckets[class.key() % CLASSES];
            let mut rays = class.rays;
            while rays != 0 {
                bucket.push((first + rays.trailing_zeros() as usize) as u32);
                self.waiting += 1;
                rays &= rays - 1;
            }
        }
    }

    /// Whether a bucket has so many rays, up to [`LARGE`](super::LARGE), or, if these are the last, any: they are
    /// taken out of it.
    pub fn take(&mut self, batch: &Rays, most: usize, last: bool) -> bool {
        let enough = if last { 1 } else { most };
        if self.waiting < enough {
            return false;
        }
        let Some(bucket) = self.buckets.iter_mut().find(|bucket| bucket.len() >= enough) else {
            return false;
        };
        self.places.clear();
        // In their order, which is that of neighbours.
        self.places.extend(bucket.drain(..bucket.len().min(most)));
        self.rays.gather(batch, &self.places);
        self.waiting -= self.places.len();
        true
    }

    /// The rays that were taken last.
    pub fn rays(&self) -> &Rays {
        &self.rays
    }

    /// Their places in the batch.
    pub fn places(&self) -> &[u32] {
        &self.places
    }
}
