//! A material with a picture on it.

use std::sync::{Arc, LazyLock};

use glam::{Vec2, Vec3};
use rt_scene::{ColorMap, Material, Texture};

use super::{Finish, Point, Shader};

/// A material whose diffuse reflectance is multiplied by a picture, repeated without end.
pub(crate) struct Textured {
    finish: Finish,
    map: ColorMap,
    texture: Arc<Texture>,
}

impl Textured {
    pub(crate) fn new(material: &Material, map: ColorMap, texture: Arc<Texture>) -> Textured {
        Textured { finish: Finish::from(material), map, texture }
    }
}

impl Shader for Textured {
    fn finish(&self, at: &Point) -> Finish {
        let color = bilinear(&self.texture, at.uv * self.map.scale + self.map.offset);
        Finish { diffuse: self.finish.diffuse * color, ..self.finish }
    }
}

/// The linear colour at texture coordinates, v upwards: the average of the four nearest pixels by
/// their distance. Coordinates that are not finite are 0.
fn bilinear(texture: &Texture, uv: Vec2) -> Vec3 {
    let (width, height) = (texture.width(), texture.height());
    let (left, right, x) = neighbours(uv.x, width);
    let (top, bottom, y) = neighbours(1.0 - uv.y, height);
    let (light, pixels) = (&*LIGHT, texture.pixels());
    let pixel = |column: u32, row: u32| {
        let [r, g, b] = pixels[(row * width + column) as usize];
        Vec3::new(light[r as usize], light[g as usize], light[b as usize])
    };
    let mix = |row| pixel(left, row) * (1.0 - x) + pixel(right, row) * x;
    mix(top) * (1.0 - y) + mix(bottom) * y
}

/// The pixels on both sides of a coordinate in a row of `count`, and how far it is from the first.
/// The middle of the first pixel is at half a pixel.
fn neighbours(coordinate: f32, count: u32) -> (u32, u32, f32) {
    // Within one picture first: what is left has all its digits. From 2^24 on there are none.
    let has_digits = coordinate.abs() < (1 << 24) as f32;
    let within = if has_digits { coordinate - floor(coordinate) as f32 } else { 0.0 };
    let place = within * count as f32 - 0.5;
    let floor = floor(place);
    let first = if floor < 0 { count - 1 } else { (floor as u32).min(count - 1) };
    let second = if first + 1 == count { 0 } else { first + 1 };
    (first, second, place - floor as f32)
}

/// The greatest integer that is not greater: of numbers up to 2^24, without the function that
/// [`f32::floor`] calls on CPUs that may lack the instruction.
fn floor(x: f32) -> i32 {
    let toward_zero = x as i32;
    toward_zero - i32::from(toward_zero as f32 > x)
}

/// The light of each 8-bit code of sRGB (IEC 61966-2-1). The power comes from the one library whose
/// bits are the same everywhere.
static LIGHT: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|code| {
        let code = code as f64 / 255.0;
        let light =
            if code <= 0.04045 { code / 12.92 } else { libm::pow((code + 0.055) / 1.055, 2.4) };
        light as f32
    })
});

#[cfg(test)]
mod tests {
    use super::*;

    /// Black, red; green, white: upper row first.
    fn four() -> Texture {
        Texture::new(2, vec![[0; 3], [255, 0, 0], [0, 255, 0], [255; 3]])
    }

    #[test]
    fn middles_of_pixels_have_their_colours() {
        let corners = [
            ([0.25, 0.75], Vec3::ZERO),
            ([0.75, 0.75], Vec3::X),
            ([0.25, 0.25], Vec3::Y),
            ([0.75, 0.25], Vec3::ONE),
        ];
        for ([u, v], want) in corners {
            for (du, dv) in [(0.0, 0.0), (1.0, -1.0), (-3.0, 1000.0)] {
                assert_eq!(bilinear(&four(), Vec2::new(u + du, v + dv)), want, "{u} {v} {du}");
            }
        }
    }

    #[test]
    fn between_them_it_is_a_mixture_also_across_the_border() {
        let mean = Vec3::new(0.5, 0.5, 0.25);
        for uv in [[0.5, 0.5], [0.0, 0.0], [1.0, 1.0], [-2.0, 0.5], [0.0, 7.5]] {
            assert_eq!(bilinear(&four(), Vec2::from_array(uv)), mean, "{uv:?}");
        }
        // A quarter of the way from black to red.
        assert_eq!(bilinear(&four(), Vec2::new(0.375, 0.75)), Vec3::X * 0.25);
        assert_eq!(bilinear(&four(), Vec2::new(0.125, 0.75)), Vec3::X * 0.25);
    }

    #[test]
    fn light_is_mixed_not_codes() {
        let grey = Texture::new(2, vec![[0; 3], [188; 3]]);
        let mean = bilinear(&grey, Vec2::new(0.5, 0.5)).x;
        assert!((mean - 0.25).abs() < 0.002, "{mean}");
    }

    #[test]
    fn no_coordinates_are_out_of_range() {
        for odd in [f32::NAN, f32::INFINITY, -f32::INFINITY, 1e38, -1e38, 16_777_215.5, -1e-45] {
            for uv in [Vec2::new(odd, 0.5), Vec2::new(0.5, odd), Vec2::splat(odd)] {
                assert!(bilinear(&four(), uv).is_finite(), "{uv}");
            }
        }
    }
}
