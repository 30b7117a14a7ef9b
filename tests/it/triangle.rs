//! The triangle kernel against volumes in `f64`.

use glam::Vec3;
use rt_kernels::geom::Triangle;
use rt_kernels::{Brute, Exec, Hit, Primitives, Ray, Rays};
use rt_tests::figures::Errors;
use rt_tests::oracle::{Meeting, ROUNDOFF, plane, ulps};
use rt_tests::random::Random;
use rt_tests::trace::{closest, ways};
use rt_tests::{aim, rays};

/// Rays to a triangle.
const BATCH: usize = 64;

fn hits(corners: [Vec3; 3], rays: &Rays, exec: Exec) -> Vec<Option<Hit>> {
    let scene = Primitives { triangles: vec![Triangle { corners }], ..Primitives::default() };
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

/// Hit or miss is decided as if the corners were within six roundoffs, of their distance to the
/// ray's origin, of their places. (Worst seen in 40 million: 1.15.)
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
        let roundoffs = meeting.outside.abs() / ROUNDOFF;
        assert!(!wrong || roundoffs < 2.0, "{got:?}, {meeting:?}, {ray:?}, {corners:?}");
        band = if wrong { band.max(roundoffs) } else { band };
        *(if got.is_some() { &mut hit } else { &mut missed }) += 1;
    });
    assert!(hit.min(missed) > rays(200_000), "{hit} hits and {missed} misses");
    assert!(band > 0.0, "nothing is ever in doubt: the rays are not aimed well");
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

/// Errors of `t`, in units in its last place, and of the weights, in roundoffs of the distance in
/// extents.
fn accuracy(center: Vec3) -> [Errors; 2] {
    let [mut t, mut weights] = [Errors::default(), Errors::default()];
    let triangle = |random: &mut Random| fair_triangle(center, random);
    with_random(22, 1_000_000, triangle, fair_ray, |corners, ray, hit| {
        let (Some(hit), Some(meeting)) = (hit, plane(&ray, corners)) else { return };
        let Meeting { t: exact, weights: [_, u, v], .. } = meeting;
        t.add(ulps(hit.t, exact));
        let distance = exact * ray.dir.as_dvec3().length();
        weights.add(
            (f64::from(hit.u) - u).abs().max((f64::from(hit.v) - v).abs()) / (ROUNDOFF * distance),
        );
    });
    assert!(t.count() > rays(900_000), "only {} hits", t.count());
    [t, weights]
}

/// Of 20 million: t p50 0.44, p99 2.5, maximum 7.0; weights p99 2.0, maximum 13.5.
#[test]
fn distances_and_weights_are_accurate() {
    let [t, weights] = accuracy(Vec3::ZERO);
    t.within("t", 3.0, 8.0);
    weights.within("weights", 3.0, 20.0);
}

/// The kernel sees a triangle from the ray's origin: the world's origin is nothing to it. (Of 20
/// million: t p50 0.58, p99 2.7, maximum 6.3; weights p99 1.5, maximum 11.4.)
#[test]
fn distances_and_weights_are_accurate_far_from_the_origin() {
    let [t, weights] = accuracy(Vec3::new(-1e5, 1e5, 1e4));
    t.within("t", 3.0, 8.0);
    weights.within("weights", 3.0, 20.0);
}

/// Both ends of the interval belong to it, both sides are hit, and `t` counts lengths of `dir`.
#[test]
fn intervals_are_closed() {
    let corners = [Vec3::new(0.0, 0.0, 8.0), Vec3::new(4.0, 0.0, 8.0), Vec3::new(0.0, 4.0, 8.0)];
    let ray = Ray::new(Vec3::new(1.0, 2.0, 0.0), Vec3::Z);
    let back = Ray::new(Vec3::new(1.0, 2.0, 16.0), Vec3::NEG_Z);
    let cases = [
        (ray, Some(8.0)),
        (back, Some(8.0)),
        (Ray { dir: Vec3::Z * 0.5, ..ray }, Some(16.0)),
        (Ray { tmin: 8.0, ..ray }, Some(8.0)),
        (Ray { tmin: 8f32.next_up(), ..ray }, None),
        (Ray { tmax: 8.0, ..ray }, Some(8.0)),
        (Ray { tmax: 8f32.next_down(), ..ray }, None),
        (Ray { tmin: 8.0, tmax: 8.0, ..ray }, Some(8.0)),
        (Ray { origin: Vec3::new(1.0, 2.0, 8.0), ..ray }, Some(0.0)),
        (Ray { origin: Vec3::new(1.0, 2.0, 8.0), tmax: 0.0, ..ray }, Some(0.0)),
        (Ray { dir: Vec3::NEG_Z, ..ray }, None),
        (Ray { origin: Vec3::new(3.0, 2.0, 0.0), ..ray }, None),
    ];
    let rays: Rays = cases.iter().map(|(ray, _)| *ray).collect();
    for exec in ways() {
        for (hit, (ray, want)) in hits(corners, &rays, exec).into_iter().zip(cases) {
            let want = want.map(|t| (t, 0.25, 0.5));
            assert_eq!(hit.map(|hit| (hit.t, hit.u, hit.v)), want, "{exec:?}: {ray:?}");
        }
    }
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

/// Corners on a line, or as near to it as numbers go, and rays along it: rounding may give such a
/// triangle an area, but what comes back makes sense.
#[test]
fn hits_of_triangles_without_area_make_sense() {
    let mut random = Random::new(24);
    for i in 0..rays(30_000) {
        let [mut a, mut b, mut c] = any_triangle(&mut random);
        match i % 3 {
            0 => {
                [a, b] = [a, b].map(Vec3::round);
                c = a + (b - a) * random.pick(&[2.0, 0.5, -1.0]);
            }
            1 => c = aim::between(a, b, random.unit()),
            _ => {
                let (axis, width) = (random.below(3), f32::from_bits(1 << random.below(28)));
                for corner in [&mut a, &mut b, &mut c] {
                    corner[axis] = width * random.signed().round();
                }
            }
        }
        let corners = [a, b, c];
        let rays: Rays = (0..16)
            .map(|j| {
                let target = aim::between(a, b, random.unit());
                let within = (b - a) * random.signed() + (c - a) * random.signed();
                let beside = random.direction() * random.magnitude(-4, 4);
                aim::at(target + if j % 2 == 0 { within * 4.0 } else { beside }, target)
            })
            .chain([aim::at(a, b), aim::at(a - (b - a), a), aim::at(c, b)])
            .collect();
        for (j, hit) in hits(corners, &rays, Exec::best().expect("a level")).iter().enumerate() {
            let Some(Hit { t, u, v, .. }) = *hit else { continue };
            let sound = t.is_finite() && t >= 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 + 1e-6;
            assert!(sound, "{hit:?} of {:?}, {corners:?}", rays.get(j));
        }
    }
}
