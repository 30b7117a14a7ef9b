//! `rt compare`: what it says of pictures with known differences, and its exit codes.

use std::fs;

use crate::support::{Picture, Run, Scratch, keys};

/// A grey PFM of 2 by 2 with one pixel set.
fn grey(scratch: &Scratch, name: &str, value: f32) {
    let mut file = b"Pf\n2 2\n-1.0\n".to_vec();
    // The last number is the right pixel of the upper row.
    for grey in [0.0, 0.0, 0.0, value] {
        file.extend(grey.to_le_bytes());
    }
    scratch.file(name, file);
}

#[track_caller]
fn compare(scratch: &Scratch, args: &[&str]) -> Run {
    scratch.rt(&[&["compare"], args].concat())
}

#[test]
fn known_differences_are_told_in_words_and_json() {
    let scratch = Scratch::new();
    grey(&scratch, "a.pfm", 0.5);
    grey(&scratch, "b.pfm", 0.25);
    let run = compare(&scratch, &["a.pfm", "b.pfm"]).exits(0);
    assert!(run.stderr.is_empty());
    let expected = "\
compared    linear
MSE         0.015625
PSNR        18.06 dB
greatest    0.250000 at 1,0
differing   1 of 4 pixels (25.000 %)
";
    assert_eq!(run.text(), expected);
    let json = compare(&scratch, &["a.pfm", "b.pfm", "--json"]).exits(0).json();
    let names = [
        "scale",
        "mse",
        "psnr",
        "max_difference",
        "worst_pixel",
        "differing_pixels",
        "pixels",
        "identical",
    ];
    assert_eq!(keys(&json), names);
    assert_eq!((&json["mse"], &json["max_difference"]), (&0.015625.into(), &0.25.into()));
    assert_eq!(json["worst_pixel"].to_string(), "[1,0]");
    assert_eq!((&json["differing_pixels"], &json["pixels"]), (&1.into(), &4.into()));
    let same = compare(&scratch, &["a.pfm", "a.pfm", "--json"]).exits(0).json();
    assert_eq!((&same["identical"], same["psnr"].is_null()), (&true.into(), true));
    let text = compare(&scratch, &["a.pfm", "a.pfm"]).exits(0).text();
    assert!(text.contains("PSNR        inf dB\ngreatest    0\ndiffering   0 of 4"), "{text}");
}

#[test]
fn a_missed_limit_is_exit_code_3() {
    let scratch = Scratch::new();
    grey(&scratch, "a.pfm", 0.5);
    grey(&scratch, "b.pfm", 0.25);
    for (limit, good, bad) in [
        ("--max-mse", "0.015625", "0.0156"),
        ("--min-psnr", "18.06", "18.07"),
        ("--max-difference", "0.25", "0.2499"),
        ("--max-pixels", "1", "0"),
    ] {
        compare(&scratch, &["a.pfm", "b.pfm", limit, good]).exits(0);
        let run = compare(&scratch, &["a.pfm", "b.pfm", limit, bad]).exits(3);
        assert!(run.stderr.starts_with("error: too different: "), "{}", run.stderr);
        assert!(run.stderr.ends_with(&format!(", {limit} {bad}\n")), "{}", run.stderr);
        assert!(run.text().contains("PSNR"), "the numbers are told all the same");
        compare(&scratch, &["a.pfm", "a.pfm", limit, bad]).exits(0);
    }
    let all = ["--max-mse", "0", "--min-psnr", "99", "--max-difference", "0", "--max-pixels", "0"];
    let run = compare(&scratch, &[&["a.pfm", "b.pfm"], &all[..]].concat()).exits(3);
    assert_eq!(run.stderr.matches("; ").count(), 3, "{}", run.stderr);
    for bad in ["--max-mse=-1", "--max-mse=x", "--min-psnr=nan", "--max-pixels=-1", "--gain=2"] {
        compare(&scratch, &["a.pfm", "b.pfm", bad]).exits(2);
    }
}

#[test]
fn the_difference_image_shows_where() {
    let scratch = Scratch::new();
    grey(&scratch, "a.pfm", 0.5);
    grey(&scratch, "b.pfm", 0.25);
    let look = |flags: &[&str]| {
        let args = [&["a.pfm", "b.pfm", "-o", "d.png"], flags].concat();
        compare(&scratch, &args).exits(0);
        Picture::open(&scratch.path("d.png"))
    };
    let picture = look(&[]);
    assert_eq!((picture.pixel(1, 0), picture.pixel(0, 0)), ([255; 3], [0; 3]));
    assert_eq!(look(&["--gain", "1"]).pixel(1, 0), [64; 3]);
    assert_eq!(look(&["--gain", "2"]).pixel(1, 0), [128; 3]);
    compare(&scratch, &["a.pfm", "b.pfm", "-o", "d.exr"]).exits(0);
    let json = compare(&scratch, &["d.exr", "b.pfm", "--json"]).exits(0).json();
    assert_eq!(json["identical"], true, "the difference is 0.25, as b is");
    let run = compare(&scratch, &["a.pfm", "b.pfm", "-o", "-"]).exits(0);
    assert_eq!(Picture::decode(&run.stdout).size, (2, 2));
    // A missed limit does not cost the picture.
    fs::remove_file(scratch.path("d.png")).unwrap();
    compare(&scratch, &["a.pfm", "b.pfm", "-o", "d.png", "--max-pixels", "0"]).exits(3);
    assert!(scratch.path("d.png").exists());
}

#[test]
fn rendered_pictures_are_compared() {
    let scratch = Scratch::with_room();
    let render = |output: &str, flags: &[&str]| {
        let args = [&["render", "room.obj", "-q", "-s", "40x30", "-o", output], flags].concat();
        scratch.rt(&args).exits(0);
    };
    render("a.png", &[]);
    render("b.png", &["--isa", "scalar", "--accel", "kd"]);
    render("c.png", &["--fov", "41"]);
    compare(&scratch, &["a.png", "b.png", "--max-pixels", "0"]).exits(0);
    let run = compare(&scratch, &["a.png", "c.png", "--max-pixels", "0"]).exits(3);
    assert!(run.text().contains(" of 255) at "), "{}", run.text());
}

#[test]
fn what_cannot_be_compared_is_told() {
    let scratch = Scratch::with_room();
    grey(&scratch, "a.pfm", 0.5);
    scratch.file("wide.pfm", b"Pf\n2 1\n-1.0\n\0\0\0\0\0\0\0\0");
    scratch.file("cut.pfm", b"PF\n200 100\n-1.0\n\0\0");
    fs::create_dir(scratch.path("folder.png")).unwrap();
    let before = scratch.names();
    for (other, message) in [
        ("wide.pfm", "the sizes differ: a.pfm has 2x2 pixels, wide.pfm has 2x1"),
        ("no.png", "cannot read no.png: No such file or directory"),
        ("folder.png", "cannot read folder.png: it is a directory"),
        ("room.obj", "room.obj: this is no PNG, PFM or OpenEXR file"),
        ("cut.pfm", "cut.pfm: PFM at byte 0: 200x100 pixels do not fit into a file of 18 bytes"),
    ] {
        let run = compare(&scratch, &["a.pfm", other, "-o", "d.png"]).exits(1);
        assert_eq!(run.stderr, format!("error: {message}\n"));
        assert!(run.stdout.is_empty());
        assert_eq!(scratch.names(), before);
    }
    let run = compare(&scratch, &["a.pfm", "a.pfm", "-o", "d.jpg"]).exits(1);
    assert!(run.stderr.contains("give it the extension .png, .pfm or .exr"), "{}", run.stderr);
    for args in [&["a.pfm"][..], &["a.pfm", "a.pfm", "a.pfm"]] {
        compare(&scratch, args).exits(2);
    }
}
