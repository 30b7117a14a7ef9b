//! Malformed and odd NFF files: a message with its place and exit code 1, or what is in them.

use crate::support::Scratch;

const VIEW: &str = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 40\nhither 0.1\nresolution 8 8\n";

/// Files that are no NFF, and what is said of them after their name.
fn bad() -> Vec<(&'static str, Vec<u8>, String)> {
    let view = |from: &str, to: &str| VIEW.replace(from, to).into_bytes();
    let say = |message: &str| message.to_owned();
    vec![
        ("empty", vec![], say(" nothing to draw")),
        ("comment", b"# a scene\n".into(), say(" nothing to draw")),
        ("only_a_view", VIEW.into(), say(" nothing to draw")),
        ("zeros", vec![0; 1000], say(" this is not NFF text: byte 1 is zero")),
        ("utf_16", b"\xFF\xFEs\0 \x000\0".into(), say(" this is UTF-16 text")),
        ("an_obj", b"o thing\nv 0 0 0\n".into(), say("1:1: expected a statement")),
        ("short_sphere", b"s 0 0 0\n".into(), say("1:8: expected 4 numbers after 's', found 3")),
        ("long_sphere", b"s 0 0 0 1 2\n".into(), say("1:11: expected a statement")),
        (
            "short_cone",
            b"c 0 0 0 1\n0 1 0\n".into(),
            say("2:6: expected 8 numbers after 'c', found 7"),
        ),
        ("nan", b"s 0 0 nan 1\n".into(), say("1:7: expected a finite number, found 'nan'")),
        ("huge", b"s 0 0 1e39 1\n".into(), say("1:7: '1e39' is beyond the range")),
        ("wide_sphere", b"s 0 0 3e38 3e38\n".into(), say("1:1: the sphere reaches beyond")),
        ("wide_cone", b"c 0 0 0 3e38 3e38 1 1 1\n".into(), say("1:1: the cone reaches beyond")),
        ("two_corners", b"p 2\n0 0 0\n1 1 1\n".into(), say("1:3: expected 3 or more vertices")),
        ("no_count", b"p\n".into(), say("1:2: expected 3 or more vertices")),
        ("negative_count", b"pp -3\n".into(), say("1:4: expected 3 or more vertices")),
        ("claims_much", b"p 4000000000\n0 0 0\n".into(), say("2:6: expected 3 numbers after 'p'")),
        (
            "no_normals",
            b"pp 3\n0 0 0\n1 0 0\n0 1 0\n".into(),
            say("4:6: expected 3 numbers after 'pp', found 0"),
        ),
        (
            "short_fill",
            b"f 1 1 1 1 0 5 0\ns 0 0 0 1\n".into(),
            say("1:16: expected 8 numbers after 'f', found 7"),
        ),
        (
            "short_light",
            b"l 1 2\ns 0 0 0 1\n".into(),
            say("1:6: expected 3 numbers after 'l', found 2"),
        ),
        (
            "half_a_color",
            b"l 1 2 3 1\ns 0 0 0 1\n".into(),
            say("1:10: expected 3 numbers after 'l x y z', found 1"),
        ),
        ("no_eye", view("from 0 0 5\n", ""), say("1:1: expected 'from' after 'v'")),
        (
            "eye_at_target",
            view("from 0 0 5", "from 0 0 0"),
            say("1:1: 'from' and 'at' are the same"),
        ),
        ("up_is_ahead", view("up 0 1 0", "up 0 0 2"), say("1:1: 'up' is along the line of sight")),
        (
            "flat_angle",
            view("angle 40", "angle 180"),
            say("5:7: expected an angle between 0 and 180"),
        ),
        ("no_pixels", view("resolution 8 8", "resolution 8 0"), say("7:14: expected a resolution")),
        (
            "too_many_pixels",
            view("resolution 8 8", "resolution 99999 8"),
            say("7:12: expected a resolution"),
        ),
    ]
}

/// Files that are odd, and what is in them.
fn odd() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let sphere = r#"{"sphere":1}"#;
    let after_view = |text: &str| format!("{VIEW}{text}").into_bytes();
    vec![
        ("one_line", after_view("s 0 0 0 1").replace_line_ends(b' '), sphere),
        ("cr", after_view("s 0 0 0 1\n").replace_line_ends(b'\r'), sphere),
        ("bom", [b"\xEF\xBB\xBF", &after_view("s 0 0 0 1")[..]].concat(), sphere),
        ("commented", after_view("# ball\ns 0 0 0 1 # of radius 1"), sphere),
        ("background_first", [b"b 0 0 1\n", &after_view("s 0 0 0 1")[..]].concat(), sphere),
        ("no_view", b"s 1 2 3 4\n".into(), sphere),
        ("two_views", [VIEW.as_bytes(), &after_view("s 0 0 0 1")].concat(), sphere),
        ("no_hither", VIEW.replace("hither 0.1\n", "").into_bytes().and(b"s 0 0 0 1"), sphere),
        ("hither_zero", VIEW.replace("0.1", "0").into_bytes().and(b"s 0 0 0 1"), sphere),
        ("cone_on_three_lines", after_view("c\n0 -1 0 1\n0 1 0 0\n"), r#"{"cone":1}"#),
        ("cone_on_one_line", after_view("c 0 -1 0 1 0 1 0 1\n"), r#"{"cylinder":1}"#),
        (
            "inside_out",
            after_view("s 0 0 0 -1\nc 0 -1 0 -1 0 1 0 -1\n"),
            r#"{"cylinder":1,"sphere":1}"#,
        ),
        ("without_radius", after_view("s 0 0 0 0\ns 0 0 0 1\n"), r#"{"sphere":2}"#),
        ("without_highlight", after_view("f 1 1 1 1 0 100000 0 0\ns 0 0 0 1\n"), sphere),
        ("glass", after_view("f 1 1 1 0 0 1 0.9 1.5\ns 0 0 0 1\n"), sphere),
        ("concave", after_view("p 5 0 0 0 2 0 0 2 2 0 1 0.5 0 0 2 0\n"), r#"{"polygon":1}"#),
        (
            "without_area",
            after_view("p 3 0 0 0 1 0 0 2 0 0\ns 0 0 0 1\n"),
            r#"{"polygon":1,"sphere":1}"#,
        ),
        (
            "flat_normals",
            after_view("pp 3 0 0 0 0 0 0 1 0 0 0 0 0 0 1 0 0 0 0\n"),
            r#"{"patch":1}"#,
        ),
    ]
}

trait Bytes {
    fn replace_line_ends(self, byte: u8) -> Vec<u8>;
    fn and(self, more: &[u8]) -> Vec<u8>;
}

impl Bytes for Vec<u8> {
    fn replace_line_ends(mut self, byte: u8) -> Vec<u8> {
        self.iter_mut().filter(|found| **found == b'\n').for_each(|found| *found = byte);
        self
    }

    fn and(self, more: &[u8]) -> Vec<u8> {
        [&self, more].concat()
    }
}

#[test]
fn bad_files_fail_with_their_place_and_leave_nothing() {
    let scratch = Scratch::new();
    for (name, content, message) in bad() {
        let name = format!("{name}.nff");
        scratch.file(&name, content);
        let names = scratch.names();
        let run = scratch.rt(&["render", &name, "-o", "a.png"]).exits(1);
        let expected = format!("{name}:{message}");
        let told = run
            .stderr
            .lines()
            .any(|line| line.strip_prefix("error: ").unwrap_or(line).starts_with(&expected));
        assert!(told, "no {expected:?} in {:?}", run.stderr);
        assert!(run.stdout.is_empty());
        assert_eq!(scratch.names(), names, "{name}");
    }
    assert!(bad().len() >= 15);
}

#[test]
fn odd_files_have_their_primitives_and_a_picture() {
    let scratch = Scratch::new();
    for (name, content, primitives) in odd() {
        let name = format!("{name}.nff");
        scratch.file(&name, content);
        let info = scratch.rt(&["info", &name, "--json"]).exits(0).json();
        assert_eq!(info["primitives"].to_string(), primitives, "{name}");
        scratch.png(&[&name, "-s", "8x8"]);
    }
}
