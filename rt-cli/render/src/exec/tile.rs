//! Tiles: which pixels they have, and in what order.

use glam::Vec3;
use rt_kernels::Ray;
use rt_kernels::camera::Pinhole;

use crate::{Job, World};

/// Pixels along the side of a tile.
const TILE: u32 = 32;

/// A light in the world's scaled space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointLight {
    pub(crate) position: Vec3,
    pub(crate) color: Vec3,
    pub(crate) casts_shadows: bool,
}

/// What a thread needs to know of a tile.
pub(crate) struct TileJob<'a> {
    pub(crate) world: &'a World,
    pub(crate) job: &'a Job,
    pub(crate) camera: Pinhole,
    pub(crate) lights: &'a [PointLight],
    /// The distances from the eye to the nearest and the farthest point of the bounds.
    pub(crate) depth_range: (f32, f32),
    /// The pixels, in the order of their rays.
    pub(crate) pixels: Vec<(u32, u32)>,
}

/// The job's lights, or one at the eye, in the world's scaled space.
pub(crate) fn lights(world: &World, job: &Job) -> Vec<PointLight> {
    let headlight =
        PointLight { position: job.view.eye * world.scale, color: Vec3::ONE, casts_shadows: false };
    let lights: Vec<_> = job
        .lights
        .iter()
        .map(|light| PointLight {
            position: light.position * world.scale,
            color: light.color,
            casts_shadows: job.shadows,
        })
        .collect();
    if lights.is_empty() { vec![headlight] } else { lights }
}

/// The distances from a point to the nearest and the farthest point of the scene's bounds.
pub(crate) fn depth_range(world: &World, eye: Vec3) -> (f32, f32) {
    let (min, max) = (world.bounds().min() * world.scale, world.bounds().max() * world.scale);
    let nearest = eye.clamp(min, max);
    let farthest = (eye - min).abs().max((max - eye).abs());
    (eye.distance(nearest), farthest.length())
}

/// The upper left corners of all tiles.
pub(crate) fn tiles(width: u32, height: u32) -> Vec<(u32, u32)> {
    let rows = (0..height).step_by(TILE as usize);
    rows.flat_map(|y| (0..width).step_by(TILE as usize).map(move |x| (x, y))).collect()
}

/// The pixels of a tile along the Z curve (Morton 1966): 4 in a row are 2 by 2, 8 are 4 by 2, 16
/// are 4 by 4. So every packet size gets near neighbours from the same order.
pub(crate) fn pixels((left, top): (u32, u32), width: u32, height: u32) -> Vec<(u32, u32)> {
    (0..TILE * TILE)
        .map(|i| (left + even_bits(i), top + even_bits(i >> 1)))
        .filter(|&(x, y)| x < width && y < height)
        .collect()
}

/// The rays through the middles of pixels.
pub(crate) fn rays(camera: &Pinhole, pixels: &[(u32, u32)]) -> impl Iterator<Item = Ray> {
    pixels.iter().map(|&(x, y)| camera.ray(x as f32 + 0.5, y as f32 + 0.5))
}

/// The bits at even places of a number of up to 10 bits.
fn even_bits(i: u32) -> u32 {
    (0..5).map(|bit| (i >> (2 * bit) & 1) << bit).sum()
}

#[cfg(test)]
mod tests {
    use super::{pixels, tiles};

    #[test]
    fn every_pixel_is_in_one_tile_once() {
        for (width, height) in [(1, 1), (32, 32), (33, 31), (100, 7), (64, 65)] {
            let mut all: Vec<_> = tiles(width, height)
                .into_iter()
                .flat_map(|origin| pixels(origin, width, height))
                .collect();
            all.sort_unstable_by_key(|&(x, y)| (y, x));
            let want: Vec<_> = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).collect();
            assert_eq!(all, want);
        }
    }

    #[test]
    fn neighbours_in_order_are_neighbours_in_the_picture() {
        let order = pixels((0, 0), 32, 32);
        assert_eq!(order[..4], [(0, 0), (1, 0), (0, 1), (1, 1)]);
        assert_eq!(order[4..8], [(2, 0), (3, 0), (2, 1), (3, 1)]);
    }
}
