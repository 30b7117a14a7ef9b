//! Table 2: what the rays of a packet have in common.

use rt_render::measure;
use rt_render::{AccelKind, Exec, KdBuilder, World};
use serde_json::json;

use super::{COHERENT, Paper, job};
use crate::error::Error;

/// The paper's scenes: 2×2, 4×4, 8×8 rays, and 2×2 of a small picture.
const PAPER: [[f64; 4]; 3] =
    [[1.4, 4.4, 11.8, 5.8], [2.6, 8.2, 21.6, 10.4], [3.2, 10.6, 28.2, 12.2]];

pub(super) fn run(paper: &mut Paper<'_>) -> Result<(), Error> {
    paper.show(&format!(
        "Table 2: visits of nodes in packets more than ray by ray, of 1024×1024 pixels; the tree's depth, \
         and entries of its leaves for each triangle\n\
         {:<20}{:>10}{:>7}{:>9}{:>9}{:>9}{:>9}{:>12}   {}",
        "", "triangles", "depth", "entries", "2×2", "4×4", "8×8", "2×2, 256²", "paper"
    ))?;
    let exec = Exec::at(paper.level);
    let most = paper.most;
    let sizes = COHERENT.into_iter().filter(|size| *size <= most);
    for (i, scene) in paper.scenes(sizes.clone())?.into_iter().enumerate() {
        let world = World::build(scene.clone(), AccelKind::Bvh, 1)?;
        let tree = measure::kd_tree(&world, KdBuilder::default())?;
        let over = |size: u32, packets: &[usize]| -> Result<Vec<f64>, Error> {
            let rays = measure::primary(&world, &job(&scene, &world, (size, size), exec))?;
            let shares = measure::packet_overhead(&tree, &rays, exec, packets);
            Ok(shares.into_iter().map(|share| share * 100.0).collect())
        };
        let mut shares = over(1024, &[4, 16, 64])?;
        shares.extend(over(256, &[4])?);
        let cell = |width: usize| move |share: &f64| format!("{share:>0$.1} %", width);
        let mut cells: String = shares[..3].iter().map(cell(7)).collect();
        cells.extend(shares[3..].iter().map(cell(10)));
        let entries = tree.references() as f64 / (world.triangles() + world.spheres()) as f64;
        let figures = PAPER.get(i).filter(|_| i < sizes.clone().count());
        let figures = figures.map(|[a, b, c, d]| format!("   {a} {b} {c} %, {d} %"));
        paper.show(&format!(
            "{:<20}{:>10}{:>7}{entries:>9.2}{cells}{}",
            scene.name,
            world.triangles(),
            tree.depth(),
            figures.unwrap_or_default()
        ))?;
        paper.rows.push(json!({
            "what": "overhead",
            "scene": scene.name,
            "triangles": world.triangles(),
            "depth": tree.depth(),
            "nodes": tree.nodes(),
            "entries": tree.references(),
            "percent_2x2": shares[0],
            "percent_4x4": shares[1],
            "percent_8x8": shares[2],
            "percent_2x2_256": shares[3],
        }));
    }
    paper.show("")
}
