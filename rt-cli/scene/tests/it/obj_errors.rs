//! OBJ files that are wrong, and what is said of them.

use std::fmt::Write;

use crate::support::{error, headlines, obj};

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// Line 4 is wrong.
#[track_caller]
fn fourth(line: &str, expected: &str) {
    let text = format!("{CORNERS}{line}\nf 1 2 3\n");
    assert_eq!(error(obj(text)), format!("t.obj:4:{expected}"), "{line:?}");
}

#[test]
fn bad_numbers() {
    fourth("v 1 2", "6: expected 3 numbers after 'v', found 2");
    fourth("v", "2: expected 3 numbers after 'v', found 0");
    fourth("vn 1 2 # 3", "7: expected 3 numbers after 'vn', found 2");
    fourth("vt", "3: expected 1 number after 'vt', found 0");
    fourth("  v  0 x 0", "8: expected a number, found 'x'");
    fourth("v 0 0 1,5", "7: expected a number, found '1,5'");
    fourth("v nan 0 0", "3: expected a finite number, found 'nan'");
    fourth("v 0 -inf 0", "5: expected a finite number, found '-inf'");
    fourth("vn 0 Infinity 0", "6: expected a finite number, found 'Infinity'");
    fourth("v 1e999 0 0", "3: '1e999' is beyond the range of single precision");
    fourth("v 0 0 -3.5e38", "7: '-3.5e38' is beyond the range of single precision");
    fourth("v 0 0 1.#INF", "7: expected a number, found '1.#INF'");
    fourth("vt 0x10 0", "4: expected a number, found '0x10'");
}

#[test]
fn bad_corners() {
    let example = "expected a corner such as 1, 1/2, 1//3 or 1/2/3, found";
    fourth("f 1 two 3", &format!("5: {example} 'two'"));
    fourth("f 1 2.0 3", &format!("5: {example} '2.0'"));
    fourth("f 1 2 /3", &format!("7: {example} '/3'"));
    fourth("f 1/1/1/1 2 3", &format!("3: {example} '1/1/1/1'"));
    fourth("f 1 2 -", &format!("7: {example} '-'"));
    fourth("f 1 2", "6: expected 3 or more corners after 'f', found 2");
    fourth("f", "2: expected 3 or more corners after 'f', found 0");
}

#[test]
fn bad_indices() {
    fourth("f 1 2 0", "7: vertex index 0 is out of range: indices start at 1");
    fourth("f 1 2 4", "7: vertex index 4 is out of range: the file has 3 vertices");
    fourth("f 1 2 -4", "7: vertex index -4 is out of range: only 3 vertices so far");
    fourth(
        "f 1 2 4294967297",
        "7: vertex index 4294967297 is out of range: the file has 3 vertices",
    );
    fourth("f 1 2 99999999999999999999", "7: index '99999999999999999999' is out of range");
    fourth("f 1 2 -99999999999999999999", "7: index '-99999999999999999999' is out of range");
    fourth(
        "f 1 2 9223372036854775807",
        "7: vertex index 9223372036854775807 is out of range: the file has 3 vertices",
    );
    fourth(
        "f 1 2 -9223372036854775808",
        "7: vertex index -9223372036854775808 is out of range: only 3 vertices so far",
    );
    fourth(
        "f 1/1 2/1 3/1",
        "3: texture coordinate index 1 is out of range: the file has 0 texture coordinates",
    );
    fourth("f 1 2 3//-1", "7: normal index -1 is out of range: only 0 normals so far");
}

#[test]
fn an_index_is_held_against_the_whole_file() {
    let text = "f 1 2 3\nf 1 2 5\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 x 0\nf 9 1 2\n";
    let expected = [
        "t.obj:2:7: vertex index 5 is out of range: the file has 4 vertices",
        "t.obj:6:5: expected a number, found 'x'",
        "t.obj:7:3: vertex index 9 is out of range: the file has 4 vertices",
    ];
    assert_eq!(headlines(obj(text)), expected);
}

#[test]
fn places_in_odd_lines() {
    let place = |text: &[u8]| error(obj(text)).split(": ").next().unwrap().to_owned();
    assert_eq!(place(b"\xEF\xBB\xBFv x 0 0"), "t.obj:1:3", "byte order mark");
    assert_eq!(place(b"\r\n\r\nv x 0 0"), "t.obj:3:3", "CR LF");
    assert_eq!(place(b"\r\rv x 0 0"), "t.obj:3:3", "CR");
    assert_eq!(place(b"\n\r\nv x 0 0"), "t.obj:3:3", "mixed");
    assert_eq!(place(b"v 0 \\\n 0 \\\r\n  x"), "t.obj:3:3", "continued");
    assert_eq!(place("v é\u{1F600} 0 0".as_bytes()), "t.obj:1:3", "UTF-8 word");
    assert_eq!(place("v 0\\é 0 x".as_bytes()), "t.obj:1:3");
    assert_eq!(place(b"v 0 0 0 \xE9\nf 1 \xE9 1"), "t.obj:2:5", "Latin-1");
}

#[test]
fn the_line_is_shown_with_a_caret() {
    let text = obj("v 0\t0 0\n\tf 1 1 \u{7}x").unwrap_err().to_string();
    let expected = "t.obj:2:8: expected a corner such as 1, 1/2, 1//3 or 1/2/3, found '.x'\n  \
                    \u{20}f 1 1 .x\n  \u{20}      ^";
    assert_eq!(text, expected);
}

#[test]
fn of_a_long_line_a_part_is_shown() {
    let text = format!("v {} nan{}", "1".repeat(3000), " é".repeat(100_000));
    let text = obj(text).unwrap_err().to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].starts_with("t.obj:1:3: '1111") && lines[0].chars().count() < 120, "{text}");
    assert!(lines[1].starts_with("  v 1111") && lines[1].ends_with('…'), "{text}");
    let text = obj(format!("v 0 0 0\nf {}x", "1 ".repeat(50))).unwrap_err().to_string();
    assert!(text.contains("\n  …1 1 1"), "{text}");
    let text = format!("v 0 0 0\nf {}nan 1 1", "1 ".repeat(3000));
    let text = obj(text).unwrap_err().to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].starts_with("t.obj:2:6003: "), "{text}");
    assert!(lines[1].starts_with("  …1 1") && lines[1].ends_with(" nan 1 1"), "{text}");
    let caret = lines[2].find('^').unwrap();
    let under: String = lines[1].chars().skip(caret).take(3).collect();
    assert_eq!(under, "nan");
}

#[test]
fn ten_errors_and_no_more() {
    let mut text = String::from(CORNERS);
    for _ in 0..20 {
        writeln!(text, "f 1 2 x").unwrap();
    }
    let error = obj(&text).unwrap_err().to_string();
    assert_eq!(error.matches("expected a corner").count(), 10);
    assert!(error.ends_with("\nstopped after 10 errors"), "{error}");
    // Too high an index is known only at the end.
    let text = format!("{CORNERS}{}", "f 7 8 9\n".repeat(20));
    assert_eq!(headlines(obj(&text)).len(), 10);
}

#[test]
fn files_that_are_no_obj() {
    let nothing = "t.obj: no faces: nothing to draw without 'f' statements";
    assert_eq!(error(obj("")), nothing);
    assert_eq!(error(obj("\u{FEFF}")), nothing);
    assert_eq!(error(obj(CORNERS)), nothing);
    assert_eq!(error(obj("solid cube\nfacet normal 0 0 1\n")), nothing);
    assert_eq!(
        error(obj(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR")),
        "t.obj: this is not OBJ text: byte 9 is zero"
    );
    let utf16 = "t.obj: this is UTF-16 text: save it as UTF-8 to have it read as OBJ";
    assert_eq!(error(obj(b"\xFF\xFEv\0 \0")), utf16);
    assert_eq!(error(obj(b"\xFE\xFF\0v\0 ")), utf16);
}
