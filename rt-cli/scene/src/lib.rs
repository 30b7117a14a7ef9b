//! Scene descriptions: what is there, not how it is traced.
//!
//! [`Scene`] is plain data: a triangle mesh, quadrics that stay quadrics until someone
//! [tessellates](tessellate()) them, materials, lights and a view. It comes from a file ([`obj`], [`nff`], [`aff`], [`ply`]) or from a procedure ([`spd`]); [`open`] takes
//! either by name.
//!
//! Readers take what is found in the wild and say what they left out ([`Facts`]). What they cannot
//! take they report with its place ([`Diagnostic`]). They neither panic nor trust a count that a
//! file claims. The same input gives the same scene on every machine.
#![forbid(unsafe_code)]

pub mod aff;
mod diag;
mod model;
pub mod nff;
pub mod obj;
pub mod ply;
pub mod spd;
mod tessellate;
mod text;
mod texture;
mod triangulate;

use std::ffi::OsStr;
use std::path::Path;

pub use diag::{Diagnostic, Error};
pub use model::{
    ColorMap, Cone, Facts, Light, Material, Mesh, Scene, Skipped, Sphere, Triangle, View,
};
pub use tessellate::{SPD_RESOLUTION, tessellate};
pub use texture::Texture;

/// Opens a scene by name: `spd:NAME[:SIZE]` is generated, anything else is a file whose extension
/// tells its format.
pub fn open(name: impl AsRef<OsStr>) -> Result<Scene, Error> {
    let name = name.as_ref();
    if let Some(procedure) = name.to_str().and_then(|name| name.strip_prefix("spd:")) {
        return spd::open(procedure);
    }
    let path = Path::new(name);
    let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
    match extension.as_ref().and_then(|extension| extension.to_str()) {
        Some("obj") => obj::read(path),
        Some("nff") => nff::read(path),
        Some("aff") => aff::read(path),
        Some("ply") => ply::read(path),
        _ => Err(Error::UnknownFormat { path: path.to_owned(), known: ".obj, .nff, .aff or .ply" }),
    }
}

/// A file's name without its folders.
fn base_name(name: &str) -> String {
    Path::new(name).file_name().map_or(name.into(), |base| base.to_string_lossy()).into_owned()
}
