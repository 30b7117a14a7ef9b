//! Pictures as files: [PNG](mod@png), [PFM](pfm) and [OpenEXR](exr), written and read, and the
//! [difference](compare()) of two.
//!
//! What is written is the same bytes on every machine. Readers neither panic nor trust a size that
//! a file claims: they take memory only for pixels that the file is long enough to hold.
#![forbid(unsafe_code)]

mod bytes;
mod compare;
pub mod exr;
mod half;
pub mod part;
pub mod pfm;
pub mod png;
pub mod srgb;

use std::path::Path;

use glam::Vec3;

pub use compare::{Difference, compare};

/// The most pixels of a picture.
pub const MAX_PIXELS: u64 = 1 << 27;

/// What the numbers of a picture stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Light: linear in its intensity, without an upper bound.
    Linear,
    /// What a screen is told: sRGB, from 0 to 1.
    Srgb,
}

/// A picture, row by row from the upper left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// What the pixels are given in.
    pub scale: Scale,
    /// Red, green and blue: `width` · `height` of them.
    pub pixels: Vec<Vec3>,
}

/// A kind of picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Portable Network Graphics, sRGB.
    Png(png::Depth),
    /// Portable float map, linear, 32 bits a channel.
    Pfm,
    /// OpenEXR, linear, 32 bits a channel.
    Exr,
}

/// What keeps a picture from being read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The bytes begin like no picture that is read.
    #[error("this is no PNG, PFM or OpenEXR file")]
    Unknown,
    /// The bytes are not what their beginning promises.
    #[error("{format} at byte {at}: {what}")]
    Invalid {
        /// The format.
        format: &'static str,
        /// The offset where it is wrong, or as far as was read.
        at: usize,
        /// What was expected, and what was found.
        what: String,
    },
    /// A format has more than is read here.
    #[error("{0}")]
    Unsupported(String),
    /// A picture cannot be encoded.
    #[error("cannot encode the picture: {0}")]
    Encode(String),
}

/// Reads a picture, of whatever format its first bytes tell.
///
/// # Errors
/// If it is of none, or broken, or uses a part of its format that is not read: see the formats.
pub fn read(bytes: &[u8]) -> Result<Picture, Error> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => png::read(bytes),
        [b'P', b'F' | b'f', ..] => pfm::read(bytes),
        [0x76, 0x2F, 0x31, 0x01, ..] => exr::read(bytes),
        _ => Err(Error::Unknown),
    }
}

/// Writes a picture as a file of that format. `text` is keywords and what is said of them; only
/// PNG holds it.
///
/// # Errors
/// If the format cannot hold a keyword, or the number of pixels is not the picture's size.
pub fn write(picture: &Picture, format: Format, text: &[(&str, String)]) -> Result<Vec<u8>, Error> {
    let stated = u64::from(picture.width) * u64::from(picture.height);
    if stated == 0 || stated != picture.pixels.len() as u64 {
        let (width, height, found) = (picture.width, picture.height, picture.pixels.len());
        return Err(Error::Encode(format!("it has {found} pixels at a size of {width}x{height}")));
    }
    match format {
        Format::Png(depth) => png::write(picture, depth, text),
        Format::Pfm => Ok(pfm::write(picture)),
        Format::Exr => Ok(exr::write(picture)),
    }
}

/// The format that a file's extension names, in capitals or not; PNG with 8 bits for `png`.
pub fn format_of(path: &Path) -> Option<Format> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    match extension.as_str() {
        "png" => Some(Format::Png(png::Depth::Eight)),
        "pfm" => Some(Format::Pfm),
        "exr" => Some(Format::Exr),
        _ => None,
    }
}

/// Refuses pictures of no pixels, of too many, or of more than a file of `len` bytes can hold at
/// `least` bits a pixel before compression. Nothing that is read compresses by more than 1032.
fn check_size(
    format: &'static str,
    (width, height): (u64, u64),
    least: u64,
    ratio: u64,
    len: usize,
) -> Result<(), Error> {
    let pixels = width.saturating_mul(height);
    let what = if pixels == 0 || pixels > MAX_PIXELS {
        format!("a picture of {width}x{height} pixels is not read: 1 to {MAX_PIXELS} are")
    } else if pixels * least / 8 > (len as u64).saturating_mul(ratio) {
        format!("{width}x{height} pixels do not fit into a file of {len} bytes")
    } else {
        return Ok(());
    };
    Err(Error::Invalid { format, at: 0, what })
}
