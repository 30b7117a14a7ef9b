//! The arguments of `rt compare`.

use std::path::PathBuf;

use clap::Args as Group;

/// Tell how much two pictures of one size differ.
///
/// PNG, PFM and OpenEXR are read. Two linear pictures (PFM, OpenEXR) are compared as they are; else
/// both are compared as a screen shows them, in sRGB from 0 to 1. Where a limit is given and missed,
/// the exit code is 3.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt compare a.png b.png\n  \
    rt compare a.exr b.exr -o difference.png\n  \
    rt compare new.png golden.png --max-pixels 0 && echo same")]
pub(crate) struct CompareArgs {
    /// A picture.
    #[arg(value_name = "A")]
    pub(crate) a: PathBuf,
    /// Another, or the one to compare it with.
    #[arg(value_name = "B")]
    pub(crate) b: PathBuf,
    /// Answer as JSON.
    #[arg(long)]
    pub(crate) json: bool,

    /// Write a picture of the difference of each channel: .png, .pfm or .exr.
    #[arg(short, long, value_name = "FILE", help_heading = "Difference image")]
    pub(crate) output: Option<PathBuf>,
    /// Multiply the difference in that picture [default: such that the greatest is white; 1 in .pfm
    /// and .exr].
    #[arg(long, value_name = "X", requires = "output", value_parser = limit,
          help_heading = "Difference image")]
    pub(crate) gain: Option<f64>,

    /// The greatest mean squared error that will do.
    #[arg(long, value_name = "X", value_parser = limit, help_heading = "Limits")]
    pub(crate) max_mse: Option<f64>,
    /// The least peak signal-to-noise ratio that will do, in decibels.
    #[arg(long, value_name = "DB", value_parser = decibels, allow_hyphen_values = true,
          help_heading = "Limits")]
    pub(crate) min_psnr: Option<f64>,
    /// The greatest difference of a channel that will do.
    #[arg(long, value_name = "X", value_parser = limit, help_heading = "Limits")]
    pub(crate) max_difference: Option<f64>,
    /// How many pixels may differ at all.
    #[arg(long, value_name = "N", help_heading = "Limits")]
    pub(crate) max_pixels: Option<u64>,
}

fn limit(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(limit) if limit.is_finite() && limit >= 0.0 => Ok(limit),
        _ => Err("expected a number, 0 or more".into()),
    }
}

fn decibels(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(limit) if limit.is_finite() => Ok(limit),
        _ => Err("expected a number of decibels".into()),
    }
}
