//! Triangles for spheres, cones and cylinders, as the programs of the Standard Procedural Databases
//! make them.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec3;

use crate::diag::Error;
use crate::model::{Cone, Mesh, Scene, Sphere, Triangle};

/// The resolution at which the Standard Procedural Databases count their triangles: 192 for a
/// sphere and 32 for a cone or cylinder.
pub const SPD_RESOLUTION: u32 = 4;

/// No scene gets more triangles than this.
const MAX_TRIANGLES: u128 = 1 << 28;

/// Makes triangles of what is curved, with the normals of what they stand for. They follow those
/// that are there already: first of the spheres, then of the cones.
///
/// A sphere is a cube of `resolution`² squares a side, whose lines are great circles at equal
/// angles, blown up: 12 `resolution`² triangles. A cone or cylinder has 4 `resolution` sides of two
/// triangles, or of one where an end is a point. All triangles of one primitive share their
/// vertices, so a sphere is closed.
///
/// # Errors
/// If there would be more than 2^28 triangles.
///
/// # Panics
/// If `resolution` is zero.
pub fn tessellate(mut scene: Scene, resolution: u32) -> Result<Scene, Error> {
    assert!(resolution > 0, "a resolution of zero");
    let [flat, spheres, cones] =
        [scene.mesh.triangles.len(), scene.spheres.len(), scene.cones.len()]
            .map(|count| count as u128);
    let each = u128::from(resolution);
    if flat + 12 * each * each * spheres + 8 * each * cones > MAX_TRIANGLES {
        return Err(Error::TooFine { name: scene.name, resolution, limit: MAX_TRIANGLES });
    }
    if !scene.spheres.is_empty() {
        Ball::new(resolution).add_all(&mut scene.mesh, &scene.spheres);
        scene.spheres.clear();
    }
    let circle = Circle::new(resolution);
    for cone in scene.cones.drain(..) {
        circle.add(&mut scene.mesh, &cone);
    }
    Ok(scene)
}

/// A sphere of radius one about the origin.
struct Ball {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Ball {
    fn new(resolution: u32) -> Ball {
        // Where the lines cross an axis of the cube whose sides are at distance one.
        let angle = |line| FRAC_PI_4 * (2.0 * f64::from(line) / f64::from(resolution) - 1.0);
        let lines: Vec<f64> = (0..=resolution).map(|line| libm::tan(angle(line))).collect();
        let mut ball = Ball { points: Vec::new(), triangles: Vec::new() };
        let mut known = HashMap::new();
        for axis in 0..3 {
            for side in [0, resolution] {
                for u in 0..resolution {
                    for v in 0..resolution {
                        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(du, dv)| {
                            let mut place = [0; 3];
                            place[axis] = side;
                            // Turned such that the corners go round as seen from outside.
                            let (u_axis, v_axis) = if side > 0 { (1, 2) } else { (2, 1) };
                            place[(axis + u_axis) % 3] = u + du;
                            place[(axis + v_axis) % 3] = v + dv;
                            *known.entry(place).or_insert_with(|| {
                                let point = place.map(|line| lines[line as usize]);
                                ball.points.push(DVec3::from_array(point).normalize());
                                ball.points.len() as u32 - 1
                            })
                        });
                        let [a, b, c, d] = corners;
                        ball.triangles.extend([[a, b, c], [c, d, a]]);
                    }
                }
            }
        }
        ball
    }

    fn add_all(&self, mesh: &mut Mesh, spheres: &[Sphere]) {
        let first_normal = mesh.normals.len() as u32;
        mesh.normals.extend(self.points.iter().map(|point| point.as_vec3()));
        mesh.positions.reserve_exact(spheres.len() * self.points.len());
        mesh.triangles.reserve_exact(spheres.len() * self.triangles.len());
        for sphere in spheres {
            let first = mesh.positions.len() as u32;
            let (center, radius) = (sphere.center.as_dvec3(), f64::from(sphere.radius));
            let on_sphere = |&point: &DVec3| (center + point * radius).as_vec3();
            mesh.positions.extend(self.points.iter().map(on_sphere));
            mesh.triangles.extend(self.triangles.iter().map(|corners| Triangle {
                position: corners.map(|corner| first + corner),
                normal: Some(corners.map(|corner| first_normal + corner)),
                uv: None,
                material: sphere.material,
            }));
        }
    }
}

/// Cosines and sines of equal angles all around.
struct Circle(Vec<(f64, f64)>);

impl Circle {
    fn new(resolution: u32) -> Circle {
        let angle = |side| f64::from(side) / f64::from(resolution) * FRAC_PI_2;
        let turn = |side| (libm::cos(angle(side)), libm::sin(angle(side)));
        Circle((0..4 * resolution).map(turn).collect())
    }

    fn add(&self, mesh: &mut Mesh, cone: &Cone) {
        let (base, apex) = (cone.base.as_dvec3(), cone.apex.as_dvec3());
        let axis = (apex - base).normalize();
        let start = [DVec3::Z, DVec3::X].map(|other| axis.cross(other));
        let start = if start[0].length() > 1e-6 { start[0] } else { start[1] }.normalize();
        let across = axis.cross(start);
        let ways: Vec<_> = self.0.iter().map(|(cos, sin)| start * *cos + across * *sin).collect();

        let (base_radius, apex_radius) = (f64::from(cone.base_radius), f64::from(cone.apex_radius));
        let lean: DVec3 = axis * ((base_radius - apex_radius) / (apex - base).length());
        let first_normal = mesh.normals.len() as u32;
        mesh.normals.extend(ways.iter().map(|&way| (way + lean).normalize().as_vec3()));
        let mut end = |center: DVec3, radius: f64| {
            let first = mesh.positions.len() as u32;
            let count = if radius > 0.0 { ways.len() } else { 1 };
            let points = ways[..count].iter().map(|&way| (center + way * radius).as_vec3());
            mesh.positions.extend(points);
            move |side: u32| first + side % count as u32
        };
        let (base, apex) = (end(base, base_radius), end(apex, apex_radius));
        let sides = ways.len() as u32;
        for side in 0..sides {
            let next = side + 1;
            let normal = |side: u32| first_normal + side % sides;
            let mut add = |position, normals: [u32; 3]| {
                let normal = Some(normals.map(normal));
                mesh.triangles.push(Triangle {
                    position,
                    normal,
                    uv: None,
                    material: cone.material,
                });
            };
            if base_radius > 0.0 {
                add([base(side), base(next), apex(next)], [side, next, next]);
            }
            if apex_radius > 0.0 {
                add([base(side), apex(next), apex(side)], [side, next, side]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn nobody_gets_more_than_the_limit() {
        let sphere = Sphere { center: Vec3::ZERO, radius: 1.0, material: 0 };
        let scene = |n| Scene { spheres: vec![sphere; n], ..Scene::default() };
        assert_eq!(tessellate(scene(1), 2).unwrap().mesh.triangles.len(), 48);
        for (spheres, resolution) in [(1, 4730), (2, u32::MAX), (23_000, 32)] {
            let result = tessellate(scene(spheres), resolution);
            assert!(matches!(result, Err(Error::TooFine { .. })), "{spheres}, {resolution}");
        }
    }
}
