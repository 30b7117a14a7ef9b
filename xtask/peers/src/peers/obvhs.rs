//! `obvhs`: its compressed wide hierarchy, by its medium build, over triangles in the order of the
//! leaves.

use std::time::Duration;

use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;

use super::single::{Single, Tracer};
use super::{Built, Hit, Peer};
use crate::clock::took;
use crate::mesh::Mesh;

struct Obvhs {
    bvh: CwBvh,
    triangles: Vec<RtTriangle>,
}

/// Builds it.
pub(super) fn build(mesh: &Mesh) -> Box<dyn Peer> {
    let corners = |i| mesh.corners(i).map(Vec3A::from);
    let triangle = |i| {
        let [v0, v1, v2] = corners(i);
        Triangle { v0, v1, v2 }
    };
    let triangles: Vec<_> = (0..mesh.triangles.len()).map(triangle).collect();
    let (tracer, took) = took(|| {
        let params = BvhBuildParams::medium_build();
        let bvh = build_cwbvh_from_tris(&triangles, params, &mut Duration::default());
        let in_order = bvh.primitive_indices.iter().map(|&i| (&triangles[i as usize]).into());
        Obvhs { triangles: in_order.collect(), bvh }
    });
    let bytes = size_of_val(&*tracer.bvh.nodes)
        + size_of_val(&*tracer.bvh.primitive_indices)
        + size_of_val(&*tracer.triangles);
    Box::new(Single { tracer, built: Built { took, bytes } })
}

impl Tracer for Obvhs {
    const NAME: [&str; 2] = ["obvhs", "cwbvh"];
    type Ray = Ray;

    fn ray(ray: &rt_kernels::Ray) -> Ray {
        Ray::new(ray.origin.into(), ray.dir.into(), ray.tmin, ray.tmax)
    }

    fn closest(&self, ray: &Ray) -> Option<Hit> {
        let mut hit = RayHit::none();
        let found =
            self.bvh.ray_traverse(*ray, &mut hit, |ray, i| self.triangles[i].intersect(ray));
        let prim = || self.bvh.primitive_indices[hit.primitive_id as usize];
        found.then(|| Hit { t: hit.t, prim: prim() })
    }

    fn any(&self, ray: &Ray) -> bool {
        !self.bvh.ray_traverse_miss(*ray, |ray, i| self.triangles[i].intersect(ray))
    }
}
