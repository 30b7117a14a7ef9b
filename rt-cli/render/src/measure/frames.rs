//! Frames as Geimer and Müller (2003, Section 3.1) divide them: rays, hits, shading.

use std::time::{Duration, Instant};

use rt_kernels::Exec;

use crate::exec::{Tally, TileJob, Tiles, camera, tile};
use crate::integrate::{Scratch, integrate};
use crate::{Film, Job, RenderError, World};

/// How much of a picture is done with one stage before the next begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// A tile: what a thread's nearest caches hold.
    Tile,
    /// All of it, as in the paper.
    Picture,
}

impl Extent {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Extent::Tile => "tile",
            Extent::Picture => "picture",
        }
    }
}

/// What frames took that were made one way: the least of all rounds, each for itself.
#[derive(Clone, Copy, Debug)]
pub struct FrameTimes {
    /// The ray casting step.
    pub casting: Duration,
    /// The shading.
    pub shading: Duration,
    /// The frame.
    pub total: Duration,
}

/// Times frames on the calling thread, once a round for every way in turn. All pictures are the
/// same: the first says which.
///
/// # Errors
/// If the camera looks nowhere.
///
/// # Panics
/// If two pictures differ.
pub fn frames(
    world: &World,
    job: &Job,
    ways: &[(Exec, Extent)],
    rounds: usize,
) -> Result<Vec<FrameTimes>, RenderError> {
    let mut first: Option<Film> = None;
    let mut times = vec![Vec::new(); ways.len()];
    let mut frames: Vec<_> = ways
        .iter()
        .map(|&(exec, extent)| Frame::new(world, Job { exec, ..job.clone() }, extent))
        .collect::<Result<_, _>>()?;
    // The first round warms up.
    for round in 0..=rounds {
        for (frame, times) in frames.iter_mut().zip(&mut times) {
            let took = frame.make();
            if round > 0 {
                times.push(took);
                continue;
            }
            match &first {
                None => first = Some(frame.film.clone()),
                Some(first) => assert!(*first == frame.film, "one answer"),
            }
        }
    }
    let least = |times: &[FrameTimes], of: fn(&FrameTimes) -> Duration| {
        times.iter().map(of).min().unwrap_or_default()
    };
    let least = times.iter().map(|times| FrameTimes {
        casting: least(times, |frame| frame.casting),
        shading: least(times, |frame| frame.shading),
        total: least(times, |frame| frame.total),
    });
    Ok(least.collect())
}

/// One way to make a frame, and the memory for it.
struct Frame<'a> {
    world: &'a World,
    job: Job,
    /// The pixels that go through the stages together.
    parts: Vec<Vec<(u32, u32)>>,
    scratch: Scratch,
    colors: Vec<glam::Vec3>,
    film: Film,
}

impl<'a> Frame<'a> {
    fn new(world: &'a World, job: Job, extent: Extent) -> Result<Frame<'a>, RenderError> {
        camera(world, &job)?;
        let (width, height) = job.size;
        let job = Job { crop: None, ..job };
        let tiles = Tiles::of(&job).all();
        let parts = match extent {
            Extent::Tile => tiles.collect(),
            Extent::Picture => vec![tiles.flatten().collect()],
        };
        Ok(Frame {
            world,
            parts,
            scratch: Scratch::default(),
            colors: Vec::new(),
            film: Film::new(width, height),
            job,
        })
    }

    fn make(&mut self) -> FrameTimes {
        let Frame { world, job, parts, scratch, colors, film } = self;
        let start = Instant::now();
        let camera = camera(world, job).expect("it was there before");
        let lights = tile::lights(world, job);
        let depth_range = tile::depth_range(world, camera.eye());
        let mut tally = Tally::default();
        for part in parts {
            let pixels = std::mem::take(part);
            let tile = TileJob { world, job, camera, lights: &lights, depth_range, pixels };
            integrate(&tile, scratch, colors, &mut tally);
            for (&(x, y), &color) in tile.pixels.iter().zip(colors.iter()) {
                film.set(x, y, color);
            }
            *part = tile.pixels;
        }
        let report = tally.report(start.elapsed(), 1);
        FrameTimes { casting: report.primary.time, shading: report.shading, total: report.total }
    }
}
