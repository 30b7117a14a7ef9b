//! A z-buffer rasteriser, as a yardstick: every triangle in turn, one sample in the middle of each
//! pixel, no shading. It is plain scalar code and nobody's best; what it shows is how the cost grows.

use glam::Vec3;

use crate::World;
use crate::fit::half_height;
use crate::job::{Job, RenderError};

/// The nearest depth of every pixel, as its reciprocal; 0 where nothing is.
pub struct ZBuffer {
    width: usize,
    height: usize,
    inverse: Vec<f32>,
}

impl ZBuffer {
    /// For a picture of that size.
    pub fn new((width, height): (u32, u32)) -> ZBuffer {
        let (width, height) = (width as usize, height as usize);
        ZBuffer { width, height, inverse: vec![0.0; width * height] }
    }

    /// How many pixels show something.
    pub fn covered(&self) -> usize {
        self.inverse.iter().filter(|inverse| **inverse > 0.0).count()
    }

    /// Draws all triangles of a world that are in front of the eye with all corners.
    ///
    /// # Errors
    /// If the camera looks nowhere.
    pub fn draw(&mut self, world: &World, job: &Job) -> Result<(), RenderError> {
        let view = &job.view;
        let (eye, target) = (view.eye * world.scale, view.target * world.scale);
        let looks =
            || RenderError::View("eye and target coincide, or up is along the line of sight");
        let forward = (target - eye).try_normalize().ok_or_else(looks)?;
        let right = forward.cross(view.up).try_normalize().ok_or_else(looks)?;
        let down = forward.cross(right);
        let pixels = self.height as f32 / (2.0 * half_height(view.fov_y));
        let middle = [self.width as f32 * 0.5, self.height as f32 * 0.5];
        self.inverse.fill(0.0);
        let project = |point: Vec3| {
            let seen = point - eye;
            let inverse = 1.0 / seen.dot(forward);
            let [x, y] = [seen.dot(right), seen.dot(down)].map(|side| side * inverse * pixels);
            [x + middle[0], y + middle[1], inverse]
        };
        for triangle in &world.scene.mesh.triangles {
            let corners = world.corners(triangle).map(project);
            if corners.iter().all(|[.., inverse]| *inverse > 0.0) {
                self.triangle(corners);
            }
        }
        Ok(())
    }

    /// Corners in pixels, with the reciprocals of their depths, which are linear in the picture.
    fn triangle(&mut self, [a, b, c]: [[f32; 3]; 3]) {
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 {
            return;
        }
        let [left, right] = range([a[0], b[0], c[0]], self.width);
        let [top, bottom] = range([a[1], b[1], c[1]], self.height);
        let scale = 1.0 / area;
        for y in top..bottom {
            let row = &mut self.inverse[y * self.width..][..self.width];
            let py = y as f32 + 0.5;
            for (x, nearest) in row.iter_mut().enumerate().take(right).skip(left) {
                let px = x as f32 + 0.5;
                let u = ((b[0] - px) * (c[1] - py) - (b[1] - py) * (c[0] - px)) * scale;
                let v = ((c[0] - px) * (a[1] - py) - (c[1] - py) * (a[0] - px)) * scale;
                let w = 1.0 - u - v;
                if u >= 0.0 && v >= 0.0 && w >= 0.0 {
                    *nearest = nearest.max(u * a[2] + v * b[2] + w * c[2]);
                }
            }
        }
    }
}

/// The pixels whose middles are between the least and the greatest of three places.
fn range(places: [f32; 3], pixels: usize) -> [usize; 2] {
    let [a, b, c] = places;
    let first = (a.min(b).min(c) - 0.5).ceil().max(0.0) as usize;
    let end = ((a.max(b).max(c) - 0.5).floor() + 1.0).max(0.0) as usize;
    [first.min(pixels), end.min(pixels)]
}
