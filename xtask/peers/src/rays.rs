//! The rays: the same for everyone, in an order that suits packets.

use glam::Vec3;
use rt_kernels::camera::Pinhole;
use rt_kernels::reference::random::Random;
use rt_kernels::{Accelerator, Exec, Hits, Ray, Rays, Stats};
use serde::{Deserialize, Serialize};

use crate::mesh::Mesh;

/// What rays are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Kind {
    /// From the eye to whatever is closest.
    Primary,
    /// Between what is seen and the light: is there anything?
    Shadow,
    /// From what is seen to anywhere, as matt surfaces scatter light: what is closest?
    Diffuse,
}

impl Kind {
    pub(crate) const ALL: [Kind; 3] = [Kind::Primary, Kind::Shadow, Kind::Diffuse];

    /// As on the command line and in JSON.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Kind::Primary => "primary",
            Kind::Shadow => "shadow",
            Kind::Diffuse => "diffuse",
        }
    }

    /// Whether the closest hit is asked for, and not only whether there is any.
    pub(crate) fn closest(self) -> bool {
        self != Kind::Shadow
    }
}

/// Rays that are traced in one go.
pub(crate) struct Work {
    pub(crate) kind: Kind,
    /// Which end they start from, where there is a choice.
    pub(crate) order: &'static str,
    pub(crate) rays: Vec<Ray>,
}

/// Of the size of the scene's coordinates, how far rays start before a surface.
const LIFT: f32 = 1e-5;

/// All rays of a picture.
pub(crate) struct Picture {
    primary: Vec<Ray>,
    /// What each of them hits, if anything: a point before the surface and the normal there.
    seen: Vec<Option<(Vec3, Vec3)>>,
    light: Vec3,
}

impl Picture {
    /// Looks at the mesh, in a picture of `size` by `size` pixels.
    pub(crate) fn new(
        mesh: &Mesh,
        accel: &impl Accelerator,
        exec: Exec,
        size: u32,
    ) -> Result<Picture, String> {
        let view = &mesh.view;
        let half_height = (view.fov_y.to_radians() * 0.5).tan();
        let camera = Pinhole::new(view.eye, view.target, view.up, half_height, size, size);
        let camera = camera.ok_or("the camera looks nowhere")?;
        let primary: Vec<_> =
            along_curve(size).map(|(x, y)| camera.ray(x as f32 + 0.5, y as f32 + 0.5)).collect();
        let rays: Rays = primary.iter().copied().collect();
        let mut hits = Hits::new();
        accel.closest(exec, &rays, &mut hits, &mut Stats::default());
        let greatest = mesh.vertices.as_flattened().iter().fold(0.0, |m: f32, x| m.max(x.abs()));
        let seen = primary.iter().enumerate().map(|(i, ray)| {
            let hit = hits.get(i)?;
            let [a, b, c] = mesh.corners(hit.prim as usize);
            let normal = (b - a).cross(c - a).try_normalize()?;
            let normal = if normal.dot(ray.dir) < 0.0 { normal } else { -normal };
            Some((ray.at(hit.t) + normal * (greatest * LIFT), normal))
        });
        Ok(Picture { seen: seen.collect(), primary, light: mesh.light })
    }

    /// Its rays of one kind. Shadow rays are one work for each end that they may start from.
    pub(crate) fn works(&self, kind: Kind) -> Vec<Work> {
        let seen = self.seen.iter().flatten();
        let work = |order, rays| Work { kind, order, rays };
        match kind {
            Kind::Primary => vec![work("", self.primary.clone())],
            Kind::Shadow => {
                let light = self.light;
                // What is turned away from the light needs no ray to be dark.
                let lit = seen.filter(|(at, normal)| normal.dot(light - at) > 0.0);
                let between = |from, to: Vec3| Ray { tmax: 1.0, ..Ray::new(from, to - from) };
                let (to, from) =
                    lit.map(|&(at, _)| (between(at, light), between(light, at))).unzip();
                vec![work("to the light", to), work("from the light", from)]
            }
            Kind::Diffuse => {
                let mut random = Random::new(1);
                let mut bounce = |&(at, normal): &(Vec3, Vec3)| {
                    // A point of the ball that touches the surface there: likely as the cosine.
                    Ray::new(at, (normal + random.direction()).normalize_or(normal))
                };
                vec![work("", seen.map(&mut bounce).collect())]
            }
        }
    }
}

/// The pixels along Morton's curve: 4, 8, 16 or 64 in a row are a tile.
fn along_curve(size: u32) -> impl Iterator<Item = (u32, u32)> {
    let side = size.next_power_of_two();
    let even = |code: u32| (0..16).fold(0, |bits, i| bits | (code >> (2 * i) & 1) << i);
    let pixels = (0..side * side).map(move |code| (even(code), even(code >> 1)));
    pixels.filter(move |&(x, y)| x < size && y < size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peers::primitives;
    use rt_kernels::reference::mesh::Mesh as Ball;
    use rt_kernels::{Bvh, Sequential};
    use std::collections::HashSet;

    #[test]
    fn the_curve_goes_through_every_pixel_once_and_tile_by_tile() {
        for size in [1, 8, 13] {
            let pixels: Vec<_> = along_curve(size).collect();
            assert_eq!(pixels.iter().collect::<HashSet<_>>().len(), (size * size) as usize);
            assert_eq!(pixels.len(), (size * size) as usize);
        }
        for (edges, count) in [((2, 2), 4), ((4, 2), 8), ((4, 4), 16), ((8, 8), 64)] {
            for tile in along_curve(16).collect::<Vec<_>>().chunks(count) {
                let corner = tile[0];
                let (x, y) = tile.iter().fold((0, 0), |(x, y), p| {
                    (x.max(p.0 - corner.0 + 1), y.max(p.1 - corner.1 + 1))
                });
                assert_eq!((x, y), edges);
            }
        }
    }

    fn picture() -> Picture {
        let mesh = Mesh::of(&Ball::icosphere(3));
        let bvh = Bvh::build(&primitives(&mesh).expect("a mesh"), &Sequential).expect("in range");
        Picture::new(&mesh, &bvh, Exec::best().expect("a level"), 32).expect("a camera")
    }

    #[test]
    fn shadow_rays_are_the_same_segments_from_either_end() {
        let works = picture().works(Kind::Shadow);
        let [to, from] = &*works else { panic!("{} works", works.len()) };
        assert!(to.rays.len() > 100 && to.rays.len() < 32 * 32);
        for (to, from) in to.rays.iter().zip(&from.rays) {
            assert_eq!(from.origin, Vec3::Y * 5.0);
            assert_eq!((to.dir, to.tmax, from.tmax), (-from.dir, 1.0, 1.0));
            assert!((from.at(1.0) - to.origin).length() < 1e-5);
            // On the lit half of the ball.
            assert!(to.origin.y > 0.0 && (to.origin.length() - 1.0).abs() < 0.02);
        }
    }

    #[test]
    fn matt_surfaces_scatter_outward() {
        let works = picture().works(Kind::Diffuse);
        let rays = &works[0].rays;
        let seen = picture().seen.iter().flatten().count();
        assert_eq!((works.len(), rays.len()), (1, seen));
        let cosine = |ray: &Ray| ray.dir.dot(ray.origin.normalize());
        assert!(rays.iter().all(|ray| cosine(ray) > -0.1));
        let mean = rays.iter().map(cosine).sum::<f32>() / rays.len() as f32;
        assert!((mean - 2.0 / 3.0).abs() < 0.05, "{mean}");
    }
}
