//! A closed mesh, and rays from inside.
//!
//! The mesh is a ball of 320 triangles with every vertex pushed in or out a little, or that ball
//! squeezed. Rays are aimed, as exactly as rounding lets them, at what triangles share. Each batch
//! takes one edge and all triangles that touch it.

use std::sync::OnceLock;

use glam::{DVec3, Vec3};
use rt_kernels::Ray;
use rt_kernels::geom::Triangle;

use super::{Batch, TriangleFamily};
use crate::place::Place;
use crate::{BATCH, Facts, Kind, Setting};
use rt_kernels::reference::aim;
use rt_kernels::reference::mesh::Mesh;
use rt_kernels::reference::random::Random;

pub(super) const EDGE: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "edge",
        about: "rays aimed at points of an edge that two triangles share",
        kind: Kind::Closed,
        fair: true,
        setting: Setting::UNIT,
    },
    make: |random, place| aimed(random, place, ROUND, Aim::Edge),
};

pub(super) const VERTEX: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "vertex",
        about: "rays aimed at a vertex that five or six triangles share",
        kind: Kind::Closed,
        fair: true,
        setting: Setting::UNIT,
    },
    make: |random, place| aimed(random, place, ROUND, Aim::Vertex),
};

pub(super) const AXIS: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "axis",
        about: "rays along an axis, exactly at a vertex or a point of an edge, with zeros of both signs",
        kind: Kind::Closed,
        fair: true,
        setting: Setting::UNIT,
    },
    make: |random, place| aimed(random, place, ROUND, Aim::Axis),
};

pub(super) const FAR: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "far",
        about: "edges and vertices of a mesh of size 2 that is 220,000 from the world's origin",
        kind: Kind::Closed,
        fair: true,
        setting: Setting { offset: 2.2e5, ..Setting::UNIT },
    },
    make: |random, place| aimed(random, place, ROUND, Aim::Both),
};

pub(super) const VERY_FAR: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "very far",
        about: "the same at a million, where coordinates are rounded to a sixteenth",
        kind: Kind::Closed,
        fair: true,
        setting: Setting { offset: 1e6, ..Setting::UNIT },
    },
    make: |random, place| aimed(random, place, ROUND, Aim::Both),
};

pub(super) const TINY: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "tiny",
        about: "edges and vertices of a mesh of size 2e-6, which any absolute epsilon loses",
        kind: Kind::Closed,
        fair: true,
        setting: Setting { scale: 1e-6, ..Setting::UNIT },
    },
    make: |random, place| aimed(random, place, ROUND, Aim::Both),
};

pub(super) const HUGE: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "huge",
        about: "edges and vertices of a mesh of size 2e6",
        kind: Kind::Closed,
        fair: true,
        setting: Setting { scale: 1e6, ..Setting::UNIT },
    },
    make: |random, place| aimed(random, place, ROUND, Aim::Both),
};

pub(super) const PANCAKE: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "pancake",
        about: "edges and vertices of a mesh a thousand times as wide as it is high",
        kind: Kind::Closed,
        fair: false,
        setting: Setting::UNIT,
    },
    make: |random, place| aimed(random, place, DVec3::new(1.0, 1.0, 1e-3), Aim::Both),
};

pub(super) const NEEDLE: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "needle",
        about: "edges and vertices of a mesh a thousand times as long as it is wide",
        kind: Kind::Closed,
        fair: false,
        setting: Setting::UNIT,
    },
    make: |random, place| aimed(random, place, DVec3::new(1.0, 1e-3, 1e-3), Aim::Both),
};

pub(super) const INTERIOR: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "interior",
        about: "rays aimed at the insides of triangles: what t is worth",
        kind: Kind::Natural,
        fair: true,
        setting: Setting::UNIT,
    },
    make: |random, place| aimed(random, place, ROUND, Aim::Inside),
};

pub(super) const RANDOM: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "random",
        about: "rays in any direction inside a mesh of 80 triangles",
        kind: Kind::Natural,
        fair: true,
        setting: Setting::UNIT,
    },
    make: random_directions,
};

pub(super) const CAMERA: TriangleFamily = TriangleFamily {
    facts: Facts {
        name: "camera",
        about: "eight by eight neighbouring pixels of 512 by 512, seen from inside a mesh of 80 triangles",
        kind: Kind::Natural,
        fair: true,
        setting: Setting::UNIT,
    },
    make: camera,
};

/// No axis is squeezed.
const ROUND: DVec3 = DVec3::ONE;

/// How far vertices are pushed in or out.
const JITTER: f64 = 0.05;

/// The radius of the ball that rays start in: well inside.
const INSIDE: f64 = 0.5;

/// What rays are aimed at.
#[derive(Clone, Copy)]
enum Aim {
    Edge,
    Vertex,
    /// An edge or one of its ends.
    Both,
    /// The same, along an axis.
    Axis,
    Inside,
}

/// The unit ball with an uneven surface, and its edges.
struct Ball {
    vertices: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    edges: Vec<[u32; 2]>,
}

impl Ball {
    fn new(splits: u32) -> Ball {
        let mut random = Random::new(320);
        let mesh = Mesh::icosphere(splits);
        let mut push = |v: &Vec3| v.as_dvec3() * (1.0 + JITTER * (2.0 * random.unit() - 1.0));
        Ball {
            vertices: mesh.vertices.iter().map(&mut push).collect(),
            edges: mesh.edges(),
            faces: mesh.faces,
        }
    }

    /// The faces that touch an end of an edge.
    fn around(&self, edge: [u32; 2]) -> impl Iterator<Item = &[u32; 3]> {
        self.faces.iter().filter(move |face| face.iter().any(|i| edge.contains(i)))
    }
}

fn aimed(random: &mut Random, place: &mut Place, squeeze: DVec3, aim: Aim) -> Batch {
    static BALL: OnceLock<Ball> = OnceLock::new();
    let ball = BALL.get_or_init(|| Ball::new(2));
    let edge = random.pick(&ball.edges);
    let at = |place: &Place, i: u32| place.point(ball.vertices[i as usize] * squeeze);
    let triangles: Vec<_> = ball
        .around(edge)
        .map(|face| {
            let corners = face.map(|i| at(place, i));
            place.triangle(corners)
        })
        .collect();
    let [a, b] = edge.map(|i| at(place, i));
    let center = place.point(DVec3::ZERO);
    let rays = (0..BATCH).map(|i| {
        let on_edge =
            |random: &mut Random| aim::between(a, b, if i % 8 == 0 { 0.5 } else { random.unit() });
        let target = match aim {
            Aim::Edge => on_edge(random),
            Aim::Vertex => a,
            Aim::Both | Aim::Axis if i % 2 == 0 => a,
            Aim::Both | Aim::Axis => on_edge(random),
            Aim::Inside => inside(random.pick(&triangles).corners, random),
        };
        match aim {
            Aim::Axis => along_axis(center, target, i % 3 == 0),
            _ => place.ray(place.point(start(random) * squeeze), target),
        }
    });
    Batch { rays: rays.collect(), triangles }
}

/// A point of a triangle, not too near to its edges.
fn inside([a, b, c]: [Vec3; 3], random: &mut Random) -> Vec3 {
    let [u, v, w] = [(); 3].map(|()| 0.05 + random.unit());
    let point = a.as_dvec3() * u + b.as_dvec3() * v + c.as_dvec3() * w;
    (point / (u + v + w)).as_vec3()
}

/// A place to start from: the centre, one of a coarse grid, or any.
fn start(random: &mut Random) -> DVec3 {
    let point = match random.below(4) {
        0 => DVec3::ZERO,
        1 => (random.in_ball().as_dvec3() * 2.0).round() * 0.25,
        _ => random.in_ball().as_dvec3(),
    };
    point * INSIDE
}

/// Along the axis on which the target is farthest from the centre, from the plane of the centre.
fn along_axis(center: Vec3, target: Vec3, negative_zeros: bool) -> Ray {
    let axis = (target - center).abs().max_position();
    let mut origin = target;
    origin[axis] = center[axis];
    // The difference of equals is +0, and its negative −0.
    let dir = if negative_zeros { -(origin - target) } else { target - origin };
    Ray::new(origin, dir)
}

/// All triangles of a coarser ball.
fn small_ball(place: &mut Place) -> Vec<Triangle> {
    static BALL: OnceLock<Ball> = OnceLock::new();
    let ball = BALL.get_or_init(|| Ball::new(1));
    let vertices: Vec<Vec3> = ball.vertices.iter().map(|&v| place.point(v)).collect();
    let triangle = |face: &[u32; 3]| place.triangle(face.map(|i| vertices[i as usize]));
    ball.faces.iter().map(triangle).collect()
}

fn random_directions(random: &mut Random, place: &mut Place) -> Batch {
    let triangles = small_ball(place);
    let rays = (0..BATCH).map(|_| {
        let ray = Ray::new(place.point(start(random)), random.direction());
        place.paced(ray)
    });
    Batch { rays: rays.collect(), triangles }
}

/// A square tile of a picture that is as wide as it is far away; the batch's rotation turns it.
fn camera(random: &mut Random, place: &mut Place) -> Batch {
    let triangles = small_ball(place);
    let eye = start(random);
    let tile = [(); 2].map(|()| 8 * random.below(64));
    let rays = (0..BATCH).map(|i| {
        let at = |first: usize, k: usize| ((first + k) as f64 + 0.5) / 512.0 - 0.5;
        let pixel = DVec3::new(at(tile[0], i % 8), at(tile[1], i / 8), 1.0);
        place.ray(place.point(eye), place.point(eye + pixel))
    });
    Batch { rays: rays.collect(), triangles }
}
