//! Normals for smoothing groups.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use crate::model::{Mesh, Triangle};

/// The sums of the normals of faces, by smoothing group and vertex.
#[derive(Default)]
pub(super) struct Smoothing {
    numbers: HashMap<(u32, u32), u32>,
    sums: Vec<DVec3>,
}

impl Smoothing {
    /// Takes a face of a group, in triangles, which get the numbers of normals that are not there yet
    /// and will follow those that are. Large faces count more.
    pub(super) fn add(
        &mut self,
        group: u32,
        positions: &[Vec3],
        first: usize,
        face: &mut [Triangle],
    ) {
        let at = |index: u32| positions[index as usize].as_dvec3();
        let normal = |triangle: &Triangle| {
            let [a, b, c] = triangle.position.map(at);
            (b - a).cross(c - a)
        };
        let sum: DVec3 = face.iter().map(normal).sum();
        let mut vertices: Vec<u32> = face.iter().flat_map(|triangle| triangle.position).collect();
        vertices.sort_unstable();
        vertices.dedup();
        for vertex in vertices {
            let next = self.sums.len() as u32;
            let number = *self.numbers.entry((group, vertex)).or_insert(next);
            if number == next {
                self.sums.push(DVec3::ZERO);
            }
            self.sums[number as usize] += sum;
        }
        for triangle in face {
            let number = |vertex| first as u32 + self.numbers[&(group, vertex)];
            triangle.normal = Some(triangle.position.map(number));
        }
    }

    /// Adds the normals. Where faces cancel each other there is none: a renderer takes the true one.
    pub(super) fn finish(self, mesh: &mut Mesh) {
        mesh.normals.extend(self.sums.iter().map(|sum| sum.normalize_or_zero().as_vec3()));
    }
}
