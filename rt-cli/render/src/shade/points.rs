//! Points of all materials, component by component, so that any number of lanes loads them.

use glam::Vec3;

use super::{Finish, Surface};

/// Columns are as long as this many lanes need.
const LANES: usize = 16;

/// What Phong's model needs to know of points.
#[derive(Default)]
pub(crate) struct Points {
    len: usize,
    pub(super) leave: [Vec<f32>; 3],
    pub(super) true_normal: [Vec<f32>; 3],
    pub(super) normal: [Vec<f32>; 3],
    pub(super) dir: [Vec<f32>; 3],
    /// Reflectance times the weight of the point in its pixel.
    pub(super) diffuse: [Vec<f32>; 3],
    pub(super) specular: [Vec<f32>; 3],
    pub(super) shininess: Vec<f32>,
}

impl Points {
    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// Removes all and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.len = 0;
        self.vectors().into_iter().flatten().for_each(Vec::clear);
        self.shininess.clear();
    }

    /// Adds one, which contributes `weight` to its pixel.
    pub(crate) fn push(&mut self, surface: &Surface, finish: &Finish, weight: Vec3) {
        let vectors = [
            surface.leave,
            surface.point.true_normal,
            finish.normal,
            surface.point.dir,
            weight * finish.diffuse,
            weight * finish.specular,
        ];
        for (columns, vector) in self.vectors().into_iter().zip(vectors) {
            for (column, x) in columns.iter_mut().zip(vector.to_array()) {
                column.push(x);
            }
        }
        self.shininess.push(finish.shininess);
        self.len += 1;
    }

    /// Fills up the last lanes.
    pub(crate) fn pad(&mut self) {
        let len = self.len.next_multiple_of(LANES);
        self.vectors().into_iter().flatten().for_each(|column| column.resize(len, 0.0));
        self.shininess.resize(len, 0.0);
    }

    fn vectors(&mut self) -> [&mut [Vec<f32>; 3]; 6] {
        [
            &mut self.leave,
            &mut self.true_normal,
            &mut self.normal,
            &mut self.dir,
            &mut self.diffuse,
            &mut self.specular,
        ]
    }
}

/// What a light does to points.
#[derive(Default)]
pub(crate) struct Lit {
    pub(super) to_light: [Vec<f32>; 3],
    pub(super) distance: Vec<f32>,
    pub(super) added: [Vec<f32>; 3],
}

impl Lit {
    /// Makes room for that many points.
    pub(super) fn resize(&mut self, points: usize) {
        let len = points.next_multiple_of(LANES);
        let columns = self.to_light.iter_mut().chain(&mut self.added);
        columns.chain([&mut self.distance]).for_each(|column| column.resize(len, 0.0));
    }

    /// The direction of the light from a point, of unit length.
    pub(crate) fn to_light(&self, i: usize) -> Vec3 {
        at(&self.to_light, i)
    }

    /// How far the light is from a point.
    pub(crate) fn distance(&self, i: usize) -> f32 {
        self.distance[i]
    }

    /// What the light adds to the pixel of a point.
    pub(crate) fn added(&self, i: usize) -> Vec3 {
        at(&self.added, i)
    }
}

fn at([x, y, z]: &[Vec<f32>; 3], i: usize) -> Vec3 {
    Vec3::new(x[i], y[i], z[i])
}
