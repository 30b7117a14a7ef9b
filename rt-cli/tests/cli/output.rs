//! Where output goes: whole or not at all, and nothing beside it.

use std::fs::{self, Permissions};
use std::io;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;

use crate::support::{Picture, Run, Scratch, TRIANGLE, argv, run, skipped};

fn triangle() -> Scratch {
    let scratch = Scratch::new();
    scratch.file("a.obj", TRIANGLE);
    scratch
}

#[track_caller]
fn render_to(scratch: &Scratch, output: &str) -> Run {
    scratch.rt(&["render", "-q", "a.obj", "-s", "8x8", "-o", output])
}

/// Runs `rt` from a shell that does something first.
#[track_caller]
fn after(scratch: &Scratch, first: &str, args: &[&str]) -> Run {
    let shell = ["sh", "-c", &format!("{first}; exec \"$@\""), "sh"].map(Into::into);
    run(scratch.command(&[&shell[..], &argv()].concat()).args(args))
}

/// A device to write to: 3 is null, 7 is full. Root makes its own in the folder, for a program at
/// fault may well put a file in the place of the machine's; for all others /dev is out of reach.
fn device(scratch: &Scratch, minor: u8) -> Option<String> {
    let own = scratch.path(&format!("device{minor}"));
    let mknod = Command::new("mknod").arg(&own).args(["c", "1", &minor.to_string()]).output();
    if mknod.is_ok_and(|made| made.status.success()) && open_device(&own).is_ok() {
        return Some(own.to_string_lossy().into_owned());
    }
    if tempfile::tempfile_in("/dev").is_ok() {
        skipped("root may not make devices here, and shall not use those of the machine");
        return None;
    }
    let device = if minor == 3 { "/dev/null" } else { "/dev/full" };
    if open_device(device).is_err() {
        skipped("there is no such device here");
        return None;
    }
    Some(device.to_owned())
}

fn open_device(path: impl AsRef<Path>) -> io::Result<fs::File> {
    fs::OpenOptions::new().write(true).open(path)
}

#[track_caller]
fn mode(path: &Path) -> u32 {
    fs::metadata(path).expect("the file is there").permissions().mode() & 0o7777
}

#[test]
fn places_that_cannot_be_written_to_are_told_before_any_work() {
    let scratch = triangle();
    fs::create_dir(scratch.path("folder")).unwrap();
    symlink("folder", scratch.path("link")).unwrap();
    symlink("loop", scratch.path("loop")).unwrap();
    let before = scratch.names();
    for (output, message) in [
        ("no/a.png", "cannot write no/a.png: there is no folder no"),
        ("no/", "cannot write no/: there is no folder no/"),
        ("folder", "cannot write folder: it is a directory"),
        ("folder/", "cannot write folder/: it is a directory"),
        (".", "cannot write .: it is a directory"),
        ("link", "cannot write link: it is a directory"),
        ("loop", "cannot write loop: "),
        ("a.obj/b.png", "cannot write a.obj/b.png: Not a directory"),
        ("a.jpg", "cannot write a.jpg: give it the extension .png"),
        ("a.obj", "cannot write a.obj: give it the extension .png"),
    ] {
        // The scene is not even looked at.
        for scene in ["a.obj", "missing.obj"] {
            let run = scratch.rt(&["render", scene, "-o", output]).exits(1);
            assert!(run.stderr.starts_with(&format!("error: {message}")), "{}", run.stderr);
            assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
        }
        assert_eq!(scratch.names(), before);
    }
    assert_eq!(scratch.bytes("a.obj"), TRIANGLE.as_bytes());
}

#[test]
fn an_empty_name_is_wrong_usage() {
    render_to(&triangle(), "").exits(2);
}

#[test]
fn picture_and_statistics_do_not_overwrite_each_other() {
    let scratch = triangle();
    symlink("a", scratch.path("b.json")).unwrap();
    for (picture, stats) in [("-", "-"), ("a", "a"), ("a", "./a"), ("a", "b.json")] {
        let args = ["render", "a.obj", "-s", "8x8", "-o", picture, "--stats-json", stats];
        let run = scratch.rt(&args).exits(1);
        assert!(run.stderr.contains("cannot go to the same place"), "{}", run.stderr);
        assert!(run.stdout.is_empty());
    }
    assert_eq!(scratch.names(), ["a.obj", "b.json"]);
    let Some(null) = device(&scratch, 3) else { return };
    let args = ["render", "a.obj", "-s", "8x8", "-o", &null, "--stats-json", &null];
    scratch.rt(&args).exits(0);
}

#[test]
fn devices_and_pipes_are_written_to_and_stay() {
    let scratch = triangle();
    if let Some(null) = device(&scratch, 3) {
        render_to(&scratch, &null).exits(0);
        assert!(!fs::metadata(null).unwrap().is_file());
    }
    let fifo = scratch.path("pipe.png");
    assert!(Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    let reader = thread::spawn({
        let fifo = fifo.clone();
        move || fs::read(fifo).unwrap()
    });
    render_to(&scratch, "pipe.png").exits(0);
    assert_eq!(Picture::decode(&reader.join().unwrap()).size, (8, 8));
    assert!(!fs::metadata(&fifo).unwrap().is_file());
    let hidden = scratch.names().iter().any(|name| name.starts_with('.'));
    assert!(!hidden, "{:?}", scratch.names());

    let run = render_to(&scratch, "/dev/fd/1").exits(0);
    assert_eq!(Picture::decode(&run.stdout).size, (8, 8));
}

#[test]
fn links_stay_and_what_they_name_is_written() {
    let scratch = triangle();
    fs::create_dir(scratch.path("folder")).unwrap();
    symlink("folder/there.png", scratch.path("link.png")).unwrap();
    symlink("link.png", scratch.path("second.png")).unwrap();
    // At first there is nothing at its end.
    for name in ["second.png", "link.png"] {
        render_to(&scratch, name).exits(0);
        assert!(fs::symlink_metadata(scratch.path("link.png")).unwrap().is_symlink());
        assert!(fs::symlink_metadata(scratch.path("second.png")).unwrap().is_symlink());
        assert!(fs::symlink_metadata(scratch.path("folder/there.png")).unwrap().is_file());
        assert_eq!(Picture::open(&scratch.path("link.png")).size, (8, 8));
        fs::write(scratch.path("folder/there.png"), "something longer than nothing").unwrap();
    }
    assert_eq!(fs::read_dir(scratch.path("folder")).unwrap().count(), 1);
    assert_eq!(scratch.names(), ["a.obj", "folder", "link.png", "second.png"]);
}

#[test]
fn a_read_only_file_stays() {
    let scratch = triangle();
    scratch.file("a.png", "precious");
    fs::set_permissions(scratch.path("a.png"), Permissions::from_mode(0o444)).unwrap();
    let run = render_to(&scratch, "a.png").exits(1);
    assert_eq!(run.stderr, "error: cannot write a.png: it is read-only\n");
    assert_eq!(scratch.bytes("a.png"), b"precious");
}

#[test]
fn a_folder_that_takes_no_files_is_told() {
    let scratch = triangle();
    let folder = scratch.path("folder");
    fs::create_dir(&folder).unwrap();
    fs::set_permissions(&folder, Permissions::from_mode(0o555)).unwrap();
    // Nothing is forbidden to root, but /proc takes files from nobody.
    let privileged = fs::write(folder.join("probe"), "").is_ok();
    let folder = if privileged { "/proc/self" } else { "folder" };
    let run = render_to(&scratch, &format!("{folder}/a.png")).exits(1);
    let message = format!("cannot write {folder}/a.png: no file can be made in ");
    assert!(run.stderr.starts_with(&format!("error: {message}")), "{}", run.stderr);
    assert!(!run.stderr.contains("os error") && !run.stderr.contains("tmp"), "{}", run.stderr);
}

#[test]
fn new_files_follow_the_umask_and_old_ones_keep_their_mode() {
    let scratch = triangle();
    let args = ["render", "-q", "a.obj", "-s", "8x8", "-o", "a.png"];
    for (umask, expected) in [("022", 0o644), ("077", 0o600), ("002", 0o664), ("000", 0o666)] {
        after(&scratch, &format!("umask {umask}"), &args).exits(0);
        assert_eq!(mode(&scratch.path("a.png")), expected, "umask {umask}");
        fs::remove_file(scratch.path("a.png")).unwrap();
    }
    for kept in [0o600, 0o664, 0o646, 0o755] {
        scratch.file("a.png", "old");
        fs::set_permissions(scratch.path("a.png"), Permissions::from_mode(kept)).unwrap();
        after(&scratch, "umask 022", &args).exits(0);
        assert_eq!(mode(&scratch.path("a.png")), kept);
        assert_eq!(Picture::open(&scratch.path("a.png")).size, (8, 8));
    }
}

#[test]
fn a_full_disk_leaves_what_was_there() {
    let scratch = triangle();
    fs::write(scratch.path("a.png"), "precious").unwrap();
    for args in [
        &["render", "-q", "spd:balls:1", "-s", "99x99", "-o", "a.png"][..],
        &["render", "-q", "spd:balls:1", "-s", "99x99", "-o", "new.png"],
        &["gen", "balls", "--size", "2", "-o", "new.nff"],
    ] {
        // No file may grow beyond half a kilobyte.
        let run = after(&scratch, "trap '' XFSZ; ulimit -f 1", args).exits(1);
        let message = format!("error: cannot write {}: File too large\n", args.last().unwrap());
        assert_eq!(run.stderr, message);
        assert_eq!(scratch.names(), ["a.obj", "a.png"]);
        assert_eq!(scratch.bytes("a.png"), b"precious");
    }
}

#[test]
fn a_full_device_is_told() {
    let scratch = triangle();
    let Some(full) = device(&scratch, 7) else { return };
    let no_space = |what: &str| format!("error: cannot write {what}: No space left on device\n");
    assert_eq!(render_to(&scratch, &full).exits(1).stderr, no_space(&full));
    let open = || Stdio::from(open_device(&full).unwrap());
    let run = run_with(&scratch, &["info"], open(), Stdio::piped()).exits(1);
    assert_eq!(run.stderr, no_space("standard output"));
    // Talk that cannot be written is no reason to stop.
    let args = ["render", "a.obj", "-s", "8x8", "-o", "b.png"];
    run_with(&scratch, &args, Stdio::piped(), open()).exits(0);
    assert_eq!(Picture::open(&scratch.path("b.png")).size, (8, 8));
}

#[track_caller]
fn run_with(scratch: &Scratch, args: &[&str], stdout: Stdio, stderr: Stdio) -> Run {
    run(scratch.rt_command(args).stdout(stdout).stderr(stderr))
}

#[test]
fn nobody_has_to_listen() {
    let scratch = triangle();
    let closed = || {
        let (reader, writer) = io::pipe().unwrap();
        drop(reader);
        Stdio::from(writer)
    };
    for args in [
        &["info", "a.obj"][..],
        &["info", "--json"],
        &["gen", "balls"],
        &["render", "a.obj", "-s", "300x300", "-o", "-"],
        &["render", "a.obj", "-s", "8x8", "-o", "a.png", "--stats-json", "-"],
        &["bench", "spd:balls:0", "-s", "8x8", "--rounds", "1"],
        &["render", "--help"],
    ] {
        run_with(&scratch, args, closed(), Stdio::piped()).exits(0);
    }
    fs::remove_file(scratch.path("a.png")).unwrap();
    let args = ["render", "a.obj", "-s", "8x8", "-o", "a.png"];
    run_with(&scratch, &args, Stdio::piped(), closed()).exits(0);
    assert_eq!(Picture::open(&scratch.path("a.png")).size, (8, 8));
    run_with(&scratch, &["render", "no.obj", "-o", "a.png"], Stdio::piped(), closed()).exits(1);
    run_with(&scratch, &["render", "no.obj"], Stdio::piped(), closed()).exits(2);
}
