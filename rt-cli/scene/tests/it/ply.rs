//! PLY: text and binary, polygons, normals, and what is wrong with files.

use glam::Vec3;
use rt_scene::{Error, Scene};

use crate::support::error;

fn ply(text: impl AsRef<[u8]>) -> Result<Scene, Error> {
    rt_scene::ply::parse(text.as_ref(), "t.ply")
}

/// A header of so many vertices and faces.
fn header(format: &str, vertices: usize, faces: usize) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment by hand\nelement vertex {vertices}\n\
         property float x\nproperty float y\nproperty float z\nelement face {faces}\n\
         property list uchar int vertex_indices\nend_header\n"
    )
}

const CORNERS: [[f32; 3]; 5] =
    [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.5], [0.0, 1.0, 0.5], [9.0, 9.0, 9.0]];

/// A quadrilateral, a triangle, a line and a vertex that nobody needs, as text.
fn text() -> String {
    let vertices: String = CORNERS.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    format!("{}{vertices}4 0 1 2 3\n3 2 1 0\n2 0 1\n", header("ascii", 5, 3))
}

/// The same in binary.
fn binary(big: bool) -> Vec<u8> {
    let name = if big { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = header(name, 5, 3).into_bytes();
    let mut put = |word: [u8; 4]| {
        bytes.extend(if big { word.into_iter().rev().collect::<Vec<_>>() } else { word.into() });
    };
    CORNERS.as_flattened().iter().for_each(|x| put(x.to_le_bytes()));
    for face in [&[0_i32, 1, 2, 3][..], &[2, 1, 0], &[0, 1]] {
        bytes.push(face.len() as u8);
        for index in face {
            let word = index.to_le_bytes();
            bytes.extend(if big {
                word.into_iter().rev().collect::<Vec<_>>()
            } else {
                word.into()
            });
        }
    }
    bytes
}

#[test]
fn text_and_binary_say_the_same() {
    let scene = ply(text()).unwrap();
    assert_eq!(
        scene.mesh.positions,
        CORNERS[..4].iter().map(|&c| Vec3::from(c)).collect::<Vec<_>>()
    );
    assert_eq!(scene.mesh.triangles.len(), 3);
    assert_eq!(scene.mesh.triangles[2].position, [2, 1, 0]);
    assert!(scene.mesh.normals.is_empty() && scene.mesh.triangles[0].normal.is_none());
    assert_eq!((scene.materials.len(), scene.facts.stated["polygon"]), (1, 3));
    let skipped: Vec<_> = scene.facts.skipped.iter().map(|s| (&*s.what, s.count)).collect();
    assert_eq!(skipped, [("vertex", 1), ("face", 1)]);
    for big in [false, true] {
        let other = ply(binary(big)).unwrap();
        assert_eq!(other.mesh.positions, scene.mesh.positions);
        assert_eq!(other.mesh.triangles, scene.mesh.triangles);
    }
}

#[test]
fn normals_are_read_and_other_things_are_counted() {
    let scene = ply("ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n\
        property double z\nproperty float nx\nproperty float ny\nproperty float nz\n\
        property uchar red\nproperty uchar green\nelement edge 1\nproperty int vertex1\n\
        property int vertex2\nelement face 1\nproperty list uint ushort vertex_index\n\
        property int flags\nend_header\n0 0 0 0 0 1 255 0\n1 0 0 0 1 1 255 0\n0 1 0 1 0 1 9 9\n0 1\n\
        3 2 0 1 7\n")
    .unwrap();
    assert_eq!(scene.mesh.positions, [Vec3::Y, Vec3::ZERO, Vec3::X]);
    assert_eq!(scene.mesh.normals[0], Vec3::new(1.0, 0.0, 1.0));
    assert_eq!(scene.mesh.triangles[0].normal, Some(scene.mesh.triangles[0].position));
    let skipped: Vec<_> = scene.facts.skipped.iter().map(|s| (&*s.what, s.count)).collect();
    assert_eq!(skipped, [("edge", 1), ("property", 2)]);
}

#[test]
fn what_is_wrong_is_said() {
    let with = |from: &str, to: &str| error(ply(text().replacen(from, to, 1)));
    for (from, to, expected) in [
        ("4 0 1 2 3", "4 0 1 2 5", " face 0 has the vertex 5, but there are 5"),
        ("2 1 0.5\n", "2 nan 0.5\n", "13:3: expected a number"),
        ("2 1 0.5\n", "2 1e99 0.5\n", " vertex 2 is not finite in single precision"),
        ("element face 3", "element fact 3", " no faces: nothing to draw"),
        ("element vertex", "element vertices", " there is no element 'vertex'"),
        ("property float z", "property float w", " the element 'vertex' has no x, y and z"),
        (
            "list uchar int",
            "list uchar float",
            "16:1: expected coordinates to be numbers, and vert",
        ),
        ("2 0 0\n", "2 0\n", "12:1: Expected element of type 'Scalar(Float)', but found nothing"),
        ("2 0 0\n", "2 0 zero\n", "12:5: expected a number"),
        ("4 0 1 2 3", "4 0 1 2 -3", "16:1: expected coordinates to be numbers, and vertices"),
        ("4 0 1 2 3", "4 0 1 2", "16:1: Expected 4 list elements, but found only 3"),
        ("element face 3", "element face 4", "19:1: Unexpected end of file"),
        ("element face 3", "element face x", "8:14: expected a line of a PLY header"),
        ("end_header", "end", "10:1: expected a line of a PLY header"),
        ("format ascii 1.0", "format utf8 1.0", "2:8: expected a line of a PLY header"),
        ("ply", "plx", "1:1: expected a line of a PLY header"),
    ] {
        let message = with(from, to);
        let start = format!("t.ply:{expected}");
        assert!(message.starts_with(&start), "{from:?} {to:?}: {message}");
        assert!(!message.contains(char::is_control), "{message:?}");
    }
    assert!(error(ply("")).starts_with("t.ply: "));
    // What a file says is no place, though the parser repeats it.
    assert!(error(ply("comment \u{b}column: 0\n")).starts_with("t.ply:1:"));
    for length in 0..binary(false).len() {
        assert!(ply(&binary(false)[..length]).is_err(), "cut after {length} bytes");
    }
}

/// Counts that only the file claims cost neither time nor memory.
#[test]
fn claims_are_not_trusted() {
    let endless = "ply\nformat binary_little_endian 1.0\nelement nothing 18446744073709551615\n\
                   end_header\n";
    assert_eq!(error(ply(endless)), "t.ply: the element 'nothing' has no properties");
    let many = header("binary_little_endian", 1 << 60, 1 << 60);
    assert!(error(ply(many)).contains("t.ply: "));
    let mut long =
        header("binary_little_endian", 0, 1).replace("uchar int", "uint int").into_bytes();
    long.extend(u32::MAX.to_le_bytes());
    assert!(error(ply(long)).contains("t.ply: "));
}
