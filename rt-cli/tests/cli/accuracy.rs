//! `rt accuracy`.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use crate::support::{Scratch, keys, levels};

const QUICK: [&str; 5] = ["accuracy", "--rays", "64", "--rounds", "1"];

const KEYS: [&str; 26] = [
    "suite",
    "kernel",
    "variant",
    "default",
    "exact",
    "level",
    "shape",
    "width",
    "family",
    "kind",
    "fair",
    "seed",
    "scale",
    "offset",
    "rays",
    "leaks",
    "double_hits",
    "false_hits",
    "false_misses",
    "nan_hits",
    "unsure",
    "t_ulp",
    "band",
    "band_of_reach",
    "ns",
    "ns_least",
];

/// All in one test, because a run takes an emulator a minute.
#[test]
fn every_kernel_is_shown_every_family_at_every_level_and_a_seed_says_which_rays() {
    let scratch = Scratch::with_room();
    let args = [&QUICK[..], &["--seed", "7", "--json", "a.json"]].concat();
    let run = scratch.rt(&args).exits(0);
    let table = run.text();
    for method in ["moller-trumbore", "watertight", "unordered", "conservative", "residual"] {
        assert!(table.contains(method), "{table}");
    }
    assert!(run.stderr.contains("triangle 1/"), "{}", run.stderr);

    let json: Value = serde_json::from_slice(&scratch.bytes("a.json")).unwrap();
    assert_eq!(keys(&json), ["command", "arch", "machine", "rows"]);
    let rows = json["rows"].as_array().unwrap();
    let text = |row: &Value, key: &str| row[key].as_str().unwrap().to_owned();
    for row in rows {
        assert_eq!(keys(row), KEYS);
        assert_eq!(keys(&row["t_ulp"]), ["p50", "p99", "max"]);
        assert_eq!(row["rays"], 64);
        assert!(row["ns"].as_f64().unwrap() > 0.0, "{row}");
    }
    for suite in ["triangle", "box", "quadric"] {
        let of = || rows.iter().filter(|row| row["suite"] == suite);
        let mut levels: BTreeSet<_> = levels().into_iter().collect();
        levels.insert("scalar".to_owned());
        assert_eq!(of().map(|row| text(row, "level")).collect::<BTreeSet<_>>(), levels, "{suite}");
        let default = || of().filter(|row| row["default"] == true);
        let methods: BTreeSet<_> = default().map(|row| text(row, "kernel")).collect();
        assert_eq!(methods.len(), 1, "{methods:?}");
        assert!(default().all(|row| row["leaks"] == 0 && row["nan_hits"] == 0));
    }

    let counts = |mut json: Value| {
        for row in json["rows"].as_array_mut().unwrap() {
            row.as_object_mut().unwrap().retain(|key, _| !key.starts_with("ns"));
        }
        json["rows"].take()
    };
    let again = |more: &[&str]| {
        let args = [&QUICK[..], &["-q", "--json", "-"], more].concat();
        let run = scratch.rt(&args).exits(0);
        assert_eq!(run.stderr, "");
        counts(run.json())
    };
    let first = counts(json);
    assert_eq!(again(&["--seed", "7"]), first);
    let elsewhere = again(&["--seed", "8", "--scale", "0.5", "--offset", "1000"]);
    for (row, first) in elsewhere.as_array().unwrap().iter().zip(first.as_array().unwrap()) {
        assert_eq!((&row["scale"], &row["offset"]), (&json!(0.5), &json!(1000.0)));
        assert_eq!(row["family"], first["family"]);
    }
    assert_ne!(elsewhere, first);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let scratch = Scratch::with_room();
    for args in [
        ["--rays", "0"],
        ["--rays", "many"],
        ["--seed", "-1"],
        ["--scale", "0"],
        ["--offset", "1e7"],
    ] {
        scratch.rt(&[&["accuracy"], &args[..]].concat()).exits(2);
    }
    let run = scratch.rt(&["accuracy", "--quick", "--json", "room.obj"]).exits(1);
    assert!(run.stderr.contains("give it the extension .json"), "{}", run.stderr);
}
