//! Damaged files: whatever happens to the bytes, nothing panics and memory stays within bounds.

use std::io;

use proptest::prelude::*;
use rt_scene::{Error, Scene};

const OBJ: &str = "mtllib a.mtl b.mtl\r\nv 0 0 0\nv 1 0 0 # one\nv 1 1.5e0 -0.25\nv 0 1 0\nv .5 2 0\n\
    vt 0 0\nvt 1 0\nvn 0 0 1\nusemtl red\ns 1\nf 1/1/1 2/2/1 3/1/1\nf -5//1 -4//1 -2//1 \\\n-1//1\n\
    g café\nusemtl blue\nf 1 2 3 4 5\nl 1 2\nf 4/1 3/2 1/2\n";

const MTL: &str = "newmtl red\nKd 1 0 0 # red\nKs .5 .5 .5\nNs 12\nillum 3\nKe 1 2 3\n\
    newmtl blue\nKd 0.25\nmap_Kd x.png\nd 0.5\n";

const NFF: &str = "b 0.1 0.2 0.3\nv\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\n\
    resolution 64 48\nl 1 2 3\nl 4 5 6 1 1 0.5\nf 1 0.5 0.25 0.5 0.25 10 0 1\ns 1 2 3 4\n\
    c 0 0 0 1 0 0 1 0.5\np 5\n0 0 0\n1 0 0\n1 1 0\n0.5 0.5 0\n0 1 0\n# end\n\
    pp 3\n0 0 0 0 0 1\n1 0 0 0 1 1\n0 1 0 1 0 1\n";

const AFF: &str = "b 0 0 1 v from 0 0 9 at 0 0 0 up 0 1 0 angle 40 hither 1 resolution 8 6\nam 1 1 1\n\
    l 1 2 3 la lamp 1 2 3 1 1 1 fm 1 1 1 1 0 0 0 1 0 9 0 1 % shiny\ni 0 b.aff d 1 i 2 b.aff\n\
    xs 1 2 1 0 0 1 30 1 2 3 { s 0 0 0 1 c 0 0 0 1 0 0 1 0.5 x a { i 1 b.aff tt w.ppm 0 0 0 0 0\n\
    1 0 0 1 0 0 1 0 0 1 } }\ntpa 2 0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1 2 0 0 1 0 0 1 1 0 1\n\
    0 0 1 0 1 1 0 0 1\nm vertices 3 0 0 0 1 0 0 0 1 0 normals 1 0 0 1 texturecoords 1 w.ppm 0 0\n\
    triangles 1 0 1 2 0 0 0 0 0 0\na 0 9 9 k a { transl 4 0 1 1 1 0 0 0 0 1 1 1 0 0 0 5 1 1 1 0 0 0\n\
    6 1 1 1 0 0 0 rot 4 0 0 1 0 9 0 0 0 0 0 1 0 9 0 0 0 5 0 1 0 9 0 0 0 6 0 1 0 9 0 0 0\n\
    visibility 2 0 1 9 0 } k camera { scale 4 0 1 1 1 0 0 0 0 1 1 1 0 0 0 5 1 1 1 0 0 0 6 1 1 1 0 0 0 }\n";

/// What it includes.
const INCLUDED: &str = "p 4 0 0 0 1 0 0 1 1 0 0 1 0\npp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n";

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
    property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n\
    element face 2\nproperty list uchar int vertex_indices\nelement edge 1\nproperty int v\n\
    end_header\n0 0 0 0 0 1 9\n1 0 0 0 0 1 9\n1 1 0 0 0 1 9\n0 1 0 0 0 1 9\n4 0 1 2 3\n3 0 1 2\n7\n";

/// What may be put into a file: bytes that mean something to a reader, and any other.
fn piece() -> impl Strategy<Value = Vec<u8>> {
    let words = [
        "f",
        "v",
        "p",
        "\n",
        "\r",
        "\\\n",
        "/",
        "//",
        "-",
        "0",
        "1e999",
        "nan",
        "4294967295",
        " ",
        "-1",
        "18446744073709551615",
        "9223372036854775807",
        "#",
        "\u{FEFF}",
        "usemtl ",
        "é",
        "\0",
        "1e-45",
        "3e38",
        "p 4000000000\n",
        "f 1 2 3 4 5 1 2 3 4 5\n",
        "newmtl ",
        "Kd ",
        "mtllib ",
    ];
    let any_byte = any::<u8>().prop_map(|byte| vec![byte]);
    prop_oneof![
        prop::sample::select(words.to_vec()).prop_map(|word| word.as_bytes().to_vec()),
        any_byte
    ]
}

/// A file with some places cut out or overwritten, and perhaps its end missing.
fn damaged(text: &'static str) -> impl Strategy<Value = Vec<u8>> {
    let change = (any::<prop::sample::Index>(), 0..4_usize, piece());
    let end = prop_oneof![3 => Just(None), 1 => any::<prop::sample::Index>().prop_map(Some)];
    (prop::collection::vec(change, 1..6), end).prop_map(|(changes, end)| {
        let mut bytes = text.as_bytes().to_vec();
        for (place, removed, piece) in changes {
            let start = place.index(bytes.len() + 1);
            let stop = bytes.len().min(start + removed);
            bytes.splice(start..stop, piece);
        }
        if let Some(end) = end {
            bytes.truncate(end.index(bytes.len() + 1));
        }
        bytes
    })
}

fn parse_obj(obj: &[u8], mtl: &[u8]) -> Result<Scene, Error> {
    rt_scene::obj::parse(obj, "t.obj", &mut |name| match name {
        "a.mtl" => Ok(mtl.to_vec()),
        _ => Err(io::ErrorKind::NotFound.into()),
    })
}

/// What a ball and a cone that are stretched are worth in text.
const STRETCHED: usize = 4000;

fn parse_aff(aff: &[u8], included: &[u8]) -> Result<Scene, Error> {
    rt_scene::aff::parse(aff, "t.aff", &mut |name| match name {
        "b.aff" => Ok(included.to_vec()),
        _ => Err(io::ErrorKind::NotFound.into()),
    })
}

/// A scene must be sound, and no larger than its file allows; an error must be short.
fn check(result: &Result<Scene, Error>, bytes: usize) {
    let scene = match result {
        Ok(scene) => scene,
        Err(error) => {
            assert!(error.to_string().len() < 10_000, "{error}");
            return;
        }
    };
    let mesh = &scene.mesh;
    let memory = 12 * (mesh.positions.capacity() + mesh.normals.capacity())
        + 32 * mesh.triangles.capacity()
        + 20 * scene.spheres.capacity()
        + 36 * scene.cones.capacity();
    assert!(memory <= 64 * bytes + 4096, "{memory} bytes for {bytes}");
    assert!(mesh.positions.iter().chain(&mesh.normals).all(|v| v.is_finite()));
    let materials = scene.materials.len() as u32;
    for triangle in &mesh.triangles {
        assert!(triangle.position.iter().all(|&i| (i as usize) < mesh.positions.len()));
        let normals = triangle.normal.unwrap_or([0; 3]);
        assert!(
            triangle.normal.is_none() || normals.iter().all(|&i| (i as usize) < mesh.normals.len())
        );
        assert!(triangle.material < materials);
    }
    for sphere in &scene.spheres {
        assert!(sphere.center.is_finite() && sphere.radius.is_finite() && sphere.radius > 0.0);
        assert!(sphere.material < materials);
    }
    for cone in &scene.cones {
        let [base, apex] = [cone.base_radius, cone.apex_radius];
        assert!(cone.base.is_finite() && cone.apex.is_finite() && cone.base != cone.apex);
        assert!(base.max(apex).is_finite() && base.max(apex) > 0.0 && base.min(apex) >= 0.0);
        assert!(cone.material < materials);
    }
    for m in &scene.materials {
        let colors = [m.diffuse, m.specular, m.mirror, m.transmission, m.emission];
        assert!(colors.iter().all(|color| color.is_finite()), "{m:?}");
        assert!(m.shininess.is_finite() && m.ior.is_finite() && m.ior > 0.0, "{m:?}");
    }
    assert!(scene.bounds().is_none_or(|(low, high)| low.is_finite() && high.is_finite()));
}

#[test]
fn the_files_are_good() {
    let scene = parse_obj(OBJ.as_bytes(), MTL.as_bytes()).unwrap();
    assert_eq!((scene.mesh.triangles.len(), scene.materials.len()), (7, 2));
    let scene = rt_scene::nff::parse(NFF.as_bytes(), "t.nff").unwrap();
    assert_eq!((scene.mesh.triangles.len(), scene.spheres.len(), scene.cones.len()), (4, 1, 1));
    let scene = parse_aff(AFF.as_bytes(), INCLUDED.as_bytes()).unwrap();
    let ply = rt_scene::ply::parse(PLY.as_bytes(), "t.ply").unwrap();
    assert_eq!((ply.mesh.triangles.len(), ply.mesh.normals.len()), (3, 4));
    // Twice what is included, three single ones, and those of a ball and a cone.
    assert_eq!(scene.mesh.triangles.len(), 2 * 3 + 3 + 12 * 64 + 8 * 8);
}

#[test]
fn every_truncation() {
    for end in 0..PLY.len() {
        check(&rt_scene::ply::parse(&PLY.as_bytes()[..end], "t.ply"), end);
    }
    for end in 0..OBJ.len() {
        check(&parse_obj(&OBJ.as_bytes()[..end], MTL.as_bytes()), end);
    }
    for end in 0..MTL.len() {
        let result = parse_obj(OBJ.as_bytes(), &MTL.as_bytes()[..end]);
        assert!(result.is_ok(), "a library never fails a file");
        check(&result, OBJ.len() + end);
    }
    for end in 0..NFF.len() {
        check(&rt_scene::nff::parse(&NFF.as_bytes()[..end], "t.nff"), end);
    }
    for end in 0..AFF.len() {
        check(&parse_aff(&AFF.as_bytes()[..end], INCLUDED.as_bytes()), STRETCHED + end);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damaged_ply(bytes in damaged(PLY)) {
        check(&rt_scene::ply::parse(&bytes, "t.ply"), bytes.len());
    }

    #[test]
    fn damaged_obj(bytes in damaged(OBJ)) {
        check(&parse_obj(&bytes, MTL.as_bytes()), bytes.len());
    }

    #[test]
    fn damaged_mtl(bytes in damaged(MTL)) {
        let result = parse_obj(OBJ.as_bytes(), &bytes);
        prop_assert!(result.is_ok(), "a library never fails a file");
        check(&result, OBJ.len() + bytes.len());
    }

    #[test]
    fn damaged_nff(bytes in damaged(NFF)) {
        check(&rt_scene::nff::parse(&bytes, "t.nff"), bytes.len());
    }

    #[test]
    fn damaged_aff(bytes in damaged(AFF)) {
        let result = parse_aff(&bytes, INCLUDED.as_bytes());
        check(&result, STRETCHED + bytes.len());
    }

    #[test]
    fn damaged_includes(bytes in damaged(INCLUDED)) {
        let result = parse_aff(AFF.as_bytes(), &bytes);
        check(&result, STRETCHED + AFF.len() + bytes.len());
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        check(&parse_obj(&bytes, &bytes), bytes.len());
        check(&rt_scene::nff::parse(&bytes, "t.nff"), bytes.len());
        check(&parse_aff(&bytes, &bytes), bytes.len());
    }
}
