//! `--kernel`, `--tolerance`, and what `rt info` tells of precision.

use serde_json::Value;

use crate::support::{Picture, Scratch, keys, levels};

/// A grid of squares, `place` away from the origin on every axis.
fn grid(place: i32) -> String {
    let mut obj = String::new();
    for (x, y) in (0..9).flat_map(|y| (0..9).map(move |x| (x, y))) {
        let z = (x * 5 + y * 3) % 7;
        obj +=
            &format!("v {} {} {}\n", place + x, place + y, f64::from(place) + f64::from(z) / 8.0);
    }
    for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))) {
        let a = 9 * y + x + 1;
        obj += &format!("f {} {} {}\nf {} {} {}\n", a, a + 1, a + 10, a, a + 10, a + 9);
    }
    obj
}

/// Needles side by side.
fn needles() -> String {
    let mut obj = String::new();
    for i in 0..3000 {
        let x = f64::from(i) / 3000.0;
        obj += &format!("v {x} 0 0\nv {} 0 0\nv {x} 1 0\n", x + 1.0 / 3000.0);
        obj += &format!("f {} {} {}\n", 3 * i + 3, 3 * i + 1, 3 * i + 2);
    }
    obj
}

fn scenes() -> Scratch {
    let scratch = Scratch::new();
    scratch.file("near.obj", grid(0));
    scratch.file("far.obj", grid(300_000));
    scratch.file("needles.obj", needles());
    scratch
}

#[track_caller]
fn stats(scratch: &Scratch, args: &[&str]) -> Value {
    let base = ["render", "-o", "a.png", "-s", "64x64", "--stats-json", "-"];
    scratch.rt(&[&base, args].concat()).exits(0).json()
}

const EXPECTED: [(&str, &str); 3] =
    [("near.obj", "wald"), ("far.obj", "moller-trumbore"), ("needles.obj", "watertight")];

#[test]
fn a_tolerance_picks_the_same_on_every_level() {
    let scratch = scenes();
    for (scene, kernel) in EXPECTED {
        let all: Vec<_> = levels()
            .iter()
            .map(|level| {
                let flags = [scene, "--layout", "skip", "--tolerance", "0.05", "--isa", level];
                stats(&scratch, &flags)
            })
            .collect();
        for stats in &all {
            assert_eq!(stats["kernel"], kernel, "{scene}");
            assert_eq!(stats["tolerance"], all[0]["tolerance"], "{scene}");
        }
        assert_eq!(keys(&all[0]["tolerance"]), ["px", "predicted"]);
        assert_eq!(all[0]["tolerance"]["px"], 0.05);
    }
}

#[test]
fn without_a_tolerance_or_with_none_it_is_watertight() {
    let scratch = scenes();
    for (scene, _) in EXPECTED {
        let plain = stats(&scratch, &[scene]);
        assert_eq!((&plain["kernel"], &plain["tolerance"]), (&"watertight".into(), &Value::Null));
        let picture = scratch.bytes("a.png");
        assert_eq!(stats(&scratch, &[scene, "--tolerance", "0"])["kernel"], "watertight");
        assert!(scratch.bytes("a.png") == picture, "{scene}");
    }
}

#[test]
fn the_closing_line_says_which_and_why() {
    let scratch = scenes();
    let line = |args: &[&str]| {
        let base = ["render", "-o", "a.png", "-s", "64x64"];
        let talk = scratch.rt(&[&base, args].concat()).exits(0).stderr;
        talk.lines().last().expect("a closing line").to_owned()
    };
    let skip = |scene| line(&[scene, "--layout", "skip", "--tolerance", "0.05"]);
    let wald = skip("near.obj");
    assert!(wald.contains("; wald kernel (off by at most 1."), "{wald}");
    assert!(wald.ends_with(" px, tolerance 0.05 px)"), "{wald}");
    let cells = line(&["near.obj", "--accel", "kd", "--tolerance", "0.05"]);
    let why = "; watertight kernel (none that stays under 0.05 px is cheaper here)";
    assert!(cells.ends_with(why), "{cells}");
    let wide = line(&["near.obj", "--tolerance", "0.05"]);
    assert!(wide.ends_with("; watertight kernel (over wide nodes none is cheaper)"), "{wide}");
    let needles = skip("needles.obj");
    let why = "; watertight kernel (no cheaper one stays under 0.05 px)";
    assert!(needles.ends_with(why), "{needles}");
    let asked = line(&["near.obj", "--kernel", "moller-trumbore"]);
    assert!(asked.ends_with("; moller-trumbore kernel"), "{asked}");
}

#[test]
fn every_kernel_renders_and_each_its_own_picture() {
    let scratch = scenes();
    let picture = |scene: &str, kernel: &str| {
        Picture::decode(&scratch.png(&[scene, "-s", "64x64", "--kernel", kernel]))
    };
    for kernel in ["watertight", "moller-trumbore", "wald", "plucker"] {
        assert_eq!(stats(&scratch, &["near.obj", "--kernel", kernel])["kernel"], kernel);
        let same = scratch.png(&["far.obj", "-s", "64x64", "--kernel", kernel, "--accel", "brute"]);
        assert!(Picture::decode(&same) == picture("far.obj", kernel), "{kernel}");
    }
    // Far from the origin the precomputed records are off by pixels.
    assert!(picture("far.obj", "wald") != picture("far.obj", "watertight"));
}

#[test]
fn info_tells_what_decides_and_what_follows() {
    let scratch = scenes();
    scratch.file("odd.obj", "v 0 0 0\nv 8 0 0\nv 4 0.25 0\nf 1 2 3\nf 3 1 2\nf 1 2 2\n");
    let odd = scratch.rt(&["info", "odd.obj", "--json"]).exits(0).json()["precision"].clone();
    let expected = [
        "largest_coordinate",
        "smallest_feature",
        "ratio",
        "worst_aspect",
        "boxes_met",
        "degenerate",
        "duplicates",
        "curved",
        "kernels",
    ];
    assert_eq!(keys(&odd), expected);
    let numbers = [8.0, 0.25, 32.0, 32.0, 2.0];
    for (key, number) in expected.iter().zip(numbers) {
        assert_eq!(odd[key], number, "{key}");
    }
    assert_eq!((&odd["degenerate"], &odd["duplicates"]), (&1.into(), &1.into()));
    let kernels = odd["kernels"].as_array().expect("a list");
    let names: Vec<_> = kernels.iter().map(|kernel| &kernel["kernel"]).collect();
    assert_eq!(names, ["wald", "moller-trumbore", "plucker", "watertight"]);
    assert_eq!(keys(&kernels[0]), ["kernel", "leaks", "band", "depth", "px"]);
    let leaks: Vec<_> = kernels.iter().map(|kernel| &kernel["leaks"]).collect();
    assert_eq!(leaks, [true, true, true, false]);

    // What info foretells of the fitted camera is what a tolerance goes by.
    for (scene, _) in EXPECTED {
        let info = scratch.rt(&["info", scene, "--json"]).exits(0).json();
        let args = ["render", scene, "-o", "a.png", "--tolerance", "1", "--stats-json", "-"];
        let told = scratch.rt(&args).exits(0).json();
        assert_eq!(info["precision"]["kernels"], told["tolerance"]["predicted"], "{scene}");
    }

    let text = scratch.rt(&["info", "odd.obj"]).exits(0).text();
    for line in [
        "\n  precision   coordinates up to 8.00, features down to 0.250: ratio 32.00\n",
        "\n  slivers     up to 32.00 times as long as high\n",
        "\n  crowding    a line meets the boxes of 2.00 triangles on average\n",
        "\n  degenerate  1 triangle\n",
        "\n  duplicates  1 triangle\n",
        "\n  kernel      watertight: band ",
    ] {
        assert!(text.contains(line), "{line:?} in\n{text}");
    }
    let balls = scratch.rt(&["info", "spd:balls:1"]).exits(0).text();
    assert!(balls.contains("\n  curved      10 spheres, exact and never flattened\n"), "{balls}");
}
