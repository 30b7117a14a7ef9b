//! The files of pictures: by extension, whole, and the same numbers in all of them.

use crate::support::{Picture, Scratch};

const SMALL: [&str; 4] = ["render", "room.obj", "-s", "40x30"];

#[track_caller]
fn render(scratch: &Scratch, output: &str, flags: &[&str]) -> Vec<u8> {
    scratch.rt(&[&SMALL[..], &["-q", "-o", output], flags].concat()).exits(0);
    scratch.bytes(output)
}

/// The numbers of a PFM, in the order of a picture.
#[track_caller]
fn floats(file: &[u8]) -> Vec<f32> {
    let data = file.strip_prefix(b"PF\n40 30\n-1.0\n").expect("the header of a PFM");
    let rows = data.rchunks(40 * 12);
    rows.flat_map(|row| row.chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())))
        .collect()
}

/// The codes of a PNG with 16 bits.
#[track_caller]
fn sixteen(file: &[u8]) -> Vec<u16> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut bytes).unwrap();
    assert_eq!(frame.bit_depth, png::BitDepth::Sixteen);
    bytes.chunks(2).map(|two| u16::from_be_bytes([two[0], two[1]])).collect()
}

#[test]
fn every_format_has_the_same_picture() {
    let scratch = Scratch::with_room();
    let light = ["--light", "-1,2.5,1.5,3,2,1"];
    let pfm = render(&scratch, "a.pfm", &light);
    let linear = floats(&pfm);
    assert!(linear.iter().any(|&x| x > 1.0), "not cut off at white");
    let srgb = |x: f32| {
        let x = f64::from(x.clamp(0.0, 1.0));
        if x <= 0.0031308 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
    };
    let eight = Picture::decode(&render(&scratch, "a.png", &light));
    for (&code, &x) in eight.pixels.iter().zip(&linear) {
        assert!((f64::from(code) - 255.0 * srgb(x)).abs() < 0.501, "{code} {x}");
    }
    for (&code, &x) in
        sixteen(&render(&scratch, "b.PNG", &[&light[..], &["--bits", "16"]].concat()))
            .iter()
            .zip(&linear)
    {
        assert!((f64::from(code) - 65535.0 * srgb(x)).abs() < 0.51, "{code} {x}");
    }
    let exr = render(&scratch, "a.exr", &light);
    assert!(exr.starts_with(&[0x76, 0x2F, 0x31, 0x01]));
    for (one, other) in [("a.pfm", "a.exr"), ("a.exr", "a.pfm")] {
        let run = scratch.rt(&["compare", one, other, "--json"]).exits(0).json();
        assert_eq!((&run["scale"], &run["identical"]), (&"linear".into(), &true.into()));
    }
    let run = scratch.rt(&["compare", "a.exr", "a.png", "--max-difference", "0.00197"]).exits(0);
    assert!(run.text().contains("sRGB"));
    scratch.rt(&["compare", "a.exr", "b.PNG", "--max-difference", "0.0000077"]).exits(0);
    assert_eq!(
        render(&scratch, "c.png", &[&light[..], &["--bits", "8"]].concat()),
        scratch.bytes("a.png")
    );
}

#[test]
fn sixteen_bits_go_with_the_same_text() {
    let scratch = Scratch::with_room();
    let file = render(&scratch, "a.png", &["--bits", "16"]);
    let reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap();
    let keys: Vec<_> = reader.info().utf8_text.iter().map(|chunk| &*chunk.keyword).collect();
    assert_eq!(keys, ["Software", "Scene", "Size", "View"]);
}

#[test]
fn bits_are_for_png() {
    let scratch = Scratch::with_room();
    for output in ["a.pfm", "a.exr"] {
        let run = scratch.rt(&[&SMALL[..], &["-o", output, "--bits", "16"]].concat()).exits(2);
        let message = format!("error: --bits is for PNG: {output} gets 32 bits a channel\n");
        assert!(run.stderr.starts_with(&message), "{}", run.stderr);
    }
    scratch.rt(&[&SMALL[..], &["-o", "a.png", "--bits", "12"]].concat()).exits(2);
    assert_eq!(scratch.names(), ["room.mtl", "room.obj"]);
}

#[test]
fn unknown_extensions_are_told() {
    let scratch = Scratch::with_room();
    let run = scratch.rt(&[&SMALL[..], &["-o", "a.jpg"]].concat()).exits(1);
    let message = "error: cannot write a.jpg: give it the extension .png, .pfm or .exr\n";
    assert_eq!(run.stderr, message);
}

/// Wherever it lies on the grid of tiles.
#[test]
fn a_crop_is_a_piece_of_the_whole() {
    let scratch = Scratch::with_room();
    let args = ["render", "room.obj", "-q", "-s", "100x70", "--light", "-1,2.5,1.5", "-o"];
    scratch.rt(&[&args[..], &["whole.png"]].concat()).exits(0);
    let whole = Picture::open(&scratch.path("whole.png"));
    for [left, top, width, height] in
        [[0, 0, 100, 70], [33, 20, 40, 31], [99, 69, 1, 1], [0, 64, 5, 6], [31, 31, 2, 2]]
    {
        let crop = format!("{left},{top},{width},{height}");
        scratch.rt(&[&args[..], &["part.png", "--crop", &crop]].concat()).exits(0);
        let part = Picture::open(&scratch.path("part.png"));
        assert_eq!(part.size, (width, height));
        assert_eq!((&*part.text["Size"], &*part.text["Crop"]), ("100x70", &*crop));
        for y in 0..height {
            for x in 0..width {
                assert_eq!(part.pixel(x, y), whole.pixel(left + x, top + y), "{crop} {x},{y}");
            }
        }
    }
    assert!(!whole.text.contains_key("Crop"));
    let stats = [&args[..], &["a.png", "--crop", "3,4,5,6", "--stats-json", "-"]].concat();
    let stats = scratch.rt(&stats).exits(0).json();
    assert_eq!(stats["crop"].to_string(), "[3,4,5,6]");
    assert_eq!((&stats["width"], &stats["rays"]["primary"]), (&100.into(), &30.into()));
    let line = scratch.rt(&["render", "room.obj", "-s", "9x9", "--crop", "1,1,2,3", "-o", "a.png"]);
    assert!(line.exits(0).stderr.contains("a.png: 2x3 of 9x9, 7 triangles"));
}

#[test]
fn a_crop_beyond_the_picture_is_refused() {
    let scratch = Scratch::with_room();
    for crop in ["0,0,41,30", "0,0,40,31", "40,0,1,1", "0,30,1,1", "4294967295,0,4294967295,1"] {
        let run = scratch.rt(&[&SMALL[..], &["-o", "a.png", "--crop", crop]].concat()).exits(1);
        assert!(run.stderr.contains("is not within the picture of 40x30"), "{}", run.stderr);
    }
    for crop in ["0,0,0,1", "1,2,3", "-1,0,2,2", "a,b,c,d"] {
        scratch.rt(&[&SMALL[..], &["-o", "a.png", "--crop", crop]].concat()).exits(2);
    }
    assert_eq!(scratch.names(), ["room.mtl", "room.obj"]);
}
