//! Textures: statements, files, and what is wrong with either.

use std::collections::HashMap;
use std::io;

use glam::Vec2;
use rt_scene::{ColorMap, Scene};

const FACE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0 0\nvt .5\nf 1/1 2/2 3/3\n";

/// Reads an OBJ that uses material `m` of that library, with those other files.
fn with(library: &str, files: &[(&str, Vec<u8>)]) -> Scene {
    with_libraries(&[("m.mtl", library)], files)
}

fn with_libraries(libraries: &[(&str, &str)], files: &[(&str, Vec<u8>)]) -> Scene {
    let mut text = String::new();
    let mut all: HashMap<String, Vec<u8>> = HashMap::new();
    for (name, library) in libraries {
        text += &format!("mtllib {name}\n");
        all.insert((*name).to_owned(), library.as_bytes().to_vec());
    }
    all.extend(files.iter().map(|(name, bytes)| ((*name).to_owned(), bytes.clone())));
    text += &format!("usemtl m\n{FACE}");
    let mut load =
        |name: &str| all.get(name).cloned().ok_or(io::Error::from(io::ErrorKind::NotFound));
    rt_scene::obj::parse(text.as_bytes(), "t.obj", &mut load).expect("a good scene")
}

fn png(width: u32, height: u32, color: png::ColorType, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    drop(writer);
    bytes
}

/// Red, then green below.
fn two() -> Vec<u8> {
    png(1, 2, png::ColorType::Rgb, &[255, 0, 0, 0, 255, 0])
}

/// Eight by eight pixels of one grey, 128 + 40 · 8 / 8: one block whose first coefficient is 40 in steps
/// of 8.
fn jpeg() -> Vec<u8> {
    let mut bytes = vec![0xFF, 0xD8, 0xFF, 0xDB, 0, 67, 0];
    bytes.extend([8; 64]);
    // 8 bits, 8 by 8, one component with table 0.
    bytes.extend([0xFF, 0xC0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0]);
    // Of first coefficients: 0 is for none, 10 for six bits.
    bytes.extend([0xFF, 0xC4, 0, 21, 0x00, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 6]);
    // Of others: 0 is for no more.
    bytes.extend([0xFF, 0xC4, 0, 20, 0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    bytes.extend([0xFF, 0xDA, 0, 8, 1, 1, 0x00, 0, 63, 0]);
    // 10 101000 0, and ones.
    bytes.extend([0b1010_1000, 0b0111_1111, 0xFF, 0xD9]);
    bytes
}

#[test]
fn a_texture_and_its_coordinates() {
    let scene = with("newmtl m\nmap_Kd two.png\n", &[("two.png", two())]);
    assert_eq!(scene.facts.warnings, Vec::<String>::new());
    let texture = &scene.textures[0];
    assert_eq!((texture.width(), texture.height()), (1, 2));
    assert_eq!(texture.pixels(), [[255, 0, 0], [0, 255, 0]]);
    let map = ColorMap { texture: 0, scale: Vec2::ONE, offset: Vec2::ZERO };
    assert_eq!(scene.materials[0].diffuse_map, Some(map));
    assert_eq!(scene.materials[0].diffuse, glam::Vec3::ONE, "a texture is a colour by itself");
    let uvs = scene.mesh.triangles[0].uv.map(|uv| uv.map(|i| scene.mesh.uvs[i as usize]));
    assert_eq!(uvs, Some([Vec2::ZERO, Vec2::X, Vec2::new(0.5, 0.0)]));

    let mut without = scene.clone();
    without.remove_textures();
    assert!(without.textures.is_empty() && without.materials[0].diffuse_map.is_none());
}

#[test]
fn faces_without_coordinates_among_others() {
    let text = format!("vt 9 9\n{FACE}f 1 2 3\nf 1/2 2/1 3\nf 3/-1 2/-2 1/-3\n");
    let mut no_file = |_: &str| Err(io::ErrorKind::NotFound.into());
    let scene = rt_scene::obj::parse(text.as_bytes(), "t.obj", &mut no_file).unwrap();
    let uvs: Vec<_> = scene
        .mesh
        .triangles
        .iter()
        .map(|triangle| triangle.uv.map(|uv| uv.map(|i| scene.mesh.uvs[i as usize].x)))
        .collect();
    assert_eq!(uvs, [Some([9.0, 0.0, 1.0]), None, None, Some([0.5, 1.0, 0.0])]);
}

#[test]
fn names_with_blanks_backslashes_and_folders() {
    for (library, statement, file) in [
        ("m.mtl", "map_Kd a b.png", "a b.png"),
        ("m.mtl", "map_Kd  a  b.png # red", "a  b.png"),
        ("m.mtl", "map_Kd maps\\a.png", "maps/a.png"),
        ("m.mtl", "map_Kd C:\\maps\\a.png", "a.png"),
        ("lib/m.mtl", "map_Kd maps/a.png", "lib/maps/a.png"),
        ("lib\\m.mtl", "map_Kd maps/a.png", "lib/maps/a.png"),
        ("lib/m.mtl", "map_Kd maps/a.png", "maps/a.png"),
        ("m.mtl", "map_Kd -clamp on -mm 0 1 -type sphere a.png", "a.png"),
        ("m.mtl", "map_kd a.png", "a.png"),
    ] {
        let text = format!("newmtl m\n{statement}\n");
        let scene = with_libraries(&[(library, &text)], &[(file, two())]);
        assert_eq!(scene.facts.warnings, Vec::<String>::new(), "{statement}");
        assert_eq!(scene.textures.len(), 1, "{statement}");
    }
}

#[test]
fn scales_and_offsets() {
    for (options, scale, offset) in [
        ("-s 2 3 4 -o .5", Vec2::new(2.0, 3.0), Vec2::splat(0.5)),
        ("-o 1 2 -s 4", Vec2::splat(4.0), Vec2::new(1.0, 2.0)),
        ("-t 1 1 1 -bm 2", Vec2::ONE, Vec2::ZERO),
    ] {
        let library = format!("newmtl m\nmap_Kd {options} a.png\n");
        let scene = with(&library, &[("a.png", two())]);
        let map = scene.materials[0].diffuse_map.expect(options);
        assert_eq!((map.scale, map.offset), (scale, offset), "{options}");
    }
}

#[test]
fn written_textures_come_back() {
    let library = "newmtl m\nKd 0.5 1 1\nmap_Kd -s 2 3 -o .5 .25 a.png\nnewmtl n\nmap_Kd b.jpg\n";
    let face =
        "usemtl n\nf 3/2 2/1 1/3\nf 1 2 3\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf 1//1 2//1 3//1\n";
    let text = format!("mtllib m.mtl\nusemtl m\n{FACE}{face}");
    let read = |text: &[u8], files: &[(&str, &[u8])]| {
        let mut load = |name: &str| {
            let file = files.iter().find(|(file, _)| *file == name);
            file.map(|(_, bytes)| bytes.to_vec()).ok_or(io::Error::from(io::ErrorKind::NotFound))
        };
        rt_scene::obj::parse(text, "t.obj", &mut load).expect("a good scene")
    };
    let files = [("m.mtl", library.as_bytes()), ("a.png", &two()), ("b.jpg", &jpeg())];
    let scene = read(text.as_bytes(), &files);
    assert_eq!((scene.textures.len(), scene.mesh.triangles.len()), (2, 5));

    let names = ["one.png", "the other.png"].map(str::to_owned);
    let (mut obj, mut mtl) = (Vec::new(), Vec::new());
    rt_scene::obj::write(&scene, Some("w.mtl"), &mut obj).unwrap();
    rt_scene::obj::write_library(&scene, &names, &mut mtl).unwrap();
    let pictures = [0, 1].map(|i| scene.textures[i].to_png());
    let again =
        read(&obj, &[("w.mtl", &mtl), ("one.png", &pictures[0]), ("the other.png", &pictures[1])]);
    assert_eq!(again.facts.warnings, Vec::<String>::new());
    assert_eq!(again.textures, scene.textures);
    assert_eq!(again.materials, scene.materials);
    assert_eq!(format!("{:?}", again.mesh), format!("{:?}", scene.mesh));
}

#[test]
fn pictures_of_all_kinds() {
    let rgba = png(1, 1, png::ColorType::Rgba, &[1, 2, 3, 0]);
    let grey = png(1, 1, png::ColorType::Grayscale, &[7]);
    let grey_alpha = png(1, 1, png::ColorType::GrayscaleAlpha, &[7, 0]);
    for (bytes, first) in
        [(rgba, [1, 2, 3]), (grey, [7; 3]), (grey_alpha, [7; 3]), (jpeg(), [168; 3])]
    {
        // The name tells nothing.
        let scene = with("newmtl m\nmap_Kd a.dat\n", &[("a.dat", bytes)]);
        assert_eq!(scene.facts.warnings, Vec::<String>::new());
        assert_eq!(scene.textures[0].pixels()[0], first);
    }
}

#[test]
fn a_texture_is_read_once_and_only_if_used() {
    let mut asked = Vec::new();
    let library = "newmtl a\nmap_Kd x.png\nnewmtl b\nmap_Kd x.png\nnewmtl c\nmap_Kd y.png\n";
    let text = format!("mtllib m.mtl\nusemtl a\n{FACE}usemtl b\nf 1 2 3\n");
    let mut load = |name: &str| {
        asked.push(name.to_owned());
        if name == "m.mtl" { Ok(library.as_bytes().to_vec()) } else { Ok(two()) }
    };
    let scene = rt_scene::obj::parse(text.as_bytes(), "t.obj", &mut load).unwrap();
    assert_eq!(scene.textures.len(), 1);
    assert_eq!(asked, ["m.mtl", "x.png"]);
}

/// What is said of a texture that is there but of no use.
fn refused(bytes: Vec<u8>) -> String {
    let scene = with("newmtl m\nmap_Kd a.png\n", &[("a.png", bytes)]);
    assert!(scene.textures.is_empty() && scene.materials[0].diffuse_map.is_none());
    assert_eq!(scene.facts.warnings, scene.facts.missing);
    let [warning] = &scene.facts.warnings[..] else { panic!("{:?}", scene.facts.warnings) };
    let start = "m.mtl:2:8: cannot read texture 'a.png': ";
    warning.strip_prefix(start).unwrap_or_else(|| panic!("{warning}")).to_owned()
}

#[test]
fn textures_that_are_no_good_are_warnings() {
    let missing = with("newmtl m\n  map_Kd a b.png\n", &[]);
    let expected = "m.mtl:2:10: cannot read texture 'a b.png': entity not found";
    assert_eq!(missing.facts.warnings, [expected]);
    assert_eq!(missing.facts.missing, [expected]);
    let nameless = with("newmtl m\nmap_Kd -s 1 1\n", &[]);
    assert_eq!(nameless.facts.warnings, ["m.mtl:2:14: expected the name of a texture"]);

    assert_eq!(refused(Vec::new()), "neither PNG nor JPEG");
    assert_eq!(refused(b"GIF89a".to_vec()), "neither PNG nor JPEG");
    for bytes in [two(), jpeg()] {
        for cut in [5, 20, 40, bytes.len() / 2] {
            let told = refused(bytes[..cut].to_vec());
            assert!(told.starts_with("not a good ") || told.contains("claims"), "{cut}: {told}");
        }
    }
}

#[test]
fn sizes_are_believed_as_far_as_the_file_can_hold_them() {
    let mut bytes = two();
    // Width and height, and the checksum of their chunk.
    let claim = |bytes: &mut Vec<u8>, width: u32, height: u32| {
        bytes[16..20].copy_from_slice(&width.to_be_bytes());
        bytes[20..24].copy_from_slice(&height.to_be_bytes());
        let crc = crc32(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&crc.to_be_bytes());
    };
    claim(&mut bytes, 30_000, 30_000);
    let told = "the file is too short for the 30000x30000 pixels it claims";
    assert_eq!(refused(bytes.clone()), told);
    claim(&mut bytes, 70_000, 1);
    assert_eq!(refused(bytes.clone()), "a picture of 70000x1 pixels: sides go from 1 to 32768");
    claim(&mut bytes, 100, 1);
    assert!(refused(bytes).starts_with("not a good PNG"));

    let mut bytes = jpeg();
    let size = bytes.windows(2).position(|two| two == [0xFF, 0xC0]).unwrap() + 5;
    bytes[size..size + 4].copy_from_slice(&[0x70, 0, 0x70, 0]);
    let told = "the file is too short for the 28672x28672 pixels it claims";
    assert_eq!(refused(bytes), told);
}

/// Of a colour and a third: sums and all else are as they should be.
#[test]
fn a_palette_that_ends_within_a_colour_is_refused() {
    let parts: [&[u8]; 3] = [
        b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x03\x00\x00\x00(\xcb4\xbb",
        b"\x00\x00\x00\x04PLTE\x01\x02\x03\x04#\xdb\x8a\xab",
        b"\x00\x00\x00\nIDATx\x9cc`\x00\x00\x00\x02\x00\x01H\xaf\xa4q",
    ];
    let told = refused(parts.concat());
    assert_eq!(told, "not a good PNG: its palette ends within a colour");
}

fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = !0_u32;
    for &byte in bytes {
        crc ^= u32::from(byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg());
        }
    }
    !crc
}

#[test]
fn missing_textures_without_end_are_told_ten_times() {
    let mut library = String::new();
    let mut text = String::from("mtllib m.mtl\n");
    text += FACE;
    for n in 0..2000 {
        library += &format!("newmtl {n}\nmap_Kd {n}.png\n");
        text += &format!("usemtl {n}\nf 1 2 3\n");
    }
    let mut tried = 0;
    let mut load = |name: &str| {
        if name == "m.mtl" {
            return Ok(library.clone().into_bytes());
        }
        tried += 1;
        Err(io::ErrorKind::NotFound.into())
    };
    let scene = rt_scene::obj::parse(text.as_bytes(), "t.obj", &mut load).unwrap();
    assert_eq!(tried, 1024);
    assert_eq!(scene.facts.missing.len(), 10);
    let warnings = &scene.facts.warnings;
    assert_eq!(warnings.len(), 12);
    assert_eq!(warnings[10], "more than 1024 textures: the rest is not read");
    assert_eq!(warnings[11], "t.obj: 1014 more textures cannot be read");
}

/// A million random changes would find no more than these, in a test's time.
#[test]
fn broken_pictures_neither_panic_nor_hang() {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize
    };
    for original in [two(), jpeg()] {
        for _ in 0..2000 {
            let mut bytes = original.clone();
            for _ in 0..1 + random() % 3 {
                let at = 2 + random() % (bytes.len() - 2);
                bytes[at] = random() as u8;
            }
            with("newmtl m\nmap_Kd a.png\n", &[("a.png", bytes)]);
        }
    }
}
