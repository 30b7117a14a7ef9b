//! Haines's Neutral File Format.
//!
//! Statements are words and numbers; where lines break does not matter. Read are `v`, `b`, `l`,
//! `f`, `s`, `c`, `p` and `pp`.
//!
//! What the format leaves open is decided thus: surfaces have two sides; highlights and mirror
//! reflections are grey, both of strength Ks, and so is what goes through, of strength T; lights
//! without a colour are white, each of intensity 1/√n where there are n lights, as the programs of the
//! Standard Procedural Databases have it.

mod read;
mod surface;
mod write;

use std::path::Path;

use crate::diag::Error;
use crate::model::Scene;
use crate::text::read_file;

pub use read::parse;
pub use surface::poorer;
pub(crate) use surface::{Surface, Surfaces, grey};
pub use write::write;
pub(crate) use write::{write_background, write_cone, write_sphere, write_view};

/// Reads an NFF file.
pub fn read(path: &Path) -> Result<Scene, Error> {
    let bytes = read_file(path).map_err(|source| Error::Io { path: path.to_owned(), source })?;
    parse(&bytes, &path.to_string_lossy())
}
