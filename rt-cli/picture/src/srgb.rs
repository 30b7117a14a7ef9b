//! From light to what a screen is told, and back (IEC 61966-2-1).
//!
//! The power comes from the one library whose bits are the same everywhere.

use std::sync::LazyLock;

/// One linear channel as 8-bit sRGB, rounded to nearest; NaN is black.
pub fn encode8(linear: f32) -> u8 {
    STARTS.partition_point(|start| *start <= linear) as u8
}

/// One linear channel as 16-bit sRGB, rounded to nearest; NaN is black.
pub fn encode16(linear: f32) -> u16 {
    code16(encode(f64::from(linear)))
}

/// One linear channel on the scale of sRGB, not rounded to any code: 0 to 1, or NaN.
pub fn encode(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.0031308 { linear * 12.92 } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// A channel on the scale of sRGB as light.
pub fn decode(code: f64) -> f64 {
    if code <= 0.04045 { code / 12.92 } else { libm::pow((code + 0.055) / 1.055, 2.4) }
}

/// A number from 0 to 1 as one of 256; NaN is black.
pub(crate) fn code8(value: f64) -> u8 {
    // The conversion stays within its range, and makes zero of NaN.
    (value * 255.0 + 0.5) as u8
}

/// A number from 0 to 1 as one of 65,536; NaN is black.
pub(crate) fn code16(value: f64) -> u16 {
    (value * 65535.0 + 0.5) as u16
}

/// The linear values at which the codes 1, 2, …, 255 begin: half a code before the code itself.
static STARTS: LazyLock<[f32; 255]> =
    LazyLock::new(|| std::array::from_fn(|i| decode((i as f64 + 0.5) / 255.0) as f32));
