//! Pixels.

use glam::Vec3;
use rt_picture::srgb::encode8;
use rt_picture::{Picture, Scale};

/// A picture in linear colour, row by row from the upper left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    pixels: Vec<Vec3>,
}

impl Film {
    /// A black picture.
    pub(crate) fn new(width: u32, height: u32) -> Film {
        Film { width, height, pixels: vec![Vec3::ZERO; width as usize * height as usize] }
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The pixels, row by row.
    pub fn pixels(&self) -> &[Vec3] {
        &self.pixels
    }

    /// One pixel.
    ///
    /// # Panics
    /// If it is not within the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Vec3 {
        self.pixels[y as usize * self.width as usize + x as usize]
    }

    /// Sets one pixel.
    pub(crate) fn set(&mut self, x: u32, y: u32, color: Vec3) {
        self.pixels[y as usize * self.width as usize + x as usize] = color;
    }

    /// Red, green and blue of each pixel in 8-bit sRGB, rounded to nearest.
    pub fn to_srgb8(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|color| color.to_array().map(encode8)).collect()
    }

    /// The picture, ready to be written.
    pub fn into_picture(self) -> Picture {
        let Film { width, height, pixels } = self;
        Picture { width, height, scale: Scale::Linear, pixels }
    }
}
