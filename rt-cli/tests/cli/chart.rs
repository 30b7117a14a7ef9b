//! `rt chart`.

use std::fs;

use roxmltree::{Document, Node};
use serde_json::{Value, json};

use crate::support::{Run, Scratch};

/// One row for each of some families.
fn rows(suite: &str, code: &Value, errors: [u64; 2], p99: f64, band: f64) -> Vec<Value> {
    let hard = if suite == "triangle" { "closed" } else { "single" };
    let families = [("hard ones", hard, errors[0]), ("random", "natural", errors[1])];
    let row = |(family, kind, wrong): (&str, &str, u64)| {
        let mut row = code.clone();
        for (key, value) in [
            ("suite", json!(suite)),
            ("family", json!(family)),
            ("kind", json!(kind)),
            ("rays", json!(250_000)),
            ("leaks", json!(wrong)),
            ("false_hits", json!(0)),
            ("false_misses", json!(wrong)),
            ("t_ulp", json!({ "p50": 0.5, "p99": p99, "max": null })),
            ("fair", json!(true)),
            ("band", json!(band)),
        ] {
            row[key] = value;
        }
        row
    };
    families.into_iter().map(row).collect()
}

/// Three kernels of several variants at three levels, as crowded as can be.
fn measured(suite: &str) -> Value {
    let mut all = Vec::new();
    for (k, kernel) in ["tight one", "quick one", "middling"].into_iter().enumerate() {
        for v in 0..12 {
            for (l, level) in ["scalar", "sse4.1", "avx2"].into_iter().enumerate() {
                let ns = (0.4 + 0.03 * k as f64 + 0.02 * f64::from(v)) * 3.0 / (l + 1) as f64;
                let wrong = if k == 0 { 0 } else { 20_000 / (v as u64 + 1) };
                let code = json!({
                    "kernel": kernel, "variant": format!("knob {v}"), "default": (k, v) == (0, 3),
                    "exact": v % 3 == 0, "level": level, "shape": "rays", "width": 4, "ns": ns,
                });
                let p99 = [2.0, 4000.0][k % 2];
                all.extend(rows(suite, &code, [wrong, wrong / 10_000], p99, f64::from(v)));
            }
        }
    }
    json!({ "machine": "a machine & its <name>", "command": "rt accuracy --json x.json",
        "rows": all })
}

/// With a file for each suite.
fn scratch() -> Scratch {
    let scratch = Scratch::new();
    for suite in ["triangle", "box", "quadric"] {
        scratch.file(&format!("{suite}.json"), measured(suite).to_string());
    }
    scratch
}

#[track_caller]
fn chart(scratch: &Scratch, from: &[&str]) -> Run {
    scratch.rt(&[&["chart", "--from"], from, &["-o", "-"]].concat())
}

/// The lines of text in a picture.
fn texts<'a>(svg: &'a Document<'a>) -> Vec<(Node<'a, 'a>, String)> {
    let texts = svg.descendants().filter(|node| node.has_tag_name("text"));
    let texts = texts.map(|node| (node, node.text().unwrap_or_default().trim().to_owned()));
    texts.filter(|(_, text)| !text.is_empty()).collect()
}

fn number(node: Node, name: &str) -> f64 {
    let value = node.attribute(name).unwrap_or_else(|| panic!("{name} in {node:?}"));
    value.parse().unwrap_or_else(|_| panic!("{name}={value}"))
}

/// The places that an element names.
fn places(node: Node) -> Vec<(f64, f64)> {
    let at = |x: &str, y: &str| (number(node, x), number(node, y));
    match node.tag_name().name() {
        "circle" => vec![at("cx", "cy")],
        "text" | "rect" => vec![at("x", "y")],
        "line" => vec![at("x1", "y1"), at("x2", "y2")],
        "polygon" | "polyline" => {
            let points = node.attribute("points").expect("points").split_whitespace();
            let point = |xy: &str| {
                let (x, y) = xy.split_once(',').expect("x,y");
                (x.parse().expect("x"), y.parse().expect("y"))
            };
            points.map(point).collect()
        }
        _ => Vec::new(),
    }
}

#[test]
fn a_stranger_finds_all_that_it_takes_to_read_it() {
    let run = chart(&scratch(), &["triangle.json", "box.json", "quadric.json"]).exits(0);
    let svg = run.text();
    let svg = Document::parse(&svg).expect("well-formed XML");
    let texts: Vec<_> = texts(&svg).into_iter().map(|(_, text)| text).collect();
    let times = |text: &str| texts.iter().filter(|other| other.contains(text)).count();
    for (text, least) in [
        ("Ray/triangle", 1),
        ("Ray/box", 1),
        ("Ray/quadric", 1),
        ("tight one", 3),
        ("quick one", 3),
        ("middling", 3),
        ("leaks per million in the worst family", 1),
        ("false misses per million in the worst family", 1),
        ("false hits and misses per million in the worst family", 1),
        ("ns per test", 15),
        ("Natural: random and camera rays", 3),
        ("Error of t", 3),
        ("Band", 3),
        ("Levels", 3),
        ("none seen", 3),
        ("3/N = 12 per million", 6),
        ("filled: the same bits", 1),
        ("hollow: bits differ", 1),
        ("what rt renders with", 1),
        ("Pareto front", 1),
        ("Machine: a machine & its <name>", 1),
        ("Command: rt accuracy --json x.json", 1),
    ] {
        assert!(times(text) >= least, "{text}: {}", times(text));
    }
    // The only one on the front: the fastest of all, which is never wrong.
    assert_eq!(times("tight one: 0.4 ns, none seen"), 3);
    for level in ["scalar", "sse4.1", "avx2"] {
        assert_eq!(texts.iter().filter(|text| *text == level).count(), 1, "{level}");
    }
    assert_eq!(texts.iter().filter(|text| *text == "sse2").count(), 0);
    // Both rates are on one scale, whose numbers stand at its left end.
    assert_eq!(times("1,000,000"), 3);
    // The default is ringed in the legend, and in each suite in four panels, in the list and
    // among the levels.
    let ring = |node: &Node| node.has_tag_name("circle") && number(*node, "r") == 10.0;
    assert_eq!(svg.descendants().filter(ring).count(), 1 + 3 * 6);
}

#[test]
fn all_is_on_the_page_and_no_text_on_another() {
    let run = chart(&scratch(), &["triangle.json", "box.json", "quadric.json"]).exits(0);
    let svg = run.text();
    let svg = Document::parse(&svg).expect("well-formed XML");
    let (width, height) =
        (number(svg.root_element(), "width"), number(svg.root_element(), "height"));
    for node in svg.descendants() {
        for (x, y) in places(node) {
            assert!((0.0..=width).contains(&x) && (0.0..=height).contains(&y), "{node:?}");
        }
    }
    assert_no_overlap(&svg);
}

/// No text lies on another, or goes over the edge of the page.
#[track_caller]
fn assert_no_overlap(svg: &Document) {
    let page = number(svg.root_element(), "width");
    let boxes: Vec<_> = texts(svg)
        .into_iter()
        .map(|(node, text)| {
            let size = number(node, "font-size");
            // What sans-serif fonts take on average.
            let wide = text.chars().count() as f64 * size * 0.5;
            let left = match node.attribute("text-anchor") {
                Some("end") => number(node, "x") - wide,
                Some("middle") => number(node, "x") - wide / 2.0,
                _ => number(node, "x"),
            };
            let y = number(node, "y");
            (text, [left, left + wide], [y - size * 0.35, y + size * 0.35])
        })
        .collect();
    let overlap = |a: [f64; 2], b: [f64; 2]| a[0] < b[1] && b[0] < a[1];
    for (i, (text, x, y)) in boxes.iter().enumerate() {
        assert!(x[0] >= 0.0 && x[1] <= page, "{text:?} goes over the edge: {x:?}");
        for (other, other_x, other_y) in &boxes[i + 1..] {
            let both = overlap(*x, *other_x) && overlap(*y, *other_y);
            assert!(!both, "{text:?} lies on {other:?}");
        }
    }
}

#[test]
fn what_goes_wrong_more_often_is_higher_and_what_takes_longer_is_further_right() {
    let scratch = Scratch::new();
    let code = |kernel: &str, ns: f64| {
        json!({ "kernel": kernel, "variant": "v", "default": false, "exact": kernel != "b",
            "level": "scalar", "shape": "one", "width": 1, "ns": ns })
    };
    let all = [
        rows("triangle", &code("a", 0.5), [10_000, 0], 1.0, 1.0),
        rows("triangle", &code("b", 1.0), [100, 0], 1.0, 1.0),
        rows("triangle", &code("c", 2.0), [0, 0], 1.0, 1.0),
    ];
    let file = json!({ "machine": "m", "command": "c", "rows": all.concat() });
    scratch.file("a.json", file.to_string());
    let svg = chart(&scratch, &["a.json"]).exits(0).text();
    let svg = Document::parse(&svg).expect("well-formed XML");
    // Scalar points are circles, each filled and outlined: those of the first panel.
    let circles = svg.descendants().filter(|node| node.has_tag_name("circle"));
    let mut seen: Vec<_> = circles.map(|node| (places(node)[0], node.attribute("fill"))).collect();
    seen.retain(|((x, y), _)| (80.0..520.0).contains(x) && (210.0..510.0).contains(y));
    seen.retain(|(_, fill)| *fill != Some("none"));
    let [(a, a_fill), (b, b_fill), (c, c_fill)] = seen[..] else { panic!("{seen:?}") };
    // Filled are those whose bits are the same everywhere, each in a colour of its own.
    let white = Some("#FFFFFF");
    assert!(a_fill != white && b_fill == white && c_fill != white && a_fill != c_fill, "{seen:?}");
    assert!(a.0 < b.0 && b.0 < c.0 && a.1 < b.1 && b.1 < c.1, "{seen:?}");
    // Equal factors of time are equal distances.
    assert!(((b.0 - a.0) - (c.0 - b.0)).abs() <= 1.0, "{seen:?}");
}

#[test]
fn the_same_rows_in_any_order_are_the_same_bytes() {
    let scratch = scratch();
    let svg = chart(&scratch, &["triangle.json"]).exits(0).stdout;
    let mut file = measured("triangle");
    file["rows"].as_array_mut().expect("rows").reverse();
    scratch.file("reversed.json", file.to_string());
    assert!(chart(&scratch, &["triangle.json"]).exits(0).stdout == svg);
    assert!(chart(&scratch, &["reversed.json"]).exits(0).stdout == svg);
}

#[test]
fn a_file_is_written_and_a_line_said() {
    let scratch = scratch();
    let args = ["chart", "--from", "triangle.json", "box.json", "-o", "a.svg"];
    let run = scratch.rt(&args).exits(0);
    assert!(run.stdout.is_empty());
    assert_eq!(run.stderr, "a.svg: 72 variants, 6 kernels, 2 suites\n");
    let both = chart(&scratch, &["triangle.json", "box.json"]).exits(0);
    assert_eq!(both.stderr, "");
    assert!(scratch.bytes("a.svg") == both.stdout);
}

#[test]
fn strange_rows_are_drawn_all_the_same() {
    let scratch = Scratch::new();
    let long = "very ".repeat(300);
    let kernel = |k: usize| match k {
        0 => "<\"&'\u{1}\u{ffff}>".to_owned(),
        1 => long.clone(),
        k => format!("kernel {k}"),
    };
    let mut all = Vec::new();
    for k in 0..60 {
        let code = json!({ "kernel": kernel(k), "variant": long, "default": k == 1, "exact": false,
            "level": "neon", "shape": "one", "width": 1, "ns": 10_f64.powi(k as i32 * 10 - 300) });
        let (p99, band) = ([0.0, 1e-300, 1e300][k % 3], [1e300, 0.0, 1.0][k % 3]);
        all.extend(rows("triangle", &code, [k as u64 * 4000, 250_000], p99, band));
    }
    for rows in [&all[..], &all[..1], &all[1..2], &all[2..3], &all[4..6]] {
        let file = json!({ "machine": long, "command": "\u{0}", "rows": rows });
        scratch.file("a.json", file.to_string());
        let svg = chart(&scratch, &["a.json"]).exits(0).text();
        let svg = Document::parse(&svg).expect("well-formed XML");
        assert!(svg.descendants().count() > 50);
        assert_no_overlap(&svg);
    }
}

#[test]
fn bad_files_are_told_and_what_was_there_stays() {
    let scratch = scratch();
    scratch.file("there.svg", "a picture");
    scratch.file("empty.json", "");
    scratch.file("text.json", "Möller");
    scratch.file("binary.json", [0xff, 0xfe, 0]);
    scratch.file("list.json", "[]");
    scratch.file("keys.json", r#"{"machine": "m", "rows": []}"#);
    scratch.file("none.json", r#"{"machine": "m", "command": "c", "rows": []}"#);
    scratch.file("deep.json", "[".repeat(100_000));
    let mut file = measured("box");
    file["rows"][7]["ns"] = json!(0);
    scratch.file("time.json", format!("{file:#}"));
    let mut file = measured("box");
    file["rows"][7]["level"] = json!("mmx");
    scratch.file("level.json", format!("{file:#}"));
    let mut file = measured("box");
    file["rows"][1]["ns"] = json!(7);
    scratch.file("twice.json", file.to_string());
    let mut file = measured("box");
    file["machine"] = json!("another");
    scratch.file("other.json", file.to_string());
    fs::create_dir(scratch.path("folder")).expect("a folder");

    let before = scratch.names();
    for (from, message) in [
        (&["missing.json"][..], "error: cannot read missing.json: No such file or directory"),
        (&["folder"], "error: cannot read folder: "),
        (&["empty.json"], "empty.json:1:0: EOF while parsing a value"),
        (&["text.json"], "text.json:1:1: expected value"),
        (&["binary.json"], "binary.json:1:1: expected value"),
        (&["list.json"], "list.json:1:"),
        (&["keys.json"], "keys.json:1:28: missing field `command`"),
        (&["none.json"], "error: no chart: there are no rows"),
        (&["deep.json"], "deep.json:1:"),
        (&["time.json"], "time.json:"),
        (&["level.json"], "level.json:"),
        (
            &["twice.json"],
            "error: no chart: tight one (knob 0) at scalar, family random: two times",
        ),
        (&["triangle.json", "other.json"], "error: no chart: two machines in one chart: "),
        (&["triangle.json", "text.json"], "text.json:1:1: expected value"),
    ] {
        let args = [&["chart", "--from"], from, &["-o", "there.svg"]].concat();
        let run = scratch.rt(&args).exits(1);
        assert!(run.stderr.starts_with(message), "{from:?}: {}", run.stderr);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
        assert!(run.stdout.is_empty());
    }
    assert_eq!(scratch.bytes("there.svg"), b"a picture");
    assert_eq!(scratch.names(), before);

    let line = |file: &str, text: &str| {
        let run = chart(&scratch, &[file]).exits(1);
        let content = String::from_utf8(scratch.bytes(file)).expect("UTF-8");
        let found = content.lines().position(|line| line.contains(text)).expect("the line") + 1;
        assert!(run.stderr.starts_with(&format!("{file}:{found}:")), "{}", run.stderr);
        run.stderr
    };
    assert!(line("time.json", "\"ns\": 0,").contains("expected a time above 0, found 0"));
    assert!(line("level.json", "mmx").contains("\"mmx\" is no level: expected scalar, "));
}

#[test]
fn places_that_cannot_be_written_to_are_told_before_anything_is_read() {
    let scratch = scratch();
    let before = scratch.names();
    for (output, message) in [
        ("a.png", "cannot write a.png: give it the extension .svg"),
        ("triangle.json", "cannot write triangle.json: give it the extension .svg"),
        ("no/a.svg", "cannot write no/a.svg: there is no folder no"),
        (".", "cannot write .: it is a directory"),
    ] {
        let run = scratch.rt(&["chart", "--from", "missing.json", "-o", output]).exits(1);
        assert_eq!(run.stderr, format!("error: {message}\n"));
    }
    assert_eq!(scratch.names(), before);
}
