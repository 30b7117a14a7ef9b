//! Pictures: what is in the file, and that the flags of the camera, the light and the shading
//! have their effect.

use crate::support::{Picture, Scratch, TRIANGLE};

const SMALL: [&str; 2] = ["-s", "40x30"];

#[track_caller]
fn png(scratch: &Scratch, scene: &str, flags: &[&str]) -> Vec<u8> {
    scratch.png(&[&[scene][..], &SMALL, flags].concat())
}

#[test]
fn a_picture_has_its_size_and_says_what_it_shows() {
    let scratch = Scratch::with_room();
    scratch.rt(&["render", "room.obj", "-o", "a.png", "-s", "33x17"]).exits(0);
    let picture = Picture::open(&scratch.path("a.png"));
    assert_eq!(picture.size, (33, 17));
    assert_eq!(picture.text["Scene"], "room.obj");
    assert_eq!(picture.text["Size"], "33x17");
    assert!(picture.text["View"].starts_with("--eye "), "{:?}", picture.text);
    assert_eq!(picture.text["Software"], concat!("rt ", env!("CARGO_PKG_VERSION")));
    assert_eq!(scratch.names(), ["a.png", "room.mtl", "room.obj"]);
}

#[test]
fn the_size_is_the_flag_s_or_the_scene_s_or_512() {
    let scratch = Scratch::new();
    scratch.file("a.obj", TRIANGLE);
    scratch.file("a.nff", "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 20 10\nf 1 1 1 1 0 0 0 1\ns 0 0 0 1\n");
    let size = |args: &[&str]| Picture::decode(&scratch.png(args)).size;
    assert_eq!(size(&["a.obj"]), (512, 512));
    assert_eq!(size(&["a.nff"]), (20, 10));
    assert_eq!(size(&["a.nff", "-s", "7x9"]), (7, 9));
}

#[test]
fn the_printed_flags_give_the_same_picture() {
    let scratch = Scratch::with_room();
    scratch.file("far.obj", "v 1e20 0 0\nv 1.00001e20 0 0\nv 1e20 1e15 0\nf 1 2 3\n");
    scratch.file("tiny.obj", "v 1e-30 0 0\nv 0 1e-30 0\nv 0 0 1.3e-30\nf 1 2 3\n");
    for (scene, flags) in [
        ("room.obj", &[][..]),
        ("room.obj", &["--up", "0,0,1"]),
        ("room.obj", &["--up", "1,0.5,0", "--fov", "17.3"]),
        ("room.obj", &["--eye", "1.1,2.2,3.3"]),
        ("far.obj", &[]),
        ("tiny.obj", &[]),
    ] {
        let args = [&["render", scene, "-o", "a.png", "-s", "41x23"], flags].concat();
        let run = scratch.rt(&args).exits(0);
        let camera = run.stderr.lines().find_map(|line| line.strip_prefix("camera: "));
        let camera: Vec<_> = camera.expect("the camera is told").split_whitespace().collect();
        assert!(["--eye", "--target", "--up", "--fov"].iter().all(|flag| camera.contains(flag)));
        let again = scratch.png(&[&[scene, "-s", "41x23"], &camera[..]].concat());
        assert_eq!(again, scratch.bytes("a.png"), "{scene} {flags:?} {camera:?}");
    }
}

#[test]
fn a_scene_with_a_camera_keeps_it_and_every_flag_overrides_a_part() {
    let scratch = Scratch::new();
    let run = scratch.rt(&["render", "spd:balls:1", "-o", "own.png", "-s", "40x30"]).exits(0);
    assert!(!run.stderr.contains("camera:"), "{}", run.stderr);
    let own = ["--eye", "2.1,1.3,1.7", "--target", "0,0,0", "--up", "0,0,1", "--fov", "45"];
    let plain = scratch.bytes("own.png");
    assert_eq!(png(&scratch, "spd:balls:1", &own), plain);
    let pixels = |flags: &[&str]| Picture::decode(&png(&scratch, "spd:balls:1", flags)).pixels;
    let mut seen = vec![Picture::decode(&plain).pixels];
    for flags in [
        ["--eye", "2.1,-1.3,1.7"],
        ["--target", "0.5,0,0"],
        ["--up", "0,1,1"],
        ["--fov", "30"],
        ["--eye", "-2.1,1.3,1.7"],
    ] {
        let picture = pixels(&flags);
        assert!(!seen.contains(&picture), "{flags:?} has no effect");
        seen.push(picture);
    }
}

#[test]
fn light_and_shading_have_their_effect() {
    let scratch = Scratch::with_room();
    let light = ["--light", "-1,2.5,1.5"];
    let with = |flags: &[&str]| {
        Picture::decode(&png(&scratch, "room.obj", &[&light, flags].concat())).pixels
    };
    let mut seen = vec![("--light", with(&[]))];
    for flags in [
        &["--light", "1,1,1,0.5,0,0"][..],
        &["--depth", "0"],
        &["--no-shadows"],
        &["--integrator", "eyelight"],
        &["--integrator", "normals"],
        &["--integrator", "depth"],
        &["--integrator", "heat"],
        &["--background", "0,1,0"],
    ] {
        let picture = with(flags);
        let same = seen.iter().find(|(_, other)| *other == picture);
        assert!(same.is_none(), "{flags:?} looks like {}", same.unwrap().0);
        seen.push((flags[flags.len() - 1], picture));
    }
    let headlight = Picture::decode(&png(&scratch, "room.obj", &[])).pixels;
    assert!(seen.iter().all(|(_, picture)| *picture != headlight), "--light has no effect");
    assert_eq!(with(&["--integrator", "whitted"]), seen[0].1);
    assert_eq!(with(&["--depth", "5"]), seen[0].1);
}

/// Estimates are not for the eye.
#[test]
fn a_relaxed_picture_looks_the_same() {
    let scratch = Scratch::with_room();
    let picture = |flags: &[&str]| Picture::decode(&png(&scratch, "room.obj", flags)).pixels;
    let light = ["--light", "-1,2.5,1.5"];
    let (exact, relaxed) = (picture(&light), picture(&[&light[..], &["--relaxed"]].concat()));
    assert_eq!(exact.len(), relaxed.len());
    let most = exact.iter().zip(&relaxed).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(most <= Some(1), "{most:?}");
}

#[test]
fn the_background_is_what_the_flag_says_in_srgb() {
    let scratch = Scratch::new();
    scratch.file("a.obj", TRIANGLE);
    for (flag, color) in [("1,0,0.5", [255, 0, 188]), ("0,0,0", [0; 3]), ("9,9,9", [255; 3])] {
        let picture = Picture::decode(&png(&scratch, "a.obj", &["--background", flag]));
        assert_eq!(picture.pixel(0, 0), color);
        assert_ne!(picture.pixel(15, 15), color, "the triangle is in front");
    }
}

#[test]
fn light_and_background_are_the_flag_s_or_the_scene_s() {
    let scratch = Scratch::new();
    let scene = "b 0 0 1\nl 0 0 9\nf 1 1 1 1 0 0 0 1\ns 0 0 0 1\n";
    let view = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 1\nresolution 20 20\n";
    scratch.file("a.nff", format!("{view}{scene}"));
    let picture = |flags: &[&str]| Picture::decode(&scratch.png(&[&["a.nff"], flags].concat()));
    let own = picture(&[]);
    assert_eq!(own.pixel(0, 0), [0, 0, 255]);
    assert_eq!(picture(&["--background", "0,1,0"]).pixel(0, 0), [0, 255, 0]);
    let lit = picture(&["--light", "0,0,9,1,0,0"]);
    assert!(own.pixel(10, 10)[1] > 200 && lit.pixel(10, 10)[1] == 0);
    assert!(lit.pixel(10, 10)[0] > 200);
}

#[test]
fn normals_and_depth_are_what_they_say() {
    let scratch = Scratch::new();
    scratch.file("a.obj", TRIANGLE);
    let center =
        |kind| Picture::decode(&png(&scratch, "a.obj", &["--integrator", kind])).pixel(15, 15);
    // The triangle faces the eye on +z: half, half, full.
    assert_eq!(center("normals"), [188, 188, 255]);
    let [r, g, b] = center("depth");
    assert!(r == g && g == b && r > 200, "near is white: {r} {g} {b}");
}

#[test]
fn nothing_to_see_is_a_picture_of_the_background_and_a_warning() {
    let scratch = Scratch::new();
    scratch.file("a.obj", "v 0 0 0\nv 1 1 0\nf 1 2 1\nf 2 2 2\n");
    let args = ["render", "a.obj", "-o", "a.png", "-s", "9x9", "--background", "1,1,1"];
    let run = scratch.rt(&args).exits(0);
    assert!(run.stderr.starts_with("warning: 2 triangles have no area"), "{}", run.stderr);
    assert!(Picture::open(&scratch.path("a.png")).pixels.iter().all(|&byte| byte == 255));
}

/// It shows what finds the hits, and nothing else of the machine.
#[test]
fn heat_depends_on_the_accelerator_alone() {
    let scratch = Scratch::new();
    let heat = |flags: &[&str]| {
        let args = [&["spd:rings:1", "-s", "40x40", "--integrator", "heat"], flags].concat();
        Picture::decode(&scratch.png(&args)).pixels
    };
    let own = heat(&[]);
    let mut same = vec![vec!["-j", "1"], vec!["-j", "3"], vec!["--packet", "1"]];
    let levels = crate::support::levels();
    same.extend(levels.iter().map(|level| vec!["--isa", level]));
    for flags in same {
        assert!(heat(&flags) == own, "{flags:?}");
    }
    for flags in
        [["--accel", "kd"], ["--accel", "brute"], ["--layout", "skip"], ["--builder", "insertion"]]
    {
        assert!(heat(&flags) != own, "{flags:?}");
    }
    // Every ray is tested against all there is: one colour, of 61 tests.
    let brute = heat(&["--accel", "brute"]);
    assert!(brute.chunks(3).all(|pixel| *pixel == brute[..3]) && brute[0] > 0);
}
