//! What picture is wanted.

use glam::Vec3;
use rt_kernels::{BuildError, Exec};
use rt_scene::{Light, View};

use crate::Integrator;

/// A picture to render.
#[derive(Clone, Debug)]
pub struct Job {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// The part of it that is wanted; none is all of it. Its pixels are those of the whole.
    pub crop: Option<Crop>,
    /// The camera. Its own `size` is not looked at.
    pub view: View,
    /// Point lights. None: a light at the eye, without shadows.
    pub lights: Vec<Light>,
    /// The linear colour of rays that hit nothing.
    pub background: Vec3,
    /// What is computed of a hit.
    pub integrator: Integrator,
    /// Rays through each pixel, averaged: one through the middle, or several in a fixed pattern.
    pub samples: u32,
    /// How often a ray may be reflected or refracted.
    pub depth: u32,
    /// Whether lights cast shadows.
    pub shadows: bool,
    /// Whether shading may estimate: faster, and not the same bits on every machine. Of the light that
    /// a surface of shininess n sends back, the share that is wrong is below (n + 4) / 2^21.
    pub relaxed: bool,
    /// Level and packet size.
    pub exec: Exec,
    /// Threads to render with.
    pub threads: usize,
}

impl Job {
    /// What is seen, and nothing else: of primary rays on one thread.
    pub fn seen(view: View, size: (u32, u32), exec: Exec) -> Job {
        Job {
            size,
            crop: None,
            view,
            lights: Vec::new(),
            background: Vec3::ZERO,
            integrator: Integrator::Depth,
            samples: 1,
            depth: 0,
            shadows: false,
            relaxed: false,
            exec,
            threads: 1,
        }
    }

    /// What is rendered: the crop or all.
    pub fn area(&self) -> Crop {
        let (width, height) = self.size;
        self.crop.unwrap_or(Crop { left: 0, top: 0, width, height })
    }
}

/// A rectangle of pixels of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    /// Columns to the left of it.
    pub left: u32,
    /// Rows above it.
    pub top: u32,
    /// Pixels in a row of it.
    pub width: u32,
    /// Its rows.
    pub height: u32,
}

/// The most pixels of a picture.
const MAX_PIXELS: u64 = 1 << 27;

/// Refuses pictures of no pixels or too many: sooner than [`render`](crate::render) does, which
/// needs the scene.
///
/// # Errors
/// [`RenderError::Size`].
pub fn check_size((width, height): (u32, u32)) -> Result<(), RenderError> {
    match u64::from(width) * u64::from(height) {
        1..=MAX_PIXELS => Ok(()),
        _ => Err(RenderError::Size(width, height)),
    }
}

/// Refuses a crop that has no pixels or is not within the picture: likewise sooner.
///
/// # Errors
/// [`RenderError::Crop`].
pub fn check_crop(crop: Crop, size: (u32, u32)) -> Result<(), RenderError> {
    let ends = |start: u32, len: u32| u64::from(start) + u64::from(len);
    let within = ends(crop.left, crop.width) <= u64::from(size.0)
        && ends(crop.top, crop.height) <= u64::from(size.1);
    match within && crop.width > 0 && crop.height > 0 {
        true => Ok(()),
        false => Err(RenderError::Crop { crop, size }),
    }
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// Nothing in the scene can be seen.
    #[error("{0}: there is nothing to see: the scene has no primitives")]
    Empty(String),
    /// The kernels refuse the scene.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The picture has no pixels, or too many.
    #[error("a picture of {0}x{1} pixels cannot be made: 1 to {MAX_PIXELS} pixels are possible")]
    Size(u32, u32),
    /// The crop has no pixels, or is not within the picture.
    #[error(
        "the crop of {}x{} pixels at {},{} is not within the picture of {}x{}",
        crop.width, crop.height, crop.left, crop.top, size.0, size.1
    )]
    Crop {
        /// What was asked for.
        crop: Crop,
        /// Width and height of the picture.
        size: (u32, u32),
    },
    /// The camera looks nowhere.
    #[error("the camera looks nowhere: {0}")]
    View(&'static str),
    /// Threads cannot be started.
    #[error("cannot start {threads} threads: {why}")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the system says.
        why: String,
    },
}
