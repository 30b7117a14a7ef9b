//! `rt paper`.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::support::{Scratch, levels};

#[test]
fn every_table_and_chart_of_a_paper_is_there() {
    let scratch = Scratch::with_room();
    let small = ["--triangles", "2000", "--quick", "--rounds", "1", "--charts", "."];
    let args = ["paper", "wald-2001", "room.obj", "--json", "rows.json"];
    let text = scratch.rt(&[&args[..], &small[..]].concat()).exits(0).text();
    for head in ["Table 1", "Table 2", "Table 3", "Mailboxes", "Figure 5"] {
        assert!(text.contains(head), "{head} in {text}");
    }
    for scene in ["terrain:800", "room.obj"] {
        let rows = text.lines().filter(|line| line.starts_with(scene)).count();
        assert!(rows > 0, "{scene} in {text}");
    }
    for structure in ["bvh bvh8", "bvh skip", "kd binned", "kd sweep", "kd median"] {
        assert!(text.contains(structure), "{structure} in {text}");
    }
    for chart in ["mailboxes.svg", "growth.svg"] {
        assert!(scratch.bytes(chart).starts_with(b"<svg"), "{chart}");
    }

    let rows = Rows::read(&scratch.bytes("rows.json"));
    let what = ["test", "overhead", "trace", "mailbox", "two threads", "growth"];
    assert_eq!(rows.of("what", |_| true), words(&what));
    let of = |what: &'static str| move |row: &Value| row["what"] == what;
    assert_eq!(rows.of("scene", of("overhead")), words(&["terrain:800", "room.obj"]));
    let kinds = rows.of("kind", of("trace"));
    assert_eq!(kinds, words(&["primary", "shadow", "diffuse"]));
    let packets = rows.of("packet", |row| of("trace")(row) && row["accel"] == "kd");
    assert!(["1", "4", "64"].iter().all(|packet| packets.contains(*packet)), "{packets:?}");
    let mailboxes = rows.of("mailbox", of("mailbox"));
    assert_eq!(mailboxes.len(), 16, "{mailboxes:?}");
    for row in rows.0.iter().filter(|row| of("trace")(row)) {
        for number in ["ns", "mrays_per_s", "nodes_per_ray", "bytes"] {
            assert!(row[number].as_f64().unwrap() > 0.0, "{number} of {row}");
        }
    }
}

/// Measured rows.
struct Rows(Vec<Value>);

impl Rows {
    fn read(json: &[u8]) -> Rows {
        let json: Value = serde_json::from_slice(json).unwrap();
        Rows(json["rows"].as_array().unwrap().clone())
    }

    /// What some of them have under that key.
    fn of(&self, key: &str, which: impl Fn(&Value) -> bool) -> BTreeSet<String> {
        let rows = self.0.iter().filter(|row| which(row));
        rows.map(|row| row[key].to_string().replace('"', "")).collect()
    }
}

fn words(words: &[&str]) -> BTreeSet<String> {
    words.iter().map(|&word| word.to_owned()).collect()
}

#[test]
fn a_part_of_a_paper_is_measured_alone() {
    let scratch = Scratch::new();
    let args = ["paper", "wald-2001", "--triangles", "2000", "--rounds", "1", "--json", "-"];
    let json = scratch.rt(&[&args[..], &["--part", "overhead"]].concat()).exits(0).stdout;
    let rows = Rows::read(&json);
    assert_eq!(rows.of("what", |_| true), words(&["overhead"]));
    scratch.rt(&[&args[..], &["--part", "everything"]].concat()).exits(2);
}

#[test]
fn the_simulator_gets_the_rays_of_a_packet_or_none() {
    let scratch = Scratch::with_room();
    for trace in ["room.obj,none", "terrain:800,1", "room.obj,64"] {
        let run = scratch.rt(&["paper", "wald-2001", "--trace", trace]).exits(0);
        assert_eq!((run.text().as_str(), run.stderr.as_str()), ("", ""), "{trace}");
    }
    for trace in ["room.obj", "room.obj,5"] {
        scratch.rt(&["paper", "wald-2001", "--trace", trace]).exits(2);
    }
    scratch.rt(&["paper", "wald-2001", "--trace", "missing.obj,4"]).exits(1);
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

    let rows = Rows::read(&scratch.bytes("a.json"));
    let of = |what: &str, key: &str| rows.of(key, |row| row["what"] == what);
    assert_eq!(of("frame", "level"), levels().into_iter().collect());
    assert_eq!(of("frame", "extent"), words(&["picture", "tile"]));
    assert_eq!(of("trace", "order"), words(&["heap", "skip"]));
    assert_eq!(of("trace", "sorted"), words(&["false", "true"]));
    assert_eq!(of("trace", "builder"), words(&["insertion"]));
    assert_eq!(of("trace", "box_test").len(), 4);
    for row in &rows.0 {
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
    // One point at a time, and each level, exact and relaxed.
    assert_eq!(count("phong"), 1 + 2 * levels().len());
    assert_eq!((count("shading"), count("texturing"), count("close-up")), (3, 2, 2));
    assert_eq!(count("speed"), 12);
    for row in rows.iter().filter(|row| row["what"] == "speed") {
        assert!(row["full_fps"].as_f64().unwrap() > 0.0, "{row}");
    }
}
