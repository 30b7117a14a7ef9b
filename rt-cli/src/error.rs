//! What can go wrong.

use std::io;
use std::path::PathBuf;

/// A command failed: exit code 1.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Error {
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] rt_scene::Error),
    /// The picture cannot be made.
    #[error(transparent)]
    Render(#[from] rt_render::RenderError),
    /// The level is not to be had.
    #[error(transparent)]
    Level(#[from] rt_render::LevelError),
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A picture cannot be encoded.
    #[error("cannot encode the picture: {0}")]
    Encode(#[from] png::EncodingError),
    /// The extension of an output file is of no format that is written.
    #[error("{}: the format is told by the extension, one of {known}", path.display())]
    OutputFormat {
        /// The file.
        path: PathBuf,
        /// The extensions.
        known: &'static str,
    },
    /// A way to trace gave other hits than another. This is a fault of the program.
    #[error("{scene}: {differing} hits differ between {way} and the first row: please report this")]
    Differ {
        /// The scene.
        scene: String,
        /// How many.
        differing: u64,
        /// Where.
        way: String,
    },
}
