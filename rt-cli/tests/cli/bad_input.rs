//! Malformed and odd OBJ files: a message with its place and exit code 1, or the right triangles.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::support::{Picture, Run, Scratch, TRIANGLE};

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// Three vertices and a line.
fn and(line: &str) -> Vec<u8> {
    format!("{CORNERS}{line}\n").into_bytes()
}

/// One polygon with corners at those places.
fn polygon(corners: impl IntoIterator<Item = (f64, f64)>) -> Vec<u8> {
    let (mut text, mut face) = (String::new(), "f".to_owned());
    for (i, (x, y)) in corners.into_iter().enumerate() {
        writeln!(text, "v {x} {y} 0").unwrap();
        write!(face, " {}", i + 1).unwrap();
    }
    (text + &face + "\n").into_bytes()
}

/// A star of so many spikes: every other corner is a dent.
fn star(spikes: usize) -> Vec<u8> {
    polygon((0..2 * spikes).map(|i| {
        let (sin, cos) = (i as f64 / (2 * spikes) as f64 * TAU).sin_cos();
        let radius = if i % 2 == 0 { 2.0 } else { 0.7 };
        (radius * cos, radius * sin)
    }))
}

/// Files that are odd, and how many triangles they have.
fn odd() -> Vec<(&'static str, Vec<u8>, usize)> {
    let circle = |n: usize| {
        polygon((0..n).map(move |i| {
            let (sin, cos) = (i as f64 / n as f64 * TAU).sin_cos();
            (cos, sin)
        }))
    };
    let utf8_bom = b"\xEF\xBB\xBF";
    vec![
        ("crlf", TRIANGLE.replace('\n', "\r\n").into(), 1),
        ("cr", TRIANGLE.replace('\n', "\r").into(), 1),
        ("bom", [utf8_bom, TRIANGLE.as_bytes()].concat(), 1),
        ("no_last_line_end", TRIANGLE.trim_end().into(), 1),
        ("tabs", TRIANGLE.replace(' ', "\t \t").into(), 1),
        ("continued", and("f 1 \\\n2 \\\r\n3"), 1),
        ("face_first", format!("f 1 2 3\n{CORNERS}").into(), 1),
        ("relative", and("f -3 -2 -1"), 1),
        ("open_corners", and("f 1/ 2/ 3/"), 1),
        (
            "latin_1",
            and("# caf\u{e9}\nf 1 2 3").iter().copied().filter(|b| *b != 0xC3).collect(),
            1,
        ),
        ("unknown", and("f 1 2 3\nfrobnicate 1 2\n\u{1F600}"), 1),
        ("missing_library", and("mtllib ../no/such.mtl\nusemtl x\nf 1 2 3"), 1),
        ("degenerate", and("f 1 1 1\nf 1 2 1\nf 2 2 3"), 3),
        ("on_a_line", b"v 0 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 2 3 4\n".into(), 2),
        ("small", b"v 1e-30 0 0\nv 0 1e-30 0\nv 0 0 1e-30\nf 1 2 3\n".into(), 1),
        ("large", b"v 1e30 0 0\nv 0 1e30 0\nv 0 0 1e30\nf 1 2 3\n".into(), 1),
        ("far_away", b"v 1e7 0 0\nv 10000001 0 0\nv 1e7 1 0\nf 1 2 3\n".into(), 1),
        ("circle", circle(20_000), 19_998),
        ("star", star(100), 198),
        ("dent", polygon([(0., 0.), (4., 0.), (4., 4.), (2., 1.), (0., 4.)]), 3),
        ("bow_tie", polygon([(0., 0.), (1., 1.), (1., 0.), (0., 1.)]), 2),
        ("twice_the_same", and("f 1 2 3\nf 1 2 3\nf 3 2 1"), 3),
    ]
}

/// Files that are no OBJ, and what is said of them after their name.
fn bad() -> Vec<(&'static str, Vec<u8>, String)> {
    let out_of_range = "is out of range";
    let random = |n: usize| {
        let next = |seed: u32| seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let seeds = std::iter::successors(Some(7), move |seed| Some(next(*seed)));
        seeds.take(n).map(|seed| (seed >> 24) as u8)
    };
    let say = |message: &str| message.to_owned();
    vec![
        ("empty", vec![], say(" no faces")),
        ("comments", b"# nothing\n\n# at all".into(), say(" no faces")),
        ("no_faces", CORNERS.into(), say(" no faces")),
        ("nan", b"v 0 nan 0\nf 1 1 1\n".into(), say("1:5: expected a finite number, found 'nan'")),
        ("infinite", b"v 0 0 -inf\n".into(), say("1:7: expected a finite number, found '-inf'")),
        ("msvc_nan", b"v 1.#QNAN 0 0\n".into(), say("1:3: expected a number, found '1.#QNAN'")),
        (
            "huge",
            b"v 1e39 0 0\n".into(),
            say("1:3: '1e39' is beyond the range of single precision"),
        ),
        (
            "endless_number",
            format!("v {} 0 0\n", "9".repeat(1 << 20)).into(),
            say("1:3: '9999999999"),
        ),
        ("hexadecimal", b"v 0x10 0 0\n".into(), say("1:3: expected a number, found '0x10'")),
        ("comma", b"v 1,5 0 0\n".into(), say("1:3: expected a number, found '1,5'")),
        (
            "short_vertex",
            b"v 1 2\nv 1 0 0\n".into(),
            say("1:6: expected 3 numbers after 'v', found 2"),
        ),
        ("short_normal", and("vn\nf 1 2 3"), say("4:3: expected 3 numbers after 'vn', found 0")),
        ("short_face", and("f 1 2"), say("4:6: expected 3 or more corners after 'f', found 2")),
        ("no_corners", and("f"), say("4:2: expected 3 or more corners after 'f', found 0")),
        ("zero", and("f 0 1 2"), say("4:3: vertex index 0 is out of range: indices start at 1")),
        (
            "beyond",
            and("f 1 2 4"),
            format!("4:7: vertex index 4 {out_of_range}: the file has 3 vert"),
        ),
        ("before", and("f -4 -2 -1"), format!("4:3: vertex index -4 {out_of_range}: only 3 vert")),
        ("no_normal", and("f 1//1 2//1 3//1"), format!("4:3: normal index 1 {out_of_range}")),
        (
            "overflow",
            and("f 1 2 18446744073709551617"),
            format!("4:7: index '18446744073709551617' {out_of_range}"),
        ),
        (
            "overflow_32",
            and("f 1 2 4294967297"),
            format!("4:7: vertex index 4294967297 {out_of_range}"),
        ),
        (
            "negative_overflow",
            and("f 1 2 -9223372036854775808"),
            format!("4:7: vertex index -9223372036854775808 {out_of_range}"),
        ),
        (
            "fraction",
            and("f 1 2 3.5"),
            say("4:7: expected a corner such as 1, 1/2, 1//3 or 1/2/3, found '3.5'"),
        ),
        ("four_parts", and("f 1/1/1/1 2 3"), say("4:3: expected a corner such as")),
        ("no_position", and("f /1 2 3"), say("4:3: expected a corner such as")),
        (
            "word",
            and("f 1 two 3"),
            say("4:5: expected a corner such as 1, 1/2, 1//3 or 1/2/3, found 'two'"),
        ),
        (
            "cut",
            TRIANGLE.as_bytes()[..14].into(),
            say("2:6: expected 3 numbers after 'v', found 2"),
        ),
        ("zeros", vec![0; 1000], say(" this is not OBJ text: byte 1 is zero")),
        (
            "picture",
            b"\x89PNG\r\n\x1A\n\0\0\0\rIHDR".into(),
            say(" this is not OBJ text: byte 9 is zero"),
        ),
        (
            "utf_16",
            TRIANGLE.encode_utf16().flat_map(u16::to_le_bytes).collect(),
            say(" this is not OBJ text: byte 2 is zero"),
        ),
        (
            "utf_16_bom",
            b"\xFF\xFEv\0 \x000\0".into(),
            say(" this is UTF-16 text: save it as UTF-8"),
        ),
        ("noise", random(50_000).collect(), say(" this is not OBJ text: byte ")),
        ("noise_without_zeros", random(50_000).filter(|&byte| byte != 0).collect(), say("")),
    ]
}

/// Of nothing that failed may there be a trace.
#[track_caller]
fn failed_clean(scratch: &Scratch, run: &Run, names: &[String]) {
    assert!(run.stdout.is_empty());
    assert_eq!(scratch.names(), names);
    assert_eq!(scratch.bytes("old.png"), b"precious");
}

#[test]
fn bad_files_are_told_with_their_place_and_leave_nothing() {
    let scratch = Scratch::new();
    scratch.file("old.png", "precious");
    for (name, content, message) in bad() {
        let name = format!("{name}.obj");
        scratch.file(&name, content);
        let names = scratch.names();
        for args in [
            &["info", &name, "--json"][..],
            &["info", &name],
            &["render", &name, "-o", "old.png"],
            &["render", &name, "-o", "new.png", "--stats-json", "new.json", "-q"],
        ] {
            let run = scratch.rt(args).exits(1);
            assert!(run.stderr.starts_with(&format!("{name}:{message}")), "{}", run.stderr);
            assert!(run.stderr.len() < 4000, "{name}: a message of {} bytes", run.stderr.len());
            failed_clean(&scratch, &run, &names);
        }
    }
}

#[test]
fn odd_files_have_their_triangles_and_a_picture() {
    let scratch = Scratch::new();
    for (name, content, triangles) in odd() {
        let name = format!("{name}.obj");
        scratch.file(&name, content);
        let info = scratch.rt(&["info", &name, "--json"]).exits(0).json();
        assert_eq!(info["triangles"], triangles, "{name}");
        let picture = Picture::decode(&scratch.png(&[&name, "-s", "20x20"]));
        let visible = picture.pixels.chunks(3).any(|pixel| *pixel != picture.pixels[..3]);
        // Corners on a slanting line are a sliver to some rays: it shows in a pixel or two.
        assert!(visible != (name == "degenerate.obj") || name == "on_a_line.obj", "{name}");
    }
}

#[test]
fn there_are_enough_of_both() {
    assert!(bad().len() >= 20 && odd().len() >= 20);
}

#[test]
fn points_and_extremes_have_their_triangles_and_a_picture() {
    let scratch = Scratch::new();
    for (name, content) in [
        ("point.obj", "v 1 2 3\nf 1 1 1\n"),
        ("origin.obj", "v 0 0 0\nf 1 1 1\n"),
        ("subnormal.obj", "v 1e-40 0 0\nv 0 1e-40 0\nv 0 0 1e-45\nf 1 2 3\n"),
        ("extreme.obj", "v 3e38 0 0\nv -3e38 0 0\nv 0 3e38 0\nf 1 2 3\n"),
    ] {
        scratch.file(name, content);
        let info = scratch.rt(&["info", name, "--json"]).exits(0).json();
        assert_eq!(info["triangles"], 1, "{name}");
        let names = scratch.names();
        let run = scratch.rt(&["render", name, "-o", "a.png", "-s", "8x8"]);
        run.exits(0);
        std::fs::remove_file(scratch.path("a.png")).unwrap();
        assert_eq!(scratch.names(), names);
    }
}

#[test]
fn a_message_shows_the_line_and_where_it_is_wrong() {
    let scratch = Scratch::new();
    scratch.file("a.obj", "v 0 0 0\nv 1 0  zero # no\nf 1 2 9\n");
    let expected = "\
a.obj:2:8: expected a number, found 'zero'
  v 1 0  zero # no
         ^
a.obj:3:7: vertex index 9 is out of range: the file has 2 vertices
  f 1 2 9
        ^
";
    assert_eq!(scratch.rt(&["info", "a.obj"]).exits(1).stderr, expected);
}

#[test]
fn after_ten_errors_it_stops() {
    let scratch = Scratch::new();
    scratch.file("a.obj", "v x\n".repeat(1000));
    let run = scratch.rt(&["render", "a.obj", "-o", "a.png"]).exits(1);
    let places = run.stderr.lines().filter(|line| line.starts_with("a.obj:")).count();
    assert_eq!(places, 10);
    assert_eq!(run.stderr.lines().last(), Some("stopped after 10 errors"));
}

#[test]
fn nff_is_told_in_the_same_way() {
    let scratch = Scratch::new();
    scratch.file("a.nff", "v\nfrom 0 1\n");
    let run = scratch.rt(&["render", "a.nff", "-o", "a.png"]).exits(1);
    let message = "a.nff:2:9: expected 3 numbers after 'from', found 2\n  from 0 1\n";
    assert!(run.stderr.starts_with(message), "{}", run.stderr);
    assert_eq!(scratch.names(), ["a.nff"]);
}

#[test]
fn damaged_files_never_bring_it_down() {
    let scratch = Scratch::with_room();
    let good = scratch.bytes("room.obj");
    let mut seed: u32 = 1;
    let mut random = |below: usize| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as usize % below
    };
    for round in 0..40 {
        let mut bytes = good.clone();
        for _ in 0..=random(4) {
            let at = random(bytes.len());
            match random(4) {
                0 => bytes[at] = random(256) as u8,
                1 => bytes.truncate(at.max(1)),
                2 => bytes[at] = b"0123456789-/.e#\\\n "[random(18)],
                _ => {
                    let piece = bytes[at..].iter().copied().take(random(30)).collect::<Vec<_>>();
                    bytes.splice(at..at, piece);
                }
            }
        }
        scratch.file("bad.obj", &bytes);
        let run = scratch.rt(&["render", "bad.obj", "-o", "a.png", "-s", "8x8", "-j1"]);
        let done = scratch.path("a.png").exists();
        assert!(run.code == i32::from(!done), "round {round}: {} {}", run.code, run.stderr);
        assert!(done || !run.stderr.is_empty(), "round {round}");
        let _ = std::fs::remove_file(scratch.path("a.png"));
    }
}
