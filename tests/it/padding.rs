//! The own box takes no hit away.
//!
//! The kernel hits where its signs say so **and** the ray passes the triangle's own box. The box is
//! padded so that the second never matters: here against a naive test that has no box.

use glam::Vec3;
use rt_kernels::geom::Triangle;
use rt_kernels::{Brute, Exec, Primitives, Ray, Rays};
use rt_tests::oracle::{entry, woop};
use rt_tests::random::{Random, power};
use rt_tests::trace::closest;
use rt_tests::{aim, rays};

/// A triangle of one of the kinds that are hard on boxes, with an extent of about `size`.
fn triangle(kind: usize, size: f32, random: &mut Random) -> [Vec3; 3] {
    let mut corners = [(); 3].map(|()| random.in_cube() * size);
    let [a, b, c] = &mut corners;
    match kind {
        // As it comes.
        0 => {}
        // In a plane across an axis: its box is all padding there.
        1 => {
            let axis = random.below(3);
            (b[axis], c[axis]) = (a[axis], a[axis]);
        }
        // A needle, down to a few units in the last place wide.
        2 => *c = *b + random.in_cube() * (size * power(-(random.below(24) as i32))),
        // Three corners nearly on a line.
        3 => *c = aim::between(*a, *b, random.unit()) + random.in_cube() * (size * 1e-6),
        // A needle along an axis, perhaps thinner than the error of the kernel.
        4 => {
            let axis = random.below(3);
            let least = power(-40) / size;
            let width = power(-(random.below(36) as i32)).max(least);
            for corner in &mut corners {
                let along = corner[axis];
                *corner *= width;
                corner[axis] = along;
            }
        }
        // An edge along one axis or two, and one plane across another: sides of the box, and edges.
        5 => {
            let axis = random.below(3);
            // Where a coordinate is near 0, its last place is worth nothing.
            a[axis] *= random.pick(&[1.0, power(-12), 0.0]);
            b[axis] = a[axis];
            b[(axis + 1) % 3] = random.pick(&[*a, *b])[(axis + 1) % 3];
            c[(axis + 1) % 3] = random.pick(&[*a, *c])[(axis + 1) % 3];
        }
        // On a grid: exact differences, and edges that rays meet exactly.
        _ => corners = [(); 3].map(|()| (random.in_cube() * 4.0).round() * (size / 4.0)),
    }
    corners
}

/// A ray that barely hits or barely misses.
fn ray(corners: [Vec3; 3], random: &mut Random) -> Ray {
    let [a, b, c] = {
        let first = random.below(3);
        [0, 1, 2].map(|i| corners[(first + i) % 3])
    };
    let extent = (b - a).abs().max((c - a).abs()).max_element();
    let target = match random.below(6) {
        0 => a,
        1 => aim::between(a, b, random.unit()),
        2 => aim::between(aim::between(a, b, random.unit()), c, random.unit()),
        // Off an edge, by next to nothing up to a percent.
        3 => {
            aim::between(a, b, random.unit())
                + random.in_cube() * (extent * random.magnitude(-27, -7))
        }
        // Hardly off a corner or an edge: perhaps just outside the box.
        4 => {
            let axis = random.below(3);
            let mut target =
                if random.bits() & 1 == 0 { a } else { aim::between(a, b, random.unit()) };
            let (at, least) = (target[axis], extent * random.magnitude(-28, -23).abs());
            target[axis] =
                random.pick(&[at.next_up().max(at + least), at.next_down().min(at - least)]);
            target
        }
        _ => a + random.in_cube() * extent,
    };
    let origin = match random.below(10) {
        // On the triangle.
        0 => random.pick(&corners),
        1 => aim::between(a, c, random.unit()),
        // In its plane, or as near as rounding has it: seen from its edge.
        2 => a + (b - a) * random.magnitude(-2, 4) + (c - a) * random.magnitude(-2, 4),
        // Level with a target on one axis or two: directions with zeros, or nearly so.
        3 | 4 => {
            let axis = random.below(3);
            let mut origin = target;
            origin[axis] += extent * random.magnitude(-10, 20);
            if random.bits() & 1 == 0 {
                origin[(axis + 1) % 3] += extent * random.magnitude(-40, 0);
            }
            origin
        }
        // So near that corners are much farther away than the target is.
        5 | 6 => target + random.direction() * (extent * random.magnitude(-22, -2)),
        // From a thousandth of the extent to a million.
        _ => target + random.direction() * (extent * random.magnitude(-10, 20)),
    };
    let mut ray = aim::paced(aim::at(origin, target), random.below(5) as i32 - 2);
    if random.below(3) == 0 {
        // Past the target by less than a unit in the last place of its coordinates.
        ray.dir *= 1.0 + random.in_cube() * random.magnitude(-24, -12);
    }
    ray
}

/// Rays for which the naive test and the kernel could differ, by what they are.
#[derive(Default)]
struct Count {
    hits: usize,
    clamped: usize,
    greatest_share: f64,
}

/// Judges the kernel's hits of one triangle.
fn judge(corners: [Vec3; 3], rays: &Rays, exec: Exec, count: &mut Count) {
    let triangle = Triangle { corners };
    let scene = Primitives { triangles: vec![triangle], ..Primitives::default() };
    let brute = Brute::build(&scene).expect("in range");
    for (i, hit) in closest(&brute, exec, rays).into_iter().enumerate() {
        let ray = rays.get(i);
        let award = if ray.dir == Vec3::ZERO { None } else { woop(&ray, corners) };
        let Some(award) = award else {
            assert!(hit.is_none(), "{exec:?}: {hit:?}, but not by the signs: {ray:?}, {corners:?}");
            continue;
        };
        if award.t.abs() <= award.slack {
            continue; // At the very start of the ray: rounding decides whether it is ahead.
        }
        let Some(hit) = hit else {
            assert!(award.t < 0.0, "{exec:?}: {award:?} was taken away from {ray:?}, {corners:?}");
            continue;
        };
        count.hits += 1;
        let entry = entry(&ray, &triangle.own_box());
        let t = f64::from(hit.t);
        assert!(hit.t >= entry, "{exec:?}: {hit:?} before {entry}: {ray:?}, {corners:?}");
        if hit.t == entry {
            count.clamped += 1;
            let late = f64::from(entry) > award.t + award.slack + 1e-5 * award.t;
            assert!(!late, "{exec:?}: {hit:?} is behind {award:?}: {ray:?}, {corners:?}");
        } else {
            let share = (t - award.t).abs() / award.slack;
            count.greatest_share = count.greatest_share.max(share);
            assert!(share <= 1.0, "{exec:?}: {hit:?} is not at {award:?}: {ray:?}, {corners:?}");
        }
    }
}

/// Three million rays at fifty thousand triangles, from 2^-16 to 2^17 in size.
#[test]
fn own_boxes_take_no_hit_away() {
    let best = Exec::best().expect("a level");
    let mut random = Random::new(5);
    let mut count = Count::default();
    let batch = 64;
    for i in 0..rays(3_000_000) / batch {
        let size = random.magnitude(-16, 16).abs();
        let mut corners = triangle(i % 7, size, &mut random);
        // Near the origin, or far from it by up to a million extents.
        if random.bits() & 1 == 0 {
            let away = random.in_cube() * (size * random.magnitude(0, 19));
            corners = corners.map(|corner| corner + away);
        }
        let rays: Rays = (0..batch).map(|_| ray(corners, &mut random)).collect();
        judge(corners, &rays, best, &mut count);
    }
    let Count { hits, clamped, .. } = count;
    let all = rays(3_000_000);
    assert!(hits > all / 5, "only {hits} of {all} rays hit");
    assert!(clamped > 0, "no hit was held at the entry: the rays do not try the clamp");
}
