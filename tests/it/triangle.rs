//! The triangle kernel against volumes in `f64`.

use glam::Vec3;
use rt_kernels::geom::Triangle;
use rt_kernels::{Brute, Exec, Hit, Primitives, Ray, Rays};
use rt_tests::figures::Errors;
use rt_tests::oracle::{Meeting, ROUNDOFF, plane, ulps};
use rt_tests::random::{Random, power};
use rt_tests::trace::{closest, ways};
use rt_tests::{aim, rays};

/// Rays to a triangle.
const BATCH: usize = 64;

fn hits(corners: [Vec3; 3], rays: &Rays, exec: Exec) -> Vec<Option<Hit>> {
    let scene = Primitives { triangles: vec![Triangle { corners }], spheres: vec![] };
    closest(&Brute::build(&scene).expect("in range"), exec, rays)
}

/// Traces rays at random triangles and shows each to `judge`: the triangle's corners, the ray and
/// the hit.
fn with_random(
    seed: u64,
    n: usize,
    triangle: impl Fn(&mut Random) -> [Vec3; 3],
    ray: impl Fn([Vec3; 3], &mut Random) -> Ray,
    mut judge: impl FnMut([Vec3; 3], Ray, Option<Hit>),
) {
    let exec = Exec::best().expect("a level");
    let mut random = Random::new(seed);
    for _ in 0..rays(n).div_ceil(BATCH) {
        let corners = triangle(&mut random);
        let rays: Rays = (0..BATCH).map(|_| ray(corners, &mut random)).collect();
        for (i, hit) in hits(corners, &rays, exec).into_iter().enumerate() {
            judge(corners, rays.get(i), hit);
        }
    }
}

/// A triangle of any shape and size, at any distance from the world's origin.
fn any_triangle(random: &mut Random) -> [Vec3; 3] {
    let size = random.magnitude(-12, 12).abs();
    let offset = random.in_cube() * (size * random.pick(&[0.0, 1.0, 1e3, 1e6]));
    [(); 3].map(|()| random.in_cube() * size + offset)
}

/// Near an edge, from hardly at all up to the whole extent, from a tenth to a thousand extents away.
fn ray_near_edge([a, b, c]: [Vec3; 3], random: &mut Random) -> Ray {
    let extent = (b - a).abs().max((c - a).abs()).max_element();
    let off = random.direction() * (extent * random.magnitude(-27, 0));
    let target = aim::between(a, b, random.unit()) + off;
    aim::at(target + random.direction() * (extent * random.magnitude(-3, 10)), target)
}

/// Hit or miss is decided as if the corners were within six roundoffs of their places, of their
/// distance to the origin: here it is seen, for the edges, that this is so, and how near it comes.
#[test]
fn hit_and_miss_are_right_but_for_a_band() {
    let mut band: f64 = 0.0;
    let (mut hit, mut missed) = (0, 0);
    with_random(21, 2_000_000, any_triangle, ray_near_edge, |corners, ray, got| {
        let Some(meeting) = plane(&ray, corners) else { return };
        if meeting.t <= 0.0 {
            return; // Behind, or all but: not the edges' business.
        }
        let wrong = (meeting.outside > 0.0) == got.is_some();
        if wrong {
            band = band.max(meeting.outside.abs() / ROUNDOFF);
        }
        *(if got.is_some() { &mut hit } else { &mut missed }) += 1;
        let limit = 6.0 * ROUNDOFF;
        assert!(!wrong || meeting.outside.abs() < limit, "{got:?}, {meeting:?}, {ray:?}, {corners:?}");
    });
    assert!(hit.min(missed) > rays(200_000), "{hit} hits and {missed} misses");
    assert!(band > 0.0, "nothing is ever in doubt: the rays are not aimed well");
    println!("band {band}");
}

/// A triangle of extent near 1 with no sharp corner, about `center`.
fn fair_triangle(center: Vec3, random: &mut Random) -> [Vec3; 3] {
    loop {
        let corners = [(); 3].map(|()| random.in_cube() + center);
        let [a, b, c] = corners.map(|corner| corner.as_dvec3());
        if (b - a).cross(c - a).length() > 0.5 {
            return corners;
        }
    }
}

/// The inside of a triangle, from two to a hundred extents away, not too much from its edge.
fn fair_ray([a, b, c]: [Vec3; 3], random: &mut Random) -> Ray {
    let target = aim::between(aim::between(a, b, random.unit()), c, random.unit());
    loop {
        let origin = target + random.direction() * random.magnitude(1, 6).abs();
        let ray = aim::paced(aim::at(origin, target), random.below(9) as i32 - 4);
        if plane(&ray, [a, b, c]).is_some_and(|meeting| meeting.cosine > 0.25) {
            return ray;
        }
    }
}

/// Errors of `t`, in units in its last place, and of the weights, in roundoffs.
fn accuracy(center: Vec3) -> [Errors; 2] {
    let [mut t, mut weights] = [Errors::default(), Errors::default()];
    let triangle = |random: &mut Random| fair_triangle(center, random);
    with_random(22, 1_000_000, triangle, fair_ray, |corners, ray, hit| {
        let (Some(hit), Some(meeting)) = (hit, plane(&ray, corners)) else { return };
        let Meeting { t: exact, weights: [_, u, v], .. } = meeting;
        t.add(ulps(hit.t, exact));
        let distance = exact * ray.dir.as_dvec3().length();
        weights.add((f64::from(hit.u) - u).abs().max((f64::from(hit.v) - v).abs()) / (ROUNDOFF * distance));
    });
    assert!(t.count() > rays(900_000), "only {} hits", t.count());
    [t, weights]
}

#[test]
fn distances_and_weights_are_accurate() {
    let [t, weights] = accuracy(Vec3::ZERO);
    t.clone().within("t", 9.0, 90.0);
    weights.within("weights", 4.0, 16.0);
}

/// The kernel sees the triangle from the ray's origin: the world's origin is nothing to it.
#[test]
fn distances_and_weights_are_accurate_far_from_the_origin() {
    let [t, weights] = accuracy(Vec3::new(-1e5, 1e5, 1e4));
    t.clone().within("t", 9.0, 90.0);
    weights.within("weights", 4.0, 16.0);
}

/// With two equal corners or three, a triangle is never hit, wherever the ray comes from.
#[test]
fn triangles_with_equal_corners_are_never_hit() {
    let mut random = Random::new(23);
    for i in 0..rays(20_000) {
        let [a, b, _] = any_triangle(&mut random);
        let corners = [[a, a, b], [a, b, a], [b, a, a], [a, a, a]][i % 4];
        let rays: Rays = (0..9)
            .map(|_| {
                let target = aim::between(a, b, random.unit());
                aim::at(target + random.direction() * random.magnitude(-4, 4), target)
            })
            .chain([aim::at(a, b), aim::at(b, a), aim::at(a - (b - a), a)])
            .collect();
        for exec in ways() {
            let hits = hits(corners, &rays, exec);
            assert!(hits.iter().all(Option::is_none), "{exec:?}: {hits:?} of {corners:?}");
        }
    }
}

/// Corners on a line, and rays in the triangle's plane: hit or not, what comes back makes sense.
#[test]
fn hits_of_degenerate_triangles_make_sense() {
    let mut random = Random::new(24);
    let (mut hit, mut exact_hit) = (0, 0);
    for i in 0..rays(20_000) {
        let [mut a, mut b, _] = any_triangle(&mut random);
        let c;
        if i % 2 == 0 {
            [a, b] = [a, b].map(|v| (v * power(-12)).round());
            c = a + (b - a) * random.pick(&[2.0, 0.5, -1.0]);
        } else {
            c = aim::between(a, b, random.unit());
        }
        let corners = [a, b, c];
        let rays: Rays = (0..16)
            .map(|_| {
                let target = aim::between(a, b, random.unit());
                aim::at(target + random.direction() * random.magnitude(-4, 4), target)
            })
            .chain([aim::at(a, b), aim::at(a - (b - a), a), aim::at(c, b)])
            .collect();
        for (j, got) in hits(corners, &rays, Exec::best().expect("a level")).iter().enumerate() {
            let Some(got) = got else { continue };
            hit += 1;
            if i % 2 == 0 { exact_hit += 1; }
            let sound = got.t.is_finite() && got.t >= 0.0 && got.u >= 0.0 && got.v >= 0.0 && got.u + got.v <= 1.0 + 1e-6;
            assert!(sound, "{got:?} of {:?}, {corners:?}", rays.get(j));
        }
    }
    println!("degenerate hits {hit} {exact_hit}");
}
