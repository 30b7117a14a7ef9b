//! `rt paper`.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::support::{Scratch, levels};

#[test]
fn every_table_and_chart_of_a_paper_is_there() {
    let scratch = Scratch::with_room();
    let small = ["--triangles", "2000", "--quick", "--rounds", "1", "--charts", "."];
    let args = [&["paper", "wald-2001", "room.obj"], &small[..]].concat();
    let text = scratch.rt(&args).exits(0).text();
    for head in ["Table 1", "Table 2", "Table 3", "Mailboxes", "Figure 5"] {
        assert!(text.contains(head), "{head} in {text}");
    }
    for scene in ["terrain:800", "room.obj"] {
        let rows = text.lines().filter(|line| line.starts_with(scene)).count();
        assert!(rows > 0, "{scene} in {text}");
    }
    for structure in ["bvh binned-sah", "kd binned", "kd sweep", "kd median"] {
        assert!(text.contains(structure), "{structure} in {text}");
    }
    for chart in ["mailboxes.svg", "growth.svg"] {
        assert!(scratch.bytes(chart).starts_with(b"<svg"), "{chart}");
    }
}

const QUICK: [&str; 7] = ["paper", "geimer-mueller", "--quick", "-s", "16x16", "--rounds", "1"];

/// All in one test: the scenes take their time to build.
#[test]
fn what_the_paper_compares_is_compared_and_its_figures_stand_beside() {
    let scratch = Scratch::new();
    let run = scratch.rt(&[&QUICK[..], &["--json", "a.json"]].concat()).exits(0);
    let table = run.text();
    for text in ["5.2-6.1", "2.4-3.9", "nearly 2", "to 1.1", "three stages of the picture"] {
        assert!(table.contains(text), "{text:?} in\n{table}");
    }
    for scene in ["spd:balls:2", "spd:rings:3", "spd:tree:6"] {
        assert!(table.contains(scene), "{scene} in\n{table}");
    }

    let json: Value = serde_json::from_slice(&scratch.bytes("a.json")).unwrap();
    let rows = json["rows"].as_array().unwrap();
    let of = |what: &str, key: &str| -> BTreeSet<String> {
        let rows = rows.iter().filter(|row| row["what"] == what);
        rows.map(|row| row[key].to_string().replace('"', "")).collect()
    };
    let all = |words: &[&str]| words.iter().map(|&word| word.to_owned()).collect::<BTreeSet<_>>();
    assert_eq!(of("frame", "level"), levels().into_iter().collect());
    assert_eq!(of("frame", "extent"), all(&["picture", "tile"]));
    assert_eq!(of("trace", "order"), all(&["heap", "skip"]));
    assert_eq!(of("trace", "sorted"), all(&["false", "true"]));
    assert_eq!(of("trace", "builder"), all(&["insertion"]));
    assert_eq!(of("trace", "box_test").len(), 4);
    for row in rows {
        assert!(row["ns"].as_f64().unwrap() > 0.0, "{row}");
    }
}

#[test]
fn the_simulator_gets_a_frame_or_none() {
    let scratch = Scratch::new();
    for frame in ["balls:0,none", "balls:0,tile", "rings:1,picture"] {
        let run = scratch.rt(&[&QUICK[..], &["--frame", frame]].concat()).exits(0);
        assert_eq!((run.text().as_str(), run.stderr.as_str()), ("", ""), "{frame}");
    }
    for frame in ["balls:0", "balls:0,line"] {
        scratch.rt(&[&QUICK[..], &["--frame", frame]].concat()).exits(2);
    }
    scratch.rt(&["paper", "no-such-paper"]).exits(2);
}

#[test]
fn what_shading_costs_stands_beside_the_paper() {
    let scratch = Scratch::with_room();
    let quick = ["paper", "shading", "room.obj", "--quick", "-s", "32x32", "--rounds", "1"];
    let run = scratch.rt(&[&quick[..], &["--json", "a.json"]].concat()).exits(0);
    let table = run.text();
    for text in ["2 to 2.5 times", "less than 10 %", "Figure 4", "0.8 to 1.8", "room.obj"] {
        assert!(table.contains(text), "{text:?} in\n{table}");
    }
    let json: Value = serde_json::from_slice(&scratch.bytes("a.json")).unwrap();
    let rows = json["rows"].as_array().unwrap();
    let count = |what: &str| rows.iter().filter(|row| row["what"] == what).count();
    // One point at a time, and each level.
    assert_eq!(count("phong"), 1 + levels().len());
    assert_eq!((count("shading"), count("texturing"), count("close-up")), (3, 1, 2));
    assert_eq!(count("speed"), 12);
    for row in rows.iter().filter(|row| row["what"] == "speed") {
        assert!(row["full_fps"].as_f64().unwrap() > 0.0, "{row}");
    }
}
