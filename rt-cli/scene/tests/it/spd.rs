//! Procedural scenes.

use glam::Vec3;
use rt_scene::spd;

use crate::support::nff;

#[test]
fn scenes_come_in_sizes() {
    let balls = |size: u32| vec![("polygon", 1), ("sphere", (9_u64.pow(size + 1) - 1) / 8)];
    let rings = |size: u32| {
        let pieces = u64::from(5 * size * (size + 1) * (2 * size + 1));
        vec![("cylinder", pieces), ("polygon", 1), ("sphere", pieces)]
    };
    let tree = |size: u32| {
        let branches = (1 << (size + 1)) - 1;
        vec![("cone", branches), ("polygon", 1), ("sphere", branches)]
    };
    type Counts<'a> = &'a dyn Fn(u32) -> Vec<(&'static str, u64)>;
    let scenes: [(&str, &[u32], Counts<'_>); 3] = [
        ("balls", &[0, 1, 2, 3, 4, 5], &balls),
        ("rings", &[1, 2, 3, 7], &rings),
        ("tree", &[0, 1, 2, 8, 11, 12], &tree),
    ];
    for (name, sizes, counts) in scenes {
        for &size in sizes {
            let scene = spd::generate(name, Some(size)).unwrap();
            assert_eq!(scene.name, format!("spd:{name}:{size}"));
            assert_eq!(scene.facts.stated.into_iter().collect::<Vec<_>>(), counts(size));
            assert!(scene.facts.warnings.is_empty());
        }
    }
    assert_eq!(spd::generate("balls", None).unwrap().spheres.len(), 7381);
    assert_eq!(spd::generate("rings", None).unwrap().cones.len(), 4200);
    assert_eq!(spd::generate("tree", None).unwrap().cones.len(), 4095);
}

/// Children touch their parent, and no sphere is larger than it should be.
#[test]
fn balls_touch() {
    let scene = spd::generate("balls", Some(2)).unwrap();
    let gap = |a: usize, b: usize| {
        let (a, b) = (scene.spheres[a], scene.spheres[b]);
        a.center.distance(b.center) - a.radius - b.radius
    };
    for child in 0..9 {
        let child = 1 + child * 10;
        assert!(gap(0, child).abs() < 1e-6);
        for grandchild in 1..=9 {
            assert!(gap(child, child + grandchild).abs() < 1e-6);
        }
    }
}

/// Some spheres and cones of each database as its own program prints them.
#[test]
fn primitives_in_the_order_of_the_databases() {
    let scene = spd::generate("balls", Some(3)).unwrap();
    for (nth, center) in [
        (1, [0.272166, 0.272166, 0.544331]),
        (2, [0.420314, 0.420314, 0.618405]),
        (4, [0.461623, 0.409245, 0.557924]),
        (12, [0.461844, 0.304709, 0.43322]),
        (13, [0.492085, 0.33495, 0.372739]),
        (1 + 3 * 91, [-0.371785, 0.0996195, 0.544331]),
        (1 + 8 * 91, [0.471405, -0.471405, 0.0]),
    ] {
        let found = scene.spheres[nth].center;
        assert!(found.abs_diff_eq(center.into(), 1e-5), "sphere {nth} is at {found}");
    }
    for (name, size, nth, [base, apex], radii, sphere) in [
        (
            "rings",
            3,
            166,
            [[-2.28769, 7.4434, -1.20805], [-2.93099, 7.83938, -2.0]],
            [0.07412, 0.07412],
            None,
        ),
        (
            "tree",
            8,
            3,
            [[0.625853, 0.271578, 1.74586], [0.594216, 0.406804, 1.98278]],
            [0.0451145, 0.0302267],
            None,
        ),
        (
            "tree",
            8,
            166,
            [[0.951713, -0.727962, 2.11686], [0.957196, -0.759444, 2.13542]],
            [0.00609102, 0.00408098],
            Some((419, [-0.0082508, 0.986386, 2.39319, 0.00909107])),
        ),
    ] {
        let scene = spd::generate(name, Some(size)).unwrap();
        let cone = scene.cones[nth];
        let near = |a: Vec3, b: [f32; 3]| a.abs_diff_eq(b.into(), 1e-5);
        assert!(near(cone.base, base) && near(cone.apex, apex), "{name}: {cone:?}");
        let [base_radius, apex_radius] = radii;
        assert!((cone.base_radius - base_radius).abs() < 1e-6, "{name}: {cone:?}");
        assert!((cone.apex_radius - apex_radius).abs() < 1e-6, "{name}: {cone:?}");
        if let Some((nth, [x, y, z, radius])) = sphere {
            let sphere = scene.spheres[nth];
            assert!(near(sphere.center, [x, y, z]), "{name}: {sphere:?}");
            assert!((sphere.radius - radius).abs() < 1e-6, "{name}: {sphere:?}");
        }
    }
}

#[test]
fn written_and_read_back() {
    for procedure in spd::PROCEDURES {
        let scene = spd::generate(procedure.name, Some(2)).unwrap();
        let mut written = Vec::new();
        rt_scene::nff::write(&scene, &mut written).unwrap();
        let mut again = nff(&written).unwrap();
        again.name.clone_from(&scene.name);
        assert_eq!(format!("{again:?}"), format!("{scene:?}"));
    }
    let scene = spd::generate("balls", Some(2)).unwrap();
    let mut written = Vec::new();
    rt_scene::nff::write(&scene, &mut written).unwrap();
    let text = String::from_utf8(written).unwrap();
    let floor = "f 1 0.75 0.33 0.8 0 100000 0 1";
    let balls = "f 1 0.9 0.7 0.5 0.5 3.0827 0 1";
    for line in ["l 4 3 2", floor, "p 4", "12 12 -0.5", balls, "s 0 0 0 0.5"] {
        assert!(text.lines().any(|found| found == line), "no line {line}");
    }
}

#[test]
fn the_list_of_procedures_is_good() {
    for procedure in spd::PROCEDURES {
        assert!(procedure.sizes.0 <= procedure.default_size);
        assert!(procedure.default_size <= procedure.sizes.1);
        let scene = spd::generate(procedure.name, Some(procedure.sizes.0)).unwrap();
        assert!(scene.bounds().is_some(), "{}", procedure.about);
    }
}
