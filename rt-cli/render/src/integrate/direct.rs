//! The integrators that look at the first hit alone.

use glam::Vec3;
use rt_kernels::{Hit, Ray};

use super::{RayKind, Scratch};
use crate::exec::{Tally, TileJob};
use crate::shade::Surface;

/// Traces the primary rays and adds to each pixel the colour that `color` makes of its hit.
pub(super) fn integrate(
    job: &TileJob<'_>,
    scratch: &mut Scratch,
    colors: &mut [Vec3],
    tally: &mut Tally,
    color: impl Fn(&TileJob<'_>, &Ray, &Hit) -> Vec3,
) {
    let Scratch { rays, seen, .. } = scratch;
    seen.find(job, RayKind::Primary, rays, tally);
    tally.shading(|| {
        for (i, pixel) in colors.iter_mut().enumerate() {
            *pixel += match seen.get(i) {
                Some(hit) => color(job, &rays.get(i), &hit),
                None => job.job.background,
            };
        }
    });
}

/// Diffuse colour times the cosine to the viewer.
pub(super) fn eyelight(job: &TileJob<'_>, ray: &Ray, hit: &Hit) -> Vec3 {
    let surface = Surface::at(job.world, ray, hit);
    let finish = job.world.finish(&surface.point);
    finish.diffuse * finish.normal.dot(-ray.dir).max(0.0) + finish.emission
}

/// The normal as a colour.
pub(super) fn normals(job: &TileJob<'_>, ray: &Ray, hit: &Hit) -> Vec3 {
    Surface::at(job.world, ray, hit).point.normal * 0.5 + 0.5
}

/// The distance as a grey, between those of the scene's bounds.
pub(super) fn depth(job: &TileJob<'_>, _: &Ray, hit: &Hit) -> Vec3 {
    let (near, far) = job.depth_range;
    Vec3::splat(((far - hit.t) / (far - near)).clamp(0.0, 1.0))
}
