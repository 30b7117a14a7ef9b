//! Tiles: which pixels they have, and in what order.

use glam::Vec3;
use rt_kernels::camera::Pinhole;

use crate::{Crop, Job, World};

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

/// The squares that a job is done in. They lie on one grid over the whole picture, whatever is cut
/// out of it.
#[derive(Clone, Copy, Debug)]
pub struct Tiles {
    area: Crop,
    /// Of the grid, the first column and how many.
    columns: (u32, u32),
    /// The first row and how many.
    rows: (u32, u32),
}

impl Tiles {
    /// Those of a job whose crop is within its picture.
    pub fn of(job: &Job) -> Tiles {
        let area = job.area();
        let span = |start: u32, len: u32| {
            let first = start / TILE;
            (first, (start + len).div_ceil(TILE) - first)
        };
        Tiles { area, columns: span(area.left, area.width), rows: span(area.top, area.height) }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.columns.1 as usize * self.rows.1 as usize
    }

    /// Whether there are none: never, of a job that can be done.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The pixels of each of them.
    pub fn all(self) -> impl Iterator<Item = Vec<(u32, u32)>> {
        (0..self.len() as u32).map(move |index| self.pixels(index))
    }

    /// The pixels of one of them, of which there are none beyond the last. They are in the order of
    /// the Z curve (Morton 1966): 4 in a row are 2 by 2, 8 are 4 by 2, 16 are 4 by 4. So every packet
    /// size gets near neighbours from the same order.
    pub fn pixels(&self, index: u32) -> Vec<(u32, u32)> {
        if index as usize >= self.len() {
            return Vec::new();
        }
        let left = (self.columns.0 + index % self.columns.1) * TILE;
        let top = (self.rows.0 + index / self.columns.1) * TILE;
        let columns = self.area.left..self.area.left + self.area.width;
        let rows = self.area.top..self.area.top + self.area.height;
        (0..TILE * TILE)
            .map(|i| (left + even_bits(i), top + even_bits(i >> 1)))
            .filter(|(x, y)| columns.contains(x) && rows.contains(y))
            .collect()
    }
}

/// The bits at even places of a number of up to 10 bits.
fn even_bits(i: u32) -> u32 {
    (0..5).map(|bit| (i >> (2 * bit) & 1) << bit).sum()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use rt_kernels::Exec;

    use super::Tiles;
    use crate::{Crop, Job};

    fn tiles(size: (u32, u32), crop: Option<Crop>) -> Tiles {
        let view = rt_scene::View {
            eye: Vec3::Z,
            target: Vec3::ZERO,
            up: Vec3::Y,
            fov_y: 40.0,
            size: None,
        };
        Tiles::of(&Job {
            size,
            crop,
            view,
            lights: Vec::new(),
            background: Vec3::ZERO,
            integrator: Default::default(),
            samples: 1,
            depth: 0,
            shadows: false,
            relaxed: false,
            exec: Exec::best().expect("a level"),
            threads: 1,
        })
    }

    #[test]
    fn every_pixel_is_in_one_tile_once() {
        for size in [(1, 1), (32, 32), (33, 31), (100, 7), (64, 65)] {
            let (width, height) = size;
            let whole = Crop { left: 0, top: 0, width, height };
            let right =
                Crop { left: width - 1, top: height / 2, width: 1, height: height.div_ceil(2) };
            let middle =
                Crop { left: width / 3, top: height / 5, width: width.div_ceil(2), height: 1 };
            for crop in [None, Some(whole), Some(right), Some(middle)] {
                let Crop { left, top, width, height } = crop.unwrap_or(whole);
                let tiles = tiles(size, crop);
                let mut all: Vec<_> = tiles.all().flatten().collect();
                all.sort_unstable_by_key(|&(x, y)| (y, x));
                let row = |y| (left..left + width).map(move |x| (x, y));
                let want: Vec<_> = (top..top + height).flat_map(row).collect();
                assert_eq!(all, want);
                assert_eq!(tiles.pixels(tiles.len() as u32), []);
                assert_eq!(tiles.pixels(u32::MAX), []);
            }
        }
    }

    #[test]
    fn neighbours_in_order_are_neighbours_in_the_picture() {
        let order = tiles((32, 32), None).pixels(0);
        assert_eq!(order[..4], [(0, 0), (1, 0), (0, 1), (1, 1)]);
        assert_eq!(order[4..8], [(2, 0), (3, 0), (2, 1), (3, 1)]);
    }
}
