//! How much two pictures differ.

use glam::Vec3;

use crate::{Picture, Scale, srgb};

/// The difference of two pictures of one size. Numbers are on the scale of both: of light if both
/// are linear, else of sRGB, where 1 is the greatest code.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The scale that they were compared on.
    pub scale: Scale,
    /// The mean over pixels and channels of the squared difference.
    pub mse: f64,
    /// The greatest difference of a channel.
    pub max: f64,
    /// Column and row of the first pixel that has it; none if no pixel differs.
    pub worst: Option<(u32, u32)>,
    /// How many pixels differ at all.
    pub pixels: u64,
    /// How much each channel of each pixel differs.
    pub picture: Picture,
}

impl Difference {
    /// The peak signal-to-noise ratio in decibels, for a peak of 1: infinite if there is no
    /// difference.
    pub fn psnr(&self) -> f64 {
        // Not −10 · log10, which is −0 for an error of 1.
        10.0 * libm::log10(1.0 / self.mse)
    }
}

/// Compares two pictures; `None` if their sizes differ. What is not a number differs infinitely
/// from every number, and not from what is not one either.
pub fn compare(a: &Picture, b: &Picture) -> Option<Difference> {
    if (a.width, a.height) != (b.width, b.height) || a.pixels.len() != b.pixels.len() {
        return None;
    }
    let linear = a.scale == Scale::Linear && b.scale == Scale::Linear;
    let scale = if linear { Scale::Linear } else { Scale::Srgb };
    let on_scale = |picture: &Picture, value: f32| match picture.scale == scale {
        true => f64::from(value),
        false => srgb::encode(value.into()),
    };
    let (mut squares, mut max, mut worst, mut pixels) = (0.0, 0.0, None, 0);
    let mut picture = Picture {
        width: a.width,
        height: a.height,
        scale,
        pixels: Vec::with_capacity(a.pixels.len()),
    };
    for (i, (one, other)) in a.pixels.iter().zip(&b.pixels).enumerate() {
        let channel = |c: usize| apart(on_scale(a, one[c]), on_scale(b, other[c]));
        let apart = [channel(0), channel(1), channel(2)];
        picture.pixels.push(Vec3::from_array(apart.map(|x| x as f32)));
        let most = apart.into_iter().fold(0.0, f64::max);
        squares += apart.iter().map(|x| x * x).sum::<f64>();
        pixels += u64::from(most > 0.0);
        if most > max {
            let i = i as u32;
            (max, worst) = (most, Some((i % a.width, i / a.width)));
        }
    }
    let mse = squares / (3 * a.pixels.len()) as f64;
    Some(Difference { scale, mse, max, worst, pixels, picture })
}

fn apart(a: f64, b: f64) -> f64 {
    if a == b || (a.is_nan() && b.is_nan()) {
        return 0.0;
    }
    let apart = (a - b).abs();
    if apart.is_nan() { f64::INFINITY } else { apart }
}
