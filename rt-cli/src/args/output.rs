//! Where a picture goes, and how.

use std::path::{Path, PathBuf};

use clap::{Args as Group, ValueEnum};
use rt_picture::Format;
use rt_picture::png::Depth;

use crate::error::Error;

/// The file of a picture, and what of it is there already.
#[derive(Group)]
pub(crate) struct PictureOutputArgs {
    /// The file to write: .png (sRGB), .pfm or .exr (linear, 32 bits a channel); - for PNG on
    /// standard output.
    #[arg(short = 'o', long = "output", value_name = "FILE")]
    pub(crate) path: PathBuf,
    /// Bits a channel of a PNG.
    #[arg(long, value_enum, value_name = "N", help_heading = "Picture")]
    bits: Option<Bits>,

    /// Keep finished tiles in FILE.part all the while, and go on with those that are there already:
    /// of the same picture, or it is an error.
    #[arg(long, help_heading = "Long jobs")]
    pub(crate) resume: bool,
    /// Begin anew where FILE.part is there, of an interrupted picture; with --resume, only if it is
    /// of another picture.
    #[arg(long, help_heading = "Long jobs")]
    pub(crate) overwrite: bool,
}

impl PictureOutputArgs {
    /// The format of the file.
    pub(crate) fn format(&self) -> Result<Format, Error> {
        let format = picture_format(&self.path)?;
        match (format, self.bits) {
            (Format::Png(_), bits) => Ok(Format::Png(match bits {
                Some(Bits::Sixteen) => Depth::Sixteen,
                Some(Bits::Eight) | None => Depth::Eight,
            })),
            (_, Some(_)) => {
                let path = self.path.display();
                Err(Error::Usage(format!("--bits is for PNG: {path} gets 32 bits a channel")))
            }
            (format, None) => Ok(format),
        }
    }
}

/// The format that a picture's name asks for; without an extension it is PNG.
pub(crate) fn picture_format(path: &Path) -> Result<Format, Error> {
    if path.extension().is_none() {
        return Ok(Format::Png(Depth::Eight));
    }
    rt_picture::format_of(path)
        .ok_or_else(|| Error::OutputFormat { path: path.into(), known: &["png", "pfm", "exr"] })
}

#[derive(Clone, Copy, ValueEnum)]
enum Bits {
    /// The default.
    #[value(name = "8")]
    Eight,
    /// For gradients, and for what is compared.
    #[value(name = "16")]
    Sixteen,
}
