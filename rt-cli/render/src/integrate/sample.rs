//! Where in its pixel each sample lies: a fixed pattern, another one for every pixel.
//!
//! The points of a pixel are a (0,2)-sequence: of the first 2^k of them there is one in each of the 2^k
//! boxes of any shape that halves of halves make. Pixels scramble it, each in its own way, so that what
//! is left of error is noise and no pattern.
//!
//! Source: Kollig, Keller, "Efficient Multidimensional Sampling", 2002: the sequence is the radical
//! inverse of van der Corput and that of Sobol', scrambled by exclusive or.

use rt_kernels::Ray;
use rt_kernels::camera::Pinhole;

/// The rays through that sample of each pixel, of `samples`; through the middle if there is but one.
pub(super) fn rays(
    camera: &Pinhole,
    pixels: &[(u32, u32)],
    sample: u32,
    samples: u32,
) -> impl Iterator<Item = Ray> {
    pixels.iter().map(move |&pixel| {
        let [x, y] = if samples == 1 { [0.5; 2] } else { place(pixel, sample) };
        camera.ray(pixel.0 as f32 + x, pixel.1 as f32 + y)
    })
}

/// Where a sample lies in its pixel: from 0 up to 1.
fn place((x, y): (u32, u32), sample: u32) -> [f32; 2] {
    let scramble = hash(x ^ hash(y ^ SEED));
    let first = sample.reverse_bits() ^ scramble;
    let second = sobol(sample) ^ hash(scramble);
    // 24 bits: all that a number below 1 holds.
    [first, second].map(|bits| (bits >> 8) as f32 / (1 << 24) as f32)
}

/// What all hashes begin with.
const SEED: u32 = 0x5eed_0001;

/// The second dimension of Sobol's sequence.
fn sobol(mut n: u32) -> u32 {
    let (mut sum, mut direction) = (0, 1 << 31);
    while n != 0 {
        if n & 1 == 1 {
            sum ^= direction;
        }
        n >>= 1;
        direction ^= direction >> 1;
    }
    sum
}

/// Every bit of the result depends on every bit of the argument (Wellons's "lowbias32").
fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ x >> 16
}

#[cfg(test)]
mod tests {
    use super::place;

    #[test]
    fn every_box_has_its_sample() {
        for pixel in [(0, 0), (1, 0), (0, 1), (511, 300), (65_535, 65_535)] {
            for k in 0..=8 {
                for columns in 0..=k {
                    let (width, height) = (1 << columns, 1 << (k - columns));
                    let mut boxes = vec![0; width * height];
                    for sample in 0..1 << k {
                        let [x, y] = place(pixel, sample);
                        assert!((0.0..1.0).contains(&x) && (0.0..1.0).contains(&y));
                        let column = (x * width as f32) as usize;
                        boxes[(y * height as f32) as usize * width + column] += 1;
                    }
                    assert!(boxes.iter().all(|&count| count == 1), "{pixel:?}, {width}x{height}");
                }
            }
        }
    }

    #[test]
    fn pixels_differ() {
        let mut places: Vec<_> =
            (0..1000).map(|i| place((i % 40, i / 40), 0).map(f32::to_bits)).collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), 1000);
    }
}
