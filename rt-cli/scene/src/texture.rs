//! Pictures on surfaces: PNG and JPEG.

use std::fmt;
use std::io::Cursor;

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Pixels along a side, at most.
const MAX_SIDE: usize = 1 << 15;

/// Deflate makes at most 1032 bytes of one.
const MAX_INFLATION: usize = 1032;

/// A block of 64 samples takes one bit of a JPEG at least.
const MAX_PIXELS_A_BYTE: usize = 512;

/// A picture, row by row from the upper left corner.
#[derive(Clone, PartialEq, Eq)]
pub struct Texture {
    /// Pixels in a row.
    width: u32,
    /// Red, green and blue, in 8-bit sRGB.
    pixels: Vec<[u8; 3]>,
}

impl Texture {
    /// A picture of `width` times any number of pixels.
    ///
    /// # Panics
    /// If there are no pixels, or if the last row is not full.
    pub fn new(width: u32, pixels: Vec<[u8; 3]>) -> Texture {
        let full = width > 0 && pixels.len().is_multiple_of(width as usize);
        assert!(full && !pixels.is_empty(), "{} pixels in rows of {width}", pixels.len());
        Texture { width, pixels }
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        (self.pixels.len() / self.width as usize) as u32
    }

    /// The pixels, row by row: red, green and blue in 8-bit sRGB.
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    /// The same picture as a PNG file.
    pub fn to_png(&self) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width(), self.height());
        encoder.set_color(png::ColorType::Rgb);
        let written = encoder
            .write_header()
            .and_then(|mut writer| writer.write_image_data(self.pixels.as_flattened()));
        written.expect("a picture has pixels, and memory takes all that is written");
        file
    }

    /// Reads a PNG or JPEG file. What it claims to hold is believed only as far as a file of its
    /// length can hold it.
    pub(crate) fn decode(bytes: &[u8]) -> Result<Texture, String> {
        match bytes {
            [0x89, b'P', b'N', b'G', ..] => png(bytes),
            [0xFF, 0xD8, ..] => jpeg(bytes),
            _ => Err("neither PNG nor JPEG".to_owned()),
        }
    }
}

impl fmt::Debug for Texture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Texture({}x{})", self.width(), self.height())
    }
}

/// Refuses sizes that cannot be true: `most` is the number of pixels that the file can hold.
fn check_size(width: usize, height: usize, most: usize) -> Result<(), String> {
    if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
        return Err(format!("a picture of {width}x{height} pixels: sides go from 1 to {MAX_SIDE}"));
    }
    if width * height > most {
        return Err(format!("the file is too short for the {width}x{height} pixels it claims"));
    }
    Ok(())
}

/// Transparency is left out; 16 bits are cut to 8.
fn png(bytes: &[u8]) -> Result<Texture, String> {
    let told = |error: png::DecodingError| format!("not a good PNG: {error}");
    let limits = png::Limits { bytes: 1 << 26 };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
    let mut reader = decoder.read_info().map_err(told)?;
    let info = reader.info();
    // Over such a one the decoder would panic.
    if info.palette.as_ref().is_some_and(|palette| !palette.len().is_multiple_of(3)) {
        return Err("not a good PNG: its palette ends within a colour".to_owned());
    }
    let (width, height) = (info.width as usize, info.height as usize);
    let bits = info.bits_per_pixel();
    let most = bytes.len().saturating_mul(MAX_INFLATION).saturating_mul(8) / bits;
    check_size(width, height, most)?;
    let channels = reader.output_color_type().0.samples();
    if info_is_interlaced(&reader) {
        let size = reader.output_buffer_size().ok_or("too large a picture")?;
        let mut all = vec![0; size];
        reader.next_frame(&mut all).map_err(told)?;
        return Ok(Texture::new(width as u32, all.chunks_exact(channels).map(rgb).collect()));
    }
    // Row by row: memory grows with what is there.
    let mut pixels = Vec::new();
    while let Some(row) = reader.next_row().map_err(told)? {
        pixels.extend(row.data().chunks_exact(channels).map(rgb));
    }
    if pixels.len() != width * height {
        return Err("not a good PNG: rows are missing".to_owned());
    }
    Ok(Texture::new(width as u32, pixels))
}

fn info_is_interlaced(reader: &png::Reader<Cursor<&[u8]>>) -> bool {
    reader.info().interlaced
}

/// One or two samples are a grey, three or four a colour.
fn rgb(samples: &[u8]) -> [u8; 3] {
    match *samples {
        [r, g, b, ..] => [r, g, b],
        [grey, ..] => [grey; 3],
        [] => [0; 3],
    }
}

/// Without instructions that some machines lack: the same pixels on all.
fn jpeg(bytes: &[u8]) -> Result<Texture, String> {
    let told = |error| format!("not a good JPEG: {error:?}");
    let options = DecoderOptions::default()
        .set_use_unsafe(false)
        .set_strict_mode(false)
        .set_max_width(MAX_SIDE)
        .set_max_height(MAX_SIDE)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(told)?;
    let (width, height) = decoder.dimensions().ok_or("not a good JPEG: it states no size")?;
    check_size(width, height, bytes.len().saturating_mul(MAX_PIXELS_A_BYTE))?;
    let samples = decoder.decode().map_err(told)?;
    let pixels = samples.as_chunks().0.to_vec();
    if pixels.len() != width * height {
        return Err("not a good JPEG: rows are missing".to_owned());
    }
    Ok(Texture::new(width as u32, pixels))
}
