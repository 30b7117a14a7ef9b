//! Tiles over threads.

mod tally;
pub(crate) mod tile;

pub(crate) use tally::Tally;
pub use tally::{KindReport, Report};
pub(crate) use tile::TileJob;

use std::error::Error;
use std::io;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use rayon::prelude::*;
use rt_kernels::Join;
use rt_kernels::camera::Pinhole;

use crate::fit::half_height;
use crate::integrate::{Scratch, integrate};
use crate::job::check_size;
use crate::{Film, Job, RenderError, World};

/// Who wants to know how far the work is. Called from all threads.
pub trait Progress: Sync {
    /// `done` of `total` tiles are finished.
    fn tiles(&self, done: usize, total: usize);
}

/// Nobody does.
pub struct Silent;

impl Progress for Silent {
    fn tiles(&self, _: usize, _: usize) {}
}

/// Renders a picture.
///
/// # Errors
/// If the picture has no pixels or too many, if the camera looks nowhere, or if the threads cannot
/// be started.
pub fn render(
    world: &World,
    job: &Job,
    progress: &dyn Progress,
) -> Result<(Film, Report), RenderError> {
    let (width, height) = job.size;
    check_size(job.size)?;
    let camera = camera(world, job)?;
    let lights = tile::lights(world, job);
    let depth_range = tile::depth_range(world, camera.eye());

    let start = Instant::now();
    let tiles = tile::tiles(width, height);
    let film = Mutex::new(Film::new(width, height));
    let total = Mutex::new(Tally::default());
    let done = AtomicUsize::new(0);
    let one = |(scratch, colors): &mut (Scratch, Vec<_>), origin: &(u32, u32)| {
        let pixels = tile::pixels(*origin, width, height);
        let tile = TileJob { world, job, camera, lights: &lights, depth_range, pixels };
        let mut tally = Tally::default();
        integrate(&tile, scratch, colors, &mut tally);

        let mut film = film.lock().expect("no thread panics with the film in its hands");
        for (&(x, y), &color) in tile.pixels.iter().zip(colors.iter()) {
            film.set(x, y, color);
        }
        drop(film);
        *total.lock().expect("no thread panics while it adds") += tally;
        progress.tiles(done.fetch_add(1, Ordering::Relaxed) + 1, tiles.len());
    };
    on_threads(job.threads, || {
        tiles.par_iter().for_each_init(Default::default, one);
    })?;

    let film = film.into_inner().expect("all threads are done");
    let tally = total.into_inner().expect("all threads are done");
    Ok((film, tally.report(start.elapsed(), job.threads)))
}

/// The camera of a job, in the world's scaled space.
pub(crate) fn camera(world: &World, job: &Job) -> Result<Pinhole, RenderError> {
    let (view, (width, height)) = (&job.view, job.size);
    if !(view.fov_y > 0.0 && view.fov_y < 180.0) {
        return Err(RenderError::View("the angle of view must be between 0 and 180 degrees"));
    }
    let (eye, target) = (view.eye * world.scale, view.target * world.scale);
    Pinhole::new(eye, target, view.up, half_height(view.fov_y), width, height)
        .ok_or(RenderError::View("eye and target coincide, or up is along the line of sight"))
}

/// Does the work on threads of its own, so that their number is what was asked for. Where there are
/// none, as in WebAssembly, the caller does it alone.
pub(crate) fn on_threads<R: Send>(
    threads: usize,
    work: impl FnOnce() -> R + Send,
) -> Result<R, RenderError> {
    match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => Ok(pool.install(work)),
        Err(why) if is_unsupported(&why) => Ok(work()),
        Err(why) => Err(RenderError::Threads { threads, why: why.to_string() }),
    }
}

/// Whether the platform has no threads at all.
fn is_unsupported(why: &rayon::ThreadPoolBuildError) -> bool {
    let cause = why.source().and_then(|cause| cause.downcast_ref::<io::Error>());
    cause.is_some_and(|cause| cause.kind() == io::ErrorKind::Unsupported)
}

/// A builder's halves on the threads of the pool that it runs in.
pub(crate) struct RayonJoin;

impl Join for RayonJoin {
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        rayon::join(a, b)
    }
}
