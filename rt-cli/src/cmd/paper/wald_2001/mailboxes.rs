//! Section 2.3: mailboxes.

use rt_render::measure;
use rt_render::{AccelKind, Exec, KdBuilder, KdTree, Mailbox, PacketSize, World};
use serde_json::json;

use super::{COHERENT, Paper, job};
use crate::chart::{Line, Lines};
use crate::error::Error;

/// The places of the hash tables that are tried: 2 to the power of these.
const TABLES: std::ops::RangeInclusive<u8> = 0..=12;

pub(super) fn run(paper: &mut Paper<'_>) -> Result<(), Error> {
    paper.show(&format!(
        "Mailboxes: tests spared of those without any, and time to that without any\n\
         {:<18}{:<9}{:>7} {:<16}{:>8}{:>9}{:>9}",
        "", "rays", "packet", "mailbox", "tests", "spared", "time"
    ))?;
    let level = paper.level;
    let single = Exec { level, packet: PacketSize::Single };
    let large = Exec { level, packet: PacketSize::Large };
    let ordinary = Exec::at(level);
    let mut lines = Vec::new();
    for scene in paper.scenes(std::iter::once(COHERENT[2].min(paper.most)))? {
        let world = World::build(scene.clone(), AccelKind::Bvh, 1)?;
        let tree = measure::kd_tree(&world, KdBuilder::default())?;
        let primary = measure::primary(&world, &job(&scene, &world, (256, 256), ordinary))?;
        let diffuse = measure::diffuse(&world, &primary, ordinary);
        let mut kinds = vec![Mailbox::None, Mailbox::Stamps, Mailbox::Inverse];
        kinds.extend(TABLES.map(Mailbox::Hashed));
        for (rays, exec) in
            [(&primary, single), (&primary, ordinary), (&primary, large), (&diffuse, single)]
        {
            let rows = measure::mailboxes(&tree, &kinds, rays, exec, paper.rounds());
            let packet = rows[0].exec.lanes();
            let none = rows[0].stats.primitive_tests() as f64;
            let mut points = Vec::new();
            for row in &rows {
                let spared = row.stats.mailed as f64 / none * 100.0;
                if let Mailbox::Hashed(bits) = row.mailbox {
                    points.push((f64::from(1u32 << bits), spared.max(0.01)));
                }
                let (tests, time) = (
                    row.stats.primitive_tests() as f64 / rays.len() as f64,
                    row.time.as_secs_f64() / rows[0].time.as_secs_f64(),
                );
                let name = name(row.mailbox);
                paper.rows.push(json!({
                    "what": "mailbox",
                    "scene": scene.name,
                    "kind": rays.kind,
                    "level": level.name(),
                    "packet": packet.to_string(),
                    "mailbox": name,
                    "tests_per_ray": tests,
                    "percent_spared": spared,
                    "time_to_none": time,
                    "ns": row.time.as_secs_f64() * 1e9 / rays.len() as f64,
                }));
                // Every second size is enough to read.
                if !matches!(row.mailbox, Mailbox::Hashed(bits) if bits % 2 == 1) {
                    paper.show(&format!(
                        "{:<18}{:<9}{packet:>7} {name:<16}{tests:>8.2}{spared:>7.1} %{time:>9.3}",
                        scene.name, rays.kind,
                    ))?;
                }
            }
            let packet = if packet == 1 { "single".into() } else { format!("{packet} together") };
            lines.push(Line { name: format!("{}, {packet}", rays.kind), points });
        }
        two_threads(paper, &scene.name, &tree, &primary, single)?;
    }
    let title = "Tests that a hashed mailbox spares";
    let axes = ["entries of the table", "% of the tests without a mailbox"];
    paper.chart("mailboxes.svg", &Lines { title, axes, lines })?;
    paper.show("")
}

/// Stamps that threads share, beside tables of their own.
fn two_threads(
    paper: &mut Paper<'_>,
    scene: &str,
    tree: &KdTree,
    rays: &measure::Batches,
    exec: Exec,
) -> Result<(), Error> {
    let mailboxes = [Mailbox::None, Mailbox::Stamps, Mailbox::default()];
    let gains = measure::two_threads(tree, &mailboxes, rays, exec, paper.rounds());
    paper.show(&format!(
        "{scene:<18}two threads to one: {:.2} × without, {:.2} × with stamps that they share, {:.2} × \
         with tables of their own",
        gains[0], gains[1], gains[2]
    ))?;
    for (mailbox, gain) in mailboxes.into_iter().zip(gains) {
        let mailbox = name(mailbox);
        paper.rows.push(json!({
            "what": "two threads",
            "scene": scene,
            "kind": rays.kind,
            "level": exec.level.name(),
            "packet": exec.lanes().to_string(),
            "mailbox": mailbox,
            "times_as_fast_as_one": gain,
        }));
    }
    Ok(())
}

fn name(mailbox: Mailbox) -> String {
    match mailbox {
        Mailbox::None => "none".to_owned(),
        Mailbox::Stamps => "stamps".to_owned(),
        Mailbox::Inverse => "inverse, last 8".to_owned(),
        Mailbox::Hashed(bits) => format!("hashed, {}", 1u32 << bits),
    }
}
