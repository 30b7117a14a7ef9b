//! Standard output is data, standard error is talk.

use std::process::Command;

use serde_json::Value;

use crate::support::{Picture, Scratch, TRIANGLE, argv, levels, run, skipped};

const RENDER: [&str; 6] = ["render", "room.obj", "-o", "a.png", "-s", "40x30"];

#[test]
fn the_closing_line_has_it_all() {
    let scratch = Scratch::with_room();
    let args = [&RENDER[..], &["-j", "1", "--isa", "scalar", "--light", "-1,2.5,1.5"]].concat();
    let run = scratch.rt(&args).exits(0);
    assert!(run.stdout.is_empty());
    let line = run.stderr.lines().last().unwrap();
    let mut rest = line;
    for part in [
        "a.png: 40x30, 7 triangles; bvh built in ",
        "s, rendered in ",
        "s (tracing ",
        "s); Mray/s: primary ",
        ", shadow ",
        ", reflection ",
        "; scalar, 1 thread; watertight kernel",
    ] {
        rest = match rest.split_once(part) {
            Some((_, rest)) => rest,
            None => panic!("no {part:?} in {line}"),
        };
    }
    assert_eq!(rest, "");

    let best = levels().pop().unwrap();
    let args = ["render", "spd:balls:1", "-o", "a.png", "-s", "8x8", "-j2", "--accel", "brute"];
    let line = scratch.rt(&args).exits(0).stderr;
    assert!(line.starts_with("a.png: 8x8, 2 triangles, 10 spheres; brute built in "), "{line}");
    assert!(line.ends_with(&format!("; {best}, 2 threads; watertight kernel\n")), "{line}");
    scratch.file("one.obj", TRIANGLE);
    let line = scratch.rt(&["render", "one.obj", "-o", "a.png", "-s", "8x8"]).exits(0).stderr;
    assert!(line.contains(": 8x8, 1 triangle; "), "{line}");
}

#[test]
fn quiet_says_nothing() {
    let scratch = Scratch::with_room();
    scratch.file("odd.obj", format!("{TRIANGLE}l 1 2\nf 1 1 2\nmtllib no.mtl\n"));
    let loud = scratch.rt(&["render", "odd.obj", "-o", "a.png", "-s", "8x8"]).exits(0);
    for line in ["skipped: 1 × l: ", "warning: odd.obj:7:8: ", "warning: 1 triangle ", "camera: "]
    {
        assert!(loud.stderr.contains(line), "{line} in\n{}", loud.stderr);
    }
    for flags in [&["-q"][..], &["--quiet", "--progress", "json"], &["-q", "--progress", "bar"]] {
        let args = [&["render", "odd.obj", "-o", "a.png", "-s", "8x8"], flags].concat();
        let run = scratch.rt(&args).exits(0);
        assert!(run.stdout.is_empty() && run.stderr.is_empty(), "{}", run.stderr);
    }
    let run = scratch.rt(&["render", "-q", "no.obj", "-o", "a.png"]).exits(1);
    assert!(run.stderr.starts_with("error: cannot read no.obj"), "errors are told all the same");
}

#[test]
fn verbose_says_more_and_no_less() {
    let scratch = Scratch::with_room();
    let plain = scratch.rt(&[&RENDER[..], &["--light", "-1,2.5,1.5"]].concat()).exits(0).stderr;
    let args = [&RENDER[..], &["-v", "--light", "-1,2.5,1.5", "--layout", "skip"]].concat();
    let shown = scratch.rt(&args).exits(0).stderr;
    let lines: Vec<_> = shown.lines().collect();
    assert!(plain.lines().count() == 2 && lines.len() == 9, "{shown}");
    for (line, parts) in lines.iter().zip([
        &["room.obj: opened in ", ": 7 triangles, 3 materials"][..],
        &["camera: --eye "],
        &["bvh, skip: built in ", " by binned-sah; ", " KiB beside ", " KiB of scene"],
        &["primary rays: 1200, traced in "],
        &["shadow rays: "],
        &["reflected rays: "],
        &["a ray on average: ", " nodes, ", " boxes, ", " triangles, 0.0 spheres, 0.0 cones"],
        &["shaded in ", " rays together over skip"],
        &["a.png: 40x30, 7 triangles; "],
    ]) {
        assert!(parts.iter().all(|part| line.contains(part)), "{line}");
    }
}

#[test]
fn standard_output_takes_the_picture_and_nothing_else() {
    let scratch = Scratch::with_room();
    let run = scratch.rt(&["render", "room.obj", "-o", "-", "-s", "40x30"]).exits(0);
    assert_eq!(Picture::decode(&run.stdout).size, (40, 30));
    assert!(run.stderr.contains("\nstandard output: 40x30, "), "{}", run.stderr);
    assert_eq!(scratch.names(), ["room.mtl", "room.obj"]);
}

#[test]
fn progress_as_json_is_json() {
    let scratch = Scratch::with_room();
    let args = [&RENDER[..], &["--progress", "json"]].concat();
    let run = scratch.rt(&args).exits(0);
    let events = run.stderr.lines().filter(|line| line.starts_with('{'));
    let events: Vec<Value> = events.map(|line| serde_json::from_str(line).unwrap()).collect();
    let last = events.last().expect("the end is always told");
    assert_eq!(last["event"], "tiles");
    assert_eq!((&last["done"], &last["total"]), (&2.into(), &2.into()));
    assert!(last["elapsed_s"].as_f64().is_some_and(|s| s >= 0.0), "{last}");
    assert_eq!(last["left_s"], 0.0);
    assert!(run.stderr.lines().last().unwrap().starts_with("a.png: "));
}

#[test]
fn no_bar_where_there_is_no_terminal() {
    let scratch = Scratch::with_room();
    for how in ["auto", "bar", "lines", "none"] {
        let run = scratch.rt(&[&RENDER[..], &["--progress", how]].concat()).exits(0);
        assert!(!run.stderr.contains("elapsed") && !run.stderr.contains('\x1B'), "{how}");
        assert!(run.stderr.lines().all(|line| !line.starts_with('{')), "{how}");
    }
}

/// Runs `rt` on a terminal, and returns what that shows.
fn on_a_terminal(scratch: &Scratch, args: &[&str], ci: bool) -> Option<String> {
    if !Command::new("script").arg("--version").output().is_ok_and(|out| out.status.success()) {
        skipped("there is no `script` here to make a terminal");
        return None;
    }
    let words = argv().into_iter().map(|word| word.into_string().unwrap());
    let line: Vec<_> = words.chain(args.iter().map(|&arg| arg.to_owned())).collect();
    let script = ["script", "-qec", &line.join(" "), "/dev/null"].map(Into::into);
    let mut command = scratch.command(&script);
    if ci {
        command.env("CI", "true");
    }
    Some(run(command.env("TERM", "xterm")).exits(0).text())
}

#[test]
fn a_bar_on_a_terminal_and_none_under_ci() {
    let scratch = Scratch::with_room();
    let args = ["render", "room.obj", "-o", "a.png", "-s", "200x200"];
    let Some(shown) = on_a_terminal(&scratch, &args, false) else { return };
    assert!(shown.contains('█') && shown.contains(" elapsed, "), "{shown:?}");
    // It is wiped away at the end.
    let last = shown.rsplit(['\r', '\n']).find(|line| !line.is_empty()).unwrap();
    assert!(last.contains("a.png: 200x200") && !last.contains("elapsed"), "{shown:?}");

    let with = |more: &[&str], ci| on_a_terminal(&scratch, &[&args, more].concat(), ci).unwrap();
    assert!(!with(&[], true).contains("elapsed"));
    assert!(!with(&["--progress", "none"], false).contains("elapsed"));
    assert!(!with(&["--progress", "lines"], false).contains("elapsed"));
    assert_eq!(with(&["-q"], false), "");
    assert!(with(&["--progress", "bar"], true).contains("elapsed"));
}
