//! No ray leaves a closed mesh unseen.
//!
//! A million rays from inside, aimed exactly at shared edges and vertices, where a test that is not
//! watertight leaks one ray in twenty: a control shows that these rays find such leaks.

use glam::Vec3;
use rt_kernels::tri::Method;
use rt_kernels::{Bvh, Exec, Ray, Rays, Sequential};
use rt_tests::mesh::Mesh;
use rt_tests::oracle::{ROUNDOFF, moller_trumbore};
use rt_tests::random::Random;
use rt_tests::trace::{any, closest, every_plan, every_way};
use rt_tests::{aim, cases, rays};
use simd4::Level;

/// A closed mesh about `center`, and a radius within which all is inside.
struct Vessel {
    mesh: Mesh,
    edges: Vec<[u32; 2]>,
    bvh: Bvh,
    center: Vec3,
    inside: f32,
}

/// The ball of 81,920 triangles, or of 5,120 where there are few rays, each vertex pushed out or in by
/// up to `jitter`, shrunk to `radius` and moved to `center`.
fn vessel(radius: f32, center: Vec3, jitter: f32) -> Vessel {
    vessel_of(Mesh::icosphere(if cases() < 64 { 4 } else { 6 }), radius, center, jitter)
}

fn vessel_of(ball: Mesh, radius: f32, center: Vec3, jitter: f32) -> Vessel {
    let mut random = Random::new(3);
    let place = |v: Vec3| v * (1.0 + jitter * random.signed()) * radius + center;
    let mesh = ball.map(place);
    Vessel {
        edges: mesh.edges(),
        bvh: Bvh::build(&mesh.primitives(), &Sequential).expect("in range"),
        mesh,
        center,
        inside: 0.9 * radius * (1.0 - jitter),
    }
}

impl Vessel {
    /// A point inside: the centre, one of a coarse grid, or any.
    fn origin(&self, random: &mut Random) -> Vec3 {
        let offset = match random.below(4) {
            0 => Vec3::ZERO,
            1 => (random.in_cube() * 2.0).round() * 0.25,
            _ => random.in_ball() * 0.9,
        };
        self.center + offset * self.inside
    }

    /// The point that ray `i` aims at: now a vertex, now a point of an edge.
    fn target(&self, i: usize, random: &mut Random) -> Vec3 {
        let at = |i: u32| self.mesh.vertices[i as usize];
        if i.is_multiple_of(2) {
            return self.mesh.vertices[random.below(self.mesh.vertices.len())];
        }
        let [a, b] = random.pick(&self.edges);
        aim::between(at(a), at(b), if i % 8 == 1 { 0.5 } else { random.unit() })
    }

    /// Rays in every direction, that share no more than chance has it.
    fn scattered(&self, n: usize, random: &mut Random) -> Rays {
        (0..n).map(|i| aim::at(self.origin(random), self.target(i, random))).collect()
    }

    /// From each of some points at every vertex and at every edge of a stretch of the mesh, in
    /// order: neighbours go in the same packet and agree in their signs.
    fn swept(&self, n: usize, random: &mut Random) -> Rays {
        let mut rays = Rays::new();
        while rays.len() < n {
            let origin = self.origin(random);
            let first = random.below(self.mesh.faces.len() - 1024);
            for face in first..first + 1024 {
                let [a, b, _] = self.mesh.corners(face);
                rays.extend([
                    aim::at(origin, a),
                    aim::at(origin, aim::between(a, b, random.unit())),
                ]);
            }
        }
        rays
    }

    /// Along the axis on which a target is farthest from the centre, from the plane of the centre,
    /// exactly at the target, with zeros of both signs.
    fn parallel(&self, n: usize, random: &mut Random) -> Rays {
        (0..n)
            .map(|i| {
                let target = self.target(i, random);
                let axis = (target - self.center).abs().max_position();
                let mut origin = target;
                origin[axis] = self.center[axis];
                let ray = aim::at(origin, target);
                // The difference of equals is +0, and its negative −0.
                let dir = if i % 3 == 0 { -(origin - target) } else { ray.dir };
                Ray { dir, ..ray }
            })
            .collect()
    }

    /// From just off the inner side, where a renderer's reflected rays start: as far from the
    /// surface as 64 roundoffs of its coordinates.
    fn grazing(&self, n: usize, random: &mut Random) -> Rays {
        (0..n)
            .map(|i| {
                let [a, b, c] = self.mesh.corners(random.below(self.mesh.faces.len()));
                let point = (a + b + c) / 3.0;
                let off = 64.0 * ROUNDOFF as f32 * point.abs().max_element();
                let origin = point + (self.center - point).normalize() * off;
                aim::at(origin, self.target(i, random))
            })
            .collect()
    }

    /// No ray gets out, at any level.
    fn holds(&self, name: &str, rays: &Rays) {
        for level in Level::available() {
            let found = any(&self.bvh, Exec::at(level), rays);
            let leaks = found.iter().filter(|found| !**found).count();
            let first = found.iter().position(|found| !found).map(|i| rays.get(i));
            assert_eq!(leaks, 0, "{name}, {level}: of {} rays, the first {first:?}", rays.len());
        }
        let hits = closest(&self.bvh, Exec::best().expect("a level"), rays);
        let leaks = hits.iter().filter(|hit| hit.is_none()).count();
        assert_eq!(leaks, 0, "{name}, closest hits");
    }

    /// The common test leaks, or these rays prove nothing.
    fn has_teeth(&self, name: &str, aimed: &Rays) {
        let n = rays(1000).clamp(200, aimed.len());
        let leaks = (0..n).map(|i| aimed.get(i * (aimed.len() / n))).filter(|ray| {
            let mut faces = 0..self.mesh.faces.len();
            !faces.any(|face| moller_trumbore(ray, self.mesh.corners(face)).is_some())
        });
        let leaks = leaks.count();
        assert!(leaks > 0, "{name}: {n} rays that do not even leak through Möller–Trumbore");
    }

    fn million(&self, name: &str) {
        let mut random = Random::new(11);
        let scattered = self.scattered(rays(500_000), &mut random);
        self.has_teeth(name, &scattered);
        self.holds(name, &scattered);
        self.holds(name, &self.swept(rays(500_000), &mut random));
        self.holds(&format!("{name}, along axes"), &self.parallel(rays(100_000), &mut random));
    }
}

#[test]
fn ball_at_the_origin() {
    let ball = vessel(1.0, Vec3::ZERO, 0.0);
    ball.million("at the origin");
    ball.holds("grazing", &ball.grazing(rays(200_000), &mut Random::new(12)));
}

#[test]
fn ball_far_away() {
    let ball = vessel(1.0, Vec3::new(1000.0, 0.0, 0.0), 0.0);
    ball.million("far");
    ball.holds("far, grazing", &ball.grazing(rays(200_000), &mut Random::new(12)));
}

/// So far that 128 roundings are all that is left of the radius, and many triangles have no area.
#[test]
fn ball_very_far_away() {
    vessel(1.0, Vec3::new(1e5, -1e5, 0.0), 0.0).million("very far");
}

#[test]
fn tiny_ball() {
    vessel(1e-3, Vec3::ZERO, 0.0).million("tiny");
}

/// Not convex, and full of slivers seen from their edges.
#[test]
fn spiky_ball() {
    vessel(1.0, Vec3::ZERO, 0.05).million("spiky");
}

#[test]
fn spiky_ball_far_away() {
    vessel(1.0, Vec3::new(0.0, 1000.0, -1e5), 0.05).million("spiky, far");
}

/// Every builder in every layout, in packets of every size, at every level.
#[test]
fn spiky_ball_of_every_plan() {
    let mut ball = vessel_of(Mesh::icosphere(5), 1.0, Vec3::ZERO, 0.1);
    let scene = ball.mesh.primitives();
    let mut random = Random::new(13);
    let (scattered, swept) =
        (ball.scattered(rays(10_000), &mut random), ball.swept(rays(10_000), &mut random));
    ball.has_teeth("every plan", &scattered);
    for plan in every_plan(Method::default()) {
        ball.bvh = Bvh::build_with(&scene, plan, &Sequential).expect("in range");
        for (exec, rays) in
            every_way().into_iter().flat_map(|exec| [(exec, &scattered), (exec, &swept)])
        {
            let found = any(&ball.bvh, exec, rays);
            let hits = closest(&ball.bvh, exec, rays);
            let leak = (0..rays.len()).find(|&i| !found[i] || hits[i].is_none());
            assert_eq!(leak.map(|i| rays.get(i)), None, "{plan:?}, {exec:?}");
        }
    }
}
