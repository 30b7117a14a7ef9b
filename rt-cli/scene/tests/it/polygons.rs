//! Polygons become triangles: their number, their areas, how they turn, and their edges.

use std::collections::HashMap;
use std::fmt::Write;

use proptest::prelude::*;
use rt_scene::Scene;

use crate::support::{double_area, obj};

type Point = [f64; 3];

/// One polygon as a scene: its corners are the vertices, in order.
fn scene(corners: &[Point]) -> Scene {
    let mut text = String::new();
    for [x, y, z] in corners {
        writeln!(text, "v {} {} {}", *x as f32, *y as f32, *z as f32).unwrap();
    }
    text += "f";
    for corner in 1..=corners.len() {
        write!(text, " {corner}").unwrap();
    }
    let scene = obj(text).unwrap();
    assert_eq!(scene.mesh.positions.len(), corners.len());
    scene
}

fn flat(corners: &[[f64; 2]]) -> Vec<Point> {
    corners.iter().map(|&[x, y]| [x, y, 0.0]).collect()
}

/// Twice the area vector, of corners as they are stored.
fn area_vector(scene: &Scene, corners: &[u32]) -> Point {
    let point = |corner: u32| scene.mesh.positions[corner as usize].to_array().map(f64::from);
    let origin = point(corners[0]);
    let mut sum = [0.0; 3];
    for (nth, &corner) in corners.iter().enumerate() {
        let [p, q] = [corner, corners[(nth + 1) % corners.len()]].map(point);
        let [p, q] = [p, q].map(|p| [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]]);
        for (axis, sum) in sum.iter_mut().enumerate() {
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            *sum += p[i] * q[j] - p[j] * q[i];
        }
    }
    sum
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// What must hold of a simple polygon in a plane.
#[track_caller]
fn check_simple(corners: &[Point]) {
    let scene = scene(corners);
    let triangles = &scene.mesh.triangles;
    let count = corners.len() as u32;
    assert_eq!(triangles.len(), corners.len() - 2);

    let whole = area_vector(&scene, &(0..count).collect::<Vec<_>>());
    let size = dot(whole, whole).sqrt();
    let mut sum = 0.0;
    for triangle in triangles {
        let area = dot(area_vector(&scene, &triangle.position), whole) / size;
        assert!(area >= -1e-6 * size, "{triangle:?} turns the other way: {area} of {size}");
        sum += double_area(&scene.mesh, triangle);
    }
    assert!((sum - size).abs() <= 1e-4 * size, "areas add up to {sum}, not {size}");
    check_edges(&scene, count);
}

/// Edges of the polygon are there once, as they run; other edges once in either direction.
#[track_caller]
fn check_edges(scene: &Scene, count: u32) {
    let mut edges: HashMap<(u32, u32), u32> = HashMap::new();
    for [a, b, c] in scene.mesh.triangles.iter().map(|triangle| triangle.position) {
        for edge in [(a, b), (b, c), (c, a)] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    for corner in 0..count {
        let edge = (corner, (corner + 1) % count);
        assert_eq!(edges.remove(&edge), Some(1), "edge {edge:?} of the polygon");
    }
    for (&(a, b), &times) in &edges {
        assert_eq!((times, edges.get(&(b, a))), (1, Some(&1)), "inner edge {a}-{b}");
    }
}

/// A polygon on a circle, its corners at these distances from the middle.
fn star(radii: &[f64]) -> Vec<[f64; 2]> {
    let turn = std::f64::consts::TAU / radii.len() as f64;
    let point = |(nth, radius): (usize, &f64)| {
        let angle = nth as f64 * turn;
        [radius * angle.cos(), radius * angle.sin()]
    };
    radii.iter().enumerate().map(point).collect()
}

fn comb(teeth: usize) -> Vec<[f64; 2]> {
    let tip = |n: usize| [n as f64, if n.is_multiple_of(2) { 10.0 } else { 1.0 }];
    (0..2 * teeth).rev().map(tip).chain([[0.0, 0.0], [(2 * teeth) as f64, 0.0]]).collect()
}

/// Steps along a square, with corners in the middle of its sides.
fn square_with_flat_corners(side: usize) -> Vec<[f64; 2]> {
    let s = side as f64;
    let place = |n: usize| match (n / side, (n % side) as f64) {
        (0, t) => [t, 0.0],
        (1, t) => [s, t],
        (2, t) => [s - t, s],
        (_, t) => [0.0, s - t],
    };
    (0..4 * side).map(place).collect()
}

#[test]
fn convex_quadrilaterals_are_cut_along_their_first_diagonal() {
    let scene = scene(&flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]));
    let positions: Vec<[u32; 3]> = scene.mesh.triangles.iter().map(|t| t.position).collect();
    assert_eq!(positions, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn concave_quadrilaterals() {
    let dart = [[0.0, 0.0], [4.0, -1.0], [1.0, 0.0], [4.0, 1.0]];
    for first in 0..4 {
        let mut corners = dart;
        corners.rotate_left(first);
        check_simple(&flat(&corners));
        corners.reverse();
        check_simple(&flat(&corners));
    }
}

#[test]
fn quadrilaterals_with_a_flat_corner() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 2.0]];
    for first in 0..4 {
        let mut corners = corners;
        corners.rotate_left(first);
        check_simple(&flat(&corners));
        let scene = scene(&flat(&corners));
        assert_eq!(scene.facts.warnings, Vec::<String>::new(), "no triangle is flat");
    }
}

#[test]
fn letters_stars_and_combs() {
    let l = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
    check_simple(&flat(&l));
    check_simple(&flat(&star(&[2.0, 0.5].repeat(5))));
    check_simple(&flat(&star(&[2.0, 0.01].repeat(50))));
    check_simple(&flat(&comb(40)));
}

#[test]
fn flat_corners_are_kept() {
    for side in [2, 3, 10, 50] {
        let corners = flat(&square_with_flat_corners(side));
        check_simple(&corners);
        let scene = scene(&corners);
        assert_eq!(scene.facts.warnings, Vec::<String>::new(), "no triangle is flat");
    }
    let all_on_one_side = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [4.0, 0.0], [1.0, 3.0]];
    check_simple(&flat(&all_on_one_side));
}

/// A square with a square hole, cut open: two edges run along each other.
#[test]
fn a_hole_reached_by_a_slit() {
    let corners = [
        [0.0, 0.0],
        [9.0, 0.0],
        [9.0, 9.0],
        [0.0, 9.0],
        [0.0, 0.0],
        [3.0, 3.0],
        [3.0, 6.0],
        [6.0, 6.0],
        [6.0, 3.0],
        [3.0, 3.0],
    ];
    let mut text = String::new();
    for [x, y] in corners {
        writeln!(text, "v {x} {y} 1").unwrap();
    }
    let scene = obj(text + "f 1 2 3 4 5 6 7 8 9 10").unwrap();
    assert_eq!(scene.mesh.triangles.len(), 8);
    let area: f64 = scene.mesh.triangles.iter().map(|t| double_area(&scene.mesh, t)).sum();
    assert_eq!(area / 2.0, 81.0 - 9.0);
    check_edges(&scene, 10);
}

#[test]
fn twenty_thousand_corners() {
    let circle = vec![1.0; 20_000];
    check_simple(&flat(&star(&circle)));
    // Corners of single precision, far out on long thin rays.
    let rays: Vec<f64> = (0..20_000).map(|n| 1.0 + f64::from(n * 7919 % 101) / 100.0).collect();
    check_simple(&flat(&star(&rays)));
    check_simple(&flat(&comb(10_000)));
    check_simple(&flat(&square_with_flat_corners(5_000)));
}

/// No input may take for ever: this one winds round itself and has no ear for long.
#[test]
fn a_large_polygon_that_crosses_itself() {
    let radii: Vec<f64> = (0..20_000).map(|n| 1.0 + f64::from(n * 7919 % 13) / 10.0).collect();
    let mut corners = star(&radii[..10_000]);
    corners.extend(star(&radii[10_000..]));
    let scene = scene(&flat(&corners));
    assert_eq!(scene.mesh.triangles.len(), 19_998);
    let warning = "1 polygon of no area or self-crossing: triangles may overlap";
    assert_eq!(scene.facts.warnings[0], warning);
}

#[test]
fn degenerate_polygons_lose_nothing() {
    for (corners, flat_triangles) in [
        (vec![[0.0, 0.0]; 6], 4),
        ((0..7).map(|n| [f64::from(n), 0.0]).collect(), 5),
        (vec![[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], 3),
        // A repeated corner, and a pentagram.
        (vec![[0.0, 0.0], [2.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]], 1),
        (vec![[0.0, 3.0], [1.9, -2.5], [-3.0, 1.0], [3.0, 1.0], [-1.9, -2.5]], 0),
    ] {
        let scene = scene(&flat(&corners));
        let triangles = &scene.mesh.triangles;
        assert_eq!(triangles.len(), corners.len() - 2);
        let seen = triangles.iter().filter(|t| double_area(&scene.mesh, t) > 0.0).count();
        assert_eq!(triangles.len() - seen, flat_triangles, "{corners:?}");
        let warning = "1 polygon of no area or self-crossing: triangles may overlap";
        assert_eq!(scene.facts.warnings[0], warning, "{corners:?}");
        assert!(scene.facts.skipped.is_empty());
    }
}

#[test]
fn in_every_plane_at_every_scale() {
    let shape = star(&[2.0, 0.7, 1.5].repeat(4));
    for [u, v] in [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
        [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.6, 0.8, 0.0], [-0.5, 0.3, 0.8]],
    ] {
        for (scale, offset) in
            [(1.0, 0.0), (1e-30, 0.0), (1e-18, 0.0), (1e18, 0.0), (1e37, 0.0), (1.0, 1e4)]
        {
            let place = |&[x, y]: &[f64; 2]| {
                [0, 1, 2].map(|axis| offset + scale * (x * u[axis] + y * v[axis]))
            };
            check_simple(&shape.iter().map(place).collect::<Vec<_>>());
        }
    }
}

/// A simple polygon through given points: two crossing edges are uncrossed until none are left.
/// Points are whole numbers, so that crossing is exact and many points lie on common lines.
fn uncrossed(mut points: Vec<[i64; 2]>) -> Option<Vec<[i64; 2]>> {
    let side = |a: [i64; 2], b: [i64; 2], c: [i64; 2]| {
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).signum()
    };
    let within = |a: [i64; 2], b: [i64; 2], c: [i64; 2]| {
        (0..2).all(|axis| a[axis].min(b[axis]) <= c[axis] && c[axis] <= a[axis].max(b[axis]))
    };
    let meet = |a, b, c, d| {
        let (abc, abd, cda, cdb) = (side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b));
        (abc * abd < 0 && cda * cdb < 0)
            || (abc == 0 && within(a, b, c))
            || (abd == 0 && within(a, b, d))
            || (cda == 0 && within(c, d, a))
            || (cdb == 0 && within(c, d, b))
    };
    let count = points.len();
    'again: for _ in 0..20 * count {
        for i in 0..count {
            for j in i + 1..count {
                let [a, b] = [points[i], points[(i + 1) % count]];
                let [c, d] = [points[j], points[(j + 1) % count]];
                let crossed = if j == i + 1 {
                    side(a, b, d) == 0 && (within(a, b, d) || within(c, d, a))
                } else if i == 0 && j == count - 1 {
                    side(c, d, b) == 0 && (within(c, d, b) || within(a, b, c))
                } else {
                    meet(a, b, c, d)
                };
                if crossed {
                    if j == i + 1 || (i == 0 && j == count - 1) {
                        return None;
                    }
                    points[i + 1..=j].reverse();
                    continue 'again;
                }
            }
        }
        return Some(points);
    }
    None
}

proptest! {
    #[test]
    fn star_shaped_polygons(
        radii in prop::collection::vec(0.1..1.0_f64, 3..60),
        offset in prop::sample::select(vec![0.0, 10.0, -1000.0]),
    ) {
        let place = |[x, y]: [f64; 2]| [offset + x, y, 0.5 * x - y];
        check_simple(&star(&radii).into_iter().map(place).collect::<Vec<_>>());
    }

    #[test]
    fn simple_polygons_through_grid_points(
        points in prop::collection::hash_set((0_i64..12, 0_i64..12), 4..24),
        reversed: bool,
    ) {
        let points = points.into_iter().map(|(x, y)| [x, y]).collect();
        if let Some(mut corners) = uncrossed(points) {
            if reversed {
                corners.reverse();
            }
            let corners: Vec<Point> =
                corners.iter().map(|&[x, y]| [x as f64, y as f64, (x + 2 * y) as f64]).collect();
            check_simple(&corners);
            prop_assert_eq!(scene(&corners).facts.warnings, Vec::<String>::new());
        }
    }

    #[test]
    fn any_polygon_at_all(
        points in prop::collection::vec((0_i8..4, 0_i8..4, 0_i8..2), 3..40),
    ) {
        let mut text = String::new();
        for (x, y, z) in &points {
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        text += "f";
        for corner in 1..=points.len() {
            write!(text, " {corner}").unwrap();
        }
        prop_assert_eq!(obj(text).unwrap().mesh.triangles.len(), points.len() - 2);
    }
}
