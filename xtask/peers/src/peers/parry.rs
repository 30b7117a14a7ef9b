//! `parry3d`: its triangle mesh. It has no way to ask for any hit but to ask for the closest.

use parry3d::math::Vector;
use parry3d::query::Ray;
use parry3d::shape::{CompositeShapeRef, TriMesh};

use super::single::{Single, Tracer};
use super::{Built, Hit, Peer};
use crate::clock::took;
use crate::mesh::Mesh;

struct Parry(TriMesh);

/// Builds it.
pub(super) fn build(mesh: &Mesh) -> Result<Box<dyn Peer>, String> {
    let vertices: Vec<_> = mesh.vertices.iter().map(|&[x, y, z]| Vector::new(x, y, z)).collect();
    let triangles = mesh.triangles.clone();
    let (built, took) = took(|| TriMesh::new(vertices, triangles));
    let mesh = built.map_err(|error| error.to_string())?;
    let bytes =
        mesh.bvh().total_memory_size() + size_of_val(mesh.vertices()) + size_of_val(mesh.indices());
    Ok(Box::new(Single { tracer: Parry(mesh), built: Built { took, bytes } }))
}

impl Tracer for Parry {
    const NAME: [&str; 2] = ["parry3d", "trimesh"];
    /// With the greatest t.
    type Ray = (Ray, f32);

    fn ray(ray: &rt_kernels::Ray) -> (Ray, f32) {
        let vector = |v: glam::Vec3| Vector::new(v.x, v.y, v.z);
        (Ray::new(vector(ray.origin), vector(ray.dir)), ray.tmax.min(f32::MAX))
    }

    fn closest(&self, (ray, tmax): &(Ray, f32)) -> Option<Hit> {
        // Not solid: a triangle has no inside.
        let hit = CompositeShapeRef(&self.0).cast_local_ray(ray, *tmax, false)?;
        Some(Hit { t: hit.1, prim: hit.0 })
    }

    fn any(&self, ray: &(Ray, f32)) -> bool {
        self.closest(ray).is_some()
    }
}
