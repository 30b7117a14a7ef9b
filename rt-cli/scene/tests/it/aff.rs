//! AFF: transformations, included files, key frames, and what is left out.

use std::collections::HashMap;
use std::f32::consts::FRAC_1_SQRT_2;
use std::io;

use glam::Vec3;
use rt_scene::{Error, Scene};

use crate::support::{double_area, headlines};

/// Reads a text called `t.aff` that may include others.
fn aff_with(text: &str, files: &[(&str, &str)]) -> Result<Scene, Error> {
    let files: HashMap<_, _> = files.iter().copied().collect();
    rt_scene::aff::parse(text.as_bytes(), "t.aff", &mut |name| match files.get(name) {
        Some(text) => Ok(text.as_bytes().to_vec()),
        None => Err(io::ErrorKind::NotFound.into()),
    })
}

fn aff(text: &str) -> Scene {
    aff_with(text, &[]).unwrap()
}

#[track_caller]
fn near(a: Vec3, b: [f32; 3]) {
    assert!(a.distance(Vec3::from_array(b)) < 1e-6, "{a} is not {b:?}");
}

/// What both formats have is the same in both, but for the intensity of lights without a colour.
#[test]
fn an_nff_is_an_aff() {
    let text = "b 0.1 0.2 0.3\nv\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\n\
        resolution 64 48\nl 4 5 6 1 1 0.5\nf 1 0.5 0.25 0.5 0.25 10 0.5 1.5\ns 1 2 3 4\n\
        c 0 0 0 1 0 0 1 0.5\nc 0 0 0 1 0 0 2 1 # pipe\np 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n\
        pp 3\n0 0 0 0 0 1\n1 0 0 0 1 1\n0 1 0 1 0 1\n";
    let (aff, nff) = (aff(text), rt_scene::nff::parse(text.as_bytes(), "t.nff").unwrap());
    assert_eq!((&aff.spheres, &aff.cones), (&nff.spheres, &nff.cones));
    assert_eq!(aff.mesh.positions, nff.mesh.positions);
    assert_eq!(aff.mesh.triangles, nff.mesh.triangles);
    assert_eq!((&aff.materials, &aff.lights), (&nff.materials, &nff.lights));
    assert_eq!((&aff.view, &aff.background), (&nff.view, &nff.background));
    assert_eq!(aff.facts.stated, nff.facts.stated);
    assert_eq!(self::aff("l 1 2 3 s 0 0 0 1").lights[0].color, Vec3::ONE);
}

#[test]
fn transformations_scale_then_turn_then_move_and_nest() {
    // A quarter about z takes x to y.
    let scene = aff("xs 2 2 2  0 0 3 90  10 0 0 { s 1 0 0 1 p 3 1 0 0 0 1 0 0 0 1 } s 5 5 5 1");
    near(scene.spheres[0].center, [10.0, 2.0, 0.0]);
    assert_eq!(scene.spheres[0].radius, 2.0);
    assert_eq!(scene.spheres[1].center, Vec3::splat(5.0));
    near(scene.mesh.positions[0], [10.0, 2.0, 0.0]);
    near(scene.mesh.positions[1], [8.0, 0.0, 0.0]);
    let nested = aff("xs 1 1 1 0 0 1 90 0 0 0{xs 1 1 1 0 0 1 0 1 0 0{c 0 0 0 1 1 0 0 2}}s 0 0 0 1");
    near(nested.cones[0].base, [0.0, 1.0, 0.0]);
    near(nested.cones[0].apex, [0.0, 2.0, 0.0]);
    assert_eq!((nested.cones[0].base_radius, nested.cones[0].apex_radius), (1.0, 2.0));
    assert_eq!(nested.spheres[0].center, Vec3::ZERO);
    // No axis is no rotation.
    near(aff("xs 1 1 1 0 0 0 90 1 2 3 { s 1 0 0 1 }").spheres[0].center, [2.0, 2.0, 3.0]);
}

#[test]
fn normals_stay_across_their_surfaces() {
    // The plane x + z = 1, stretched along x: x/3 + z = 1.
    let n = FRAC_1_SQRT_2;
    let text = format!(
        "xs 3 1 1 0 1 0 0 0 0 0 {{ pp 3 1 0 0 {n} 0 {n} 0 0 1 {n} 0 {n} 1 1 0 {n} 0 {n} }}"
    );
    let scene = aff(&text);
    let wanted = Vec3::new(1.0, 0.0, 3.0).normalize();
    for &normal in &scene.mesh.normals {
        near(normal, wanted.to_array());
    }
    // A mirror image is seen from the front where the original was.
    let facing = |scene: &Scene| {
        let [a, b, c] = scene.mesh.triangles[0].position.map(|i| scene.mesh.positions[i as usize]);
        (b - a).cross(c - a).dot(scene.mesh.normals[0])
    };
    let pp = "pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1";
    assert!(facing(&aff(pp)) > 0.0);
    let mirrored = aff(&format!("xs 1 1 -1 0 1 0 0 0 0 0 {{ {pp} }}"));
    assert_eq!(mirrored.mesh.normals[0], Vec3::NEG_Z);
    assert!(facing(&mirrored) > 0.0);
}

#[test]
fn what_is_stretched_becomes_triangles() {
    let scene = aff("s 9 9 9 1 xs 1 2 3 0 1 0 30 0 0 0 { s 0 0 0 1 c 0 0 0 1 0 0 1 1 } s 8 8 8 1");
    assert_eq!((scene.spheres.len(), scene.cones.len()), (2, 0));
    assert!(scene.mesh.triangles.len() > 500);
    let warning = "2 stretched primitives: drawn as triangles";
    assert!(scene.facts.warnings.contains(&warning.to_owned()), "{:?}", scene.facts.warnings);
    assert_eq!(scene.facts.stated["sphere"], 3);
    // On the ellipsoid, with normals that point out.
    let turn_back = |p: Vec3| {
        let (sin, cos) = 30.0_f32.to_radians().sin_cos();
        Vec3::new(cos * p.x - sin * p.z, p.y, sin * p.x + cos * p.z)
    };
    for triangle in scene.mesh.triangles.iter().take(300) {
        let normals = triangle.normal.expect("it is smooth");
        for (p, n) in triangle.position.iter().zip(normals) {
            let p = scene.mesh.positions[*p as usize];
            let local = turn_back(p) / Vec3::new(1.0, 2.0, 3.0);
            assert!((local.length() - 1.0).abs() < 1e-5, "{p}");
            assert!(scene.mesh.normals[n as usize].dot(p) > 0.0);
        }
        assert!(double_area(&scene.mesh, triangle) > 0.0);
    }
}

#[test]
fn included_files_are_read_in_place() {
    let files = [
        ("red.aff", "fm 0 0 0 1 0 0 0 0 0 1 0 1"),
        ("ball.aff", "s 1 0 0 1 i 0 red.aff"),
        ("fine.aff", "s 7 7 7 7"),
    ];
    let text = "fm 0 0 0 0 1 0 0 0 0 1 0 1\nxs 1 1 1 0 1 0 0 0 5 0 { i 0 ball.aff }\ns 0 0 0 1\n\
                i 1 fine.aff i 0 ball.aff";
    let scene = aff_with(text, &files).unwrap();
    assert_eq!(scene.spheres.len(), 3);
    near(scene.spheres[0].center, [1.0, 5.0, 0.0]);
    let color = |n: usize| scene.materials[scene.spheres[n].material as usize].diffuse;
    // The material of an included file stays in force.
    assert_eq!([color(0), color(1), color(2)], [Vec3::Y, Vec3::X, Vec3::X]);
    assert_eq!(scene.materials.len(), 2, "equal materials are one");
    assert_eq!((&*scene.facts.skipped[0].what, scene.facts.skipped[0].count), ("i", 1));
    let finer = aff_with(&format!("d 1 {text}"), &files).unwrap();
    assert_eq!(finer.spheres.len(), 4);
}

#[test]
fn materials_have_three_colours() {
    let scene = aff("fm 9 9 9 0.1 0.2 0.3 0.4 0.5 0.6 12 0.25 1.5 s 0 0 0 1");
    let material = &scene.materials[0];
    assert_eq!(material.diffuse, Vec3::new(0.1, 0.2, 0.3));
    assert_eq!(material.specular, Vec3::new(0.4, 0.5, 0.6));
    assert_eq!((material.shininess, material.ior), (12.0, 1.5));
    assert_eq!(material.transmission, Vec3::splat(0.25));
    assert_eq!(material.mirror, material.specular);
}

#[test]
fn meshes_have_their_own_indices() {
    let text = "p 3 9 9 9 8 9 9 9 8 9\nm\nvertices 4 0 0 0 1 0 0 1 1 0 0 1 0\nnormals 1 0 0 1\n\
        texturecoords 2 wood.ppm 0 0 1 1\ntriangles 2\n0 1 2 0 0 0 0 1 0\n0 2 3 0 0 0 1 1 0\n\
        m vertices 3 0 0 0 1 0 0 0 1 0 triangles 1 2 1 0";
    let scene = aff(text);
    let corners: Vec<_> = scene.mesh.triangles.iter().map(|t| t.position).collect();
    assert_eq!(corners, [[0, 1, 2], [3, 4, 5], [3, 5, 6], [9, 8, 7]]);
    assert_eq!(scene.mesh.triangles[1].normal, Some([0; 3]));
    assert_eq!(scene.mesh.triangles[3].normal, None);
    assert_eq!(scene.facts.stated["mesh triangle"], 3);
    let skipped = &scene.facts.skipped[0];
    assert_eq!((&*skipped.what, skipped.count), ("texture", 2));
}

#[test]
fn textured_triangles_are_there_without_their_textures() {
    let scene = aff("tt a-b.ppm 0 0 0 0 0 1 0 0 1 0 0 1 0 0 1\n\
                     ttp c.ppm 0 0 0 0 0 1 0 0 1 0 0 0 0 1 1 0 0 1 0 0 0 1 0 1");
    assert_eq!(scene.mesh.triangles.len(), 2);
    near(scene.mesh.positions[1], [1.0, 0.0, 0.0]);
    near(scene.mesh.normals[2], [0.0, 0.0, 1.0]);
    assert_eq!(scene.facts.skipped[0].count, 2);
}

/// Keys: the second one holds at the start; a light and the camera follow theirs.
#[test]
fn the_first_frame_is_shown() {
    let view = "v from 0 0 9 at 0 0 0 up 0 1 0 angle 40 hither 1 resolution 8 6";
    let text = format!(
        "{view} la lamp 1 1 1 0.5 0.5 0.5 x ball {{ s 0 0 0 1 }} x still {{ s 3 0 0 1 }}\n\
         a 0 10 100\n\
         k ball {{ transl 4 -1 9 9 9 0 0 0  0 1 2 3 0 0 0  5 9 9 9 0 0 0  6 9 9 9 0 0 0\n\
           scale 4 -1 9 9 9 0 0 0  0 2 2 2 0 0 0  5 9 9 9 0 0 0  6 9 9 9 0 0 0 }}\n\
         k lamp {{ transl 4 -1 9 9 9 0 0 0  0 4 5 6 0 0 0  5 9 9 9 0 0 0  6 9 9 9 0 0 0 }}\n\
         k camera {{ transl 4 -1 9 9 9 0 0 0  1 0 0 5 0 0 0  5 9 9 9 0 0 0  6 9 9 9 0 0 0\n\
           rot 4 -1 0 1 0 0 0 0 0  1 0 2 0 90 0 0 0  5 0 1 0 0 0 0 0  6 0 1 0 0 0 0 0 }}"
    );
    let scene = aff(&text);
    near(scene.spheres[0].center, [1.0, 2.0, 3.0]);
    assert_eq!(scene.spheres[0].radius, 2.0);
    near(scene.spheres[1].center, [3.0, 0.0, 0.0]);
    near(scene.lights[0].position, [4.0, 5.0, 6.0]);
    let view = scene.view.unwrap();
    near(view.eye, [0.0, 0.0, 5.0]);
    near(view.target - view.eye, [-9.0, 0.0, 0.0]);
    near(view.up, [0.0, 1.0, 0.0]);
    assert_eq!((view.fov_y, view.size), (40.0, Some((8, 6))));
    let only = "of the animation only the first frame is read";
    assert_eq!(scene.facts.warnings, [only]);
    // An animation that starts later is told.
    let late = aff(&text.replace("a 0 10 100", "a 2 10 100"));
    let moved = "3 animated names moved before the first frame: shown as before";
    assert_eq!(late.facts.warnings, [only, moved]);
}

#[test]
fn what_is_invisible_is_left_out() {
    let text = "x a { s 0 0 0 1 p 3 0 0 0 1 0 0 0 1 0 xs 1 1 1 0 1 0 0 0 0 0 { s 1 0 0 1 } }\n\
                s 2 0 0 1 a 5 9 2 k a { visibility 2 0 1 4 0 }";
    let scene = aff(text);
    assert_eq!((scene.spheres.len(), scene.mesh.triangles.len()), (1, 0));
    assert_eq!(scene.spheres[0].center.x, 2.0);
    let skipped = &scene.facts.skipped[0];
    assert_eq!((&*skipped.what, skipped.count), ("primitive", 3));
    for visible in ["a 3 9 2", "a -1 9 2"] {
        assert_eq!(aff(&text.replace("a 5 9 2", visible)).spheres.len(), 3, "{visible}");
    }
}

#[test]
fn animated_triangles_stand_as_at_the_start() {
    let corner = |x: i32| format!("{x} 0 0 0 0 1 0 {x} 0 0 0 1 0 0 {x} 0 0 1");
    let text = format!("tpa 2 1 {} 3 {} a START 9 9", corner(2), corner(4));
    for (start, x) in [("0", 2.0), ("1", 2.0), ("2", 3.0), ("2.5", 3.5), ("3", 4.0), ("7", 4.0)] {
        let scene = aff(&text.replace("START", start));
        near(scene.mesh.positions[0], [x, 0.0, 0.0]);
        near(scene.mesh.positions[1], [0.0, x, 0.0]);
        assert_eq!(scene.facts.stated["animated triangle"], 1);
    }
}

#[test]
fn comments_and_braces_stand_anywhere() {
    let scene = aff("% head\r\ns 0 0 % x and y\n0 # z\n1\nxs 1 1 1 0 1 0 0 1 0 0{s 0 0 0 1}%end");
    assert_eq!(scene.spheres.len(), 2);
}

#[test]
fn what_is_wrong_is_said_with_its_place() {
    let includes = [
        ("bad.aff", "s 0 0\n0 x\n"),
        ("self.aff", "i 0 self.aff"),
        ("twice.aff", "i 0 twice2.aff i 0 twice2.aff"),
        ("zero.aff", "s 0 0 0 1\0"),
    ];
    let view = "v from 0 0 9 at 0 0 0 up 0 1 0 angle";
    let deep = "xs 1 1 1 0 1 0 0 0 0 0 {".repeat(65);
    for (text, wanted) in [
        ("", "t.aff: nothing to draw: no 's', 'c', 'p', 'pp', 'tt', 'ttp', 'tpa' or 'm' statement"),
        ("fm 1 1 1", "t.aff:1:9: expected 12 numbers after 'fm', found 3"),
        ("s 0 0 0", "t.aff:1:8: expected 4 numbers after 's', found 3"),
        ("s 0 0 nan 1", "t.aff:1:7: expected 4 numbers after 's', found 2"),
        ("s 0 0 1e39 1", "t.aff:1:7: '1e39' is beyond the range of single precision"),
        ("s 0 0 3e38 3e38", "t.aff:1:1: the sphere reaches beyond the range of single precision"),
        (
            "c 0 0 0 3e38 3e38 0 0 1",
            "t.aff:1:1: the cone reaches beyond the range of single precision",
        ),
        ("s 0 0 0 1 }", "t.aff:1:11: expected a statement of AFF, found '}'"),
        ("s 0 0 0 1 {", "t.aff:1:11: expected a statement of AFF, found '{'"),
        ("sphere 0 0 0 1", "t.aff:1:1: expected a statement of AFF, found 'sphere'"),
        ("x a s 0 0 0 1", "t.aff:1:5: expected '{', found 's'"),
        ("x { }", "t.aff:1:3: expected the name of a transformation, found '{'"),
        ("s 0 0 0 1\nx a {\ns 0 0 0 1", "t.aff:2:1: this block has no end"),
        ("xs 1 1 1 0 0 0 0 0 0 {}", "t.aff:1:22: expected 10 numbers after 'xs', found 9"),
        ("p 2 0 0 0 1 1 1", "t.aff:1:3: expected 3 or more vertices after 'p', found '2'"),
        ("p 4000000000 0 0 0", "t.aff:1:19: expected 3 numbers after 'p', found 0"),
        ("p 3", "t.aff:1:4: expected 3 numbers after 'p', found 0"),
        ("p", "t.aff:1:2: expected 3 or more vertices after 'p', found the end of the file"),
        ("pp 3 0 0 0 1", "t.aff:1:13: expected 3 numbers after 'pp', found 1"),
        ("tt { 0", "t.aff:1:4: expected the name of a texture, found '{'"),
        ("tpa 0", "t.aff:1:5: expected 1 or more times after 'tpa', found '0'"),
        (
            "tpa 99999999999999999999 1",
            "t.aff:1:5: expected 1 or more times after 'tpa', found '99999999999999999999'",
        ),
        ("m triangles 0", "t.aff:1:3: expected 'vertices', found 'triangles'"),
        (
            "m vertices 1 0 0 0 normals",
            "t.aff:1:27: expected 0 or more normals, found the end of the file",
        ),
        (
            "m vertices 1 0 0 0 triangles 1 0 1 0",
            "t.aff:1:34: expected a vertex index of 0 to 0, found '1'",
        ),
        (
            "m vertices 1 0 0 0 triangles 1 0 -1 0",
            "t.aff:1:34: expected a vertex index of 0 to 0, found '-1'",
        ),
        (
            "m vertices 0 triangles 1 0",
            "t.aff:1:26: expected no vertex index, for there are none, found '0'",
        ),
        (
            "m vertices 1 0 0 0 normals 1 0 0 1 triangles 1 0 0 0 0 0 7",
            "t.aff:1:58: expected a normal index of 0 to 0, found '7'",
        ),
        (
            "m vertices 9000000000000000000 0 0 0",
            "t.aff:1:37: expected 3 numbers after 'vertices', found 0",
        ),
        ("i 0 no.aff", "t.aff:1:5: cannot read 'no.aff': entity not found"),
        ("i 0", "t.aff:1:4: expected the name of a file, found the end of the file"),
        ("i x bad.aff", "t.aff:1:3: expected a level of detail, found 'x'"),
        ("i 0 bad.aff", "bad.aff:2:3: expected 4 numbers after 's', found 3"),
        ("i 0 zero.aff", "zero.aff: this is not AFF text: byte 10 is zero"),
        ("i 0 self.aff", "self.aff:1:1: files and blocks are within each other more than 64 times"),
        (&deep, "t.aff:1:1537: files and blocks are within each other more than 64 times"),
        ("v from 0 0 9 at 0 0 0 angle 40", "t.aff:1:1: expected 'up' after 'v'"),
        (&format!("{view} 0"), "t.aff:1:1: expected an angle between 0 and 180 degrees, found 0"),
        (&format!("{view} 40 resolution 0 8"), "t.aff:1:52: expected 1 to 65536 pixels, found '0'"),
        ("l 1 2", "t.aff:1:6: expected 3 numbers after 'l', found 2"),
        ("l 1 2 3 1 x", "t.aff:1:11: expected 3 numbers after 'l x y z', found 1"),
        ("la { 1 2 3", "t.aff:1:4: expected the name of a light, found '{'"),
        ("a 0 1", "t.aff:1:6: expected 1 or more frames, found the end of the file"),
        ("k a transl", "t.aff:1:5: expected '{', found 'transl'"),
        ("k a { transl 3", "t.aff:1:14: expected 4 or more keys after 'transl', found '3'"),
        ("k a { turn 4", "t.aff:1:7: expected transl, rot, scale, visibility or '}', found 'turn'"),
        ("k a { visibility 1 0", "t.aff:1:21: expected 2 numbers after 'visibility', found 1"),
        (
            "k a {",
            "t.aff:1:6: expected transl, rot, scale, visibility or '}', found the end of the file",
        ),
    ] {
        assert_eq!(headlines(aff_with(text, &includes)), [wanted], "{text:.80}");
    }
    let big = "xs 3e38 3e38 3e38 0 1 0 0 0 0 0 { p 3 0 0 0 9 0 0 0 9 0 }";
    let message = aff_with(big, &[]).unwrap_err().to_string();
    assert_eq!(message, "t.aff: transformed, it reaches beyond single precision");
}

/// Files that include each other twice would be read 2^20 times.
#[test]
fn inclusion_that_multiplies_is_refused_soon() {
    let names: Vec<_> = (0..=20).map(|i| format!("f{i}")).collect();
    let texts: Vec<_> = (0..20).map(|i| format!("i 0 f{0} i 0 f{0}", i + 1)).collect();
    let mut files: Vec<_> =
        names.iter().zip(&texts).map(|(name, text)| (&**name, &**text)).collect();
    files.push(("f20", "s 0 0 0 1"));
    let found = headlines(aff_with("i 0 f0", &files));
    assert!(found[0].ends_with("more than 65536 files are included"), "{found:?}");
}

/// Triangles with normals and without, of several materials, one after the other.
#[test]
fn written_and_read_back() {
    let text = "b 0.1 0.2 0.3\nv from 1 2 3 at 0 0 0 up 0 0 1 angle 45 hither 1 resolution 64 48\n\
        l 4 5 6 1 1 0.5 l 1 1e-45 3\nfm 0 0 0 0.1 0.2 0.3 0.9 0.8 0.1 20 0.5 1.5\n\
        m vertices 4 0 0 0 1 0 0 1 1 0 0 1 1e-40 normals 1 0 0 5 triangles 2\n\
        0 1 2 0 0 0 0 2 3 0 0 0\np 4 0 0 1 1 0 1 1 1 1 0 1 1\nf 1 0 0 0.3 0.1 5 0 1\n\
        p 3 0 0 2 1 0 2 0.1 1 2\npp 3 0 0 3 0 1 3 1 0 3 0 2 3 0 1 3 0 0 0.1\n\
        s 0.1 0.2 0.3 0.4\nfm 0 0 0 0.1 0.2 0.3 0.9 0.8 0.1 20 0.5 1.5\nc 0 0 0 1 0 0 1 0.5\n";
    let scene = aff(text);
    let mut written = Vec::new();
    rt_scene::aff::write(&scene, &mut written).unwrap();
    let again = aff(std::str::from_utf8(&written).unwrap());
    let corners = |scene: &Scene| {
        let of = |t: &rt_scene::Triangle| {
            let normals = t.normal.map(|n| n.map(|i| scene.mesh.normals[i as usize]));
            (t.position.map(|i| scene.mesh.positions[i as usize]), normals, t.material)
        };
        scene.mesh.triangles.iter().map(of).collect::<Vec<_>>()
    };
    assert_eq!(corners(&again), corners(&scene));
    assert_eq!(again.mesh.positions.len(), 4 + 4 + 3 + 3);
    assert_eq!((&again.spheres, &again.cones), (&scene.spheres, &scene.cones));
    assert_eq!(again.materials, scene.materials);
    assert_eq!((again.view, again.background), (scene.view, scene.background));
    assert_eq!(again.lights, scene.lights);
    assert_eq!(rt_scene::aff::poorer(&scene), 0);
    assert_eq!(again.facts.stated["mesh triangle"], 6);
}
