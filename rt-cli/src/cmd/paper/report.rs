//! Of Geimer and Müller: today's figures beside those of the paper.

use std::fmt::Write as _;
use std::time::Duration;

use rt_render::measure::{Extent, FrameTimes, TraversalRow};
use rt_render::{Exec, Job, Level, World};
use serde_json::{Value, json};

pub(super) const HEAD: &str = "\
Geimer and Müller 2003: primary rays and Phong shading, one thread, hierarchy by insertion
paper: 2.1 to 3.9 s a frame by the FPU and 0.58 to 1 s by SSE (Xeon, 3.06 GHz)
";

pub(super) fn scene(world: &World) -> String {
    let (triangles, time) = (world.triangles(), world.build_time().as_secs_f64());
    format!("\n{}: {triangles} triangles, built in {time:.1} s\n", world.name())
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

fn ratio(time: Duration, other: Duration) -> f64 {
    time.as_secs_f64() / other.as_secs_f64()
}

/// Frames: one ray at a time first, then packets of four at the scalar level; the last is the whole
/// picture in stages.
pub(super) fn frames(ways: &[(Exec, Extent)], frames: &[FrameTimes], level: Level) -> String {
    let mut text =
        format!("{:38}{:>22}{:>22}\n", "", "casting: times as fast", "frame: times as fast");
    let _ = writeln!(
        text,
        "  {:<10}{:>6}{:>12}{:>10}{:>11}{:>11}{:>11}{:>11}",
        "level", "packet", "casting ms", "frame ms", "to one", "to scalar", "to one", "to scalar"
    );
    let (one, scalar) = (&frames[0], &frames[1]);
    for ((exec, extent), frame) in ways.iter().zip(frames) {
        if *extent == Extent::Picture {
            continue;
        }
        let _ = writeln!(
            text,
            "  {:<10}{:>6}{:>12.1}{:>10.1}{:>11.2}{:>11.2}{:>11.2}{:>11.2}",
            exec.level,
            exec.lanes(),
            ms(frame.casting),
            ms(frame.total),
            ratio(one.casting, frame.casting),
            ratio(scalar.casting, frame.casting),
            ratio(one.total, frame.total),
            ratio(scalar.total, frame.total),
        );
    }
    for (machine, casting, total) in
        [("paper: SSE", "5.2-6.1", "2.4-3.9"), ("  AltiVec", "8-11", "4-8.1")]
    {
        let _ = writeln!(text, "  {machine:<10}{:>6}{casting:>44}{total:>22}", 4);
    }
    let by_tiles = ways
        .iter()
        .position(|(exec, extent)| (exec.level, exec.lanes(), *extent) == (level, 4, Extent::Tile));
    if let (Some(tiles), Some(whole)) = (by_tiles, frames.last()) {
        let times = ratio(whole.total, frames[tiles].total);
        let _ = writeln!(
            text,
            "  {:<52}{times:>7.2}{:>12}",
            "frame in three stages of the picture, to by tiles", "a gain"
        );
    }
    text
}

/// Ratios of ray casting, each to what differs in that alone.
pub(super) fn traversals(rows: &[TraversalRow], level: Level) -> String {
    let find = |order, test: &str, sorted| {
        rows.iter().find(|row| {
            (row.order, row.sorted) == (order, sorted) && row.box_test.starts_with(test)
        })
    };
    let [renders, unsorted, heap, exact, estimate, shared] = [
        find("skip", "robust", true),
        find("skip", "robust", false),
        find("heap", "robust", true),
        find("skip", "unordered", true),
        find("skip", "conservative", true),
        find("skip", "shared", true),
    ];
    let mut text = format!(
        "  {:<52}{:>7}{:>12}{:>12}\n",
        format!("casting by packets of four at {level}, time:"),
        "now",
        "paper",
        "visits now"
    );
    for (what, one, other, paper) in [
        ("children as inserted, to children sorted by surface", unsorted, renders, "to 1.1"),
        ("heap order, to skip pointers", heap, renders, "nearly 2"),
        ("exact box test, to conservative", exact, estimate, "over 1"),
        ("origin subtracted for each ray, to shared origin", estimate, shared, "over 1"),
        ("conservative box test, to what renders", estimate, renders, ""),
    ] {
        if let (Some(one), Some(other)) = (one, other) {
            let times = ratio(one.time, other.time);
            let visits = one.stats.node_visits as f64 / other.stats.node_visits as f64;
            let _ = writeln!(text, "  {what:<52}{times:>7.2}{paper:>12}{visits:>12.2}");
        }
    }
    text
}

pub(super) fn frame_json(
    world: &World,
    job: &Job,
    (exec, extent): (Exec, Extent),
    times: &FrameTimes,
) -> Value {
    let rays = f64::from(job.size.0) * f64::from(job.size.1);
    json!({
        "what": "frame",
        "scene": world.name(),
        "kind": "primary",
        "level": exec.level.name(),
        "packet": exec.lanes().to_string(),
        "kernel": world.method().name(),
        "accel": world.accel_kind().name(),
        "builder": world.builder(),
        "layout": world.layout(),
        "extent": extent.name(),
        "ns": times.casting.as_secs_f64() * 1e9 / rays,
        "mrays_per_s": rays / times.casting.as_secs_f64() / 1e6,
        "casting_ms": ms(times.casting),
        "shading_ms": ms(times.shading),
        "frame_ms": ms(times.total),
        "bytes": world.accel_bytes(),
    })
}

pub(super) fn traversal_json(world: &World, level: Level, row: &TraversalRow) -> Value {
    let per_ray = |count: u64| count as f64 / row.rays as f64;
    json!({
        "what": "trace",
        "scene": world.name(),
        "kind": "primary",
        "level": level.name(),
        "packet": "4",
        "kernel": world.method().name(),
        "accel": world.accel_kind().name(),
        "builder": world.builder(),
        "layout": world.layout(),
        "order": row.order,
        "box_test": row.box_test,
        "sorted": row.sorted,
        "ns": row.time.as_secs_f64() * 1e9 / row.rays as f64,
        "mrays_per_s": row.rays as f64 / row.time.as_secs_f64() / 1e6,
        "nodes_per_ray": per_ray(row.stats.box_tests),
        "tests_per_ray": per_ray(row.stats.triangle_tests),
        "bytes": world.accel_bytes(),
    })
}
