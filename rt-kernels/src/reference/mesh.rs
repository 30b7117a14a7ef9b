//! Closed meshes with shared vertices.

use std::collections::{BTreeMap, HashMap};

use crate::Primitives;
use crate::geom::Triangle;
use glam::{DVec3, Vec3};

/// Triangles by the indices of their corners.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// The vertices.
    pub vertices: Vec<Vec3>,
    /// Each face's corners, counterclockwise from outside.
    pub faces: Vec<[u32; 3]>,
}

impl Mesh {
    /// A sphere of radius 1 about the origin: an icosahedron whose faces are split in four, so many
    /// times over.
    pub fn icosphere(splits: u32) -> Mesh {
        let golden = (1.0 + 5f64.sqrt()) / 2.0;
        let corner = |i: usize| {
            let (a, b) = (1.0 - (i & 1) as f64 * 2.0, golden * (1.0 - (i >> 1 & 1) as f64 * 2.0));
            [DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)][i >> 2]
        };
        let mut points: Vec<DVec3> = (0..12).map(|i| corner(i).normalize()).collect();
        // The corners of a face are the least distance apart.
        let near = |a: usize, b: usize| points[a].dot(points[b]) > 0.4;
        let mut faces = Vec::new();
        for a in 0..12 {
            for b in a + 1..12 {
                for c in (b + 1..12).filter(|&c| near(a, b) && near(b, c) && near(c, a)) {
                    let outward = points[a].cross(points[b]).dot(points[c]) > 0.0;
                    faces.push(if outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
        for _ in 0..splits {
            let mut middles = HashMap::new();
            let mut middle = |a: usize, b: usize| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    points.push((points[a] + points[b]).normalize());
                    points.len() - 1
                })
            };
            let split = |[a, b, c]: [usize; 3]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            };
            faces = faces.into_iter().flat_map(split).collect();
        }
        Mesh {
            vertices: points.iter().map(|point| point.as_vec3()).collect(),
            faces: faces.into_iter().map(|face| face.map(|i| i as u32)).collect(),
        }
    }

    /// The cube from −1 to 1, each side in `cells` by `cells` squares of two triangles.
    pub fn cube(cells: i32) -> Mesh {
        let (mut vertices, mut faces) = (Vec::new(), Vec::new());
        let mut index = HashMap::new();
        let mut vertex = |at: [i32; 3]| {
            *index.entry(at).or_insert_with(|| {
                vertices.push(Vec3::from_array(at.map(|i| (2 * i - cells) as f32 / cells as f32)));
                vertices.len() as u32 - 1
            })
        };
        for (axis, side) in [(0, 0), (0, cells), (1, 0), (1, cells), (2, 0), (2, cells)] {
            for (u, v) in (0..cells).flat_map(|u| (0..cells).map(move |v| (u, v))) {
                let mut corner = |du, dv| {
                    let mut at = [side; 3];
                    (at[(axis + 1) % 3], at[(axis + 2) % 3]) = (u + du, v + dv);
                    vertex(at)
                };
                let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                let quad = if side == 0 { [a, d, c, b] } else { [a, b, c, d] };
                faces.push([quad[0], quad[1], quad[2]]);
                faces.push([quad[0], quad[2], quad[3]]);
            }
        }
        Mesh { vertices, faces }
    }

    /// The mesh with every vertex where `place` puts it.
    #[must_use]
    pub fn map(mut self, place: impl FnMut(Vec3) -> Vec3) -> Mesh {
        self.vertices = self.vertices.into_iter().map(place).collect();
        self
    }

    /// Each edge once, by the indices of its ends.
    ///
    /// # Panics
    /// If the mesh is not closed: if an edge is not one of exactly two faces.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let mut uses = BTreeMap::new();
        for &[a, b, c] in &self.faces {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *uses.entry([from.min(to), from.max(to)]).or_insert(0) += 1;
            }
        }
        assert!(uses.values().all(|&faces| faces == 2), "the mesh is not closed");
        uses.into_keys().collect()
    }

    /// The corners of a face.
    pub fn corners(&self, face: usize) -> [Vec3; 3] {
        self.faces[face].map(|i| self.vertices[i as usize])
    }

    /// All faces as triangles.
    pub fn primitives(&self) -> Primitives {
        let triangle = |face| Triangle { corners: self.corners(face) };
        Primitives {
            triangles: (0..self.faces.len()).map(triangle).collect(),
            ..Primitives::default()
        }
    }
}
