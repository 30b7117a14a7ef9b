//! Figure 5: a terrain in more and more triangles.

use std::time::Instant;

use rt_render::measure::{self, Way, ZBuffer, terrain};
use rt_render::{AccelKind, Exec, KdBuilder, World};
use serde_json::json;

use super::{Paper, job, kd};
use crate::chart::{Line, Lines};
use crate::error::Error;

/// The fewest triangles, and how often they are doubled.
const LEAST: usize = 1_000;
const DOUBLINGS: u32 = 13;

pub(super) fn run(paper: &mut Paper<'_>) -> Result<(), Error> {
    paper.show(&format!(
        "Figure 5: ms for a picture of 512×512 pixels of a terrain, one thread, and s to build\n\
         {:>10}{:>12}{:>10}{:>10}{:>15}{:>10}",
        "triangles", "rasteriser", "kd-tree", "BVH", "build: kd-tree", "BVH"
    ))?;
    let mut points: [Vec<(f64, f64)>; 3] = Default::default();
    let exec = Exec::at(paper.level);
    for triangles in (0..=DOUBLINGS).map(|i| LEAST << i).take_while(|size| *size <= paper.most) {
        let scene = terrain(triangles);
        let count = scene.mesh.triangles.len();
        let tree = World::build(scene.clone(), kd(KdBuilder::default()), 1)?;
        let bvh = World::build(scene.clone(), AccelKind::Bvh, 1)?;
        let job = job(&scene, &bvh, (512, 512), exec);
        let rays = measure::primary(&bvh, &job)?;
        let ways = [Way { world: &tree, exec }, Way { world: &bvh, exec }];
        let rows = measure::trace(&rays, &ways, paper.rounds());
        if rows[1].differing > 0 {
            let (scene, differing) = (scene.name, rows[1].differing);
            return Err(Error::Differ { scene, differing, way: "BVH".into() });
        }
        let mut buffer = ZBuffer::new(job.size);
        let mut times = Vec::new();
        for _ in 0..paper.rounds() {
            let start = Instant::now();
            buffer.draw(&bvh, &job)?;
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        times.sort_by(f64::total_cmp);
        let of = |i: usize| rows[i].time.as_secs_f64() * 1e3;
        let ms = [times[times.len() / 2], of(0), of(1)];
        for (points, ms) in points.iter_mut().zip(ms) {
            points.push((count as f64, ms));
        }
        let build = [&tree, &bvh].map(|world| world.build_time().as_secs_f64());
        paper.show(&format!(
            "{count:>10}{:>12.2}{:>10.2}{:>10.2}{:>15.3}{:>10.3}",
            ms[0], ms[1], ms[2], build[0], build[1]
        ))?;
        paper.rows.push(json!({
            "what": "growth",
            "scene": scene.name,
            "triangles": count,
            "level": paper.level.name(),
            "rasteriser_ms": ms[0],
            "kd_ms": ms[1],
            "bvh_ms": ms[2],
            "kd_build_s": build[0],
            "bvh_build_s": build[1],
        }));
    }
    let names = ["our z-buffer rasteriser", "kd-tree", "BVH"];
    let line = |(name, points): (&str, _)| Line { name: name.to_owned(), points };
    let lines = names.into_iter().zip(points).map(line).collect();
    let title = "A terrain in more and more triangles, 512×512 pixels";
    paper.chart("growth.svg", &Lines { title, axes: ["triangles", "ms"], lines })
}
