//! What decides the precision that a scene needs.

use glam::DVec3;
use rt_scene::Scene;

use crate::world::{bounds, corners};

/// Facts of a scene, in its own units, that do not depend on who looks at it.
///
/// A **feature** is what must not get lost in rounding: the least height of a triangle that has an
/// area, or the radius of a sphere.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Facts {
    /// Triangles, the degenerate ones and all.
    pub triangles: usize,
    /// Triangles without area.
    pub degenerate: usize,
    /// Triangles whose corners are those of an earlier one, in whatever order.
    pub duplicates: usize,
    /// Spheres. They stay curved: with any triangle test they are what they are.
    pub curved: usize,
    /// The greatest coordinate in magnitude.
    pub largest_coordinate: f64,
    /// The smallest feature, if there is any.
    pub smallest_feature: Option<f64>,
    /// The worst sliver: the greatest ratio of a triangle's longest edge to its least height.
    pub worst_aspect: Option<f64>,
    /// How many boxes of triangles a line through the scene meets on average, in any direction and
    /// at any place: what cannot be left out by any hierarchy.
    pub boxes_met: f64,
}

impl Facts {
    /// Looks a scene over.
    pub fn of(scene: &Scene) -> Facts {
        let mut facts = Facts {
            triangles: scene.mesh.triangles.len(),
            curved: scene.spheres.len() + scene.cones.len(),
            boxes_met: boxes_met(scene),
            ..Facts::default()
        };
        let mut keys = Vec::with_capacity(facts.triangles);
        for triangle in &scene.mesh.triangles {
            let points = corners(scene, triangle);
            for point in points {
                facts.coordinate(f64::from(point.abs().max_element()));
            }
            // Adding 0 makes −0 the same as 0.
            let mut key = points.map(|point| (point + 0.0).to_array().map(f32::to_bits));
            key.sort_unstable();
            keys.push(key);

            let [a, b, c] = points.map(|point| point.as_dvec3());
            let longest = (b - a).length().max((c - b).length()).max((a - c).length());
            let area = (b - a).cross(c - a).length();
            if area > 0.0 {
                let height = area / longest;
                facts.feature(height);
                let aspect = longest / height;
                facts.worst_aspect = Some(facts.worst_aspect.map_or(aspect, |x| x.max(aspect)));
            } else {
                facts.degenerate += 1;
            }
        }
        keys.sort_unstable();
        facts.duplicates = keys.windows(2).filter(|pair| pair[0] == pair[1]).count();
        for sphere in &scene.spheres {
            let radius = f64::from(sphere.radius);
            facts.coordinate(f64::from(sphere.center.abs().max_element()) + radius);
            facts.feature(radius);
        }
        for cone in &scene.cones {
            let [base, apex] = [cone.base_radius, cone.apex_radius].map(f64::from);
            let (low, high) = cone.bounds();
            facts.coordinate(low.abs().max(high.abs()).max_element().into());
            facts.feature(base.max(apex));
            facts.feature(cone.base.as_dvec3().distance(cone.apex.as_dvec3()));
        }
        facts
    }

    /// The largest coordinate in units of the smallest feature: how many digits coordinates need
    /// before they say anything.
    pub fn ratio(&self) -> Option<f64> {
        self.smallest_feature.map(|feature| self.largest_coordinate / feature)
    }

    fn coordinate(&mut self, coordinate: f64) {
        self.largest_coordinate = self.largest_coordinate.max(coordinate);
    }

    fn feature(&mut self, size: f64) {
        self.smallest_feature = Some(self.smallest_feature.map_or(size, |least| least.min(size)));
    }
}

/// By Crofton: of the lines that meet a convex body, those that meet another within it are as many
/// as its share of the surface.
pub(super) fn boxes_met(scene: &Scene) -> f64 {
    let half_area = |[low, high]: [DVec3; 2]| {
        let extent = high - low;
        extent.dot(DVec3::new(extent.y, extent.z, extent.x))
    };
    let boxes = scene.mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = corners(scene, triangle).map(|corner| corner.as_dvec3());
        half_area([a.min(b).min(c), a.max(b).max(c)])
    });
    let boxes: f64 = boxes.sum();
    let whole = bounds(scene);
    let whole = half_area([whole.min(), whole.max()].map(|corner| corner.as_dvec3()));
    // Without a surface nothing is met.
    if boxes > 0.0 { boxes / whole } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use rt_scene::{Sphere, Triangle};

    #[test]
    fn facts_are_those_of_the_scene() {
        let mut scene = Scene::default();
        let triangle = |position| Triangle { position, normal: None, uv: None, material: 0 };
        scene.mesh.positions = vec![
            Vec3::ZERO,
            Vec3::new(8.0, 0.0, 0.0),
            Vec3::new(4.0, 0.25, 0.0),
            Vec3::new(-0.0, -0.0, 0.0),
            Vec3::new(1e9, 0.0, 0.0),
        ];
        scene.mesh.triangles = [[0, 1, 2], [2, 3, 1], [0, 1, 1], [1, 2, 0]].map(triangle).to_vec();
        let facts = Facts::of(&scene);
        let want = Facts {
            triangles: 4,
            degenerate: 1,
            duplicates: 2,
            curved: 0,
            largest_coordinate: 8.0,
            smallest_feature: Some(0.25),
            worst_aspect: Some(32.0),
            // Three of them as large as the whole, and one without an area.
            boxes_met: 3.0,
        };
        assert_eq!(facts, want);
        assert_eq!(facts.ratio(), Some(32.0));

        let center = Vec3::new(0.0, -20.0, 0.0);
        scene.spheres.push(Sphere { center, radius: 0.125, material: 0 });
        let facts = Facts::of(&scene);
        assert_eq!((facts.curved, facts.largest_coordinate), (1, 20.125));
        assert_eq!((facts.smallest_feature, facts.ratio()), (Some(0.125), Some(161.0)));
        assert_eq!(Facts::of(&Scene::default()), Facts::default());
    }
}
