//! NFF files, good, odd and wrong.

use glam::Vec3;
use proptest::prelude::*;
use rt_scene::{Cone, Light, Material, Skipped, Sphere};

use crate::support::{error, headlines, nff, obj};

const VIEW: &str = "v\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 640 480\n";

#[test]
fn everything_that_is_read() {
    let text = format!(
        "# comment\nb 0.1 0.2 0.3\n{VIEW}l 1 2 3\nl 4 5 6 1 0.5 0.25\n\
         f 1 0.5 0.25 0.5 0.25 10 0 1\ns 1 2 3 4\np 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n\
         pp 3\n0 0 0 0 0 1\n1 0 0 0 1 1\n0 1 0 1 0 1\n"
    );
    let scene = nff(&text).unwrap();
    assert_eq!(scene.background, Some(Vec3::new(0.1, 0.2, 0.3)));
    let view = scene.view.unwrap();
    assert_eq!((view.eye, view.target, view.up), (Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Z));
    assert_eq!((view.fov_y, view.size), (45.0, Some((640, 480))));
    let half = Vec3::splat(0.5_f32.sqrt());
    let white = Light { position: Vec3::new(1.0, 2.0, 3.0), color: half };
    assert_eq!(scene.lights[0].position, white.position);
    assert!(scene.lights[0].color.abs_diff_eq(white.color, 1e-7), "one of two lights");
    assert_eq!(scene.lights[1].color, Vec3::new(1.0, 0.5, 0.25));
    let material = Material {
        name: String::new(),
        diffuse: Vec3::new(0.5, 0.25, 0.125),
        diffuse_map: None,
        specular: Vec3::splat(0.25),
        mirror: Vec3::splat(0.25),
        transmission: Vec3::ZERO,
        ior: 1.0,
        fresnel: false,
        shininess: 10.0,
        emission: Vec3::ZERO,
        one_sided: false,
    };
    assert_eq!(scene.materials, [material]);
    let sphere = Sphere { center: Vec3::new(1.0, 2.0, 3.0), radius: 4.0, material: 0 };
    assert_eq!(scene.spheres, [sphere]);
    let triangles = &scene.mesh.triangles;
    assert_eq!(triangles.len(), 3);
    assert_eq!((triangles[1].position, triangles[1].normal), ([0, 2, 3], None));
    assert_eq!((triangles[2].position, triangles[2].normal), ([4, 5, 6], Some([0, 1, 2])));
    let stated: Vec<_> = scene.facts.stated.into_iter().collect();
    assert_eq!(stated, [("patch", 1), ("polygon", 1), ("sphere", 1)]);
    assert_eq!(scene.facts.warnings, Vec::<String>::new());

    // Where lines break does not matter, nor how they end.
    for other in [text.replace("# comment\n", "").replace('\n', " "), text.replace('\n', "\r")] {
        let other = nff(other).unwrap();
        assert_eq!(format!("{:?}", other.mesh), format!("{:?}", scene.mesh));
        assert_eq!((other.view, other.lights), (scene.view, scene.lights.clone()));
    }
}

#[test]
fn cones_and_cylinders() {
    let text = "c 0 0 0 1 0 0 1 0.5\nc\n0 0 0 1\n0 0 1 1\nc 0 0 0 0 1 2 3 4\n";
    let scene = nff(text).unwrap();
    let cone = |base_radius, apex: [f32; 3], apex_radius| {
        let (base, apex) = (Vec3::ZERO, Vec3::from_array(apex));
        Cone { base, base_radius, apex, apex_radius, material: 0 }
    };
    let [up, away] = [[0.0, 0.0, 1.0], [1.0, 2.0, 3.0]];
    assert_eq!(scene.cones, [cone(1.0, up, 0.5), cone(1.0, up, 1.0), cone(0.0, away, 4.0)]);
    let stated: Vec<_> = scene.facts.stated.into_iter().collect();
    assert_eq!(stated, [("cone", 2), ("cylinder", 1)]);
}

#[test]
fn odd_cones() {
    let text = "c 0 0 0 -1 0 0 1 -0.5\nc 1 2 3 1 1 2 3 2\nc 0 0 0 0 0 0 1 0\nc 0 0 0 -1 0 0 1 1\n";
    let scene = nff(text).unwrap();
    let radii: Vec<_> = scene.cones.iter().map(|c| (c.base_radius, c.apex_radius)).collect();
    assert_eq!(radii, [(1.0, 0.5), (1.0, 1.0)]);
    let (what, why) = ("cone".into(), "its ends are one point, or both its radii are zero".into());
    assert_eq!(scene.facts.skipped[0], Skipped { what, why, count: 2 });
    let expected =
        "t.nff: 2 cones of negative radius, to be seen from inside only: seen from both sides";
    assert_eq!(scene.facts.warnings, [expected]);
}

#[test]
fn odd_spheres_and_surfaces() {
    let scene = nff("f 1 1 1 1 0 0 0.8 1.1\ns 0 0 0 -2\ns 1 1 1 0\ns 2 2 2 -0\n").unwrap();
    assert_eq!(scene.spheres.len(), 1);
    assert_eq!(scene.spheres[0].radius, 2.0);
    let (what, why) = ("sphere".into(), "its radius is zero".into());
    assert_eq!(scene.facts.skipped, [Skipped { what, why, count: 2 }]);
    let expected =
        ["t.nff: 1 sphere of negative radius, to be seen from inside only: seen from both sides"];
    assert_eq!(scene.facts.warnings, expected);
}

#[test]
fn surfaces_are_shared_and_only_kept_if_used() {
    let [a, b] = ["f 1 0 0 1 0 1 0 1\n", "f 0 1 0 1 0 1 0 1\n"];
    let s = "s 0 0 0 1\n";
    let scene = nff(format!("{s}{b}{a}{s}{b}{s}{a}{s}{s}")).unwrap();
    let used: Vec<u32> = scene.spheres.iter().map(|sphere| sphere.material).collect();
    assert_eq!(used, [0, 1, 2, 1, 1]);
    assert_eq!(scene.materials[0], Material::default(), "before any surface");
    assert_eq!(scene.materials.len(), 3);
}

#[test]
fn extended_surfaces_have_an_ambient_part() {
    let scene = nff("f 1 1 1 1 0 5 0 1 0.2\ns 0 0 0 1").unwrap();
    assert_eq!(scene.materials[0].shininess, 5.0);
}

#[test]
fn concave_polygons() {
    let scene = nff("p 6 0 0 0 3 0 0 3 1 0 1 1 0 1 3 0 0 3 0").unwrap();
    assert_eq!(scene.mesh.triangles.len(), 4);
    let area: f64 =
        scene.mesh.triangles.iter().map(|t| crate::support::double_area(&scene.mesh, t)).sum();
    assert_eq!(area, 10.0);
}

#[test]
fn what_is_wrong_and_where() {
    for (text, expected) in [
        ("s 1 2 3", "1:8: expected 4 numbers after 's', found 3"),
        ("s 1 2\nb 0 0 0", "1:6: expected 4 numbers after 's', found 2"),
        ("v\nfrom 1 2\nat 0 0 0", "2:9: expected 3 numbers after 'from', found 2"),
        ("s 1 2 x 4", "1:6: expected 4 numbers after 's', found 2"),
        ("s 1 2 3x 4", "1:7: expected a number, found '3x'"),
        ("s 1 nan 2 3", "1:5: expected a finite number, found 'nan'"),
        ("s 1 1e99 2 3", "1:5: '1e99' is beyond the range of single precision"),
        ("b 1 2 1.#INF\ns 0 0 0 1", "1:7: expected a number, found '1.#INF'"),
        ("s 3e38 0 0 3e38", "1:1: the sphere reaches beyond the range of single precision"),
        ("c 0 0 3e38 3e38 0 0 0 1", "1:1: the cone reaches beyond the range of single precision"),
        ("c 1 2 3 4\n5 6 7", "2:6: expected 8 numbers after 'c', found 7"),
        ("p 2\n0 0 0\n1 1 1", "1:3: expected 3 or more vertices after 'p', found '2'"),
        ("pp -1", "1:4: expected 3 or more vertices after 'pp', found '-1'"),
        ("p", "1:2: expected 3 or more vertices after 'p', found the end of the file"),
        ("p 4000000000\n0 0 0\n", "2:6: expected 3 numbers after 'p', found 0"),
        (
            "p 18446744073709551616\n0 0 0\n",
            "1:3: expected 3 or more vertices after 'p', found '18446744073709551616'",
        ),
        (
            "hello\ns 0 0 0 1",
            "1:1: expected a statement (v, b, l, f, s, p, pp or c), found 'hello'",
        ),
        ("s 0 0 0 1 7", "1:11: expected a statement (v, b, l, f, s, p, pp or c), found '7'"),
        ("v\nat 0 0 0\n", "1:1: expected 'from' after 'v'"),
        ("v from 0 0 0 at 0 0 0 up 0 0 1 angle 45", "1:1: 'from' and 'at' are the same point"),
        ("v from 0 0 5 at 0 0 0 up 0 0 1 angle 45", "1:1: 'up' is along the line of sight"),
        ("v from 0 0 5 angle 180", "1:20: expected an angle between 0 and 180 degrees, found 180"),
        ("v resolution 0 5", "1:14: expected a resolution from 1 to 65536, found '0'"),
        ("v resolution 5 70000", "1:16: expected a resolution from 1 to 65536, found '70000'"),
    ] {
        assert_eq!(error(nff(text)), format!("t.nff:{expected}"), "{text:?}");
    }
}

#[test]
fn files_that_are_no_nff() {
    let nothing = "t.nff: nothing to draw: no 's', 'p', 'pp' or 'c' statement";
    assert_eq!(error(nff("")), nothing);
    assert_eq!(error(nff("# nothing\nb 0 0 0\n")), nothing);
    assert_eq!(error(nff("s 0 0 0 1\0")), "t.nff: this is not NFF text: byte 10 is zero");
    let utf16 = "t.nff: this is UTF-16 text: save it as UTF-8 to have it read as NFF";
    assert_eq!(error(nff(b"\xFE\xFF\0s")), utf16);
}

#[test]
fn errors_do_not_breed() {
    let text = "s 1 2 x 4 5 6 7\np 3 1 2\nb 0 0 0 0\ns 0 0 0 1\n".repeat(2);
    let expected = [
        "1:6: expected 4 numbers after 's', found 2",
        "2:8: expected 3 numbers after 'p', found 2",
        "3:9: expected a statement (v, b, l, f, s, p, pp or c), found '0'",
    ];
    let places = |line: usize| {
        expected.map(|text| {
            let (old, rest) = text.split_once(':').unwrap();
            format!("t.nff:{}:{rest}", old.parse::<usize>().unwrap() + line)
        })
    };
    assert_eq!(headlines(nff(&text)), [places(0), places(4)].concat());
    assert_eq!(headlines(nff("s x\n".repeat(99))).len(), 10);
}

#[test]
fn written_and_read_back() {
    let text = format!(
        "b 0.1 0.2 0.3\n{VIEW}l 1 2 3 0.5 0.5 0.5\nl 1 1e-45 3 1 1 1\nf 0.9 0.3 0.1 0.7 0.3 5 0 1\n\
         p 4\n0 0 0\n4 -1 0\n1 0 0\n4 1 0\np 3\n0 0 0\n1 0 0\n1 1 0\np 3\n0 0 0\n1 1 0\n0 1 1\n\
         pp 3\n0 0 0 0 0 1\n1 0 0 0 1 1\n0 1 0 1 0 1\nf 0 0 0 0 0 0 0 0\ns 0.1 3e38 -7e-40 0.3\n"
    );
    let scene = nff(text).unwrap();
    let mut written = Vec::new();
    rt_scene::nff::write(&scene, &mut written).unwrap();
    let again = nff(&written).unwrap();
    // Triangles side by side may have come from a quadrilateral: their corners are then shared.
    let corners = |scene: &rt_scene::Scene| {
        let of = |t: &rt_scene::Triangle| t.position.map(|i| scene.mesh.positions[i as usize]);
        format!("{:?}", scene.mesh.triangles.iter().map(of).collect::<Vec<_>>())
    };
    assert_eq!(corners(&again), corners(&scene));
    assert_eq!(again.mesh.normals, scene.mesh.normals);
    assert_eq!(again.spheres, scene.spheres);
    assert_eq!(again.materials, scene.materials);
    assert_eq!((again.view, again.background), (scene.view, scene.background));
    assert_eq!(again.lights, scene.lights);
    assert!(again.facts.stated["polygon"] <= 3);
}

#[test]
fn an_obj_becomes_an_nff() {
    let scene = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 4 3 1\n").unwrap();
    let mut written = Vec::new();
    rt_scene::nff::write(&scene, &mut written).unwrap();
    let again = nff(&written).unwrap();
    assert_eq!(again.mesh.triangles.len(), 3);
    assert_eq!(again.facts.stated["polygon"], 2);
    assert_eq!(again.materials[0].diffuse, scene.materials[0].diffuse);
}

fn color() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(prop_oneof![0.0..2.0_f32, Just(0.0), Just(1e-45)]).prop_map(Vec3::from)
}

proptest! {
    #[test]
    fn written_colors_have_the_same_bits(
        diffuse in color(),
        grey in 0.0..1.0_f32,
        clear in 0.0..1.0_f32,
        ior in 0.5..3.0_f32,
        shininess in 0.0..1e6_f32,
        lights in prop::collection::vec(color(), 0..4),
    ) {
        let mut scene = nff("s 0.1 0.2 0.3 0.4").unwrap();
        let grey = Vec3::splat(grey);
        let name = String::new();
        let (specular, mirror, transmission) = (grey, grey, Vec3::splat(clear));
        let emission = Vec3::ZERO;
        scene.materials = vec![Material {
            name, diffuse, diffuse_map: None, specular, mirror, shininess, transmission, ior, fresnel: false, emission, one_sided: false
        }];
        scene.lights =
            lights.into_iter().map(|color| Light { position: color, color }).collect();
        scene.background = Some(diffuse);
        let mut written = Vec::new();
        rt_scene::nff::write(&scene, &mut written).unwrap();
        let again = nff(&written).unwrap();
        prop_assert_eq!(&again.materials, &scene.materials);
        prop_assert_eq!(&again.lights, &scene.lights);
        prop_assert_eq!((&again.spheres, again.background), (&scene.spheres, scene.background));
    }
}
