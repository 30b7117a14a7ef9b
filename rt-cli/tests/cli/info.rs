//! `rt info`.

use crate::support::{ROOM, Scratch, TRIANGLE, keys};

#[test]
fn a_scene_s_keys_are_those_that_are_documented() {
    let scratch = Scratch::with_room();
    scratch.file("odd.obj", format!("{TRIANGLE}l 1 2\nl 2 3\nf 1 1 2\nmtllib no.mtl\n"));
    let info = scratch.rt(&["info", "odd.obj", "--json"]).exits(0).json();
    let expected = [
        "triangles",
        "primitives",
        "vertices",
        "materials",
        "lights",
        "bounds",
        "skipped",
        "warnings",
        "precision",
    ];
    assert_eq!(keys(&info), expected);
    assert_eq!(keys(&info["bounds"]), ["min", "max"]);
    assert_eq!(keys(&info["skipped"][0]), ["what", "why", "count"]);
    assert_eq!(info["triangles"], 2);
    assert_eq!(info["primitives"]["polygon"], 2);
    assert_eq!(info["vertices"], 3);
    assert_eq!(info["bounds"].to_string(), r#"{"min":[0.0,0.0,0.0],"max":[1.0,1.0,0.0]}"#);
    let skipped = &info["skipped"][0];
    assert_eq!((&skipped["what"], &skipped["count"]), (&"l".into(), &2.into()));
    let warnings = info["warnings"].as_array().unwrap();
    let warned = |text: &str| warnings.iter().any(|w| w.as_str().unwrap().contains(text));
    assert!(warned("odd.obj:8:8: cannot read material library 'no.mtl'"), "{warnings:?}");
    assert!(warned("1 triangle has no area"), "{warnings:?}");
}

#[test]
fn primitives_are_what_the_file_states_and_triangles_what_is_traced() {
    let scratch = Scratch::with_room();
    let room = scratch.rt(&["info", "room.obj", "--json"]).exits(0).json();
    let faces = ROOM.lines().filter(|line| line.starts_with("f ")).count();
    assert_eq!(room["primitives"]["polygon"], faces);
    assert_eq!(room["triangles"], 7);
    assert_eq!(room["materials"], 3);
    let balls = scratch.rt(&["info", "spd:balls:2", "--json"]).exits(0).json();
    assert_eq!(balls["primitives"].to_string(), r#"{"polygon":1,"sphere":91}"#);
    assert_eq!((&balls["triangles"], &balls["lights"]), (&2.into(), &3.into()));
}

#[test]
fn tessellated_primitives_are_stated_as_such_and_traced_as_triangles() {
    let scratch = Scratch::new();
    for (flags, triangles) in
        [(&["--tessellate"][..], 10 * 192 + 2), (&["--tessellate", "1"], 10 * 12 + 2), (&[], 2)]
    {
        let args = [&["info", "spd:balls:1", "--json"], flags].concat();
        let info = scratch.rt(&args).exits(0).json();
        assert_eq!(info["triangles"], triangles);
        assert_eq!(info["primitives"].to_string(), r#"{"polygon":1,"sphere":10}"#);
    }
    for bad in ["0", "1025", "x"] {
        scratch.rt(&["info", "spd:balls:1", "--tessellate", bad]).exits(2);
    }
    let run = scratch.rt(&["info", "spd:balls:7", "--tessellate"]).exits(1);
    let message = "spd:balls:7 has more than 268435456 triangles at resolution 4";
    assert_eq!(run.stderr, format!("error: {message}\n"));
}

#[test]
fn long_names_have_their_numbers_apart() {
    let scratch = Scratch::new();
    scratch.file("a.aff", "m vertices 3 0 0 0 1 0 0 0 1 0 triangles 1 0 1 2");
    let text = scratch.rt(&["info", "a.aff"]).exits(0).text();
    assert!(text.starts_with("a.aff\n  mesh triangles  1\n  triangles       1\n"), "{text}");
}

#[test]
fn a_scene_s_facts_as_text() {
    let scratch = Scratch::new();
    scratch.file("a.obj", TRIANGLE);
    let text = scratch.rt(&["info", "a.obj"]).exits(0).text();
    let expected = "\
a.obj
  polygons    1
  triangles   1
  vertices    3
  materials   1
  lights      0
  bounds      [0, 0, 0] to [1, 1, 0]
  extent      [1, 1, 0]
  precision   coordinates up to 1.00, features down to 0.707: ratio 1.41
  slivers     up to 2.00 times as long as high
  crowding    a line meets the boxes of 1.00 triangles on average
  kernel      wald: band 1.26e-6, depth 9.86e-7: at most 7.85e-4 px; cheaper over skip arrays
  kernel      moller-trumbore: band 6.00e-7, depth 1.90e-6: at most 1.18e-3 px; cheaper over skip arrays
  kernel      plucker: band 8.48e-7, depth 1.90e-6: at most 1.18e-3 px; no cheaper here
  kernel      watertight: band 8.55e-7, depth 1.52e-6: at most 9.47e-4 px; keeps the promise: no leaks
";
    assert_eq!(text, expected);
    let balls = scratch.rt(&["info", "spd:balls:0"]).exits(0).text();
    let view = "view        --eye 2.1,1.3,1.7 --target 0,0,0 --up 0,0,1 --fov 45";
    assert!(balls.contains(view) && balls.contains("size        512x512"), "{balls}");
}

#[test]
fn the_machine() {
    let scratch = Scratch::new();
    let machine = scratch.rt(&["info", "--json"]).exits(0).json();
    assert_eq!(keys(&machine), ["arch", "levels", "default_level"]);
    assert_eq!(machine["arch"], std::env::consts::ARCH);
    let levels = machine["levels"].as_array().unwrap();
    assert_eq!(levels[0], "scalar");
    assert_eq!(machine["default_level"], levels[levels.len() - 1]);
    let text = scratch.rt(&["info"]).exits(0).text();
    let default = format!("default level: {}\n", machine["default_level"].as_str().unwrap());
    assert!(text.starts_with("architecture: ") && text.ends_with(&default), "{text}");
}
