//! AFF, the animated file format of BART (Lext, Assarsson and Möller, "BART: A Benchmark for Animated
//! Ray Tracing", 2000): NFF with meshes, transformations, included files and key frames.
//!
//! What is read is the first frame: animated transformations, triangles and the camera stand as they
//! do when the animation starts. Ambient light is left out and so are textures. Lights without a
//! colour are white, of intensity 1. Spheres and cones that a transformation stretches become
//! triangles.

mod file;
mod keys;
mod lexer;
mod object;
mod place;
mod read;
mod surface;
mod write;

use std::io;
use std::path::Path;

use crate::diag::Error;
use crate::model::Scene;
use crate::text::read_file;

pub use read::parse;
pub use surface::poorer;
pub use write::write;

/// Gives the bytes of an included file by the name that a file states.
pub type Loader<'a> = dyn FnMut(&str) -> io::Result<Vec<u8>> + 'a;

/// Reads an AFF file and all that it includes, from the same folder.
pub fn read(path: &Path) -> Result<Scene, Error> {
    let bytes = read_file(path).map_err(|source| Error::Io { path: path.to_owned(), source })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut load = |name: &str| read_file(&folder.join(name.replace('\\', "/")));
    parse(&bytes, &path.to_string_lossy(), &mut load)
}
