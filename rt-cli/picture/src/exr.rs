//! OpenEXR: single pictures in rows of pixels, written plain; read also when compressed by deflation
//! (ZIP and ZIPS), as most programs write it, and with half precision.
//!
//! Source: "The OpenEXR File Layout", openexr.com; compression as in its `ImfZip.cpp`.

use glam::Vec3;
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

use crate::bytes::Bytes;
use crate::{Error, Picture, Scale, check_size, half};

const FORMAT: &str = "OpenEXR";
const MAGIC: [u8; 4] = [0x76, 0x2F, 0x31, 0x01];
/// Version 2 and no flag: a single picture in rows.
const VERSION: u32 = 2;
/// Names are longer than 31 bytes: it changes nothing.
const LONG_NAMES: u32 = 1 << 10;
/// Parts of a picture: what compresses best is by 1032.
const RATIO: u64 = 1032;

/// Writes three channels of 32-bit numbers, as they are.
pub(crate) fn write(picture: &Picture) -> Vec<u8> {
    let (width, height) = (picture.width as i32, picture.height as i32);
    let mut file = Vec::with_capacity(400 + picture.pixels.len() * 12 + height as usize * 16);
    file.extend(MAGIC);
    file.extend(VERSION.to_le_bytes());
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        file.extend([name.as_bytes(), b"\0", kind.as_bytes(), b"\0"].concat());
        file.extend((value.len() as i32).to_le_bytes());
        file.extend(value);
    };
    let ints = |ints: &[i32]| ints.iter().flat_map(|n| n.to_le_bytes()).collect::<Vec<_>>();
    // 32-bit numbers, without a hint, one for every pixel; channels go by the alphabet.
    let channel = |name: u8| [&[name, 0][..], &ints(&[2, 0, 1, 1])].concat();
    let channels = [channel(b'B'), channel(b'G'), channel(b'R'), vec![0]].concat();
    let window = ints(&[0, 0, width - 1, height - 1]);
    attribute("channels", "chlist", &channels);
    attribute("compression", "compression", &[0]);
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1.0_f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1.0_f32.to_le_bytes());
    file.push(0);

    let size = 12 * u64::from(picture.width);
    let first = file.len() as u64 + 8 * height as u64;
    file.extend((0..height as u64).flat_map(|y| (first + y * (8 + size)).to_le_bytes()));
    for (y, row) in picture.pixels.chunks_exact(picture.width as usize).enumerate() {
        file.extend((y as i32).to_le_bytes());
        file.extend((size as i32).to_le_bytes());
        for channel in [2, 1, 0] {
            file.extend(row.iter().flat_map(|pixel| pixel[channel].to_le_bytes()));
        }
    }
    file
}

/// How a channel's numbers are kept.
#[derive(Clone, Copy, PartialEq)]
enum Sample {
    Uint,
    Half,
    Float,
}

impl Sample {
    fn bytes(self) -> usize {
        if self == Sample::Half { 2 } else { 4 }
    }

    fn read(self, bytes: &[u8]) -> f32 {
        match (self, bytes) {
            (Sample::Half, &[a, b]) => half::to_f32(u16::from_le_bytes([a, b])),
            (Sample::Float, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
            (Sample::Uint, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]) as f32,
            _ => 0.0,
        }
    }
}

/// What a header says, as far as it matters.
#[derive(Default)]
struct Header {
    /// In the order of the file; with the colours that each is for.
    channels: Vec<(Vec<usize>, Sample)>,
    compression: Option<u8>,
    /// The least and the greatest column and row.
    window: Option<[i32; 4]>,
}

/// Reads a picture that has R, G and B or a brightness Y.
///
/// # Errors
/// If it is broken, or in tiles, deep, of several parts, subsampled or compressed in another way.
pub fn read(bytes: &[u8]) -> Result<Picture, Error> {
    let mut file = Bytes::new(FORMAT, bytes);
    if file.array()? != MAGIC {
        return Err(Error::Unknown);
    }
    let version = u32::from_le_bytes(file.array()?);
    if version & 0xFF != VERSION {
        return Err(unsupported(&format!("version {} is not read", version & 0xFF)));
    }
    for (flag, what) in [(9, "in tiles"), (11, "with depth"), (12, "of several parts")] {
        if version >> flag & 1 == 1 {
            return Err(unsupported(&format!("a picture {what} is not read")));
        }
    }
    if version & !(0xFF | LONG_NAMES) != 0 {
        return Err(unsupported("it has flags that are not known"));
    }
    let header = header(&mut file)?;
    let missing =
        |what| Error::Invalid { format: FORMAT, at: 0, what: format!("it has no {what}") };
    let [left, top, right, bottom] = header.window.ok_or_else(|| missing("dataWindow"))?;
    let side = |low, high| u64::try_from(i64::from(high) - i64::from(low) + 1).unwrap_or(0);
    let size @ (width, height) = (side(left, right), side(top, bottom));
    let rows = match header.compression.ok_or_else(|| missing("compression"))? {
        0 | 2 => 1,
        3 => 16,
        other => return Err(unsupported(&format!("compression {} is not read", name(other)))),
    };
    let deflated = header.compression != Some(0);
    let pixel: usize = header.channels.iter().map(|(_, sample)| sample.bytes()).sum();
    let colours: Vec<usize> = header.channels.iter().flat_map(|(c, _)| c.iter().copied()).collect();
    if !(0..3).all(|colour| colours.iter().filter(|&&c| c == colour).count() == 1) {
        return Err(unsupported("a picture without either R, G and B or Y is not read"));
    }
    let ratio = if deflated { RATIO } else { 1 };
    check_size(FORMAT, size, 8 * pixel as u64, ratio, bytes.len())?;

    let mut pixels = vec![Vec3::ZERO; (width * height) as usize];
    let mut found = vec![false; height as usize];
    let chunks = height.div_ceil(rows);
    let table = file.take(chunks as usize * 8)?;
    for offset in table.chunks_exact(8) {
        file.seek(u64::from_le_bytes(offset.try_into().expect("eight")))?;
        let y = i64::from(file.i32()?) - i64::from(top);
        let Some(y) = u64::try_from(y).ok().filter(|y| *y < height && y % rows == 0) else {
            return Err(file.error("expected a row of the picture".to_owned()));
        };
        let rows = rows.min(height - y) as usize;
        let len = usize::try_from(width * (pixel * rows) as u64)
            .map_err(|_| file.error("its rows are too long".to_owned()))?;
        let packed = file.len()?;
        let packed = file.take(packed)?;
        let unpacked;
        let data = match deflated && packed.len() != len {
            true => {
                unpacked = inflate(packed, len)
                    .ok_or_else(|| file.error("rows do not inflate".to_owned()))?;
                &unpacked
            }
            false => packed,
        };
        if data.len() != len {
            return Err(file.error(format!("expected rows of {len} bytes, found {}", data.len())));
        }
        for (row, line) in data.chunks_exact(len / rows).enumerate() {
            let y = y as usize + row;
            found[y] = true;
            let pixels = &mut pixels[y * width as usize..][..width as usize];
            scanline(&header.channels, line, pixels);
        }
    }
    if let Some(y) = found.iter().position(|found| !found) {
        return Err(file.error(format!("row {y} is missing")));
    }
    let (width, height) = (width as u32, height as u32);
    Ok(Picture { width, height, scale: Scale::Linear, pixels })
}

fn header(file: &mut Bytes<'_>) -> Result<Header, Error> {
    let mut header = Header::default();
    loop {
        let name = file.name()?;
        if name.is_empty() {
            return Ok(header);
        }
        file.name()?;
        let len = file.len()?;
        let value = file.take(len)?;
        let mut value = Bytes::new(FORMAT, value);
        match name {
            b"channels" => header.channels = channels(&mut value)?,
            b"compression" => header.compression = Some(value.take(1)?[0]),
            b"dataWindow" => {
                header.window = Some([value.i32()?, value.i32()?, value.i32()?, value.i32()?]);
            }
            _ => {}
        }
    }
}

/// The channels in the order of the file; those that are no colour are read over.
fn channels(list: &mut Bytes<'_>) -> Result<Vec<(Vec<usize>, Sample)>, Error> {
    let mut channels = Vec::new();
    loop {
        let name = list.name()?;
        if name.is_empty() {
            return Ok(channels);
        }
        let sample = match list.i32()? {
            0 => Sample::Uint,
            1 => Sample::Half,
            2 => Sample::Float,
            other => return Err(list.error(format!("expected a type of 0, 1 or 2, found {other}"))),
        };
        list.take(4)?;
        if (list.i32()?, list.i32()?) != (1, 1) {
            return Err(unsupported("a channel with fewer samples than pixels is not read"));
        }
        let colours = match name {
            b"R" => vec![0],
            b"G" => vec![1],
            b"B" => vec![2],
            b"Y" => vec![0, 1, 2],
            _ => vec![],
        };
        channels.push((colours, sample));
    }
}

/// Puts one row, channel after channel, into its pixels.
fn scanline(channels: &[(Vec<usize>, Sample)], mut line: &[u8], pixels: &mut [Vec3]) {
    for (colours, sample) in channels {
        let (own, rest) = line.split_at(sample.bytes() * pixels.len());
        line = rest;
        for (bytes, pixel) in own.chunks_exact(sample.bytes()).zip(&mut *pixels) {
            for &colour in colours {
                pixel[colour] = sample.read(bytes);
            }
        }
    }
}

/// Undoes deflation, differences from byte to byte, and the parting of even and odd bytes.
fn inflate(packed: &[u8], len: usize) -> Option<Vec<u8>> {
    let mut bytes = decompress_to_vec_zlib_with_limit(packed, len).ok()?;
    for i in 1..bytes.len() {
        bytes[i] = bytes[i - 1].wrapping_add(bytes[i]).wrapping_sub(128);
    }
    let (even, odd) = bytes.split_at(bytes.len().div_ceil(2));
    let mut whole = Vec::with_capacity(bytes.len());
    for (i, &byte) in even.iter().enumerate() {
        whole.push(byte);
        whole.extend(odd.get(i));
    }
    Some(whole)
}

fn name(compression: u8) -> String {
    let names = ["none", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "B44A", "DWAA", "DWAB"];
    names.get(usize::from(compression)).map_or(compression.to_string(), |name| (*name).to_owned())
}

fn unsupported(what: &str) -> Error {
    Error::Unsupported(format!("{FORMAT}: {what}"))
}
