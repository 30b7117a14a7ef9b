//! Pixels.

use std::sync::LazyLock;

use glam::Vec3;

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

    /// Sets one pixel.
    pub(crate) fn set(&mut self, x: u32, y: u32, color: Vec3) {
        self.pixels[y as usize * self.width as usize + x as usize] = color;
    }

    /// Red, green and blue of each pixel in 8-bit sRGB, rounded to nearest.
    pub fn to_srgb8(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|color| color.to_array().map(srgb8)).collect()
    }
}

/// One linear channel as 8-bit sRGB; NaN is black.
fn srgb8(linear: f32) -> u8 {
    STARTS.partition_point(|start| *start <= linear) as u8
}

/// The linear values at which the codes 1, 2, …, 255 begin: half a code before the code itself.
/// (IEC 61966-2-1. The power comes from the one library whose bits are the same everywhere.)
static STARTS: LazyLock<[f32; 255]> = LazyLock::new(|| {
    std::array::from_fn(|i| {
        let code = (i as f64 + 0.5) / 255.0;
        let linear =
            if code <= 0.04045 { code / 12.92 } else { libm::pow((code + 0.055) / 1.055, 2.4) };
        linear as f32
    })
});

#[cfg(test)]
mod tests {
    use super::srgb8;

    #[test]
    fn srgb_has_its_known_values() {
        let known = [(0.0, 0), (1.0, 255), (0.5, 188), (0.2158605, 128), (0.0031308, 10)];
        for (linear, code) in known {
            assert_eq!(srgb8(linear), code, "{linear}");
        }
        assert_eq!(srgb8(f32::NAN), 0);
        assert_eq!(srgb8(-1.0), 0);
        assert_eq!(srgb8(f32::INFINITY), 255);
    }
}
