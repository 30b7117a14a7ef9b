//! Malformed AFF files, material libraries and pictures: a message with its place and exit code 1, or
//! a warning where that is enough; and nothing left behind.

use crate::support::{Scratch, TRIANGLE};

/// Files that are no AFF, and what is said of them after their name.
fn bad_aff() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    vec![
        ("empty", b"".into(), " nothing to draw"),
        ("comments", b"# nothing\n% at all".into(), " nothing to draw"),
        ("zeros", vec![0; 100], " this is not AFF text: byte 1 is zero"),
        ("utf_16", b"\xFF\xFEs\0 \x000\0".into(), " this is UTF-16 text"),
        ("an_obj", TRIANGLE.into(), "1:1: expected 'from' after 'v'"),
        ("short", b"s 0 0 0\n".into(), "1:8: expected 4 numbers after 's', found 3"),
        ("nan", b"s 0 0 nan1 1\n".into(), "1:7: expected a number, found 'nan1'"),
        ("huge", b"s 0 0 1e39 1\n".into(), "1:7: '1e39' is beyond the range"),
        ("open", b"x a {\ns 0 0 0 1\n".into(), "1:1: this block has no end"),
        ("closed", b"s 0 0 0 1\n}\n".into(), "2:1: expected a statement of AFF, found '}'"),
        ("no_block", b"xs 1 1 1 0 0 1 0 0 0 0\ns 0 0 0 1".into(), "2:1: expected '{', found 's'"),
        (
            "deep",
            "xs 1 1 1 0 1 0 0 0 0 0 {\n".repeat(20_000).into(),
            "65:1: files and blocks are within each other more than 64 times",
        ),
        ("claims", b"p 4000000000 0 0 0".into(), "1:19: expected 3 numbers after 'p', found 0"),
        (
            "claims_more",
            b"m vertices 18446744073709551615\n0 0 0".into(),
            "2:6: expected 3 numbers after 'vertices', found 0",
        ),
        (
            "beyond",
            b"m vertices 3 0 0 0 1 0 0 0 1 0\ntriangles 1 0 1 3".into(),
            "2:17: expected a vertex index of 0 to 2, found '3'",
        ),
        ("no_file", b"i 0 no.aff\n".into(), "1:5: cannot read 'no.aff': No such file or directory"),
        ("a_folder", b"i 0 .\n".into(), "1:5: cannot read '.': it is a directory"),
        ("endless", b"i 0 /dev/zero\n".into(), "1:5: cannot read '/dev/zero': "),
        ("keys", b"k a { transl 2".into(), "1:14: expected 4 or more keys after 'transl'"),
        (
            "cut_keys",
            b"k a { rot 4 0 1 0 0".into(),
            "1:20: expected 8 numbers after 'rot', found 4",
        ),
    ]
}

/// Material libraries that are broken, and what of the warning follows the library's name.
fn bad_mtl() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    vec![
        ("zeros", vec![0; 50], ": this is not MTL text: byte 1 is zero"),
        ("utf_16", b"\xFF\xFEn\0".into(), ": this is UTF-16 text"),
        ("short", b"newmtl a\nKd 1 2\n".into(), ":2:7: expected 3 numbers after 'Kd', found 2"),
        ("word", b"newmtl a\nKd 1 red 1\n".into(), ":2:6: expected a number, found 'red'"),
        ("nan", b"newmtl a\nNs nan\n".into(), ":2:4: expected a finite number, found 'nan'"),
        ("negative", b"newmtl a\nKs -1 0 0\n".into(), ":2:4: expected a number of at least 0"),
        ("huge", b"newmtl a\nNi 1e99\n".into(), ":2:4: '1e99' is beyond the range"),
        ("none", b"newmtl a\nd\n".into(), ":2:2: expected 1 number after 'd', found 0"),
        ("model", b"newmtl a\nillum many\n".into(), ":2:7: expected an illumination model"),
    ]
}

/// Files that are no pictures, and what is said of them.
fn bad_pictures() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let png = |rest: &[u8]| [b"\x89PNG\r\n\x1A\n", rest].concat();
    let exr = |rest: &[u8]| [&[0x76, 0x2F, 0x31, 0x01][..], rest].concat();
    vec![
        ("empty.png", vec![], "this is no PNG, PFM or OpenEXR file"),
        ("text.png", b"hello".into(), "this is no PNG, PFM or OpenEXR file"),
        ("jpeg.png", b"\xFF\xD8\xFF\xE0\0\x10JFIF".into(), "this is no PNG, PFM or OpenEXR file"),
        ("head.png", png(b""), "PNG at byte 8: "),
        (
            "claims.png",
            png(b"\0\0\0\rIHDR\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x08\x02\0\0\0"),
            "PNG at byte ",
        ),
        ("noise.png", png(&[0xA5; 500]), "PNG at byte 508: "),
        ("head.pfm", b"PF".into(), "PFM at byte 2: expected 1 more bytes, found 0"),
        ("word.pfm", b"PF\nten 10\n-1\n".into(), "PFM at byte 7: expected a width, found 'ten'"),
        ("none.pfm", b"PF\n0 0\n-1\n".into(), "PFM at byte 0: a picture of 0x0 pixels is not read"),
        (
            "claims.pfm",
            b"PF\n10000 10000\n-1\n1234".into(),
            "PFM at byte 0: 10000x10000 pixels do not fit into a file of 22 bytes",
        ),
        (
            "long.pfm",
            b"Pf\n1 1\n-1\n12345".into(),
            "PFM at byte 14: expected the end of the file, found 1 more bytes",
        ),
        ("head.exr", exr(b""), "OpenEXR at byte 4: expected 4 more bytes, found 0"),
        ("version.exr", exr(b"\x01\0\0\0"), "OpenEXR: version 1 is not read"),
        ("tiles.exr", exr(b"\x02\x02\0\0"), "OpenEXR: a picture in tiles is not read"),
        ("bare.exr", exr(b"\x02\0\0\0\0"), "OpenEXR at byte 0: it has no dataWindow"),
        (
            "cut.exr",
            exr(b"\x02\0\0\0channels\0chlist\0\xFF\xFF\xFF\x7F"),
            "OpenEXR at byte 28: expected 2147483647 more bytes, found 0",
        ),
        (
            "name.exr",
            exr(&[&b"\x02\0\0\0"[..], &[b'a'; 999]].concat()),
            "OpenEXR at byte 8: expected a name of up to 255 bytes",
        ),
    ]
}

#[test]
fn bad_aff_is_told_with_its_place_and_leaves_nothing() {
    let scratch = Scratch::new();
    scratch.file("old.png", "precious");
    for (name, content, message) in bad_aff() {
        let name = format!("{name}.aff");
        scratch.file(&name, content);
        let names = scratch.names();
        for args in [
            &["info", &name, "--json"][..],
            &["render", &name, "-o", "old.png"],
            &["render", &name, "-o", "new.png", "--resume"],
            &["convert", &name, "-o", "new.obj"],
        ] {
            let run = scratch.rt(args).exits(1);
            assert!(run.stderr.starts_with(&format!("{name}:{message}")), "{}", run.stderr);
            assert!(run.stderr.len() < 1000 && run.stdout.is_empty(), "{}", run.stderr);
            assert_eq!(scratch.names(), names);
        }
        assert_eq!(scratch.bytes("old.png"), b"precious");
    }
}

#[test]
fn a_bad_library_is_a_warning_with_its_place() {
    let scratch = Scratch::new();
    for (name, content, message) in bad_mtl() {
        scratch.file("a.obj", format!("mtllib {name}.mtl\nusemtl a\n{TRIANGLE}"));
        scratch.file(&format!("{name}.mtl"), content);
        let run = scratch.rt(&["render", "a.obj", "-o", "a.png", "-s", "8x8"]).exits(0);
        let warning = format!("warning: {name}.mtl{message}");
        assert!(run.stderr.contains(&warning), "{warning} in\n{}", run.stderr);
        // It is there and was read: that is not what --strict is for.
        scratch.rt(&["render", "a.obj", "-o", "a.png", "-s", "8x8", "--strict"]).exits(0);
    }
}

#[test]
fn bad_pictures_are_told() {
    let scratch = Scratch::new();
    scratch.file("good.pfm", b"Pf\n1 1\n-1\n1234");
    for (name, content, message) in bad_pictures() {
        scratch.file(name, content);
        let names = scratch.names();
        for args in [["compare", name, "good.pfm"], ["compare", "good.pfm", name]] {
            let run = scratch.rt(&[&args[..], &["-o", "new.png"]].concat()).exits(1);
            assert!(run.stderr.starts_with(&format!("error: {name}: {message}")), "{}", run.stderr);
            assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
            assert!(run.stdout.is_empty());
            assert_eq!(scratch.names(), names);
        }
    }
}

#[test]
fn there_are_enough_of_them() {
    assert!(bad_aff().len() + bad_mtl().len() + bad_pictures().len() >= 40);
}
