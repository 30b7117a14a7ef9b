//! One answer: the same bytes for every level, packet size, number of threads, accelerator,
//! builder and layout.

use crate::support::{BUILDERS, LAYOUTS, Run, Scratch, levels, run};

const INTEGRATORS: [&str; 4] = ["whitted", "eyelight", "normals", "depth"];

#[test]
fn every_way_to_work_gives_the_same_bytes() {
    let scratch = Scratch::with_room();
    for scene in ["room.obj", "spd:balls:1"] {
        for integrator in INTEGRATORS {
            let base = [scene, "-s", "35x27", "--integrator", integrator];
            let png = |flags: &[&str]| scratch.png(&[&base, flags].concat());
            let expected = png(&[]);
            let mut ways = vec![vec!["-j", "1"], vec!["-j", "2"], vec!["--accel", "brute"]];
            let levels = levels();
            for level in &levels {
                ways.push(vec!["--isa", level]);
            }
            ways.extend(BUILDERS.map(|builder| vec!["--builder", builder]));
            ways.extend(LAYOUTS.map(|layout| vec!["--layout", layout]));
            let cells = ["sweep", "binned", "median"];
            ways.extend(cells.map(|builder| vec!["--accel", "kd", "--kd-builder", builder]));
            if integrator == "whitted" {
                for level in &levels {
                    ways.extend(["1", "4", "8"].map(|size| vec!["--isa", level, "--packet", size]));
                    ways.push(vec!["--isa", level, "--accel", "brute", "-j", "3"]);
                    let kd = |size| vec!["--isa", level, "--packet", size, "--accel", "kd"];
                    ways.extend(["1", "4", "8", "16", "64"].map(kd));
                }
            }
            for way in ways {
                assert!(png(&way) == expected, "{scene} {integrator} {way:?}");
            }
        }
    }
}

fn with_level(level: &str, args: &[&str]) -> Run {
    let scratch = Scratch::with_room();
    run(scratch.rt_command(args).env("SIMD4_LEVEL", level))
}

const RENDER: [&str; 8] = ["render", "room.obj", "-o", "a.png", "-s", "8x8", "--stats-json", "-"];

#[test]
fn the_environment_picks_the_level_of_auto() {
    for level in levels() {
        let machine = with_level(&level, &["info", "--json"]).exits(0).json();
        assert_eq!(machine["default_level"], *level);
        assert_eq!(with_level(&level, &RENDER).exits(0).json()["isa"], *level);
        let run = with_level(&level, &[&RENDER[..], &["--isa", "scalar"]].concat()).exits(0);
        assert_eq!(run.json()["isa"], "scalar");
    }
}

#[test]
fn levels_that_are_not_there_are_errors_that_list_those_that_are() {
    let levels = levels();
    let list = levels.join(", ");
    let known = ["neon", "avx2"];
    let lacking = known.into_iter().find(|known| !levels.iter().any(|level| level == known));
    let lacking = lacking.expect("no CPU has both");
    let scratch = Scratch::with_room();
    let run = scratch.rt(&["render", "room.obj", "-o", "a.png", "--isa", lacking]).exits(1);
    let lacks = format!("this CPU lacks the level {lacking}; it has {list}\n");
    assert_eq!(run.stderr, format!("error: --isa {lacking}: {lacks}"));
    assert_eq!(scratch.names(), ["room.mtl", "room.obj"]);

    for args in [&RENDER[..], &["info"]] {
        let run = with_level(lacking, args).exits(1);
        assert_eq!(run.stderr, format!("error: SIMD4_LEVEL={lacking}: {lacks}"));
        let run = with_level("nonsense", args).exits(1);
        let message = format!("there is no such level; this CPU has {list}\n");
        assert_eq!(run.stderr, format!("error: SIMD4_LEVEL=nonsense: {message}"));
    }
}

#[test]
fn a_bad_environment_is_no_matter_to_who_does_not_ask_it() {
    let with_isa = [&RENDER[..], &["--isa", "scalar"]].concat();
    assert_eq!(with_level("nonsense", &with_isa).exits(0).json()["isa"], "scalar");
    with_level("nonsense", &["info", "room.obj"]).exits(0);
    with_level("nonsense", &["gen", "balls", "--size", "0"]).exits(0);
}

#[test]
fn a_level_that_nobody_knows_is_wrong_usage() {
    let run = Scratch::with_room().rt(&["render", "room.obj", "-o", "a.png", "--isa", "mmx"]);
    let run = run.exits(2);
    assert!(run.stderr.contains("possible values: auto, scalar"), "{}", run.stderr);
}
