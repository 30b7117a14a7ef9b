//! Section 4.3: what packets ask of memory, counted in a simulator of caches.

use rt_render::measure;
use rt_render::{Exec, KdBuilder, Level, PacketSize, World};
use rt_scene::Scene;
use serde_json::json;

use super::{COHERENT, Paper, job, kd};
use crate::cmd::paper::cachegrind::{Caches, Counts, PENTIUM_III, TODAY, simulate};
use crate::error::Error;

/// How the rays go: what the command line says, and what is shown.
const WAYS: [(&str, &str); 4] =
    [("1", "one by one, scalar"), ("4", "four"), ("16", "a register"), ("64", "64")];

/// The side of the picture in pixels.
const SIDE: u32 = 256;

pub(super) fn run(paper: &mut Paper<'_>) -> Result<(), Error> {
    let triangles = COHERENT[1].min(paper.most);
    let computed = format!("terrain:{triangles}");
    let named = paper.args.scenes.iter().map(|name| name.to_string_lossy().into_owned());
    let scenes: Vec<String> = std::iter::once(computed).chain(named).collect();
    for (about, caches) in [
        ("16 KB and 256 KB, lines of 32 bytes, as the paper's Pentium III", PENTIUM_III),
        ("32 KB and 1 MB, lines of 64 bytes", TODAY),
    ] {
        paper.show(&format!(
            "Memory: what a ray of {SIDE}×{SIDE} asks for in a kd-tree, simulated by cachegrind with \
             caches of {about}; and how many times less than one by one\n\
             {:<18}{:<20}{:>9}{:>8}{:>17}{:>8}{:>16}{:>8}",
            "", "rays together", "accesses", "", "first-level misses", "", "last-level", ""
        ))?;
        for scene in &scenes {
            let without = trace_in_simulator(scene, "none", caches)?;
            let mut first = None;
            for (way, name) in WAYS {
                let with = trace_in_simulator(scene, way, caches)?;
                let rays = f64::from(SIDE) * f64::from(SIDE);
                let [refs, l1, ll] = [
                    with.accesses - without.accesses,
                    with.first - without.first,
                    with.last - without.last,
                ]
                .map(|count| count / rays);
                let [refs_one, l1_one, ll_one] = *first.get_or_insert([refs, l1, ll]);
                paper.show(&format!(
                    "{scene:<18}{name:<20}{refs:>9.1}{:>8.1}{l1:>18.3}{:>8.1}{ll:>16.4}{:>8.1}",
                    refs_one / refs,
                    l1_one / l1,
                    ll_one / ll,
                ))?;
                paper.rows.push(json!({
                    "what": "traffic",
                    "scene": scene,
                    "caches": about,
                    "packet": way,
                    "accesses_per_ray": refs,
                    "first_level_misses_per_ray": l1,
                    "last_level_misses_per_ray": ll,
                }));
            }
        }
    }
    paper.show("The paper: four times less with packets of four.\n")
}

fn trace_in_simulator(scene: &str, way: &str, caches: Caches) -> Result<Counts, Error> {
    simulate(&["paper", "wald-2001", "--trace", &format!("{scene},{way}")], Some(caches))
}

/// What is run in the simulator: builds the tree of a scene and makes the rays of a picture, and traces
/// them, or does not.
pub(super) fn trace(name: &str, packet: Option<PacketSize>, level: Level) -> Result<(), Error> {
    let scene = open(name)?;
    let world = World::build(scene.clone(), kd(KdBuilder::default()), 1)?;
    let exec = Exec::at(level);
    let rays = measure::primary(&world, &job(&scene, &world, (SIDE, SIDE), exec))?;
    if let Some(packet) = packet {
        measure::once(&world, &rays, Exec { level, packet });
    }
    Ok(())
}

/// A terrain of so many triangles, or a scene as everywhere.
fn open(name: &str) -> Result<Scene, Error> {
    let computed = name.strip_prefix("terrain:").and_then(|size| size.parse().ok());
    match computed {
        Some(triangles) => Ok(measure::terrain(triangles)),
        None => Ok(rt_scene::open(name)?),
    }
}
