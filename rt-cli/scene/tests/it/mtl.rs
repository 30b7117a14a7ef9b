//! Material libraries.

use std::io;

use glam::Vec3;
use rt_scene::{Material, Scene};

const FACE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Reads an OBJ beside some libraries.
fn with(obj: impl AsRef<[u8]>, libraries: &[(&str, &[u8])]) -> Scene {
    let mut load = |name: &str| {
        let found = libraries.iter().find(|(known, _)| *known == name);
        found.map(|(_, text)| text.to_vec()).ok_or(io::ErrorKind::NotFound.into())
    };
    rt_scene::obj::parse(obj.as_ref(), "t.obj", &mut load).unwrap()
}

/// The material `m` of a library, and the warnings.
fn material(library: impl AsRef<[u8]>) -> (Material, Vec<String>) {
    let text = format!("mtllib m.mtl\nusemtl m\n{FACE}");
    let mut scene = with(text, &[("m.mtl", library.as_ref())]);
    (scene.materials.remove(0), scene.facts.warnings)
}

#[test]
fn everything_that_is_understood() {
    let text = "newmtl m # comment\n Ka 1 1 1 # x\n\tKd .1 .2 .3 # red\r\nKs 0.5 0.6 \\\n 0.7\r\
                Ke 17 12 4\nNs 10.5\nNi 1.5\nd 0.5\nillum 5\n";
    let expected = Material {
        name: "m".into(),
        // Half of it is there.
        diffuse: Vec3::new(0.05, 0.1, 0.15),
        diffuse_map: None,
        specular: Vec3::new(0.5, 0.6, 0.7),
        shininess: 10.5,
        mirror: Vec3::new(0.5, 0.6, 0.7),
        transmission: Vec3::splat(0.5),
        ior: 1.5,
        fresnel: true,
        emission: Vec3::new(17.0, 12.0, 4.0),
        one_sided: false,
    };
    assert_eq!(material(format!("\u{FEFF}{text}")), (expected, vec![]));
}

#[test]
fn which_models_of_illumination_mirror() {
    for illum in 0..=10 {
        let (material, _) = material(format!("newmtl m\nKs 1 1 1\nillum {illum}"));
        let mirrors = [3, 4, 5, 6, 7, 8, 9].contains(&illum);
        assert_eq!(material.mirror, Vec3::splat(if mirrors { 1.0 } else { 0.0 }), "{illum}");
    }
}

#[test]
fn what_is_transparent() {
    for (lines, transmission) in [
        ("d 1", 0.0),
        ("d 0.25", 0.75),
        ("d -halo 0.25", 0.75),
        ("d 4", 0.0),
        ("Tr 0.25", 0.25),
        ("Tr 7", 1.0),
        ("Tr -1", 0.0),
        ("d 1\nTr 1", 0.0),
        ("Tr 1\nd 1", 0.0),
        ("d 1\nnewmtl m\nTr 1", 1.0),
    ] {
        let (material, _) = material(format!("newmtl m\n{lines}"));
        assert_eq!(material.transmission, Vec3::splat(transmission), "{lines}");
    }
    assert_eq!(material("newmtl m\nNi 0").0.ior, 1.0);
}

#[test]
fn what_refracts_and_what_depends_on_the_angle() {
    for (lines, transmission, ior, fresnel) in [
        // Refraction without dissolving: what highlights leave.
        ("Ks .25 .25 .25\nNi 1.5\nillum 6", Vec3::splat(0.75), 1.5, false),
        ("Ks .25 .25 .25\nNi 1.5\nillum 7", Vec3::splat(0.75), 1.5, true),
        ("Tf 1 .5 .25\nNi 1.5\nillum 7", Vec3::new(1.0, 0.5, 0.25), 1.5, true),
        ("Tf .5\nd .5\nNi 1.5\nillum 7", Vec3::splat(0.25), 1.5, true),
        ("Tf spectral glass.rfl\nd .5", Vec3::splat(0.5), 1.0, false),
        ("d .5\nNi 1.5\nillum 9", Vec3::splat(0.5), 1.5, false),
        ("d .5\nNi 1.5", Vec3::splat(0.5), 1.5, false),
        // Paper, not glass.
        ("d .5\nNi 1.5\nillum 2", Vec3::splat(0.5), 1.0, false),
        ("Ks 1 1 1\nillum 5", Vec3::ZERO, 1.0, true),
    ] {
        let (material, warnings) = material(format!("newmtl m\n{lines}"));
        let got = (material.transmission, material.ior, material.fresnel);
        assert_eq!(got, (transmission, ior, fresnel), "{lines}");
        assert_eq!(warnings, Vec::<String>::new(), "{lines}");
    }
    let (_, warnings) = material("newmtl m\nTf 1 x 1\nTf 1 2");
    let expected = [
        "m.mtl:2:6: expected a number, found 'x'",
        "m.mtl:3:7: expected 3 numbers after 'Tf', found 2",
    ];
    assert_eq!(warnings, expected);
}

#[test]
fn broken_lines_are_left_out() {
    for (line, warning) in [
        ("Kd 1 nan 0", "6: expected a finite number, found 'nan'"),
        ("Kd 1 1e99 0", "6: '1e99' is beyond the range of single precision"),
        ("Ks 1 2", "7: expected 3 numbers after 'Ks', found 2"),
        ("Ke", "3: expected 3 numbers after 'Ke', found 0"),
        ("Kd spectral x.rfl", "4: expected a number, found 'spectral'"),
        ("Kd 0 0 -1", "8: expected a number of at least 0, found '-1'"),
        ("Ns", "3: expected 1 number after 'Ns', found 0"),
        ("d", "2: expected 1 number after 'd', found 0"),
        ("d -halo", "8: expected 1 number after 'd', found 0"),
        ("Tr", "3: expected 1 number after 'Tr', found 0"),
        ("Tr full", "4: expected a number, found 'full'"),
        ("Ni -1", "4: expected a number of at least 0, found '-1'"),
        ("illum many", "7: expected an illumination model of 0 to 10, found 'many'"),
        ("newmtl", "7: expected a name after 'newmtl'"),
    ] {
        let (material, warnings) = material(format!("newmtl m\n{line}\nKe 1 2 3"));
        assert_eq!(warnings, [format!("m.mtl:2:{warning}")]);
        let expected = Material {
            name: "m".into(),
            emission: Vec3::new(1.0, 2.0, 3.0),
            ..Material::default()
        };
        assert_eq!(material, expected, "{line}");
    }
    assert_eq!(material("newmtl m\nKd 0.5").0.diffuse, Vec3::splat(0.5), "one number is a grey");
    let (_, warnings) = material(format!("newmtl m\n{}", "Kd x\n".repeat(20)));
    assert_eq!(warnings.len(), 11);
    assert_eq!(warnings[10], "m.mtl: 10 more lines left out");
}

#[test]
fn libraries_that_are_not_text() {
    let default = Material::default();
    let unknown = "t.obj:2:8: no material 'm': the default is used";
    let (found, warnings) = material(b"newmtl m\0");
    assert_eq!(warnings, ["m.mtl: this is not MTL text: byte 9 is zero", unknown]);
    assert_eq!(found, default);
    let (found, warnings) = material(b"\xFF\xFEn\0");
    let utf16 = "m.mtl: this is UTF-16 text: save it as UTF-8 to have it read as MTL";
    assert_eq!(warnings, [utf16, unknown]);
    assert_eq!(found, default);
}

#[test]
fn textures_that_are_not_drawn_are_told_once() {
    let (_, warnings) = material("newmtl m\nmap_Ks a b.png\nmap_Ks a b.png\n");
    assert_eq!(warnings, ["m.mtl:2:1: map_Ks a b.png: no textures but map_Kd are drawn"]);
    let mut text = String::from("newmtl m\n  bump -bm 1 n.png # bumps\n");
    text.extend((0..30).map(|n| format!("map_Ks {n}.png\nKd {n} 0 0\n")));
    let (material, warnings) = material(text);
    let expected = "m.mtl:2:3: bump -bm 1 n.png and 30 others: no textures but map_Kd are drawn";
    assert_eq!(warnings, [expected]);
    assert_eq!(material.diffuse.x, 29.0, "the library is read to its end");
}

#[test]
fn libraries_without_end_are_not_all_tried() {
    let names: String = (0..100_000).map(|n| format!("mtllib {n}.mtl\n")).collect();
    let scene = with(names + FACE, &[]);
    assert_eq!(scene.facts.warnings.len(), 65);
    let last = "more than 64 material libraries: the rest is not read";
    assert_eq!(scene.facts.warnings[64], last);
}

#[test]
fn a_missing_library_is_a_warning() {
    let scene = with(format!("mtllib a.mtl\nusemtl x\n{FACE}"), &[]);
    let expected = [
        "t.obj:1:8: cannot read material library 'a.mtl': entity not found",
        "t.obj:2:8: no material 'x': the default is used",
    ];
    assert_eq!(scene.facts.warnings, expected);
    assert_eq!(scene.materials, [Material::default()]);
}

#[test]
fn several_libraries_and_names_with_blanks() {
    let a: &[u8] = b"newmtl one\nKd 1 0 0\n";
    let b: &[u8] = b"newmtl two words\nKd 0 1 0\n";
    let faces = format!("usemtl one\n{FACE}usemtl  two words \nf 1 2 3\nusemtl one\nf 3 2 1\n");
    for (line, libraries) in [
        ("mtllib a.mtl\nmtllib b.mtl", [("a.mtl", a), ("b.mtl", b)]),
        ("mtllib a.mtl b.mtl", [("a.mtl", a), ("b.mtl", b)]),
        ("mtllib a b.mtl\tb c.MTL", [("a b.mtl", a), ("b c.MTL", b)]),
        ("mtllib a.txt b.txt", [("a.txt", a), ("b.txt", b)]),
        ("mtllib a b.mtl\nmtllib b\\c.mtl", [("a b.mtl", a), ("b\\c.mtl", b)]),
    ] {
        // Even a library that is named after its materials is found.
        for text in [format!("{line}\n{faces}"), format!("{faces}{line}\n")] {
            let scene = with(text, &libraries);
            assert_eq!(scene.facts.warnings, Vec::<String>::new(), "{line}");
            let names: Vec<&str> = scene.materials.iter().map(|m| m.name.as_str()).collect();
            assert_eq!(names, ["one", "two words"], "{line}");
            let used: Vec<u32> = scene.mesh.triangles.iter().map(|t| t.material).collect();
            assert_eq!(used, [0, 1, 0], "{line}");
        }
    }
}

#[test]
fn names_match_across_encodings() {
    let mut text = b"mtllib m.mtl\nusemtl caf\xE9\n".to_vec();
    text.extend(FACE.bytes());
    let scene = with(text, &[("m.mtl", "newmtl café\nKd 1 0 0".as_bytes())]);
    assert_eq!(scene.materials[0].name, "café");
    assert_eq!(scene.facts.warnings, Vec::<String>::new());
}

#[test]
fn faces_before_any_material_have_the_default() {
    let text = format!("mtllib m.mtl\n{FACE}usemtl m\nf 1 2 3\nusemtl\nf 1 2 3\n");
    let scene = with(text, &[("m.mtl", b"newmtl m\nKd 1 0 0")]);
    let used: Vec<u32> = scene.mesh.triangles.iter().map(|t| t.material).collect();
    assert_eq!(used, [0, 1, 0]);
    assert_eq!(scene.materials[0], Material::default());
}

#[test]
fn a_library_is_opened_once() {
    let mut opened = 0;
    let text = format!("{}{FACE}", "mtllib m.mtl\n".repeat(1000));
    let mut load = |_: &str| {
        opened += 1;
        Ok(Vec::new())
    };
    rt_scene::obj::parse(text.as_bytes(), "t.obj", &mut load).unwrap();
    assert_eq!(opened, 1);
}

#[test]
fn materials_written_and_read_back() {
    let library = "newmtl a\nKd 0.1 0.2 0.3\nKs 0.5 0.5 0.5\nNs 7\nKe 1 2 3\nillum 3\n\
                   newmtl b c\nKd 1 1 1\nKs 0.25 0 0\nd 0.25\nNi 1.5\n";
    let text = format!("mtllib m.mtl\nusemtl a\n{FACE}usemtl b c\nf 1 3 2\n");
    let scene = with(text, &[("m.mtl", library.as_bytes())]);
    let (mut obj, mut mtl) = (Vec::new(), Vec::new());
    rt_scene::obj::write(&scene, Some("w.mtl"), &mut obj).unwrap();
    rt_scene::obj::write_library(&scene, &[], &mut mtl).unwrap();
    let again = with(obj, &[("w.mtl", &mtl)]);
    assert_eq!(again.materials, scene.materials);
    assert_eq!(format!("{:?}", again.mesh), format!("{:?}", scene.mesh));
}

#[test]
fn written_materials_have_names_of_their_own() {
    let mut scene = with(FACE, &[]);
    let colors = [0.0, 0.25, 0.5, 0.75];
    let material = |(name, grey): (&str, f32)| Material {
        name: name.into(),
        diffuse: Vec3::splat(grey),
        ..Material::default()
    };
    scene.materials = ["", "a", "a", ""].into_iter().zip(colors).map(material).collect();
    let triangle = scene.mesh.triangles[0];
    scene.mesh.triangles =
        (0..4).map(|material| rt_scene::Triangle { material, ..triangle }).collect();
    let (mut obj, mut mtl) = (Vec::new(), Vec::new());
    rt_scene::obj::write(&scene, Some("w.mtl"), &mut obj).unwrap();
    rt_scene::obj::write_library(&scene, &[], &mut mtl).unwrap();
    let again = with(obj, &[("w.mtl", &mtl)]);
    let greys: Vec<f32> = again.materials.iter().map(|m| m.diffuse.x).collect();
    assert_eq!(greys, colors);
}
