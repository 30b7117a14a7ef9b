//! `rt bench`.

use serde_json::Value;

use crate::support::{Scratch, keys, levels};

const QUICK: [&str; 4] = ["-s", "16x16", "--rounds", "1"];

const KEYS: [&str; 15] = [
    "what",
    "scene",
    "kind",
    "level",
    "kernel",
    "accel",
    "builder",
    "layout",
    "packet",
    "ns",
    "mrays_per_s",
    "nodes_per_ray",
    "tests_per_ray",
    "build_ms",
    "bytes",
];

#[test]
fn rows_are_one_ray_and_then_every_level() {
    let scratch = Scratch::with_room();
    let args = [&["bench", "room.obj", "spd:balls:1", "--json", "b.json"], &QUICK[..]].concat();
    let run = scratch.rt(&args).exits(0);
    let json: Value = serde_json::from_slice(&scratch.bytes("b.json")).unwrap();
    assert_eq!(keys(&json), ["rows"]);
    let rows = json["rows"].as_array().unwrap();
    let levels = levels();
    assert_eq!(rows.len(), 2 * (levels.len() + 1));
    for row in rows {
        assert_eq!(keys(row), KEYS);
        for key in ["ns", "mrays_per_s", "nodes_per_ray", "tests_per_ray", "build_ms", "bytes"] {
            assert!(row[key].as_f64().unwrap() > 0.0, "{key} in {row}");
        }
    }
    for (scene, rows) in ["room.obj", "spd:balls:1"].iter().zip(rows.chunks(levels.len() + 1)) {
        assert!(rows.iter().all(|row| row["scene"] == *scene));
        assert_eq!((&rows[0]["level"], &rows[0]["packet"]), (&"scalar".into(), &"1".into()));
        let others: Vec<_> = rows[1..].iter().map(|row| row["level"].as_str().unwrap()).collect();
        assert_eq!(others, levels);
    }

    // The table says the same, in columns.
    let table = run.text();
    let lines: Vec<_> = table.lines().collect();
    assert_eq!(lines.len(), rows.len() + 1);
    let width = lines[0].chars().count();
    assert!(width <= 80 && lines.iter().all(|line| line.chars().count() == width), "{table}");
    for (line, row) in lines[1..].iter().zip(rows) {
        let words: Vec<_> = line.split_whitespace().collect();
        assert_eq!(words[..3], ["scene", "level", "packet"].map(|key| row[key].as_str().unwrap()));
        assert_eq!(words.len(), 8, "{line}");
    }
}

#[test]
fn json_on_standard_output_is_alone_there() {
    let args = [&["bench", "spd:balls:0", "--json", "-"], &QUICK[..]].concat();
    let run = Scratch::new().rt(&args).exits(0);
    assert_eq!(keys(&run.json()), ["rows"]);
}

#[test]
fn a_scene_after_json_is_not_overwritten() {
    let scratch = Scratch::with_room();
    let before = scratch.bytes("room.obj");
    let run = scratch.rt(&["bench", "--json", "room.obj", "spd:balls:0"]).exits(1);
    assert_eq!(run.stderr, "error: cannot write room.obj: give it the extension .json\n");
    assert_eq!(scratch.bytes("room.obj"), before);
}

#[test]
fn what_is_measured_before_a_bad_scene_is_shown() {
    let scratch = Scratch::new();
    let args = [&["bench", "spd:balls:0", "no.obj", "--json", "b.json"], &QUICK[..]].concat();
    let run = scratch.rt(&args).exits(1);
    assert_eq!(run.text().lines().count(), levels().len() + 2);
    assert!(run.stderr.starts_with("error: cannot read no.obj: "), "{}", run.stderr);
    assert!(scratch.names().is_empty(), "{:?}", scratch.names());
}

#[test]
fn kernels_are_told_side_by_side() {
    let scratch = Scratch::with_room();
    let args = [&["bench", "room.obj", "--kernels", "--json", "b.json"], &QUICK[..]].concat();
    let table = scratch.rt(&args).exits(0).text();
    let json: Value = serde_json::from_slice(&scratch.bytes("b.json")).unwrap();
    let rows = json["rows"].as_array().unwrap();
    let kernels: Vec<_> = rows.iter().map(|row| row["kernel"].as_str().unwrap()).collect();
    assert_eq!(kernels, ["watertight", "moller-trumbore", "wald", "plucker"]);
    let lines: Vec<_> = table.lines().collect();
    let width = lines[0].chars().count();
    assert!(width <= 80 && lines.iter().all(|line| line.chars().count() == width), "{table}");
    for (line, kernel) in lines[1..].iter().zip(&kernels) {
        let words: Vec<_> = line.split_whitespace().collect();
        assert_eq!(words[..2], ["room.obj", kernel]);
    }
}

#[test]
fn builders_are_told_side_by_side() {
    let scratch = Scratch::with_room();
    let args = [&["bench", "room.obj", "--builders", "--json", "b.json"], &QUICK[..]].concat();
    let table = scratch.rt(&args).exits(0).text();
    let json: Value = serde_json::from_slice(&scratch.bytes("b.json")).unwrap();
    let rows = json["rows"].as_array().unwrap();
    let builders: Vec<_> = rows.iter().map(|row| row["builder"].as_str().unwrap()).collect();
    assert_eq!(builders, ["binned-sah", "sweep-sah", "insertion", "spatial"]);
    let lines: Vec<_> = table.lines().collect();
    let width = lines[0].chars().count();
    assert!(width <= 80 && lines.iter().all(|line| line.chars().count() == width), "{table}");
    for (line, builder) in lines[1..].iter().zip(&builders) {
        let words: Vec<_> = line.split_whitespace().collect();
        assert_eq!(words[..2], ["room.obj", builder]);
    }
}

/// With each kind of rays every layout, ray by ray and in packets.
#[test]
fn layouts_are_told_side_by_side() {
    let scratch = Scratch::with_room();
    let args = [&["bench", "room.obj", "--layouts", "--json", "b.json"], &QUICK[..]].concat();
    let table = scratch.rt(&args).exits(0).text();
    let json: Value = serde_json::from_slice(&scratch.bytes("b.json")).unwrap();
    let rows = json["rows"].as_array().unwrap();
    let keys = ["kind", "layout", "packet"];
    let told: Vec<_> = rows.iter().map(|row| keys.map(|key| row[key].as_str().unwrap())).collect();
    for (kind, told) in ["primary", "diffuse"].iter().zip(told.chunks(6)) {
        let wide = ["bvh8", "bvh4"].map(|layout| [[kind, layout, "1"], [kind, layout, "64"]]);
        assert_eq!(told[..4], wide.concat());
        assert_eq!(told[4], [kind, "skip", "1"]);
        assert_eq!(told[5][..2], [*kind, "skip"]);
        assert!(told[5][2] != "1", "{table}");
    }
    let lines: Vec<_> = table.lines().collect();
    assert_eq!((lines.len(), rows.len()), (13, 12), "{table}");
    let width = lines[0].chars().count();
    assert!(width <= 80 && lines.iter().all(|line| line.chars().count() == width), "{table}");
    for (line, told) in lines[1..].iter().zip(told) {
        let words: Vec<_> = line.split_whitespace().collect();
        assert_eq!(words[..4], ["room.obj", told[0], told[1], told[2]]);
        assert_eq!(words.len(), 9, "{line}");
    }
}

#[test]
fn builder_and_layout_can_be_chosen() {
    let scratch = Scratch::with_room();
    for (flag, key, value) in
        [("--builder", "builder", "insertion"), ("--layout", "layout", "skip")]
    {
        let args = ["bench", "room.obj", flag, value, "--json", "-"];
        let json = scratch.rt(&[&args, &QUICK[..]].concat()).exits(0).json();
        let rows = json["rows"].as_array().unwrap();
        assert!(rows.len() > 1 && rows.iter().all(|row| row[key] == value), "{json}");
    }
}
