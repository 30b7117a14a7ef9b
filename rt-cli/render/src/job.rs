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
    /// The camera. Its own `size` is not looked at.
    pub view: View,
    /// Point lights. None: a light at the eye, without shadows.
    pub lights: Vec<Light>,
    /// The linear colour of rays that hit nothing.
    pub background: Vec3,
    /// What is computed of a hit.
    pub integrator: Integrator,
    /// How often a ray may be reflected.
    pub depth: u32,
    /// Whether lights cast shadows.
    pub shadows: bool,
    /// Level and packet size.
    pub exec: Exec,
    /// Threads to render with.
    pub threads: usize,
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
