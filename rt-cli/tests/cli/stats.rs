//! `render --stats-json`: the keys that scripts rely on, and numbers that can be.

use serde_json::Value;

use crate::support::{BUILDERS, LAYOUTS, Scratch, keys, levels};

const KEYS: [&str; 31] = [
    "scene",
    "output",
    "width",
    "height",
    "crop",
    "triangles",
    "primitives",
    "integrator",
    "isa",
    "threads",
    "accel",
    "builder",
    "layout",
    "packet",
    "kernel",
    "relaxed",
    "tolerance",
    "build_ms",
    "trace_ms",
    "shade_ms",
    "total_ms",
    "memory",
    "rays",
    "rays_alone",
    "mrays_per_s",
    "mrays_per_s_by_kind",
    "node_visits",
    "box_tests",
    "triangle_tests",
    "sphere_tests",
    "cone_tests",
];

#[track_caller]
fn stats(scratch: &Scratch, scene: &str, flags: &[&str]) -> Value {
    let base = ["render", scene, "-o", "a.png", "-s", "30x20", "--stats-json", "-"];
    scratch.rt(&[&base[..], flags].concat()).exits(0).json()
}

fn count(value: &Value) -> u64 {
    value.as_u64().unwrap_or_else(|| panic!("{value} is no count"))
}

fn positive(value: &Value) -> bool {
    value.as_f64().is_some_and(|x| x > 0.0)
}

#[test]
fn the_keys_are_those_that_are_documented() {
    let stats = stats(&Scratch::new(), "spd:balls:1", &[]);
    assert_eq!(keys(&stats), KEYS);
    assert_eq!(keys(&stats["memory"]), ["scene_bytes", "accel_bytes"]);
    assert_eq!(keys(&stats["rays"]), ["primary", "shadow", "reflection", "refraction"]);
    for counted in ["rays_alone", "mrays_per_s_by_kind"] {
        assert_eq!(keys(&stats[counted]), ["primary", "shadow", "reflection", "refraction"]);
    }
}

#[test]
fn the_numbers_can_be() {
    let scratch = Scratch::new();
    let stats = stats(&scratch, "spd:balls:1", &["--isa", "scalar", "-j", "2"]);
    for (key, value) in [("scene", "spd:balls:1"), ("output", "a.png"), ("isa", "scalar")] {
        assert_eq!(stats[key], value);
    }
    for (key, value) in [
        ("accel", "bvh"),
        ("builder", "binned-sah"),
        ("layout", "bvh8"),
        ("kernel", "watertight"),
        ("integrator", "whitted"),
    ] {
        assert_eq!(stats[key], value);
    }
    for (key, value) in [("width", 30), ("height", 20), ("threads", 2), ("triangles", 2)] {
        assert_eq!(stats[key], value, "{key}");
    }
    assert_eq!(stats["primitives"].to_string(), r#"{"polygon":1,"sphere":10}"#);
    assert_eq!(stats["rays"]["primary"], 600);
    assert_eq!(stats["rays"]["refraction"], 0);
    assert!(count(&stats["rays"]["shadow"]) > 0 && count(&stats["rays"]["reflection"]) > 0);
    for key in ["build_ms", "trace_ms", "shade_ms", "total_ms", "mrays_per_s"] {
        assert!(positive(&stats[key]), "{key}: {}", stats[key]);
    }
    let ms = |key: &str| stats[key].as_f64().expect("a time");
    assert!(ms("trace_ms") + ms("shade_ms") + ms("build_ms") <= ms("total_ms") + 1e-6);
    assert!(count(&stats["box_tests"]) >= count(&stats["node_visits"]));
    for key in ["node_visits", "triangle_tests", "sphere_tests"] {
        assert!(count(&stats[key]) > 0, "{key}");
    }
    for key in ["scene_bytes", "accel_bytes"] {
        assert!(count(&stats["memory"][key]) > 0, "{key}");
    }
}

#[test]
fn brute_force_visits_no_nodes() {
    let brute = stats(&Scratch::new(), "spd:balls:1", &["--accel", "brute"]);
    assert_eq!((&brute["accel"], &brute["builder"]), (&"brute".into(), &Value::Null));
    assert_eq!(brute["node_visits"], 0);
    // A shadow ray may stop at the first hit; every other is tested against all ten spheres.
    let all_the_way = count(&brute["rays"]["primary"]) + count(&brute["rays"]["reflection"]);
    assert!(count(&brute["sphere_tests"]) >= 10 * all_the_way, "{brute}");
}

#[test]
fn the_same_rays_are_traced_in_every_way() {
    let scratch = Scratch::with_room();
    let flags = ["--light", "-1,2.5,1.5"];
    let expected = stats(&scratch, "room.obj", &flags)["rays"].clone();
    assert!(count(&expected["shadow"]) > 0 && count(&expected["reflection"]) > 0, "{expected}");
    let mut ways = vec![vec!["--accel", "brute"], vec!["-j", "1"], vec!["-j", "5"]];
    let levels = levels();
    ways.extend(levels.iter().map(|level| vec!["--isa", level]));
    ways.extend(BUILDERS.map(|builder| vec!["--builder", builder]));
    ways.extend(LAYOUTS.map(|layout| vec!["--layout", layout]));
    for way in ways {
        let stats = stats(&scratch, "room.obj", &[&flags[..], &way].concat());
        assert_eq!(stats["rays"], expected, "{way:?}");
        match way[..] {
            ["--builder", builder] => assert_eq!(stats["builder"], builder),
            ["--layout", layout] => assert_eq!(stats["layout"], layout),
            _ => {}
        }
    }
}

#[test]
fn flags_cost_and_save_rays() {
    let scratch = Scratch::with_room();
    let rays = |flags: &[&str]| {
        let rays = stats(&scratch, "room.obj", flags)["rays"].clone();
        ["primary", "shadow", "reflection"].map(|kind| count(&rays[kind]))
    };
    let [_, shadow, reflection] = rays(&["--light", "-1,2.5,1.5"]);
    assert_eq!(rays(&["--light", "-1,2.5,1.5", "--no-shadows"]), [600, 0, reflection]);
    assert!(rays(&["--light", "-1,2.5,1.5", "--depth", "0"])[1] <= shadow);
    assert_eq!(rays(&["--light", "-1,2.5,1.5", "--depth", "0"])[2], 0);
    assert_eq!(rays(&["--integrator", "eyelight"]), [600, 0, 0]);
}

/// Wide nodes are for single rays and large packets and for the watertight test, and the program
/// says so.
#[test]
fn what_a_layout_comes_to_is_told() {
    let scratch = Scratch::with_room();
    for layout in ["bvh4", "bvh8"] {
        let flags = ["--layout", layout, "--packet", "8"];
        let wide = stats(&scratch, "room.obj", &flags);
        assert_eq!((&wide["layout"], &wide["packet"]), (&layout.into(), &"8".into()));
        let wald = stats(&scratch, "room.obj", &[&flags[..], &["--kernel", "wald"]].concat());
        assert_eq!(wald["layout"], "skip");
    }
    let brute = stats(&scratch, "room.obj", &["--layout", "bvh4", "--accel", "brute"]);
    assert_eq!(brute["layout"], "list");
}

#[test]
fn packets_are_told_by_their_number_of_rays() {
    let scratch = Scratch::new();
    for (layout, sizes) in [("skip", ["1", "4", "8"]), ("bvh8", ["1", "4", "8"])] {
        for (asked, size) in ["1", "4", "8"].iter().zip(sizes) {
            let flags = ["--layout", layout, "--packet", asked];
            assert_eq!(stats(&scratch, "spd:balls:0", &flags)["packet"], size);
        }
    }
}

/// Rays that go one by one from the start, never, and some: those of the eye less often than those of
/// mirrors.
#[test]
fn rays_that_part_are_counted() {
    let scratch = Scratch::new();
    let counts = |flags: &[&str]| {
        let stats = stats(&scratch, "spd:balls:2", flags);
        ["primary", "reflection"]
            .map(|kind| [&stats["rays"], &stats["rays_alone"]].map(|counts| count(&counts[kind])))
    };
    let all = counts(&["--packet", "1"]);
    assert!(all.iter().all(|[rays, alone]| rays == alone && *rays > 0), "{all:?}");
    let none = counts(&["--layout", "skip", "--packet", "4"]);
    assert!(none.iter().all(|[_, alone]| *alone == 0), "{none:?}");
    let some = counts(&["--packet", "64"]).map(|[rays, alone]| alone as f64 / rays as f64);
    assert!(0.0 < some[0] && some[0] < some[1] && some[1] <= 1.0, "{some:?}");
}

#[test]
fn a_file_gets_what_standard_output_gets() {
    let scratch = Scratch::new();
    let args = ["render", "spd:balls:0", "-o", "a.png", "-s", "8x8", "--stats-json", "stats.json"];
    assert!(scratch.rt(&args).exits(0).stdout.is_empty());
    let stats: Value = serde_json::from_slice(&scratch.bytes("stats.json")).unwrap();
    assert_eq!(keys(&stats), KEYS);
    assert_eq!(scratch.names(), ["a.png", "stats.json"]);
}
