//! The cone kernel against the schoolbook in `f64`.

use glam::{DVec3, Quat, Vec3};
use rt_kernels::geom::Cone;
use rt_kernels::{Brute, Exec, Hit, Primitives, Ray, Rays};
use rt_tests::oracle::{self, Encounter, ROUNDOFF, entry};
use rt_tests::random::Random;
use rt_tests::trace::{closest, closest_bits, ways};
use rt_tests::{aim, rays};

/// Rays to a cone.
const BATCH: usize = 64;

/// How wide a band may be, in roundoffs.
const BAND: f64 = 32.0;

/// Cylinders, cones with two ends and with one, from needles to rings; near the origin and not.
fn random_cone(random: &mut Random) -> Cone {
    let size = random.magnitude(-12, 12).abs();
    let base = random.in_cube() * (size * random.pick(&[0.0, 1.0, 100.0]));
    let apex = base + random.direction() * size * random.pick(&[1.0, 0.03, 1.0]);
    let mut radius = || size * random.pick(&[1.0, 0.3, 0.01]) * random.unit() as f32;
    let (a, b) = (radius(), radius());
    let [base_radius, apex_radius] = random.pick(&[[a, a], [a, b], [a, 0.0], [0.0, b]]);
    Cone { base, base_radius, apex, apex_radius }
}

fn size(cone: &Cone) -> f32 {
    cone.base.distance(cone.apex) + cone.base_radius.max(cone.apex_radius)
}

/// A point on the mantle, or up to `off` of its size beside it.
fn target(cone: &Cone, off: f32, random: &mut Random) -> Vec3 {
    let inside = random.unit() as f32;
    let share = random.pick(&[0.0, 1.0, inside, inside]);
    let axis = (cone.apex - cone.base).normalize();
    let out = random.direction().reject_from(axis).normalize_or(axis.any_orthonormal_vector());
    let radius = cone.base_radius + (cone.apex_radius - cone.base_radius) * share;
    let beside = size(cone) * off * random.signed();
    cone.base + (cone.apex - cone.base) * share + out * (radius + beside)
}

/// A roundoff of the way to the cone and of its size.
fn roundoff(ray: &Ray, cone: &Cone) -> f64 {
    let way = (ray.origin - cone.base).as_dvec3().length();
    ROUNDOFF * (way + f64::from(size(cone)))
}

/// What may be said of a ray, by rays beside it: they are moved by so many roundoffs of the way and
/// of the cone's size. `None` if they do not agree on whether they hit, or pass on different sides;
/// the least and the greatest `t` if they hit.
fn judge(ray: &Ray, cone: &Cone, roundoffs: f64) -> Option<Option<[f64; 2]>> {
    let band = roundoffs * roundoff(ray, cone);
    let steps = [0.0, band, -band];
    let moves = steps.into_iter().flat_map(|x| {
        steps.into_iter().flat_map(move |y| steps.into_iter().map(move |z| DVec3::new(x, y, z)))
    });
    let mut encounters = moves.map(|moved| oracle::cone(ray, moved, cone));
    let first = encounters.next()?;
    let range = first.t.map(|t| [t; 2]);
    encounters.try_fold(range, |range, Encounter { t, inside }| match (range, t) {
        (None, None) if inside == first.inside => Some(None),
        (Some([low, high]), Some(t)) => Some(Some([low.min(t), high.max(t)])),
        _ => None,
    })
}

/// Whether rays beside it say nothing of a ray: where a band is as wide as the cone, as near the tip,
/// where also both halves of a double cone meet.
fn is_too_thin(ray: &Ray, cone: &Cone) -> bool {
    let band = BAND * roundoff(ray, cone);
    let [size, widest] = [size(cone), cone.base_radius.max(cone.apex_radius)].map(f64::from);
    let reach = size / widest * (1e-3 * size + band);
    let near = |tip: Vec3, radius: f32| {
        let off = (tip - ray.origin).as_dvec3().reject_from(ray.dir.as_dvec3()).length();
        let radius = f64::from(radius);
        radius < 0.02 * size && off < reach + 2.0 * radius
    };
    let tips = near(cone.base, cone.base_radius) || near(cone.apex, cone.apex_radius);
    widest < band || cone.base_radius != cone.apex_radius && tips
}

/// Traces rays at random cones, from up to 10,000 of their sizes away, and from within, and shows
/// each to `look`.
fn with_random(seed: u64, n: usize, off: f32, mut look: impl FnMut(Cone, Ray, Option<Hit>)) {
    let exec = Exec::best().expect("a level");
    let mut random = Random::new(seed);
    for _ in 0..rays(n).div_ceil(BATCH) {
        let cone = random_cone(&mut random);
        let rays: Rays = (0..BATCH)
            .map(|_| {
                let away = random.pick(&[0.3, 2.0, 100.0, 1e4]) * random.unit() as f32;
                let origin = cone.base + random.direction() * size(&cone) * away;
                let target = target(&cone, off, &mut random);
                let origin = match random.below(8) {
                    // Along the axis.
                    0 => target + (cone.apex - cone.base) * (away + 1.0),
                    _ => origin,
                };
                aim::paced(aim::at(origin, target), random.below(9) as i32 - 4)
            })
            .collect();
        let scene = Primitives { cones: vec![cone], ..Primitives::default() };
        let brute = Brute::build(&scene).expect("in range");
        for (i, hit) in closest(&brute, exec, &rays).into_iter().enumerate() {
            look(cone, rays.get(i), hit);
        }
    }
}

/// All that the kernel says is true of a ray that differs from the one that was asked about by no
/// more than a band. (So of 7 million.)
#[test]
fn hits_are_right_but_for_a_band() {
    let mut near = 0;
    for off in [0.3, 1e-3, 1e-6] {
        let (mut hits, mut misses) = (0, 0);
        with_random(51, 300_000, off, |cone, ray, hit| {
            let wrong = |roundoffs| match (judge(&ray, &cone, roundoffs), hit) {
                (None, _) | (Some(None), None) => false,
                (Some(Some([low, high])), Some(hit)) => {
                    let (t, slack) = (f64::from(hit.t), 16.0 * ROUNDOFF * f64::from(hit.t));
                    t < low - slack || t > high + slack
                }
                _ => true,
            };
            if is_too_thin(&ray, &cone) {
                return;
            }
            let [least, bands @ ..] = [0.25, 1.0, 4.0, 16.0, BAND].map(wrong);
            let judged = judge(&ray, &cone, 1.0);
            assert!(!bands.iter().all(|wrong| *wrong), "{hit:?}: {ray:?}, {cone:?}, {judged:?}");
            near += usize::from(least);
            match judge(&ray, &cone, BAND) {
                None => {}
                Some(None) => misses += 1,
                Some(Some(_)) => hits += 1,
            }
        });
        assert!(hits > rays(100_000), "only {hits} rays surely hit at {off}");
        assert!(misses > rays(1_000), "only {misses} surely miss at {off}");
    }
    assert!(near > 0, "nothing is ever in doubt: the rays are not aimed well");
}

/// Which root counts: the first on the mantle that is not before `tmin`. There are no caps.
#[test]
fn roots_come_in_order() {
    let cylinder =
        Cone { base: Vec3::ZERO, base_radius: 2.0, apex: Vec3::Y * 4.0, apex_radius: 2.0 };
    let cone = Cone { apex_radius: 0.0, ..cylinder };
    let at = |x: f32, y: f32| Ray::new(Vec3::new(x, y, 0.0), Vec3::NEG_X);
    let across = at(8.0, 1.0);
    let down = Ray { dir: Vec3::NEG_Y, ..at(1.0, 9.0) };
    let slanted = Ray { dir: Vec3::new(-1.0, -1.0, 0.0), ..at(4.0, 6.0) };
    let cases = [
        (cylinder, across, Some(6.0)),
        (cylinder, Ray { dir: Vec3::NEG_X * 0.5, ..across }, Some(12.0)),
        (cylinder, Ray { tmin: 6.0, ..across }, Some(6.0)),
        (cylinder, Ray { tmin: 7.0, ..across }, Some(10.0)),
        (cylinder, Ray { tmin: 10.5, ..across }, None),
        (cylinder, Ray { tmax: 6.0, ..across }, Some(6.0)),
        (cylinder, Ray { tmax: 5.5, ..across }, None),
        (cylinder, at(8.0, 0.0), Some(6.0)),
        (cylinder, at(8.0, 4.0), Some(6.0)),
        (cylinder, at(8.0, 4.5), None),
        (cylinder, at(8.0, -0.5), None),
        (cylinder, at(0.0, 1.0), Some(2.0)),
        (cylinder, at(-3.0, 1.0), None),
        (cylinder, Ray { origin: Vec3::new(8.0, 1.0, 2.5), ..across }, None),
        (cylinder, down, None),
        // In through an end, out through the mantle.
        (cylinder, slanted, Some(2.0)),
        (cylinder, Ray { origin: Vec3::new(3.0, 6.0, 0.0), ..slanted }, Some(5.0)),
        (cone, across, Some(6.5)),
        (cone, Ray { tmin: 7.0, ..across }, Some(9.5)),
        // Where the other half of the double cone is.
        (cone, at(8.0, 5.0), None),
        (cone, down, Some(7.0)),
        (cone, Ray { dir: Vec3::Y, ..at(1.0, -1.0) }, Some(3.0)),
        // Along one side, into the other.
        (cone, Ray { dir: Vec3::new(-1.0, 2.0, 0.0), ..at(1.0, -1.0) }, Some(1.75)),
    ];
    for (cone, ray, want) in cases {
        for turn in [Quat::IDENTITY, Quat::from_xyzw(0.5, 0.5, 0.5, 0.5)] {
            let cone = Cone { base: turn * cone.base, apex: turn * cone.apex, ..cone };
            let ray = Ray { origin: turn * ray.origin, dir: turn * ray.dir, ..ray };
            let upside_down = Cone {
                base: cone.apex,
                base_radius: cone.apex_radius,
                apex: cone.base,
                apex_radius: cone.base_radius,
            };
            for cone in [cone, upside_down] {
                let scene = Primitives { cones: vec![cone], ..Primitives::default() };
                let brute = Brute::build(&scene).expect("in range");
                for exec in ways() {
                    let hit = closest(&brute, exec, &[ray].into_iter().collect())[0];
                    let got = hit.map(|hit| (hit.t, hit.u, hit.v));
                    // The sine and cosine of the cone's angle are rounded, the cylinder's are not.
                    let near = |t: f32| got.is_some_and(|got| (got.0 - t).abs() <= 1e-6 * t);
                    assert!(
                        want.map_or(got.is_none(), near),
                        "{exec:?}: {got:?}, {ray:?}, {cone:?}"
                    );
                    assert!(got.is_none_or(|(_, u, v)| (u, v) == (0.0, 0.0)));
                }
            }
        }
    }
}

/// A hit is never before the entry into the own box, and that holds all of the mantle.
#[test]
fn own_boxes_hold_the_mantle() {
    let mut held = 0;
    with_random(52, 200_000, 1e-6, |cone, ray, hit| {
        let own_box = cone.own_box();
        let entry = entry(&ray, &own_box);
        assert!(hit.is_none_or(|hit| hit.t >= entry), "{hit:?} before {entry}: {ray:?}, {cone:?}");
        held += usize::from(hit.is_some_and(|hit| hit.t == entry));
        // Two roundoffs of where it is, and those of the point itself.
        let mut random = Random::new(ray.origin.x.to_bits().into());
        let point = target(&cone, 0.0, &mut random);
        let slack = 2.0 * f32::EPSILON * (point.abs() + size(&cone));
        let inside = point.cmpge(own_box.min() - slack) & point.cmple(own_box.max() + slack);
        assert!(inside.all(), "{point} is outside of {own_box:?}: {cone:?}");
    });
    let widest = Cone { base: Vec3::ZERO, base_radius: 3.0, apex: Vec3::Y, apex_radius: 1.0 };
    let extent = widest.own_box().extent();
    assert!(extent.abs_diff_eq(Vec3::new(6.0, 1.0, 6.0), 1e-4), "no larger than it need be");
}

/// Cones too small to be seen, cones that hold all: what comes back is a number, or nothing, and the
/// same every way.
#[test]
fn extreme_cones_make_sense() {
    let mut random = Random::new(54);
    for _ in 0..rays(20_000) {
        let size = random.magnitude(-40, 37).abs();
        let base = random.in_cube() * random.magnitude(-30, 37);
        let apex = base + random.direction() * size * random.magnitude(-20, 0);
        let mut radius = || size * random.pick(&[0.0, 1e-6, 0.5, 1.0]);
        let (base_radius, apex_radius) = (radius(), radius());
        if base == apex || base_radius.max(apex_radius) == 0.0 {
            continue;
        }
        let cone = Cone { base, base_radius, apex, apex_radius };
        let scene = Primitives { cones: vec![cone], ..Primitives::default() };
        let brute = Brute::build(&scene).expect("in range");
        let rays: Rays = (0..9)
            .map(|_| {
                let target = target(&cone, 0.1, &mut random);
                let origin = target + random.direction() * random.magnitude(-20, 37);
                aim::paced(aim::at(origin, target), random.below(37) as i32 - 19)
            })
            .collect();
        let want = closest_bits(&brute, ways()[0], &rays);
        for exec in ways() {
            assert_eq!(closest_bits(&brute, exec, &rays), want, "{exec:?}");
        }
        for (i, hit) in closest(&brute, ways()[0], &rays).into_iter().enumerate() {
            let sound = hit.is_none_or(|hit| hit.t.is_finite() && hit.t >= 0.0);
            assert!(sound, "{hit:?} of {:?}, {cone:?}", rays.get(i));
        }
    }
}
