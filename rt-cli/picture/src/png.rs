//! Portable Network Graphics.

use std::io::Cursor;

use ::png::{BitDepth, ColorType, Decoder, Encoder, Limits, SrgbRenderingIntent, Transformations};
use glam::Vec3;

use crate::srgb::{code8, code16, encode8, encode16};
use crate::{Error, Picture, Scale, check_size};

const FORMAT: &str = "PNG";

/// Bits a channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// Codes from 0 to 255.
    #[default]
    Eight,
    /// Codes from 0 to 65535.
    Sixteen,
}

/// Writes sRGB, which light is made into.
pub(crate) fn write(
    picture: &Picture,
    depth: Depth,
    text: &[(&str, String)],
) -> Result<Vec<u8>, Error> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, picture.width, picture.height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(match depth {
        Depth::Eight => BitDepth::Eight,
        Depth::Sixteen => BitDepth::Sixteen,
    });
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    let failed = |error: ::png::EncodingError| Error::Encode(error.to_string());
    for (keyword, text) in text {
        encoder.add_itxt_chunk((*keyword).to_owned(), text.clone()).map_err(failed)?;
    }
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&codes(picture, depth)).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(file)
}

/// The codes of all channels, as the file has them.
fn codes(picture: &Picture, depth: Depth) -> Vec<u8> {
    let channels = picture.pixels.iter().flat_map(|pixel| pixel.to_array());
    match (depth, picture.scale) {
        (Depth::Eight, Scale::Linear) => channels.map(encode8).collect(),
        (Depth::Eight, Scale::Srgb) => channels.map(|x| code8(x.into())).collect(),
        (Depth::Sixteen, Scale::Linear) => {
            channels.flat_map(|x| encode16(x).to_be_bytes()).collect()
        }
        (Depth::Sixteen, Scale::Srgb) => {
            channels.flat_map(|x| code16(x.into()).to_be_bytes()).collect()
        }
    }
}

/// Reads any PNG as sRGB; what it says of transparency and colour spaces is not looked at, and of
/// an animation only the first picture.
///
/// # Errors
/// If it is broken or has too many pixels.
pub fn read(bytes: &[u8]) -> Result<Picture, Error> {
    let invalid = |error: &dyn std::fmt::Display| Error::Invalid {
        format: FORMAT,
        at: bytes.len(),
        what: error.to_string(),
    };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: 64 << 20 });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    let mut reader = decoder.read_info().map_err(|error| invalid(&error))?;
    let info = reader.info();
    // Over such a one the decoder would panic.
    if info.palette.as_ref().is_some_and(|palette| !palette.len().is_multiple_of(3)) {
        return Err(invalid(&"its palette ends within a colour"));
    }
    let (width, height) = (info.width, info.height);
    // A row is at least one bit a pixel, and deflation makes nothing more than 1032 times as short.
    let least = info.bits_per_pixel() as u64;
    check_size(FORMAT, (width.into(), height.into()), least, 1032, bytes.len())?;
    let size = reader.output_buffer_size().ok_or_else(|| invalid(&"it is too large"))?;
    let mut codes = vec![0; size];
    let frame = reader.next_frame(&mut codes).map_err(|error| invalid(&error))?;
    if (frame.width, frame.height) != (width, height) {
        return Err(invalid(&"its first frame is only a part of it"));
    }
    let channels: Vec<f32> = match frame.bit_depth {
        BitDepth::Sixteen => {
            let code = |two: &[u8]| u16::from_be_bytes([two[0], two[1]]);
            codes.chunks_exact(2).map(|two| f32::from(code(two)) / 65535.0).collect()
        }
        _ => codes.iter().map(|&code| f32::from(code) / 255.0).collect(),
    };
    let grey = |pixel: &[f32]| Vec3::splat(pixel[0]);
    let pixels = match frame.color_type {
        ColorType::Grayscale => channels.chunks_exact(1).map(grey).collect(),
        ColorType::GrayscaleAlpha => channels.chunks_exact(2).map(grey).collect(),
        ColorType::Rgba => channels.chunks_exact(4).map(Vec3::from_slice).collect(),
        ColorType::Rgb | ColorType::Indexed => {
            channels.chunks_exact(3).map(Vec3::from_slice).collect()
        }
    };
    let picture = Picture { width, height, scale: Scale::Srgb, pixels };
    match picture.pixels.len() as u64 == u64::from(width) * u64::from(height) {
        true => Ok(picture),
        false => Err(invalid(&"pixels are missing")),
    }
}
