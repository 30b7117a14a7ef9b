//! The surface where a ray hit.

use glam::{Vec2, Vec3};
use rt_kernels::{Hit, Ray};
use rt_scene::{Cone, Sphere};

use super::Point;
use crate::World;

/// A point on a surface, and where the rays start that it sends on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    /// The point.
    pub(crate) point: Point,
    /// Where rays that leave on the side that the ray came from start: off the surface by more than
    /// any rounding, so that they do not meet it again. In the world's scaled space.
    pub(crate) leave: Vec3,
    /// Where rays that go through start: as far off on the other side.
    pub(crate) enter: Vec3,
}

/// How far rays start off the surface, relative to the magnitudes involved: 64 roundoffs.
const OFFSET: f32 = 64.0 / (1 << 24) as f32;

impl Surface {
    /// The surface at a hit.
    pub(crate) fn at(world: &World, ray: &Ray, hit: &Hit) -> Surface {
        let scene = &world.scene;
        let prim = hit.prim as usize;
        let spheres = scene.mesh.triangles.len();
        let cones = spheres + scene.spheres.len();
        let found = if prim < spheres {
            Found::on_triangle(world, ray, hit, &scene.mesh.triangles[prim])
        } else if prim < cones {
            Found::on_sphere(ray, hit, &scene.spheres[prim - spheres])
        } else {
            Found::on_cone(ray, hit, &scene.cones[prim - cones])
        };
        found.facing(ray, 1.0 / world.scale)
    }
}

/// What was hit, in the world's scaled space.
struct Found {
    position: Vec3,
    /// The magnitude of the primitive's lengths.
    extent: f32,
    /// On the front, of unit length.
    true_normal: Vec3,
    /// That of shading, on whatever side.
    normal: Vec3,
    uv: Vec2,
    material: u32,
}

impl Found {
    fn on_triangle(world: &World, ray: &Ray, hit: &Hit, triangle: &rt_scene::Triangle) -> Found {
        let [a, b, c] = world.corners(triangle);
        let (ab, ac) = (b - a, c - a);
        // Seen from one corner the point is nearer to the plane than origin + t · dir.
        let position = a + ab * hit.u + ac * hit.v;
        let extent = ab.abs().max(ac.abs()).max_element();
        let true_normal = ab.cross(ac).normalize_or(-ray.dir);
        let normal = match triangle.normal {
            Some(normals) => {
                let [a, b, c] = normals.map(|i| world.scene.mesh.normals[i as usize]);
                let blend = a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v;
                blend.normalize_or(true_normal)
            }
            None => true_normal,
        };
        let uv = match triangle.uv {
            Some(uvs) => {
                let [a, b, c] = uvs.map(|i| world.scene.mesh.uvs[i as usize]);
                a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v
            }
            None => Vec2::ZERO,
        };
        let material = triangle.material;
        Found { position, extent, true_normal, normal, uv, material }
    }

    fn on_sphere(ray: &Ray, hit: &Hit, sphere: &Sphere) -> Found {
        let normal = (ray.at(hit.t) - sphere.center).normalize_or(-ray.dir);
        Found {
            position: sphere.center + normal * sphere.radius,
            extent: sphere.radius,
            true_normal: normal,
            normal,
            uv: Vec2::ZERO,
            material: sphere.material,
        }
    }

    fn on_cone(ray: &Ray, hit: &Hit, cone: &Cone) -> Found {
        let (along, widening) = (cone.apex - cone.base, cone.apex_radius - cone.base_radius);
        let height = along.length();
        let axis = along / height;
        let from_base = ray.at(hit.t) - cone.base;
        let share = (from_base.dot(axis) / height).clamp(0.0, 1.0);
        let out = from_base.reject_from_normalized(axis).normalize_or(-ray.dir);
        let normal = (out * height - axis * widening).normalize();
        let radius = cone.base_radius + widening * share;
        Found {
            position: cone.base + along * share + out * radius,
            extent: height.max(cone.base_radius.max(cone.apex_radius)),
            true_normal: normal,
            normal,
            uv: Vec2::ZERO,
            material: cone.material,
        }
    }

    /// Turns the normals to the side that the ray came from. `unscale` brings lengths into the units of
    /// the scene.
    fn facing(self, ray: &Ray, unscale: f32) -> Surface {
        let Found { position, extent, true_normal, normal, uv, material } = self;
        let front = true_normal.dot(ray.dir) <= 0.0;
        let true_normal = if front { true_normal } else { -true_normal };
        let normal = if normal.dot(true_normal) < 0.0 { -normal } else { normal };
        let offset = true_normal * (OFFSET * (position.abs().max_element() + extent));
        let point = Point {
            position: position * unscale,
            dir: ray.dir,
            normal,
            true_normal,
            uv,
            front,
            material,
        };
        Surface { point, leave: position + offset, enter: position - offset }
    }
}
