//! A terrain of any size: the same hills, sampled more or less finely.

use glam::Vec3;
use rt_scene::{Mesh, Scene, Triangle, View};

/// Hills at this many scales, each half as wide and as high as the one before.
const OCTAVES: u32 = 9;

/// About that many triangles, two to a square of a grid, seen from above one side.
pub fn terrain(triangles: usize) -> Scene {
    let n = ((triangles as f64 / 2.0).sqrt().round() as u32).max(1);
    let at = |i: u32| i as f32 / n as f32 * 2.0 - 1.0;
    let mut mesh = Mesh::default();
    for z in 0..=n {
        let row = (0..=n).map(|x| Vec3::new(at(x), height(at(x), at(z)), at(z)));
        mesh.positions.extend(row);
    }
    for z in 0..n {
        for x in 0..n {
            let a = z * (n + 1) + x;
            let [b, c, d] = [a + 1, a + n + 1, a + n + 2];
            let of = |position| Triangle { position, normal: None, uv: None, material: 0 };
            mesh.triangles.extend([of([a, c, b]), of([b, c, d])]);
        }
    }
    let view = View {
        eye: Vec3::new(0.3, 1.1, 1.9),
        target: Vec3::new(0.0, -0.1, 0.0),
        up: Vec3::Y,
        fov_y: 50.0,
        size: None,
    };
    let name = format!("terrain:{}", mesh.triangles.len());
    Scene { name, mesh, view: Some(view), ..Scene::default() }
}

fn height(x: f32, z: f32) -> f32 {
    let mut sum = 0.0;
    for octave in 0..OCTAVES {
        let scale = (1 << octave) as f32;
        sum += noise(x * scale * 1.5, z * scale * 1.5, octave) / scale;
    }
    sum * 0.25
}

/// Random values on the grid of whole numbers, blended between.
fn noise(x: f32, z: f32, octave: u32) -> f32 {
    let (low_x, low_z) = (x.floor(), z.floor());
    let blend = |t: f32| t * t * (3.0 - 2.0 * t);
    let (s, t) = (blend(x - low_x), blend(z - low_z));
    let value = |i: i32, k: i32| {
        let (i, k) = ((low_x as i32 + i) as u32, (low_z as i32 + k) as u32);
        let mut h = i.wrapping_mul(0x9e37_79b1) ^ k.wrapping_mul(0x85eb_ca77) ^ octave << 13;
        h = (h ^ h >> 15).wrapping_mul(0x2c1b_3c6d);
        h = (h ^ h >> 12).wrapping_mul(0x297a_2d39);
        (h ^ h >> 15) as f32 / (1u32 << 31) as f32 - 1.0
    };
    let near = value(0, 0) * (1.0 - s) + value(1, 0) * s;
    let far = value(0, 1) * (1.0 - s) + value(1, 1) * s;
    near * (1.0 - t) + far * t
}

#[cfg(test)]
mod tests {
    use rt_kernels::Exec;

    use super::super::raster::ZBuffer;
    use super::*;
    use crate::measure::primary;
    use crate::{AccelKind, Job, World};
    use rt_kernels::Stats;

    /// The rasteriser draws where rays hit, but for what rounding says of edges against the sky.
    #[test]
    fn rays_and_the_rasteriser_see_the_same() {
        let scene = terrain(5_000);
        let exec = Exec::best().expect("a level");
        let job = Job::seen(scene.view.expect("it has one"), (128, 96), exec);
        let world = World::build(scene, AccelKind::Bvh, 1).expect("in range");
        let mut buffer = ZBuffer::new(job.size);
        buffer.draw(&world, &job).expect("a camera");
        let mut hits = rt_kernels::Hits::new();
        let mut met = 0;
        for rays in primary(&world, &job).expect("a camera").batches {
            world.accel.closest(exec, &rays, &mut hits, &mut Stats::default());
            met += (0..rays.len()).filter(|&i| hits.get(i).is_some()).count();
        }
        assert!(met > 3_000 && met < 12_000, "{met} of 12288 rays hit");
        assert!(met.abs_diff(buffer.covered()) < 10, "{met} rays, {} pixels", buffer.covered());
    }
}
