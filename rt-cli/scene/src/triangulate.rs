//! Polygons to triangles: ears are cut in the plane, vertices stay where they are.
//!
//! A simple polygon with n corners gives n-2 triangles that turn the way it does, and every corner
//! is a corner of some triangle: a corner in the middle of a straight edge, left out, would be a
//! gap between this polygon and its neighbour.
//!
//! Method: Meisters, "Polygons Have Ears", American Mathematical Monthly 82(6), 1975, in the crate
//! `earcut`; Newell's normal says which way the polygon turns and which coordinate to drop.

use std::collections::BTreeMap;

use earcut::Earcut;
use glam::{DVec2, DVec3, Vec3};

use crate::model::Skipped;

/// Indices of corners.
type Corners = [u32; 3];

const FAN: [Corners; 2] = [[0, 1, 2], [0, 2, 3]];
const CROSS_FAN: [Corners; 2] = [[0, 1, 3], [1, 2, 3]];

/// Triangulates polygons one by one, and counts what it could not make.
pub(crate) struct Triangulator {
    earcut: Earcut<f64>,
    space: Vec<DVec3>,
    plane: Vec<[f64; 2]>,
    ears: Vec<u32>,
    triangles: Vec<Corners>,
    lost: u64,
}

impl Triangulator {
    pub(crate) fn new() -> Self {
        Triangulator {
            earcut: Earcut::new(),
            space: Vec::new(),
            plane: Vec::new(),
            ears: Vec::new(),
            triangles: Vec::new(),
            lost: 0,
        }
    }

    /// The triangles of a polygon, as indices into its corners (three or more).
    pub(crate) fn polygon(&mut self, corners: &[Vec3]) -> &[Corners] {
        self.triangles.clear();
        if corners.len() == 3 {
            self.triangles.push([0, 1, 2]);
            return &self.triangles;
        }
        let origin = corners[0].as_dvec3();
        self.space.clear();
        self.space.extend(corners.iter().map(|corner| corner.as_dvec3() - origin));
        if corners.len() == 4 {
            self.triangles.extend(quad(&self.space));
        } else {
            self.cut_ears();
        }
        let wanted = corners.len() - 2;
        if self.triangles.len() < wanted {
            self.mend();
        }
        self.lost += wanted.saturating_sub(self.triangles.len()) as u64;
        &self.triangles
    }

    /// What could not be made so far.
    pub(crate) fn skipped(&self) -> Option<Skipped> {
        (self.lost > 0).then(|| Skipped {
            what: "triangle".to_owned(),
            why: "its polygon has no area or crosses itself".to_owned(),
            count: self.lost,
        })
    }

    fn cut_ears(&mut self) {
        // Dropping a coordinate, unlike turning, rounds nothing: what is straight stays straight.
        let normal = newell(&self.space);
        let size = normal.abs();
        let flat: fn(&DVec3) -> [f64; 2] = if size.z >= size.x && size.z >= size.y {
            if normal.z < 0.0 { |p| [p.y, p.x] } else { |p| [p.x, p.y] }
        } else if size.y >= size.x {
            if normal.y < 0.0 { |p| [p.x, p.z] } else { |p| [p.z, p.x] }
        } else {
            if normal.x < 0.0 { |p| [p.z, p.y] } else { |p| [p.y, p.z] }
        };
        self.plane.clear();
        self.plane.extend(self.space.iter().map(flat));
        self.earcut.earcut_slice(&self.plane, &[], &mut self.ears);
        // The polygon is counterclockwise in the plane, the ears come out clockwise.
        self.triangles.extend(self.ears.as_chunks().0.iter().map(|&[a, b, c]| [c, b, a]));
    }

    /// Puts back the corners that the ear cutter took for superfluous: a run of them leaves a hole
    /// without area beside one long edge, whose triangle is replaced by a fan.
    fn mend(&mut self) {
        let mut long_edges = self.open_edges();
        let mut holes = Vec::new();
        let count = self.plane.len() as u32;
        for edge in (0..count).map(|corner| (corner, (corner + 1) % count)) {
            if long_edges.remove(&edge).is_none() {
                holes.push(edge);
            }
        }
        holes.extend(long_edges.keys().map(|&(a, b)| (b, a)));
        for hole in cycles(&holes) {
            self.fill(&hole, &mut long_edges);
        }
    }

    /// The directed edges of the triangles that no other triangle has the other way round.
    fn open_edges(&self) -> BTreeMap<(u32, u32), usize> {
        let mut open = BTreeMap::new();
        for (index, &[a, b, c]) in self.triangles.iter().enumerate() {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if open.remove(&(to, from)).is_none() {
                    open.insert((from, to), index);
                }
            }
        }
        open
    }

    /// Fans out the triangle at the hole's longest edge over the hole's other edges, unless that
    /// would turn a triangle over.
    fn fill(&mut self, hole: &[(u32, u32)], long_edges: &mut BTreeMap<(u32, u32), usize>) {
        let point = |corner: u32| DVec2::from(self.plane[corner as usize]);
        let length = |&&(a, b): &&(u32, u32)| point(a).distance_squared(point(b));
        let longest = hole
            .iter()
            .filter(|&&(a, b)| long_edges.contains_key(&(b, a)))
            .max_by(|a, b| length(a).total_cmp(&length(b)));
        let Some(&longest) = longest else { return };
        let index = long_edges[&(longest.1, longest.0)];
        let apex = self.triangles[index].into_iter().find(|&c| c != longest.0 && c != longest.1);
        let Some(apex) = apex else { return };
        let turns_over = |&(a, b): &(u32, u32)| {
            (point(b) - point(a)).perp_dot(point(apex) - point(a)) < 0.0
        };
        let rim = hole.iter().filter(|&&edge| edge != longest);
        if rim.clone().any(turns_over) {
            return;
        }
        for (nth, &(a, b)) in rim.enumerate() {
            let slot = if nth == 0 { index } else { self.triangles.len() };
            self.triangles.resize(self.triangles.len().max(slot + 1), [0; 3]);
            self.triangles[slot] = [a, b, apex];
            for edge in [(b, apex), (apex, a)] {
                long_edges.entry(edge).and_modify(|triangle| *triangle = slot);
            }
        }
    }
}

/// A quadrilateral along its first diagonal, or along the other if only that lies inside.
fn quad(corners: &[DVec3]) -> [Corners; 2] {
    let normal = newell(corners);
    let area = |[a, b, c]: Corners| {
        let [a, b, c] = [a, b, c].map(|corner| corners[corner as usize]);
        (b - a).cross(c - a).dot(normal)
    };
    let worse = |[first, second]: [Corners; 2]| area(first).min(area(second));
    if worse(FAN) <= 0.0 && worse(CROSS_FAN) > worse(FAN) { CROSS_FAN } else { FAN }
}

/// Twice the area times the unit normal of a polygon, plane or nearly so. Its first corner is the
/// origin.
fn newell(corners: &[DVec3]) -> DVec3 {
    corners.windows(2).map(|edge| edge[0].cross(edge[1])).sum()
}

/// Chains directed edges to closed walks that pass no corner twice.
fn cycles(edges: &[(u32, u32)]) -> Vec<Vec<(u32, u32)>> {
    let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &(from, to) in edges {
        next.entry(from).or_default().push(to);
    }
    let mut found = Vec::new();
    let mut place = BTreeMap::new();
    for &(start, _) in edges {
        let mut walk: Vec<(u32, u32)> = Vec::new();
        let mut at = start;
        while let Some(to) = next.get_mut(&at).and_then(Vec::pop) {
            place.insert(at, walk.len());
            walk.push((at, to));
            at = to;
            if let Some(&first) = place.get(&at) {
                let cycle = walk.split_off(first);
                cycle.iter().for_each(|(from, _)| drop(place.remove(from)));
                found.push(cycle);
            }
        }
        place.clear();
    }
    found
}
