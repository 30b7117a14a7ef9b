//! OBJ files that load, however odd.

use std::fmt::Write;

use glam::Vec3;
use rt_scene::{Scene, Skipped};

use crate::support::{double_area, obj};

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn loads(text: impl AsRef<[u8]>) -> Scene {
    obj(text).expect("a valid OBJ")
}

fn triangles(text: impl AsRef<[u8]>) -> usize {
    loads(text).mesh.triangles.len()
}

#[test]
fn line_ends_of_every_kind() {
    let unix = format!("{CORNERS}f 1 2 3\nf 1 3 4\n");
    for end in ["\n", "\r\n", "\r"] {
        assert_eq!(triangles(unix.replace('\n', end)), 2, "{end:?}");
        assert_eq!(triangles(unix.trim_end().replace('\n', end)), 2, "{end:?}, last line open");
    }
}

#[test]
fn byte_order_mark_tabs_and_indentation() {
    assert_eq!(triangles(format!("\u{FEFF}{CORNERS}f 1 2 3")), 1);
    assert_eq!(triangles("\tv\t0 0\t0\n  v 1 0 0 \n v 0  1 0\t\nf\t1 2  3"), 1);
}

#[test]
fn continued_lines() {
    for text in [
        "v 0 0 \\\n 0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n2 \\\n\\\n3\n",
        "v 0 0 \\\r 0\rv 1 0 0\rv 0 1 0\rf 1 2\\\r3\r",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\\",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\n# C:\\models\\\nf 1 2 3\n",
    ] {
        assert_eq!(triangles(text), 1, "{text:?}");
    }
}

#[test]
fn every_form_of_corner() {
    let lists = format!("{CORNERS}vt 0\nvt 0 0\nvt 0 0 0\nvn 0 0 1\nvn 0 1 1\nvn 1 0 2\n");
    for (face, normals) in [
        ("1 2 3", false),
        ("1/1 2/2 3/3", false),
        ("1/1/ 2/2/ 3/3/", false),
        ("1//1 2//2 3//3", true),
        ("1/1/1 2/2/2 3/3/3", true),
        ("-4/-3/-3 -3/-2/-2 -2/-1/-1", true),
        ("1//1 2 3//3", false),
    ] {
        let scene = loads(format!("{lists}f {face}"));
        assert_eq!(scene.mesh.triangles[0].position, [0, 1, 2], "{face}");
        let expected = normals.then_some([0, 1, 2]);
        assert_eq!(scene.mesh.triangles[0].normal, expected, "{face}");
        if normals {
            assert_eq!(scene.mesh.normals[2].to_array(), [1.0, 0.0, 2.0], "{face}");
        } else {
            assert!(scene.mesh.normals.is_empty(), "{face}");
        }
    }
}

#[test]
fn faces_with_and_without_normals() {
    let scene = loads(format!("{CORNERS}vn 0 0 1\nf 1 2 3\nf 1//1 2//1 3//1\nf 2 3 4\n"));
    let normals: Vec<bool> = scene.mesh.triangles.iter().map(|t| t.normal.is_some()).collect();
    assert_eq!(normals, [false, true, false]);
    assert_eq!(scene.mesh.positions.len(), 4, "vertices are shared");
}

#[test]
fn negative_indices_count_back_from_the_face() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf -3 -2 -1\n";
    let scene = loads(text);
    let z = |t: usize| scene.mesh.positions[scene.mesh.triangles[t].position[0] as usize].z;
    assert_eq!((z(0), z(1)), (0.0, 5.0));
}

#[test]
fn faces_before_their_vertices() {
    let scene = loads("f 1 2 3\nv 0 0 7\nv 1 0 7\nv 0 1 7\n");
    assert_eq!(scene.mesh.triangles.len(), 1);
    assert_eq!(scene.mesh.positions[0].z, 7.0);
}

#[test]
fn more_numbers_than_needed() {
    let text = "v 0 0 0 1.0\nv 2 0 0 0.5\nv 0 2 0 255 0 nonsense\nvn 0 0 1 9\nf 1//1 2//1 3//1";
    let scene = loads(text);
    assert_eq!(scene.mesh.positions[1].x, 2.0, "a weight is not divided by");
    assert_eq!(scene.mesh.triangles.len(), 1);
}

#[test]
fn numbers_keep_their_bits() {
    let values = ["1e-45", "1.17549435e-38", "3.4028235e38", "-0", "0.1", "1e-999", "+.5", "5."];
    let mut text = String::new();
    for value in values {
        writeln!(text, "v {value} {value} 1").unwrap();
    }
    text += "f 1 2 3 4 5 6 7 8";
    let scene = loads(text);
    for (value, position) in values.iter().zip(&scene.mesh.positions) {
        let expected: f32 = value.parse().unwrap();
        assert_eq!(position.x.to_bits(), expected.to_bits(), "{value}");
    }
    assert_eq!(scene.mesh.positions[0].x, f32::from_bits(1), "subnormal");
}

#[test]
fn comments_anywhere() {
    let text = "#\n# é\nv 0 0 0 # first\nv 1 0 0#second\nv 0 1 0\nf 1 2 3 # 4 5\n#f 1 2\n";
    assert_eq!(triangles(text), 1);
}

#[test]
fn names_in_any_encoding() {
    let mut text = b"o caf\xE9\ng \xFF\xFE\x81 x\nusemtl r\xF4t\n".to_vec();
    text.extend(format!("{CORNERS}f 1 2 3\n").bytes());
    let scene = loads(text);
    assert_eq!(scene.mesh.triangles.len(), 1);
    assert_eq!(scene.facts.warnings, ["t.obj:3:8: no material 'rôt': the default is used"]);
}

#[test]
fn a_very_long_line() {
    let text = format!("# {}\n{CORNERS}f{}1 2 3", "x".repeat(1 << 20), " ".repeat(1 << 20));
    assert_eq!(triangles(text), 1);
}

#[test]
fn triangles_without_area_are_kept_and_counted() {
    let scene = loads("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\nf 1 1 2\n");
    assert_eq!(scene.mesh.triangles.len(), 2);
    assert_eq!(scene.facts.warnings, ["2 triangles have no area"]);
    let scene = loads("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n");
    assert_eq!(scene.facts.warnings, ["1 triangle has no area"]);
}

#[test]
fn what_is_left_out_is_counted() {
    let text = format!(
        "{CORNERS}v 9 9 9\nl 1 2\nl 2 3\np 1\ns off\ng a\no b\nmg 1 2\ncstype bezier\n\
         surf 0 1 0 1 1 \\\n 2 3 4\nend\nf 1 2 3 4\nbogus 1\nwhat?\n"
    );
    let scene = loads(text);
    let skipped =
        |what: &str, why: &str, count| Skipped { what: what.into(), why: why.into(), count };
    let expected = [
        skipped("v", "no face uses it", 1),
        skipped("l", "lines are not drawn", 2),
        skipped("p", "points are not drawn", 1),
        skipped("surf", "free-form surfaces are not drawn", 1),
        skipped("other statement", "not known; the first is t.obj:18:1: 'bogus'", 2),
    ];
    assert_eq!(scene.facts.skipped, expected);
    assert_eq!(scene.facts.stated["polygon"], 1);
    assert_eq!(scene.bounds().unwrap().1.to_array(), [1.0, 1.0, 0.0]);
}

#[test]
fn the_scene_is_named_after_the_file() {
    let text = format!("{CORNERS}f 1 2 3");
    let mut none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    let scene = rt_scene::obj::parse(text.as_bytes(), "some/folder/x.obj", &mut none).unwrap();
    assert_eq!(scene.name, "x.obj");
    assert_eq!((scene.lights.len(), scene.view, scene.background), (0, None, None));
    assert_eq!(scene.materials, [rt_scene::Material::default()]);
}

#[test]
fn written_and_read_back() {
    let text = format!("{CORNERS}vn 0 0.1 1\nvn 1e-45 0 1\nf 1//1 2//2 3//1\nf 1 3 4\n");
    let scene = loads(text);
    let mut written = Vec::new();
    rt_scene::obj::write(&scene, None, &mut written).unwrap();
    let again = loads(&written);
    assert_eq!(format!("{:?}", again.mesh), format!("{:?}", scene.mesh));
    assert!(again.mesh.triangles.iter().all(|t| double_area(&again.mesh, t) == 1.0));
}

#[test]
fn spheres_do_not_fit_into_an_obj() {
    let scene = rt_scene::open("spd:balls:1").unwrap();
    let error = rt_scene::obj::write(&scene, None, &mut Vec::new()).unwrap_err();
    let expected = "an OBJ file cannot hold spd:balls:1's 10 spheres: write an NFF, or make \
                    triangles of them with --tessellate";
    assert_eq!(error.to_string(), expected);
}

/// Two squares at a right angle, and what normal each corner of each triangle has.
fn folded(first: &str, second: &str) -> Vec<Vec<Option<Vec3>>> {
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 1 1\nv 1 1 1\nvn 1 0 0\n";
    let scene = obj(format!("{corners}{first}\nf 1 2 3 4\n{second}\n")).unwrap();
    let normal = |i: u32| scene.mesh.normals[i as usize];
    let of = |t: &rt_scene::Triangle| match t.normal {
        Some(normals) => normals.map(|i| Some(normal(i))).to_vec(),
        None => vec![None; 3],
    };
    scene.mesh.triangles.iter().map(of).collect()
}

#[test]
fn smoothing_groups_have_normals() {
    let (front, up) = (Some(Vec3::Z), Some(Vec3::NEG_Y));
    let slant = Some(Vec3::new(0.0, -1.0, 1.0).normalize());
    let near = |found: &[Vec<Option<Vec3>>], expected: [[Option<Vec3>; 3]; 4]| {
        let pairs = found.iter().flatten().zip(expected.iter().flatten());
        let same = pairs.map(|(a, b)| match (a, b) {
            (Some(a), Some(b)) => a.abs_diff_eq(*b, 1e-6),
            _ => a == b,
        });
        found.len() == 4 && same.into_iter().all(|same| same)
    };
    let wall = "f 4 3 6 5";
    // The corners that both have lean halfway.
    let smooth =
        [[front, front, slant], [front, slant, slant], [slant, slant, up], [slant, up, up]];
    let apart = [[front; 3], [front; 3], [up; 3], [up; 3]];
    let flat = [[None; 3]; 4];
    for (first, second, expected) in [
        ("s 1", wall.to_owned(), smooth),
        ("s 7", format!("usemtl other\n{wall}"), smooth),
        ("s 1", format!("s 2\n{wall}"), apart),
        ("s 1", format!("s off\n{wall}"), [[front; 3], [front; 3], [None; 3], [None; 3]]),
        ("s 0", wall.to_owned(), flat),
        ("s off", wall.to_owned(), flat),
        ("s", wall.to_owned(), flat),
        ("g a", wall.to_owned(), flat),
    ] {
        let found = folded(first, &second);
        assert!(near(&found, expected), "{first}, {second}: {found:?}");
    }
    // Normals that are stated stay.
    let x = Some(Vec3::X);
    let found = folded("s 1", "f 4//1 3//1 6//1 5//1");
    assert!(near(&found, [[front; 3], [front; 3], [x; 3], [x; 3]]), "{found:?}");
}

#[test]
fn faces_that_cancel_have_no_normal_but_are_read() {
    let scene = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\ns 1\nf 1 2 3\nf 3 2 1\nf 1 1 1\n").unwrap();
    assert_eq!(scene.mesh.normals, [Vec3::ZERO; 3]);
    assert!(scene.mesh.triangles.iter().all(|triangle| triangle.normal.is_some()));
}
