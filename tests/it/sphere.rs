//! The sphere kernel against the schoolbook in `f64`.

use glam::Vec3;
use rt_kernels::geom::Sphere;
use rt_kernels::{Brute, Exec, Hit, Primitives, Ray, Rays};
use rt_tests::figures::Errors;
use rt_tests::oracle::{ROUNDOFF, Roots, entry, sphere, ulps};
use rt_tests::random::Random;
use rt_tests::trace::{closest, closest_bits, ways};
use rt_tests::{aim, rays};

/// Rays to a sphere.
const BATCH: usize = 64;

/// Traces rays at random spheres, each with an origin that is `reach` radii from the centre and an
/// aim that is `off` radii off it, and shows each to `judge`.
fn with_random(
    seed: u64,
    n: usize,
    reach: impl Fn(&mut Random) -> f64,
    off: impl Fn(&mut Random) -> f64,
    mut judge: impl FnMut(f64, Ray, Roots, Option<Hit>),
) {
    let exec = Exec::best().expect("a level");
    let mut random = Random::new(seed);
    for _ in 0..rays(n).div_ceil(BATCH) {
        let radius = random.magnitude(-12, 12).abs();
        let center = random.in_cube() * (radius * random.pick(&[0.0, 1.0, 100.0]));
        let ball = Sphere { center, radius };
        let rays: Rays = (0..BATCH)
            .map(|_| {
                let (from, across) = (random.direction(), random.direction());
                let across = across.cross(from).normalize();
                let origin = center + from * (radius * reach(&mut random) as f32);
                let target = center + across * (radius * off(&mut random) as f32);
                aim::paced(aim::at(origin, target), random.below(9) as i32 - 4)
            })
            .collect();
        let scene = Primitives { spheres: vec![ball], ..Primitives::default() };
        let brute = Brute::build(&scene).expect("in range");
        for (i, hit) in closest(&brute, exec, &rays).into_iter().enumerate() {
            let ray = rays.get(i);
            let entry = entry(&ray, &ball.own_box());
            assert!(
                hit.is_none_or(|hit| hit.t >= entry),
                "{hit:?} before {entry}: {ray:?}, {ball:?}"
            );
            let distance = (ray.origin - center).as_dvec3().length() / f64::from(radius);
            judge(distance, ray, sphere(&ray, &ball), hit);
        }
    }
}

/// From 3 to 100,000 radii away.
fn outside(random: &mut Random) -> f64 {
    3.0 * 10f64.powf(4.5228 * random.unit())
}

/// Hit or miss is decided by the line's distance from the centre, which is off by a few roundoffs
/// of the way from the ray's origin, and by no more. (Worst seen in 40 million: 1.7.)
#[test]
fn hit_and_miss_are_right_but_for_a_band() {
    let mut band: f64 = 0.0;
    let (mut hit, mut missed) = (0, 0);
    let off = |random: &mut Random| 1.0 + f64::from(random.magnitude(-20, 1)).clamp(-1.0, 4.0);
    with_random(31, 2_000_000, outside, off, |distance, ray, roots, got| {
        let wrong = (roots.passes < 1.0) != got.is_some();
        let roundoffs = (roots.passes - 1.0).abs() / (distance * ROUNDOFF);
        assert!(
            !wrong || roundoffs < 2.5,
            "{got:?}, {roundoffs} roundoffs off: {ray:?}, {roots:?}"
        );
        band = if wrong { band.max(roundoffs) } else { band };
        *(if got.is_some() { &mut hit } else { &mut missed }) += 1;
    });
    assert!(hit.min(missed) > rays(500_000), "{hit} hits and {missed} misses");
    assert!(band > 0.0, "nothing is ever in doubt: the rays are not aimed well");
}

/// Errors of `t` from outside, in units in its last place, of rays that pass the centre by at most
/// `most` radii.
fn accuracy(most: f64) -> Errors {
    let mut t = Errors::default();
    let off = |random: &mut Random| most * random.unit();
    with_random(32, 500_000, outside, off, |_, ray, roots, hit| {
        if roots.passes <= most {
            let hit = hit.unwrap_or_else(|| panic!("{ray:?} misses, but passes by {roots:?}"));
            t.add(ulps(hit.t, roots.t[0]));
        }
    });
    t
}

/// From 3 to 100,000 radii. (Of 20 million: p50 0.71, p99 2.9, maximum 6.4.)
#[test]
fn distances_from_outside_are_accurate() {
    accuracy(0.9).within("t", 3.25, 8.0);
}

/// The worst is where the ray grazes. (Of 20 million: p50 0.72, p99 3.0, maximum 9.3.)
#[test]
fn distances_to_the_rim_are_accurate() {
    accuracy(0.99).within("t", 3.5, 12.0);
}

/// From inside, the far side is hit. (Of 20 million: p50 0.42, p99 1.7, maximum 4.1.)
#[test]
fn distances_from_inside_are_accurate() {
    let mut t = Errors::default();
    let inside = |random: &mut Random| 0.9 * random.unit();
    let off = |random: &mut Random| 2.0 * random.unit();
    with_random(33, 500_000, inside, off, |_, ray, roots, hit| {
        let hit = hit.unwrap_or_else(|| panic!("{ray:?} is inside and misses: {roots:?}"));
        t.add(ulps(hit.t, roots.t[1]));
    });
    t.within("t", 2.0, 6.0);
}

/// Near the surface, distances are off by a few roundoffs of the radius, which is much of so short
/// a way; from 64 roundoffs on either side, where a renderer's rays start, it is always the right
/// root that counts. (Of 5 million: p50 0.53, p99 3.8, maximum 8.3.)
#[test]
fn rays_from_near_the_surface_are_right() {
    let mut errors = Errors::default();
    let near = |random: &mut Random| 1.0 + f64::from(random.magnitude(-18, -4));
    let off = |random: &mut Random| 0.9 * random.unit();
    with_random(35, 500_000, near, off, |distance, ray, roots, hit| {
        if (distance - 1.0).abs() < 64.0 * ROUNDOFF {
            return;
        }
        // Ahead of the ray is the first root outside, and the second inside.
        let want = roots.t[usize::from(distance < 1.0)];
        let hit = hit.unwrap_or_else(|| panic!("{ray:?} misses, {roots:?}"));
        let radius = (roots.t[1] - roots.t[0]) / 2.0 / (1.0 - roots.passes * roots.passes).sqrt();
        errors.add((f64::from(hit.t) - want) / (radius * ROUNDOFF));
    });
    errors.within("t, in roundoffs of the radius", 4.5, 12.0);
}

/// Which root counts: the first that is not before `tmin`.
#[test]
fn roots_come_in_order() {
    let ball = Sphere { center: Vec3::new(0.0, 0.0, 8.0), radius: 2.0 };
    let scene = Primitives { spheres: vec![ball], ..Primitives::default() };
    let brute = Brute::build(&scene).expect("in range");
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    let cases = [
        (ray, Some(6.0)),
        (Ray { dir: Vec3::Z * 0.5, ..ray }, Some(12.0)),
        (Ray { tmin: 6.0, ..ray }, Some(6.0)),
        (Ray { tmin: 7.0, ..ray }, Some(10.0)),
        (Ray { tmin: 10.5, ..ray }, None),
        (Ray { tmax: 6.0, ..ray }, Some(6.0)),
        (Ray { tmax: 5.5, ..ray }, None),
        (Ray { tmin: 7.0, tmax: 9.0, ..ray }, None),
        (Ray { origin: ball.center, ..ray }, Some(2.0)),
        (Ray { origin: Vec3::new(0.0, 0.0, 9.0), ..ray }, Some(1.0)),
        (Ray { origin: Vec3::new(0.0, 0.0, 11.0), ..ray }, None),
        (Ray { dir: Vec3::NEG_Z, ..ray }, None),
        (Ray { origin: Vec3::new(0.0, 3.0, 0.0), ..ray }, None),
    ];
    let rays: Rays = cases.iter().map(|(ray, _)| *ray).collect();
    for exec in ways() {
        for (hit, (ray, want)) in closest(&brute, exec, &rays).into_iter().zip(cases) {
            assert_eq!(
                hit.map(|hit| (hit.t, hit.u, hit.v)),
                want.map(|t| (t, 0.0, 0.0)),
                "{exec:?}: {ray:?}"
            );
        }
    }
}

/// Spheres too small to be seen, spheres that hold all: what comes back is a number, or nothing.
#[test]
fn extreme_spheres_make_sense() {
    let mut random = Random::new(34);
    for _ in 0..rays(20_000) {
        let radius = random.magnitude(-40, 38).abs();
        let center = random.in_cube() * random.magnitude(-30, 38);
        let scene =
            Primitives { spheres: vec![Sphere { center, radius }], ..Primitives::default() };
        let brute = Brute::build(&scene).expect("in range");
        let rays: Rays = (0..9)
            .map(|i| {
                let target = center + random.direction() * radius * (i % 3) as f32;
                let origin = target + random.direction() * random.magnitude(-20, 38);
                aim::paced(aim::at(origin, target), random.below(37) as i32 - 19)
            })
            .collect();
        let want = closest_bits(&brute, ways()[0], &rays);
        for exec in ways() {
            assert_eq!(closest_bits(&brute, exec, &rays), want, "{exec:?}");
        }
        for (i, hit) in closest(&brute, ways()[0], &rays).into_iter().enumerate() {
            let sound = hit.is_none_or(|hit| hit.t.is_finite() && hit.t >= 0.0);
            assert!(sound, "{hit:?} of {:?}, {radius} at {center}", rays.get(i));
        }
    }
}
