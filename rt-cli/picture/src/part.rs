//! The finished tiles of a picture that is not finished: a file that grows while it is rendered.
//!
//! First what the picture is of, a line each, and an empty line; then a record a tile. A record
//! that was cut off, or does not have its sum, ends the file: what comes before it counts.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::Vec3;

/// The first line.
const MAGIC: &str = "rt part 1";

/// What is found in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What the picture is of.
    pub lines: Vec<String>,
    /// The pixels of each tile that is finished.
    pub tiles: BTreeMap<u32, Vec<Vec3>>,
    /// The bytes that count: the file can go on from there.
    pub len: usize,
}

/// The beginning of a file. Line ends within a line become blanks.
pub fn header(lines: &[String]) -> Vec<u8> {
    let mut header = format!("{MAGIC}\n");
    for line in lines.iter().map(|line| line.replace(['\n', '\r'], " ")) {
        header += if line.is_empty() { " " } else { &line };
        header.push('\n');
    }
    header.push('\n');
    header.into_bytes()
}

/// What is added for a tile.
pub fn record(tile: u32, pixels: &[Vec3]) -> Vec<u8> {
    let mut record = Vec::with_capacity(16 + 12 * pixels.len());
    record.extend(tile.to_le_bytes());
    record.extend((pixels.len() as u32).to_le_bytes());
    record.extend(pixels.iter().flat_map(|pixel| pixel.to_array()).flat_map(f32::to_le_bytes));
    record.extend(sum(&record).to_le_bytes());
    record
}

/// Reads a file; `None` if it does not begin as one.
pub fn read(bytes: &[u8]) -> Option<Part> {
    let end = bytes.windows(2).position(|two| two == b"\n\n")?;
    let mut lines = std::str::from_utf8(&bytes[..end]).ok()?.split('\n').map(str::to_owned);
    if lines.next()? != MAGIC {
        return None;
    }
    let mut part = Part { lines: lines.collect(), tiles: BTreeMap::new(), len: end + 2 };
    while let Some((tile, pixels, len)) = next(&bytes[part.len..]) {
        part.tiles.insert(tile, pixels);
        part.len += len;
    }
    Some(part)
}

/// The record that the bytes begin with, and its length.
fn next(bytes: &[u8]) -> Option<(u32, Vec<Vec3>, usize)> {
    let word = |at: Range<usize>| Some(u32::from_le_bytes(bytes.get(at)?.try_into().ok()?));
    let (tile, count) = (word(0..4)?, word(4..8)? as usize);
    let end = count.checked_mul(12)?.checked_add(8)?;
    let stated = bytes.get(end..end.checked_add(8)?)?;
    if stated != sum(&bytes[..end]).to_le_bytes() {
        return None;
    }
    let number = |four: &[u8]| f32::from_le_bytes(four.try_into().expect("four"));
    let pixel =
        |three: &[u8]| Vec3::new(number(&three[..4]), number(&three[4..8]), number(&three[8..]));
    Some((tile, bytes[8..end].chunks_exact(12).map(pixel).collect(), end + 8))
}

/// FNV-1a.
fn sum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xCBF2_9CE4_8422_2325, |sum, &byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
    })
}
