//! Portable float maps: three lines of text, then 32-bit numbers, the lowest row first.
//!
//! Source: Paul Debevec, "PFM Portable FloatMap Image Format".

use glam::Vec3;

use crate::bytes::Bytes;
use crate::{Error, Picture, Scale, check_size};

const FORMAT: &str = "PFM";

/// Writes the numbers as they are, little-endian.
pub(crate) fn write(picture: &Picture) -> Vec<u8> {
    let mut file = format!("PF\n{} {}\n-1.0\n", picture.width, picture.height).into_bytes();
    file.reserve(12 * picture.pixels.len());
    for row in picture.pixels.rchunks(picture.width as usize) {
        let channels = row.iter().flat_map(|pixel| pixel.to_array());
        file.extend(channels.flat_map(f32::to_le_bytes));
    }
    file
}

/// Reads a map of colours (`PF`) or greys (`Pf`) of either byte order. The factor in the header is
/// for its sign alone.
///
/// # Errors
/// If the header is none, or the file is not as long as it says.
pub fn read(bytes: &[u8]) -> Result<Picture, Error> {
    let mut file = Bytes::new(FORMAT, bytes);
    let channels = match word(&mut file)? {
        b"PF" => 3,
        b"Pf" => 1,
        _ => return Err(Error::Unknown),
    };
    let width: u32 = number(&mut file, "a width")?;
    let height: u32 = number(&mut file, "a height")?;
    let factor: f32 = number(&mut file, "a scale factor")?;
    if !factor.is_finite() || factor == 0.0 {
        return Err(file.error(format!("expected a scale factor other than 0, found {factor}")));
    }
    check_size(FORMAT, (width.into(), height.into()), 32 * channels, 1, bytes.len())?;
    let len = (u64::from(width) * u64::from(height) * channels * 4) as usize;
    let data = file.take(len)?;
    let more = bytes.len() - file.at();
    if more > 0 {
        return Err(file.error(format!("expected the end of the file, found {more} more bytes")));
    }
    let read = if factor < 0.0 { f32::from_le_bytes } else { f32::from_be_bytes };
    let numbers: Vec<f32> =
        data.chunks_exact(4).map(|bytes| read(bytes.try_into().expect("four"))).collect();
    let rows = numbers.rchunks(width as usize * channels as usize);
    let pixels = match channels {
        3 => rows.flat_map(|row| row.chunks_exact(3).map(Vec3::from_slice)).collect(),
        _ => rows.flat_map(|row| row.iter().map(|&grey| Vec3::splat(grey))).collect(),
    };
    Ok(Picture { width, height, scale: Scale::Linear, pixels })
}

/// The next word of the header and the one blank after it.
fn word<'a>(file: &mut Bytes<'a>) -> Result<&'a [u8], Error> {
    const LONGEST: usize = 32;
    let start = file.at();
    for _ in 0..LONGEST {
        if file.take(1)?[0].is_ascii_whitespace() {
            let end = file.at() - 1;
            file.seek(start as u64)?;
            let word = file.take(end - start)?;
            file.take(1)?;
            return Ok(word);
        }
    }
    Err(file.error(format!("expected a word of up to {LONGEST} bytes in the header")))
}

fn number<T: std::str::FromStr>(file: &mut Bytes<'_>, expected: &str) -> Result<T, Error> {
    let word = word(file)?;
    let text = String::from_utf8_lossy(word);
    text.parse().map_err(|_| file.error(format!("expected {expected}, found '{}'", shown(&text))))
}

/// Fit for a terminal.
fn shown(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '.' } else { c }).collect()
}
