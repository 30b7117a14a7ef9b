//! Tiles over threads.

mod tally;
pub(crate) mod tile;

pub(crate) use tally::Tally;
pub use tally::{KindReport, Report};
pub use tile::Tiles;
pub(crate) use tile::{PointLight, TileJob};

use std::collections::BTreeMap;
use std::error::Error;
use std::io;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use glam::Vec3;
use rayon::prelude::*;
use rt_kernels::Join;
use rt_kernels::camera::Pinhole;

use crate::fit::half_height;
use crate::integrate::{Scratch, integrate};
use crate::job::{check_crop, check_size};
use crate::{Film, Job, RenderError, World};

/// Who wants to know how far the work is. Called from all threads.
pub trait Progress: Sync {
    /// `done` of `total` tiles are finished.
    fn tiles(&self, done: usize, total: usize);

    /// A tile is finished: its pixels in the order of [`Tiles::pixels`].
    fn finished(&self, _tile: u32, _pixels: &[Vec3]) {}

    /// Whether no other tile shall be begun.
    fn is_cancelled(&self) -> bool {
        false
    }
}

/// Nobody does.
pub struct Silent;

impl Progress for Silent {
    fn tiles(&self, _: usize, _: usize) {}
}

/// What was made of a picture.
#[derive(Debug)]
pub struct Made {
    /// The area that the job asks for. Tiles that are not finished are black.
    pub film: Film,
    /// What it took.
    pub report: Report,
    /// Which tiles are finished: all, unless the work was cancelled.
    pub finished: Vec<bool>,
}

/// Renders a picture.
///
/// # Errors
/// If the picture has no pixels or too many, if its crop is not within it, if the camera looks
/// nowhere, or if the threads cannot be started.
pub fn render(
    world: &World,
    job: &Job,
    progress: &dyn Progress,
) -> Result<(Film, Report), RenderError> {
    let made = render_rest(world, job, &BTreeMap::new(), progress)?;
    Ok((made.film, made.report))
}

/// Renders those tiles of a picture that are not there yet. What is there is taken if it is of a
/// tile of the job and has as many pixels.
///
/// # Errors
/// As [`render`].
pub fn render_rest(
    world: &World,
    job: &Job,
    there: &BTreeMap<u32, Vec<Vec3>>,
    progress: &dyn Progress,
) -> Result<Made, RenderError> {
    check_size(job.size)?;
    let area = job.area();
    check_crop(area, job.size)?;
    let camera = camera(world, job)?;
    let lights = tile::lights(world, job);
    let depth_range = tile::depth_range(world, camera.eye());

    let start = Instant::now();
    let tiles = Tiles::of(job);
    let film = Mutex::new(Film::new(area.width, area.height));
    let put = |pixels: &[(u32, u32)], colors: &[Vec3]| {
        let mut film = film.lock().expect("no thread panics with the film in its hands");
        for (&(x, y), &color) in pixels.iter().zip(colors) {
            film.set(x - area.left, y - area.top, color);
        }
    };
    let mut finished = vec![false; tiles.len()];
    for (&index, colors) in there {
        let pixels = tiles.pixels(index);
        if !pixels.is_empty() && pixels.len() == colors.len() {
            put(&pixels, colors);
            finished[index as usize] = true;
        }
    }
    let rest: Vec<u32> = (0..tiles.len() as u32).filter(|&i| !finished[i as usize]).collect();
    let done = AtomicUsize::new(tiles.len() - rest.len());
    progress.tiles(done.load(Ordering::Relaxed), tiles.len());

    let total = Mutex::new((Tally::default(), finished));
    let one = |(scratch, colors): &mut (Scratch, Vec<_>), index: &u32| {
        if progress.is_cancelled() {
            return;
        }
        let tile = TileJob {
            world,
            job,
            camera,
            lights: &lights,
            depth_range,
            pixels: tiles.pixels(*index),
        };
        let mut tally = Tally::default();
        integrate(&tile, scratch, colors, &mut tally);

        put(&tile.pixels, colors);
        progress.finished(*index, colors);
        let mut total = total.lock().expect("no thread panics while it adds");
        total.0 += tally;
        total.1[*index as usize] = true;
        drop(total);
        progress.tiles(done.fetch_add(1, Ordering::Relaxed) + 1, tiles.len());
    };
    on_threads(job.threads, || {
        rest.par_iter().for_each_init(Default::default, one);
    })?;

    let film = film.into_inner().expect("all threads are done");
    let (tally, finished) = total.into_inner().expect("all threads are done");
    Ok(Made { film, report: tally.report(start.elapsed(), job.threads), finished })
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
