//! Procedural scenes.

use rt_scene::spd;

use crate::support::nff;

#[test]
fn balls_come_in_sizes() {
    for (size, spheres) in [(0, 1), (1, 10), (2, 91), (3, 820), (4, 7381), (5, 66430)] {
        let scene = spd::generate("balls", Some(size)).unwrap();
        assert_eq!(scene.name, format!("spd:balls:{size}"));
        assert_eq!(scene.spheres.len(), spheres);
        assert_eq!(
            (scene.facts.stated["sphere"], scene.facts.stated["polygon"]),
            (spheres as u64, 1)
        );
        assert_eq!((scene.mesh.triangles.len(), scene.lights.len()), (2, 3));
        assert!(scene.facts.warnings.is_empty());
    }
    assert_eq!(spd::generate("balls", None).unwrap().spheres.len(), 7381);
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

/// Some spheres of the database as its own program prints them.
#[test]
fn balls_in_the_order_of_the_database() {
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
}

#[test]
fn balls_written_and_read_back() {
    let scene = spd::generate("balls", Some(2)).unwrap();
    let mut written = Vec::new();
    rt_scene::nff::write(&scene, &mut written).unwrap();
    let mut again = nff(&written).unwrap();
    again.name.clone_from(&scene.name);
    assert_eq!(format!("{again:?}"), format!("{scene:?}"));
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
