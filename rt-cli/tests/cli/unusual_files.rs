//! Scenes that are no files, or cannot be read.

use std::fs::{self, Permissions};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::process::Command;

use crate::support::{Scratch, TRIANGLE, skipped};

#[track_caller]
fn refused(scratch: &Scratch, scene: &str, message: &str) {
    scratch.file("old.png", "precious");
    let names = scratch.names();
    for args in [
        &["info", scene][..],
        &["render", scene, "-o", "old.png"],
        &["render", scene, "-o", "new.png"],
        &["bench", scene],
    ] {
        let run = scratch.rt(args).exits(1);
        assert!(run.stderr.starts_with(&format!("error: {message}")), "{}", run.stderr);
        assert!(!run.stderr.contains("os error"), "{}", run.stderr);
        assert_eq!(scratch.names(), names);
        assert_eq!(scratch.bytes("old.png"), b"precious");
    }
}

#[test]
fn what_is_not_there() {
    let scratch = Scratch::new();
    refused(&scratch, "no.obj", "cannot read no.obj: No such file or directory");
    refused(&scratch, "no/no.nff", "cannot read no/no.nff: No such file or directory");
    symlink("no.obj", scratch.path("link.obj")).unwrap();
    refused(&scratch, "link.obj", "cannot read link.obj: No such file or directory");
    symlink("loop.obj", scratch.path("loop.obj")).unwrap();
    refused(&scratch, "loop.obj", "cannot read loop.obj: ");
}

#[test]
fn what_is_no_file() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("folder.obj")).unwrap();
    refused(&scratch, "folder.obj", "cannot read folder.obj: it is a directory");
    symlink("/dev/zero", scratch.path("endless.obj")).unwrap();
    refused(&scratch, "endless.obj", "cannot read endless.obj: it is not a regular file");
    assert!(Command::new("mkfifo").arg(scratch.path("pipe.obj")).status().unwrap().success());
    refused(&scratch, "pipe.obj", "cannot read pipe.obj: it is not a regular file");
}

#[test]
fn what_may_not_be_read() {
    let scratch = Scratch::new();
    scratch.file("a.obj", TRIANGLE);
    fs::set_permissions(scratch.path("a.obj"), Permissions::from_mode(0o000)).unwrap();
    if fs::read(scratch.path("a.obj")).is_err() {
        refused(&scratch, "a.obj", "cannot read a.obj: Permission denied");
    } else if fs::metadata("/proc/self/mem").is_ok_and(|facts| facts.is_file()) {
        // Nothing is forbidden to root, but nobody can read what is not mapped.
        symlink("/proc/self/mem", scratch.path("b.obj")).unwrap();
        refused(&scratch, "b.obj", "cannot read b.obj: ");
    } else {
        skipped("there is nothing here that cannot be read");
    }
}

#[test]
fn what_has_no_known_extension() {
    let scratch = Scratch::new();
    scratch.file("a.stl", TRIANGLE);
    for scene in ["a.stl", "no.stl", "scene", ".", "obj", ".obj"] {
        refused(&scratch, scene, &format!("cannot tell the format of {scene}: "));
    }
    scratch.file("a.OBJ", TRIANGLE);
    scratch.rt(&["info", "a.OBJ"]).exits(0);
}

#[test]
fn names_with_blanks_and_letters_of_all_kinds() {
    let scratch = Scratch::new();
    for name in ["a b.obj", "größe.obj", "日本.obj", "--x.obj"] {
        scratch.file(name, TRIANGLE);
        let out = format!("{name}.png");
        let args = ["render", "-s", "8x8", "-o", &format!("./{out}"), "--", name];
        let run = scratch.rt(&args).exits(0);
        assert!(run.stderr.contains(&format!("./{out}: 8x8")), "{}", run.stderr);
        let picture = crate::support::Picture::open(&scratch.path(&out));
        assert_eq!(picture.text["Scene"], name);
    }
}
