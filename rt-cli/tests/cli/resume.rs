//! Long jobs: interrupted, taken up again, and what becomes of what is finished.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command};
use std::thread::{self, JoinHandle};

use crate::support::Scratch;

/// Much work, if it were let; many tiles, the first of which are soon done.
const LONG: [&str; 9] =
    ["render", "spd:balls:4", "--accel", "brute", "-j1", "-s", "1024x1024", "-o", "a.png"];

/// The same picture in no time.
const SHORT: [&str; 6] = ["render", "spd:balls:4", "-s", "1024x1024", "-o", "a.png"];

/// Starts a command and waits until it has finished a tile: in a pipe there are lines. What it says
/// then is read elsewhere, so that it can be written.
#[track_caller]
fn start(scratch: &Scratch, args: &[&str]) -> (Child, String, JoinHandle<String>) {
    let mut child = scratch.rt_command(args).spawn().expect("the program starts");
    let mut said = BufReader::new(child.stderr.take().expect("a pipe"));
    let mut line = String::new();
    while !line.starts_with("rendered ") {
        line.clear();
        assert!(said.read_line(&mut line).expect("text") > 0, "it says how far it is");
    }
    let rest = thread::spawn(move || std::io::read_to_string(said).expect("text"));
    (child, line.trim_end().to_owned(), rest)
}

#[track_caller]
fn signal(child: &Child, name: &str) {
    let kill = Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(kill.expect("there is kill").success());
}

/// What it says when it is interrupted.
#[track_caller]
fn interrupted(scratch: &Scratch, args: &[&str]) -> String {
    let (child, line, rest) = start(scratch, args);
    let percent = line.strip_prefix("rendered ").and_then(|line| line.split_once(" %, "));
    let (percent, times) = percent.expect("percent");
    assert!(percent.parse::<u32>().is_ok(), "{line:?}");
    let (elapsed, left) = times.split_once(" elapsed, ").expect("the time that it took so far");
    assert!(elapsed.ends_with('s') && left.ends_with("s to go"), "{line:?}");
    signal(&child, "-INT");
    let output = child.wait_with_output().unwrap();
    let said = rest.join().expect("it was read");
    assert_eq!((output.status.code(), output.stdout), (Some(130), vec![]), "{said}");
    said
}

#[test]
fn an_interrupt_keeps_what_is_finished_and_no_more() {
    let scratch = Scratch::new();
    scratch.file("a.png", "precious");
    let with_stats = [&LONG[..], &["--stats-json", "new.json"]].concat();
    let (child, ..) = start(&scratch, &with_stats);
    assert_eq!(scratch.names(), ["a.png"], "while it works");
    signal(&child, "-KILL");
    drop(child.wait_with_output());
    assert_eq!(scratch.names(), ["a.png"], "killed");

    interrupted(&scratch, &with_stats);
    assert_eq!(scratch.names(), ["a.png", "a.png.part"], "afterwards");
    assert_eq!(scratch.bytes("a.png"), b"precious");

    // It is not lost by accident.
    let run = scratch.rt(&SHORT).exits(1);
    let message = "error: a.png.part is there, of a picture that was interrupted: \
                   --resume goes on with it, --overwrite begins anew\n";
    assert_eq!(run.stderr, message);
    assert_eq!(scratch.names(), ["a.png", "a.png.part"]);

    let run = scratch.rt(&[&SHORT[..], &["--resume"]].concat()).exits(0);
    let resumed = run.stderr.lines().find(|line| line.starts_with("resumed: ")).expect("told");
    let words: Vec<_> = resumed.split(' ').collect();
    let ["resumed:", found, "of", "1024", "tiles", "are", "there"] = words[..] else {
        panic!("{resumed:?}")
    };
    assert!(found.parse::<u32>().is_ok_and(|found| found > 0 && found < 1024), "{resumed}");
    assert_eq!(scratch.names(), ["a.png"], "nothing is left beside a complete picture");
    let whole = scratch.bytes("a.png");
    scratch.rt(&SHORT).exits(0);
    assert!(scratch.bytes("a.png") == whole, "a resumed picture is the same");
}

#[test]
fn with_resume_even_a_kill_loses_nothing() {
    let scratch = Scratch::new();
    let resume = [&LONG[..], &["--resume"]].concat();
    let (mut child, ..) = start(&scratch, &resume);
    signal(&child, "-KILL");
    child.wait().unwrap();
    assert_eq!(scratch.names(), ["a.png.part"]);
    let kept = scratch.bytes("a.png.part");
    // A record that was cut off does not count.
    scratch.file("a.png.part", &kept[..kept.len() - 5]);

    // Taken up, interrupted, and taken up again.
    interrupted(&scratch, &resume);
    let more = fs::metadata(scratch.path("a.png.part")).unwrap().len();
    assert!(more > kept.len() as u64, "it grows");
    let stats = ["--resume", "-q", "--stats-json", "-"];
    let rest = scratch.rt(&[&SHORT[..], &stats].concat()).exits(0).json();
    let traced = rest["rays"]["primary"].as_u64().unwrap();
    assert!(traced > 0 && traced < 1024 * 1024, "{traced} rays");
    let whole = scratch.bytes("a.png");
    scratch.rt(&SHORT).exits(0);
    assert!(scratch.bytes("a.png") == whole);
}

#[test]
fn another_picture_is_refused_and_said_why() {
    let scratch = Scratch::with_room();
    interrupted(&scratch, &LONG);
    let kept = scratch.bytes("a.png.part");
    fs::rename(scratch.path("a.png.part"), scratch.path("a.pfm.part")).unwrap();
    let args = ["render", "room.obj", "-o", "a.pfm", "-s", "40x30"];
    let with = |flags: &[&str]| scratch.rt(&[&args[..], flags].concat());
    let run = with(&["--resume"]).exits(1);
    for part in [
        "a.pfm.part is of another picture: it has 'scene spd:balls:4, ",
        "'size 1024x1024', ",
        ", and this one scene room.obj, ",
        "size 40x30, ",
        ": --overwrite begins anew",
    ] {
        assert!(run.stderr.contains(part), "{part:?} in {}", run.stderr);
    }
    assert!(scratch.bytes("a.pfm.part") == kept, "it stays");
    assert!(!scratch.path("a.pfm").exists());

    scratch.rt(&["render", "room.obj", "-o", "whole.pfm", "-s", "40x30"]).exits(0);
    for flags in [&["--resume", "--overwrite"][..], &["--overwrite"]] {
        scratch.file("a.pfm.part", &kept);
        let run = with(flags).exits(0);
        assert!(!run.stderr.contains("resumed"), "{}", run.stderr);
        assert!(scratch.bytes("a.pfm") == scratch.bytes("whole.pfm"));
        assert!(!scratch.path("a.pfm.part").exists());
    }
    scratch.file("a.pfm.part", "precious");
    for flags in [&["--resume"][..], &[]] {
        let run = with(flags).exits(1);
        let message =
            if flags.is_empty() { "a.pfm.part is there" } else { "a.pfm.part is no part" };
        assert!(run.stderr.contains(message), "{}", run.stderr);
        assert_eq!(scratch.bytes("a.pfm.part"), b"precious");
    }
}

/// How the program describes a picture: beside a part without a description it tells all of it.
#[track_caller]
fn description(scratch: &Scratch, flags: &[&str]) -> String {
    scratch.file("a.png.part", "rt part 1\n\n");
    let args = ["render", "room.obj", "-s", "64x64", "--resume", "-o", "a.png"];
    let told = scratch.rt(&[&args[..], flags].concat()).exits(1).stderr;
    let (_, description) = told.split_once("and this one ").expect("what this one is");
    description.to_owned()
}

#[test]
fn whatever_changes_a_pixel_is_another_picture() {
    let scratch = Scratch::with_room();
    let own = description(&scratch, &[]);
    for same in [
        &[][..],
        &["-j", "1"],
        &["--accel", "kd"],
        &["--builder", "insertion"],
        &["--layout", "skip"],
        &["--isa", "scalar"],
        &["--packet", "4"],
    ] {
        assert_eq!(description(&scratch, same), own, "{same:?}");
    }
    let mut seen = vec![own.clone()];
    for other in [
        &["--crop", "0,0,64,63"][..],
        &["--eye", "1,2,3"],
        &["--target", "0,0,1"],
        &["--up", "0,1,0.1"],
        &["--fov", "41"],
        &["--light", "1,2,3"],
        &["--light", "1,2,3,1,1,0.5"],
        &["--background", "0,0,0"],
        &["--integrator", "normals"],
        &["--integrator", "heat"],
        &["--integrator", "heat", "--accel", "kd"],
        &["--depth", "4"],
        &["--no-shadows"],
        &["--relaxed"],
        &["--kernel", "wald"],
    ] {
        let description = description(&scratch, other);
        assert!(!seen.contains(&description), "{other:?}: {description}");
        seen.push(description);
    }
    scratch.file("room.mtl", crate::support::ROOM_MTL.replace("0.7", "0.8"));
    assert_ne!(description(&scratch, &[]), own, "a material");
    scratch.file("room.mtl", crate::support::ROOM_MTL);
    assert_eq!(description(&scratch, &[]), own);
    scratch.file("room.obj", crate::support::ROOM.replace("v 0 1.5 0", "v 0 1.6 0"));
    assert_ne!(description(&scratch, &[]), own, "a vertex");
}

/// Beside the file, not beside the link.
#[test]
fn a_part_lies_where_the_file_will_be() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("folder")).unwrap();
    std::os::unix::fs::symlink("folder/b.png", scratch.path("a.png")).unwrap();
    let said = interrupted(&scratch, &LONG);
    assert!(said.contains("folder/b.png.part, and --resume"), "{said}");
    assert_eq!(scratch.names(), ["a.png", "folder"]);
    scratch.rt(&[&SHORT[..], &["--resume"]].concat()).exits(0);
    let inside = fs::read_dir(scratch.path("folder")).unwrap().count();
    assert_eq!(inside, 1);
}

#[test]
fn what_is_no_file_has_nothing_beside_it() {
    let scratch = Scratch::with_room();
    let run = scratch.rt(&["render", "room.obj", "-o", "-", "--resume"]).exits(1);
    assert_eq!(run.stderr, "error: --resume takes a file to write to: - is none\n");
    let args = ["render", "spd:balls:4", "--accel", "brute", "-j1", "-s", "1024x1024", "-o", "-"];
    let said = interrupted(&scratch, &args);
    assert!(said.lines().last().unwrap().starts_with("error: interrupted at "), "{said}");
    assert_eq!(scratch.names(), ["room.mtl", "room.obj"]);
}
