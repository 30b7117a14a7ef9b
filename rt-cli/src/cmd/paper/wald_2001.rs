//! `rt paper wald-2001`.
//!
//! Wald, Slusallek, Benthin, Wagner, "Interactive Rendering with Coherent Ray Tracing", 2001. Their
//! figures, of a Pentium III at 800 MHz, stand beside ours.

use std::time::Instant;

use glam::Vec3;
use rt_render::measure::{self, Batches, Way, ZBuffer, terrain};
use rt_render::{AccelKind, Exec, Integrator, Job, KdBuilder, Level, Mailbox, PacketSize, World};
use rt_scene::Scene;

use crate::args::{Wald2001Args, best_level};
use crate::chart::{Line, Lines};
use crate::cmd::render::default_view;
use crate::error::Error;
use crate::output::{self, Output};

/// The numbers of triangles of the paper's scenes in its Table 2.
const COHERENT: [usize; 3] = [800, 34_000, 280_000];

/// And in its Table 3, with its microseconds a ray.
const COMPARED: [(usize, f64); 6] = [
    (40_000, 2.1),
    (256_000, 2.3),
    (680_000, 3.6),
    (907_000, 3.4),
    (2_500_000, 2.9),
    (8_000_000, 4.5),
];

/// The places of its hash tables that are tried: 2 to the power of these.
const TABLES: std::ops::RangeInclusive<u8> = 0..=12;

pub(crate) fn run(args: &Wald2001Args) -> Result<(), Error> {
    let level = best_level()?;
    let most = (args.triangles as usize).min(if args.quick { 300_000 } else { usize::MAX });
    tests(level, args)?;
    overhead(level, args, most)?;
    compared(level, args, most)?;
    mailboxes(level, args, most)?;
    growth(level, args, most)
}

fn show(text: &str) -> Result<(), Error> {
    output::to_stdout(format!("{text}\n").as_bytes())
}

/// Writes a chart, if charts are wanted.
fn chart(args: &Wald2001Args, name: &str, lines: &Lines<'_>) -> Result<(), Error> {
    let Some(folder) = &args.charts else { return Ok(()) };
    let path = folder.join(name);
    Output::open(&path)?.write(lines.svg().as_bytes())?;
    show(&format!("{}", path.display()))
}

fn job(scene: &Scene, world: &World, size: (u32, u32), exec: Exec) -> Job {
    let view = scene.view.unwrap_or_else(|| default_view(world.bounds(), size));
    Job {
        size,
        crop: None,
        view,
        lights: Vec::new(),
        background: Vec3::ZERO,
        integrator: Integrator::Depth,
        samples: 1,
        depth: 0,
        shadows: false,
        exec,
        threads: 1,
    }
}

fn kd(builder: KdBuilder) -> AccelKind {
    AccelKind::Kd { builder, mailbox: Mailbox::default() }
}

/// Those that were asked for, after the terrains of these numbers of triangles.
fn scenes(args: &Wald2001Args, sizes: impl Iterator<Item = usize>) -> Result<Vec<Scene>, Error> {
    let mut scenes: Vec<_> = sizes.map(terrain).collect();
    for name in &args.scenes {
        scenes.push(rt_scene::open(name)?);
    }
    Ok(scenes)
}

/// Table 1.
fn tests(level: Level, args: &Wald2001Args) -> Result<(), Error> {
    let four = if level.lanes() < 4 { level } else { four_lanes(level) };
    show(&format!(
        "Table 1: ns a ray-triangle test at {four}; the paper: cycles, 1.25 ns each\n\
         {:<32}{:>7}{:>7}{:>12}{:>15}   {}",
        "", "least", "most", "speed-up", "from memory", "paper's cycles"
    ))?;
    let rows = measure::tests(four, args.rounds.into(), args.quick);
    let words = [
        ("Wald, scalar", "78 to 148"),
        ("Wald, lanes for its equations", "20 % faster"),
        ("Plücker, lanes for its edges", "77 to 123"),
        ("Wald, lanes for four rays", "22 to 41, 3.5 to 3.7 ×"),
    ];
    for (row, (name, paper)) in rows.iter().zip(words) {
        show(&format!(
            "{name:<32}{:>7.2}{:>7.2}{:>7.1} to {:<3.1}{:>8.2}, {:>+4.0} %  {paper}",
            row.least,
            row.most,
            rows[0].least / row.least,
            rows[0].most / row.most,
            row.memory,
            (row.memory / row.least - 1.0) * 100.0,
        ))?;
    }
    show("The paper: over 60 % more where the triangle comes from memory.\n")
}

/// A level whose registers have four lanes, or the one that is best.
fn four_lanes(best: Level) -> Level {
    Level::available().rfind(|level| level.lanes() == 4).unwrap_or(best)
}

/// Table 2.
fn overhead(level: Level, args: &Wald2001Args, most: usize) -> Result<(), Error> {
    show(&format!(
        "Table 2: visits of nodes in packets more than ray by ray\n{:<24}{:>10}{:>9}{:>9}{:>9}{:>11}",
        "", "triangles", "2×2", "4×4", "8×8", "2×2, 256²"
    ))?;
    let paper = ["1.4 4.4 11.8 % 5.8 %", "2.6 8.2 21.6 % 10.4 %", "3.2 10.6 28.2 % 12.2 %"];
    let exec = Exec::at(level);
    for (i, scene) in
        scenes(args, COHERENT.into_iter().filter(|size| *size <= most))?.into_iter().enumerate()
    {
        let world = World::build(scene.clone(), AccelKind::Bvh, 1)?;
        let tree = measure::kd_tree(&world, KdBuilder::default())?;
        let over = |size: u32, packets: &[usize]| -> Result<Vec<f64>, Error> {
            let rays = measure::primary(&world, &job(&scene, &world, (size, size), exec))?;
            Ok(measure::packet_overhead(&tree, &rays, exec, packets))
        };
        let (large, small) = (over(1024, &[4, 16, 64])?, over(256, &[4])?);
        let cells: String = large.iter().map(|share| format!("{:>7.1} %", share * 100.0)).collect();
        let terrain = COHERENT.iter().take_while(|size| **size <= most).count();
        let paper = paper.get(i).filter(|_| i < terrain);
        let paper = paper.map_or(String::new(), |paper| format!("   paper: {paper}"));
        show(&format!(
            "{:<24}{:>10}{cells}{:>9.1} %{paper}",
            scene.name,
            world.triangles(),
            small[0] * 100.0
        ))?;
    }
    show("")
}

/// Table 3, and the BVH beside the kd-tree.
fn compared(level: Level, args: &Wald2001Args, most: usize) -> Result<(), Error> {
    show(&format!(
        "Table 3: rays of 512×512 pixels, one thread; ray by ray in scalar code and in packets at \
         {level}\n{:<18}{:<14}{:>8}{:>7}{:<9}{:>8}{:>9}{:>8}{:>9}{:>8}{:>8}",
        "",
        "structure",
        "build s",
        "bytes",
        "  rays",
        "µs, one",
        "packets",
        "×",
        "Mray/s",
        "steps",
        "tests"
    ))?;
    let sizes = COMPARED.into_iter().map(|(size, _)| size).filter(|size| *size <= most);
    for scene in scenes(args, sizes)? {
        let paper = COMPARED.iter().find(|(size, _)| {
            scene.name.starts_with("terrain:")
                && (*size as f64 / scene.mesh.triangles.len() as f64 - 1.0).abs() < 0.01
        });
        let kinds =
            [AccelKind::Bvh, kd(KdBuilder::Binned), kd(KdBuilder::Sweep), kd(KdBuilder::Median)];
        let worlds = kinds
            .iter()
            .filter(|kind| scene.mesh.triangles.len() <= 1_000_000 || **kind != kinds[2])
            .map(|kind| World::build(scene.clone(), *kind, 1))
            .collect::<Result<Vec<_>, _>>()?;
        let (one, many) = (Exec { level, packet: PacketSize::Single }, Exec::at(level));
        let job = job(&scene, &worlds[0], (512, 512), many);
        let primary = measure::primary(&worlds[0], &job)?;
        let light = job.view.eye + job.view.up * (job.view.eye - job.view.target).length() * 0.3;
        let rays: [Batches; 3] = [
            measure::shadow(&worlds[0], &primary, light, many),
            measure::diffuse(&worlds[0], &primary, many),
            primary,
        ];
        for rays in rays.iter().rev() {
            let ways: Vec<_> = worlds
                .iter()
                .flat_map(|world| [one, many].map(|exec| Way { world, exec }))
                .collect();
            let rows = measure::trace(rays, &ways, args.rounds.into());
            for (pair, world) in rows.chunks(2).zip(&worlds) {
                if let Some(row) = pair.iter().find(|row| row.differing > 0) {
                    let way = format!("{:?}", world.accel_kind());
                    return Err(Error::Differ { scene: scene.name, differing: row.differing, way });
                }
                let us = |i: usize| pair[i].time.as_secs_f64() * 1e6 / pair[i].rays as f64;
                let per_ray = |count: u64| count as f64 / pair[0].rays as f64;
                let stats = pair[0].stats;
                let structure = format!(
                    "{} {}",
                    world.accel_kind().name(),
                    world.builder().unwrap_or_default()
                );
                let paper = match (rays.kind, world.accel_kind(), paper) {
                    (
                        "primary",
                        AccelKind::Kd { builder: KdBuilder::Binned, .. },
                        Some((_, us)),
                    ) => {
                        format!("   paper: {us} µs")
                    }
                    _ => String::new(),
                };
                show(&format!(
                    "{:<18}{structure:<14}{:>8.2}{:>7.0}  {:<7}{:>8.3}{:>9.3}{:>8.2}{:>9.2}{:>8.1}{:>8.1}{paper}",
                    scene.name,
                    world.build_time().as_secs_f64(),
                    world.accel_bytes() as f64 / (world.triangles() + world.spheres()) as f64,
                    rays.kind,
                    us(0),
                    us(1),
                    us(0) / us(1),
                    1.0 / us(1),
                    per_ray(stats.node_visits),
                    per_ray(stats.triangle_tests + stats.sphere_tests),
                ))?;
            }
        }
    }
    show("The paper: 40 to 50 steps, 5 to 10 tests; 1.8 to 2.5 times as fast with four lanes.\n")
}

/// Section 2.3.
fn mailboxes(level: Level, args: &Wald2001Args, most: usize) -> Result<(), Error> {
    show(&format!(
        "Mailboxes: tests spared of those without any, and time to that without any\n{:<18}{:<9}{:<16}{:>8}{:>9}{:>9}",
        "", "rays", "mailbox", "tests", "spared", "time"
    ))?;
    let mut lines = Vec::new();
    let single = Exec { level, packet: PacketSize::Single };
    let ordinary = Exec::at(level);
    for scene in scenes(args, std::iter::once(COHERENT[2].min(most)))? {
        let world = World::build(scene.clone(), AccelKind::Bvh, 1)?;
        let tree = measure::kd_tree(&world, KdBuilder::default())?;
        let primary = measure::primary(&world, &job(&scene, &world, (256, 256), ordinary))?;
        let diffuse = measure::diffuse(&world, &primary, ordinary);
        let mut kinds = vec![Mailbox::None, Mailbox::Stamps, Mailbox::Inverse];
        kinds.extend(TABLES.map(Mailbox::Hashed));
        for (rays, exec, name) in [
            (&primary, single, "primary"),
            (&primary, ordinary, "packets"),
            (&diffuse, single, "diffuse"),
        ] {
            let rows = measure::mailboxes(&tree, &kinds, rays, exec, args.rounds.into());
            let none = rows[0].stats.triangle_tests as f64;
            let mut points = Vec::new();
            for row in &rows {
                let spared = row.stats.mailed as f64 / none;
                if let Mailbox::Hashed(bits) = row.mailbox {
                    points.push((f64::from(1u32 << bits), (spared * 100.0).max(0.01)));
                }
                let shown = match row.mailbox {
                    Mailbox::None => "none".to_owned(),
                    Mailbox::Stamps => "stamps".to_owned(),
                    Mailbox::Inverse => "inverse, last 8".to_owned(),
                    Mailbox::Hashed(bits) if bits % 2 == 0 => format!("hashed, {}", 1u32 << bits),
                    Mailbox::Hashed(_) => continue,
                };
                show(&format!(
                    "{:<18}{name:<9}{shown:<16}{:>8.2}{:>7.1} %{:>9.3}",
                    scene.name,
                    row.stats.triangle_tests as f64 / rays.len() as f64,
                    spared * 100.0,
                    row.time.as_secs_f64() / rows[0].time.as_secs_f64(),
                ))?;
            }
            lines.push(Line { name: format!("{}, {name}", scene.name), points });
        }
        let shared = [Mailbox::None, Mailbox::Stamps, Mailbox::Hashed(6)];
        let gains = measure::two_threads(&tree, &shared, &primary, single, args.rounds.into());
        show(&format!(
            "{:<18}two threads to one: {:.2} × without, {:.2} × with stamps that they share, {:.2} × \
             with tables of their own",
            scene.name, gains[0], gains[1], gains[2]
        ))?;
    }
    let title = "Tests that a hashed mailbox spares";
    let axes = ["entries of the table", "% of the tests without a mailbox"];
    chart(args, "mailboxes.svg", &Lines { title, axes, lines })?;
    show("")
}

/// Figure 5.
fn growth(level: Level, args: &Wald2001Args, most: usize) -> Result<(), Error> {
    show(&format!(
        "Figure 5: ms for a picture of 512×512 pixels of a terrain, one thread\n{:>10}{:>12}{:>10}{:>10}",
        "triangles", "rasteriser", "kd-tree", "BVH"
    ))?;
    let mut points: [Vec<(f64, f64)>; 3] = Default::default();
    let exec = Exec::at(level);
    for step in 0..=13 {
        let triangles = 1_000 << step;
        if triangles > most {
            break;
        }
        let scene = terrain(triangles);
        let count = scene.mesh.triangles.len() as f64;
        let worlds = [kd(KdBuilder::default()), AccelKind::Bvh]
            .map(|kind| World::build(scene.clone(), kind, 1));
        let [tree, bvh] = worlds;
        let (tree, bvh) = (tree?, bvh?);
        let job = job(&scene, &bvh, (512, 512), exec);
        let rays = measure::primary(&bvh, &job)?;
        let ways = [Way { world: &tree, exec }, Way { world: &bvh, exec }];
        let rows = measure::trace(&rays, &ways, args.rounds.into());
        let mut buffer = ZBuffer::new(job.size);
        let mut times = Vec::new();
        for _ in 0..args.rounds {
            let start = Instant::now();
            buffer.draw(&bvh, &job)?;
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
        times.sort_by(f64::total_cmp);
        let of = |i: usize| rows[i].time.as_secs_f64() * 1e3;
        let ms = [times[times.len() / 2], of(0), of(1)];
        for (points, ms) in points.iter_mut().zip(ms) {
            points.push((count, ms));
        }
        show(&format!("{count:>10}{:>12.2}{:>10.2}{:>10.2}", ms[0], ms[1], ms[2]))?;
    }
    let names = ["our z-buffer rasteriser", "kd-tree", "BVH"];
    let line = |(name, points): (&str, _)| Line { name: name.to_owned(), points };
    let lines = names.into_iter().zip(points).map(line).collect();
    let title = "A terrain in more and more triangles, 512×512 pixels";
    chart(args, "growth.svg", &Lines { title, axes: ["triangles", "ms"], lines })
}
