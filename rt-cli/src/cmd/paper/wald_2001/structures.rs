//! Table 3, the gain of lanes, and the BVH beside the kd-tree.

use rt_render::measure::{self, Batches, Row, Way, terrain};
use rt_render::{AccelKind, Exec, KdBuilder, Layout, PacketSize, Plan, World};
use rt_scene::Scene;
use serde_json::json;

use super::{Paper, four_lanes, job, kd};
use crate::error::Error;

/// The triangles of the paper's scenes, and its microseconds a ray.
const PAPER: [(usize, f64); 6] = [
    (40_000, 2.1),
    (256_000, 2.3),
    (680_000, 3.6),
    (907_000, 3.4),
    (2_500_000, 2.9),
    (8_000_000, 4.5),
];

/// Procedural scenes of triangles in several sizes, and how many triangles those are.
const PROCEDURAL: [(&str, usize); 6] = [
    ("spd:mount:6", 8_192),
    ("spd:mount:8", 131_072),
    ("spd:mount:11", 8_388_608),
    ("spd:tetra:7", 65_536),
    ("spd:tetra:9", 1_048_576),
    ("spd:tetra:10", 4_194_304),
];

/// Beyond that many triangles only the two that are in question are built.
const LARGE: usize = 1_100_000;

pub(super) fn run(paper: &mut Paper<'_>) -> Result<(), Error> {
    let four = four_lanes(paper.level);
    paper.show(&format!(
        "Table 3: rays of 512×512 pixels, one thread, µs a ray: one by one (kd: scalar code), in packets \
         of four at {four}, in those of a register and in large ones at {}; and how many times as fast \
         as one by one are four, and the best\n\
         {:<18}{:<16}{:>8}{:>7}{:<9}{:>8}{:>8}{:>8}{:>8}{:>6}{:>6}{:>8}{:>7}{:>6}",
        paper.level,
        "",
        "structure",
        "build s",
        "bytes",
        "  rays",
        "one",
        "four",
        "lanes",
        "large",
        "×",
        "×",
        "Mray/s",
        "steps",
        "tests"
    ))?;
    let most = paper.most;
    for (size, us) in PAPER.into_iter().filter(|(size, _)| *size <= most) {
        scene(paper, terrain(size), Some(us))?;
    }
    for (name, _) in PROCEDURAL.into_iter().filter(|(_, size)| *size <= most) {
        scene(paper, rt_scene::open(name)?, None)?;
    }
    for name in &paper.args.scenes {
        scene(paper, rt_scene::open(name)?, None)?;
    }
    paper.show(
        "The paper: 40 to 50 steps, 5 to 10 tests; 1.8 to 2.5 times as fast with four lanes.\n",
    )
}

/// All structures of a scene, with all kinds of rays.
fn scene(paper: &mut Paper<'_>, scene: Scene, us: Option<f64>) -> Result<(), Error> {
    let skip = Plan { layout: Layout::Skip, ..Plan::default() };
    let mut kinds =
        vec![(AccelKind::Bvh, Plan::default()), (kd(KdBuilder::Binned), Plan::default())];
    if scene.mesh.triangles.len() <= LARGE {
        kinds.push((kd(KdBuilder::Sweep), Plan::default()));
        kinds.push((kd(KdBuilder::Median), Plan::default()));
        kinds.push((AccelKind::Bvh, skip));
    }
    let worlds = kinds
        .into_iter()
        .map(|(kind, plan)| World::build_with(scene.clone(), kind, plan, 1))
        .collect::<Result<Vec<_>, _>>()?;
    let level = paper.level;
    let four = Exec { level: four_lanes(level), packet: PacketSize::Four };
    let execs = [PacketSize::Single, PacketSize::Four, PacketSize::Native, PacketSize::Large]
        .map(|packet| if packet == four.packet { four } else { Exec { level, packet } });
    let many = Exec::at(level);
    let job = job(&scene, &worlds[0], (512, 512), many);
    let primary = measure::primary(&worlds[0], &job)?;
    let light = job.view.eye + job.view.up * (job.view.eye - job.view.target).length() * 0.3;
    let rays: [Batches; 3] = [
        measure::shadow(&worlds[0], &primary, light, many),
        measure::diffuse(&worlds[0], &primary, many),
        primary,
    ];
    // What comes to another packet size is not measured twice.
    let has = |world: &World, exec: Exec| world.exec(exec).packet == exec.packet;
    let ways: Vec<_> = worlds
        .iter()
        .flat_map(|world| execs.map(|exec| Way { world, exec }))
        .filter(|way| has(way.world, way.exec))
        .collect();
    for rays in rays.iter().rev() {
        let rows = measure::trace(rays, &ways, paper.rounds());
        for world in &worlds {
            let own: Vec<_> = ways
                .iter()
                .zip(&rows)
                .filter(|(way, _)| std::ptr::eq(way.world, world))
                .map(|(_, row)| row)
                .collect();
            if let Some(row) = own.iter().find(|row| row.differing > 0) {
                let way = format!("{:?}, {:?}", world.accel_kind(), row.exec);
                let (scene, differing) = (scene.name, row.differing);
                return Err(Error::Differ { scene, differing, way });
            }
            let times = execs.map(|exec| own.iter().find(|row| row.exec.packet == exec.packet));
            let us = us
                .filter(|_| rays.kind == "primary" && world.accel_kind() == kd(KdBuilder::Binned));
            line(paper, world, rays.kind, times.map(|row| row.map(|row| **row)), us)?;
        }
    }
    Ok(())
}

/// One line of the table, and its rows.
fn line(
    paper: &mut Paper<'_>,
    world: &World,
    kind: &str,
    rows: [Option<Row>; 4],
    us: Option<f64>,
) -> Result<(), Error> {
    let structure = match world.accel_kind() {
        AccelKind::Bvh => format!("bvh {}", world.layout()),
        other => format!("{} {}", other.name(), world.builder().unwrap_or_default()),
    };
    let primitives = (world.triangles() + world.spheres()) as f64;
    let micros = |row: Row| row.time.as_secs_f64() * 1e6 / row.rays as f64;
    let shown = rows.map(|row| row.map_or("-".to_owned(), |row| format!("{:.3}", micros(row))));
    let [one, four, ..] = rows.map(|row| row.map_or(f64::NAN, micros));
    let best = rows.into_iter().flatten().map(micros).fold(f64::INFINITY, f64::min);
    let Some(single) = rows[0] else { return Ok(()) };
    let per_ray = |row: Row, count: u64| count as f64 / row.rays as f64;
    let gain = if four.is_nan() { "-".to_owned() } else { format!("{:.1}", one / four) };
    paper.show(&format!(
        "{:<18}{structure:<16}{:>8.2}{:>7.0}  {kind:<7}{:>8}{:>8}{:>8}{:>8}{gain:>6}{:>6.1}{:>8.2}{:>7.1}\
         {:>6.1}{}",
        world.name(),
        world.build_time().as_secs_f64(),
        world.accel_bytes() as f64 / primitives,
        shown[0],
        shown[1],
        shown[2],
        shown[3],
        one / best,
        1.0 / best,
        per_ray(single, single.stats.node_visits),
        per_ray(single, single.stats.primitive_tests()),
        us.map_or(String::new(), |us| format!("   paper: {us} µs")),
    ))?;
    for row in rows.into_iter().flatten() {
        paper.rows.push(json!({
            "what": "trace",
            "scene": world.name(),
            "triangles": world.triangles(),
            "kind": kind,
            "level": row.exec.level.name(),
            "packet": row.exec.lanes().to_string(),
            "kernel": world.method().name(),
            "accel": world.accel_kind().name(),
            "builder": world.builder(),
            "layout": world.layout(),
            "build_s": world.build_time().as_secs_f64(),
            "bytes": world.accel_bytes(),
            "ns": micros(row) * 1e3,
            "mrays_per_s": 1.0 / micros(row),
            "nodes_per_ray": per_ray(row, row.stats.node_visits),
            "tests_per_ray": per_ray(row, row.stats.primitive_tests()),
        }));
    }
    Ok(())
}
