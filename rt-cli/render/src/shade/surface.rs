//! The surface where a ray hit.

use glam::Vec3;
use rt_kernels::{Hit, Ray};
use rt_scene::{Cone, Sphere};

use crate::World;

/// A point on a surface, seen from the ray that found it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    /// The normal for shading, of unit length, on the side that the ray came from.
    pub(crate) normal: Vec3,
    /// The true normal, of unit length, on the side that the ray came from.
    pub(crate) true_normal: Vec3,
    /// Where rays that leave on that side start: off the surface by more than any rounding, so
    /// that they do not meet it again.
    pub(crate) leave: Vec3,
    /// Index of the material.
    pub(crate) material: u32,
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
        if prim < spheres {
            Surface::on_triangle(world, ray, hit, &scene.mesh.triangles[prim])
        } else if prim < cones {
            Surface::on_sphere(ray, hit, &scene.spheres[prim - spheres])
        } else {
            Surface::on_cone(ray, hit, &scene.cones[prim - cones])
        }
    }

    fn on_triangle(world: &World, ray: &Ray, hit: &Hit, triangle: &rt_scene::Triangle) -> Surface {
        let [a, b, c] = world.corners(triangle);
        let (ab, ac) = (b - a, c - a);
        // Seen from one corner the point is nearer to the plane than origin + t · dir.
        let point = a + ab * hit.u + ac * hit.v;
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
        Surface::facing(ray, point, extent, true_normal, normal, triangle.material)
    }

    fn on_sphere(ray: &Ray, hit: &Hit, sphere: &Sphere) -> Surface {
        let normal = (ray.at(hit.t) - sphere.center).normalize_or(-ray.dir);
        let point = sphere.center + normal * sphere.radius;
        Surface::facing(ray, point, sphere.radius, normal, normal, sphere.material)
    }

    fn on_cone(ray: &Ray, hit: &Hit, cone: &Cone) -> Surface {
        let (along, widening) = (cone.apex - cone.base, cone.apex_radius - cone.base_radius);
        let height = along.length();
        let axis = along / height;
        let from_base = ray.at(hit.t) - cone.base;
        let share = (from_base.dot(axis) / height).clamp(0.0, 1.0);
        let out = from_base.reject_from_normalized(axis).normalize_or(-ray.dir);
        let normal = (out * height - axis * widening).normalize();
        let radius = cone.base_radius + widening * share;
        let point = cone.base + along * share + out * radius;
        let extent = height.max(cone.base_radius.max(cone.apex_radius));
        Surface::facing(ray, point, extent, normal, normal, cone.material)
    }

    /// Turns the normals to the side that the ray came from.
    fn facing(
        ray: &Ray,
        point: Vec3,
        extent: f32,
        true_normal: Vec3,
        normal: Vec3,
        material: u32,
    ) -> Surface {
        let true_normal = if true_normal.dot(ray.dir) > 0.0 { -true_normal } else { true_normal };
        let normal = if normal.dot(true_normal) < 0.0 { -normal } else { normal };
        let offset = OFFSET * (point.abs().max_element() + extent);
        Surface { normal, true_normal, leave: point + true_normal * offset, material }
    }
}
