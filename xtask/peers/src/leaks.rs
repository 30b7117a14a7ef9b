//! Rays from inside a closed mesh, aimed exactly at what triangles share: none may get out.

use glam::Vec3;
use rt_kernels::reference::aim;
use rt_kernels::reference::mesh::Mesh as Ball;
use rt_kernels::reference::random::Random;
use rt_kernels::{Plan, Ray, Sequential};
use serde::{Deserialize, Serialize};

use crate::mesh::Mesh;
use crate::peers::{self, Embree, Isa, Ours};
use crate::rays::{Kind, Work};

/// How many rays of a family one way loses.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Leak {
    pub(crate) peer: String,
    pub(crate) mode: String,
    pub(crate) isa: Isa,
    /// Where the mesh is, and how large.
    pub(crate) place: String,
    pub(crate) family: Family,
    pub(crate) rays: usize,
    pub(crate) leaks: usize,
}

/// What rays are aimed at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Family {
    /// Points of edges.
    Edge,
    /// Vertices.
    Vertex,
    /// Vertices, along an axis.
    Axis,
}

impl Family {
    pub(crate) const ALL: [Family; 3] = [Family::Edge, Family::Vertex, Family::Axis];
}

/// Where the ball is, and its radius.
pub(crate) const PLACES: [(&str, Vec3, f32); 3] = [
    ("at the origin", Vec3::ZERO, 1.0),
    ("1000 away", Vec3::new(1000.0, 0.0, 0.0), 1.0),
    ("scaled by 0.001", Vec3::ZERO, 1e-3),
];

/// Lets everyone trace that many rays of each family, at each place.
pub(crate) fn measure(
    embree: Embree,
    plan: Plan,
    isa: Isa,
    rays: usize,
) -> Result<Vec<Leak>, String> {
    let mut leaks = Vec::new();
    for (place, center, radius) in PLACES {
        let ball = Ball::icosphere(6).map(|vertex| vertex * radius + center);
        let mesh = Mesh::of(&ball);
        let ours = Ours::build(&peers::primitives(&mesh)?, plan, &Sequential)?;
        let peers = peers::all(&ours, embree, &mesh, isa)?;
        for family in Family::ALL {
            let rays = aimed(&ball, family, center, 0.9 * radius, rays);
            let work = Work { kind: Kind::Primary, order: "", rays };
            for mut way in peers.iter().flat_map(|peer| peer.ways(&work)) {
                way.reset();
                way.run();
                let mode = way.mode();
                leaks.push(Leak {
                    peer: mode.peer.clone(),
                    mode: mode.name.clone(),
                    isa,
                    place: place.to_owned(),
                    family,
                    rays: work.rays.len(),
                    leaks: way.hits().iter().filter(|hit| hit.is_none()).count(),
                });
            }
        }
    }
    Ok(leaks)
}

/// Rays from within `inside` of the centre.
fn aimed(ball: &Ball, family: Family, center: Vec3, inside: f32, rays: usize) -> Vec<Ray> {
    let edges = ball.edges();
    let mut random = Random::new(11);
    let at = |i: u32| ball.vertices[i as usize];
    let ray = |i: usize| {
        let target = match family {
            Family::Edge => {
                let [a, b] = random.pick(&edges);
                aim::between(at(a), at(b), if i.is_multiple_of(4) { 0.5 } else { random.unit() })
            }
            Family::Vertex | Family::Axis => random.pick(&ball.vertices),
        };
        let origin = if family == Family::Axis {
            let axis = (target - center).abs().max_position();
            let mut origin = target;
            origin[axis] = center[axis];
            origin
        } else {
            // The centre, a point of a coarse grid, or any.
            let offset = match random.below(4) {
                0 => Vec3::ZERO,
                1 => (random.in_cube() * 2.0).round() * 0.25,
                _ => random.in_ball() * 0.9,
            };
            center + offset * inside
        };
        aim::at(origin, target)
    };
    (0..rays).map(ray).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rt_kernels::{Accelerator, Bvh};

    #[test]
    fn all_are_aimed_from_inside_and_ours_loses_none() {
        for (place, center, radius) in PLACES {
            let ball = Ball::icosphere(3).map(|vertex| vertex * radius + center);
            let bvh = Bvh::build(&ball.primitives(), &Sequential).expect("in range");
            for family in Family::ALL {
                for ray in aimed(&ball, family, center, 0.9 * radius, 500) {
                    let far = (ray.at(1.0) - center).length();
                    assert!((ray.origin - center).length() < radius, "{place} {family:?} {ray:?}");
                    assert!(far > 0.95 * radius, "{place} {family:?} {ray:?}");
                    assert!(bvh.occluded(&ray), "{place} {family:?} {ray:?}");
                }
            }
        }
    }
}
