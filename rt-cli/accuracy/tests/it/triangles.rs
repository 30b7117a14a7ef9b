//! What kernels promise of accuracy, and what they are known to get wrong.
//!
//! A few thousand rays a family; `cargo test -p rt-tests million -- --ignored` shows each kernel a
//! million.

use std::collections::BTreeSet;

use glam::Vec3;
use rt_kernels::geom::Triangle;
use rt_kernels::tri::{Shape, TriangleTest, Way, catalogue};
use rt_kernels::{Accelerator, Brute, Exec, Hits, Primitives, Ray, Rays, Stats};
use rt_render::accuracy::{
    BATCH, CEILINGS, Ceiling, Family, Kind, Row, Setting, Subject, answers, measure, time,
};
use rt_tests::hash::fnv1a;
use rt_tests::random::Random;
use rt_tests::{rays, trace};
use simd4::Level;

/// The kernel that renders, every way it runs.
fn defaults() -> Vec<Subject> {
    let test = catalogue().into_iter().find(|test| test.is_default()).expect("a default");
    Way::all().into_iter().map(|way| Subject { test, way }).collect()
}

/// Every kernel, one way: packets at the best level, or else one ray at a time.
fn each_kernel() -> Vec<Subject> {
    let level = Level::best().expect("a level");
    let ways = [Shape::Rays, Shape::One].map(|shape| Way { level, shape });
    let runs = |test: &&'static dyn TriangleTest| {
        let way = ways.into_iter().find(|&way| test.runs(way) && !test.is_emulated(way));
        way.map(|way| Subject { test: *test, way })
    };
    catalogue().iter().filter_map(runs).collect()
}

fn per_million(count: u64, row: &Row) -> f64 {
    count as f64 * 1e6 / row.tally.rays as f64
}

/// What the kernel that renders promises, in one family.
fn check_default(row: &Row) {
    let (subject, family, tally) = (&row.subject, row.family, &row.tally);
    let case = format!("{subject:?}, {}, {:?}: {tally:?}", family.name, row.setting);
    assert_eq!((tally.leaks, tally.nan_hits), (0, 0), "{case}");
    if family.fair {
        assert!(tally.t_ulp.at(0.99) <= 4.0, "{case}");
    }
    match family.name {
        "band" => assert!(tally.band > 0.0 && tally.band <= 2.0, "{case}"),
        "spawned" => assert_eq!(tally.false_hits, 0, "{case}"),
        _ => {}
    }
}

#[test]
fn the_default_leaks_nothing_in_any_family_at_any_level() {
    for family in &Family::TRIANGLES {
        measure(&defaults(), family, family.setting, rays(8_192)).iter().for_each(check_default);
    }
}

/// All settings of all closed families.
#[test]
fn the_default_leaks_nothing_at_any_scale_or_distance() {
    let subject = each_kernel().into_iter().find(|subject| subject.test.is_default());
    for family in Family::TRIANGLES.iter().filter(|family| family.kind == Kind::Closed) {
        for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            for offset in [0.0, 1e3, 2.2e5, 1e6] {
                let setting = Setting { seed: 2, scale, offset };
                measure(subject.as_slice(), family, setting, rays(1_024)).iter().for_each(|row| {
                    assert_eq!((row.tally.leaks, row.tally.nan_hits), (0, 0), "{row:?}")
                });
            }
        }
    }
}

/// Every hit of every exact kernel has the same bits at all levels and in all shapes.
#[test]
fn exact_kernels_are_bit_equal_on_all_levels() {
    let ways = Way::all();
    for test in catalogue().into_iter().filter(|test| test.is_exact()) {
        for family in &Family::TRIANGLES {
            let of = |way| answers(&Subject { test, way }, family, &family.setting, rays(256));
            let want = of(ways[0]);
            for &way in ways[1..].iter().filter(|&&way| test.runs(way)) {
                let (got, subject) = (of(way), Subject { test, way });
                let differ = got.iter().zip(&want).filter(|(got, want)| got != want).count();
                assert_eq!(differ, 0, "{subject:?}, {}: of {} tests", family.name, want.len());
            }
        }
    }
}

/// The closest of many: the same as brute force with the kernel that renders, and the same in all
/// shapes with any that is exact.
#[test]
fn the_closest_of_many_is_the_same_in_every_shape() {
    let mut random = Random::new(51);
    for round in 0..rays(16) {
        // Twice each, so that there are ties; not a multiple of any number of lanes.
        let mut triangles: Vec<_> = (0..21 + round % 3)
            .map(|_| Triangle { corners: [(); 3].map(|()| random.in_cube()) })
            .collect();
        triangles.extend(triangles.clone());
        let batch: Rays = (0..BATCH + 3)
            .map(|_| {
                let origin = random.in_cube() * 3.0;
                let tmax = if random.below(3) == 0 { 1.0 } else { f32::INFINITY };
                Ray { tmax, ..Ray::new(origin, random.in_cube() - origin) }
            })
            .collect();
        let scene = Primitives { triangles: triangles.clone(), spheres: vec![] };
        let mut brute = Hits::new();
        let exec = Exec::best().expect("a level");
        let accel = Brute::build(&scene).expect("in range");
        accel.closest(exec, &batch, &mut brute, &mut Stats::default());
        for test in catalogue().into_iter().filter(|test| test.is_exact()) {
            let records = test.triangles(&triangles);
            let mut want = Hits::new();
            for (i, way) in Way::all().into_iter().filter(|&way| test.runs(way)).enumerate() {
                let mut got = Hits::new();
                test.closest(way, &records, &batch, &mut got);
                if i == 0 {
                    want = if test.is_default() { brute.clone() } else { got.clone() };
                }
                for i in 0..batch.len() {
                    let bits = |hits: &Hits| hits.get(i).map(trace::bits);
                    let subject = Subject { test, way };
                    assert_eq!(bits(&got), bits(&want), "{subject:?}: {:?}", batch.get(i));
                }
            }
        }
        assert!((0..batch.len()).any(|i| brute.get(i).is_some()), "nothing is hit");
    }
}

/// A family that the common test passes would have lost its teeth.
#[test]
fn moller_trumbore_fails_the_edge_family() {
    let single = |subject: &Subject| subject.test.name() == "moller-trumbore";
    let subjects: Vec<_> = each_kernel().into_iter().filter(single).collect();
    assert!(subjects.len() >= 4, "{subjects:?}");
    for name in ["edge", "vertex", "tiny", "far", "rotated grid"] {
        let family = Family::named(name).expect("a family");
        for row in measure(&subjects, family, family.setting, rays(8_192)) {
            assert!(per_million(row.tally.leaks, &row) > 5_000.0, "{name}: {row:?}");
        }
    }
    let nature = Family::named("random").expect("a family");
    for row in measure(&subjects, nature, nature.setting, rays(8_192)) {
        assert!(per_million(row.tally.leaks, &row) < 1_000.0, "by chance too: {row:?}");
    }
}

/// The worst of each kernel over the families.
fn worst(rows: &[Row]) -> [f64; 3] {
    let max = |value: &dyn Fn(&Row) -> f64| rows.iter().map(value).fold(0.0, f64::max);
    let near = |row: &&Row| row.setting.offset == 0.0;
    let near: Vec<_> = rows.iter().filter(near).filter(|row| row.family.fair).cloned().collect();
    [
        max(&|row| per_million(row.tally.leaks, row)),
        near.iter().map(|row| row.tally.t_ulp.at(0.99)).fold(0.0, f64::max),
        near.iter().map(|row| row.tally.band).fold(0.0, f64::max),
    ]
}

/// Every kernel in every family: what `check` is shown are its ceiling and its worst.
fn against_ceilings(n: usize, mut check: impl FnMut(&Subject, Ceiling, [f64; 3])) {
    let subjects = each_kernel();
    let mut rows = vec![Vec::new(); subjects.len()];
    for family in &Family::TRIANGLES {
        for (all, row) in rows.iter_mut().zip(measure(&subjects, family, family.setting, n)) {
            if row.subject.test.is_default() {
                check_default(&row);
            }
            all.push(row);
        }
    }
    for (subject, rows) in subjects.iter().zip(rows) {
        let (kernel, variant) = (subject.test.name(), subject.test.variant());
        let of = |ceiling: &&Ceiling| ceiling.kernel == kernel && ceiling.variant == variant;
        let ceiling = CEILINGS.iter().find(of);
        let ceiling = ceiling.unwrap_or_else(|| panic!("{subject:?} has no ceiling"));
        check(subject, *ceiling, worst(&rows));
    }
}

#[test]
fn no_kernel_is_worse_than_its_ceiling() {
    let n = rays(4_096);
    against_ceilings(n, |subject, ceiling, [leaks, t_p99, band]| {
        // Of fewer rays the share is less certain: by four standard deviations.
        let expected = ceiling.leaks / 1e6 * n as f64;
        let most = (expected + 4.0 * expected.sqrt()) * 1e6 / n as f64;
        assert!(leaks <= most.max(ceiling.leaks), "{subject:?}: {leaks} leaks, {ceiling:?}");
        assert!(t_p99 <= ceiling.t_p99 * 1.1, "{subject:?}: t {t_p99}, {ceiling:?}");
        assert!(band <= ceiling.band, "{subject:?}: band {band}, {ceiling:?}");
    });
}

/// Ceilings only go down: of a kernel that is exact, and so gives the same figures everywhere, they
/// are what it does, rounded up.
#[test]
#[ignore = "some minutes"]
fn ceilings_hold_for_a_million_rays() {
    let mut wrong = String::new();
    against_ceilings(1_000_000, |subject, ceiling, [leaks, t_p99, band]| {
        let Ceiling { kernel, variant, .. } = ceiling;
        let round = |value: f64, unit: f64| (value / unit).ceil() * unit;
        let now = [round(leaks, 10.0), round(t_p99, 0.1), round(band, 0.1)];
        let was = [ceiling.leaks, ceiling.t_p99, ceiling.band];
        let higher = now.iter().zip(was).any(|(now, was)| *now > was + 1e-6);
        let lower = now.iter().zip(was).any(|(now, was)| *now < was - 1e-6);
        if higher || lower && subject.test.is_exact() {
            let [leaks, t_p99, band] = now;
            wrong +=
                &format!("\n(\"{kernel}\", \"{variant}\", {leaks:.1}, {t_p99:.1}, {band:.1}),");
        }
    });
    assert!(wrong.is_empty(), "these are the figures now:{wrong}");
}

#[test]
fn the_catalogue_is_in_order() {
    let all = catalogue();
    let names: BTreeSet<_> = all.iter().map(|test| (test.name(), test.variant())).collect();
    assert_eq!(names.len(), all.len(), "two kernels of one name");
    assert_eq!(all.iter().filter(|test| test.is_default()).count(), 1);
    let ceilings: BTreeSet<_> =
        CEILINGS.iter().map(|ceiling| (ceiling.kernel, ceiling.variant.to_owned())).collect();
    assert_eq!(ceilings, names, "ceilings and catalogue");
}

/// The same inputs on every machine.
#[test]
fn families_are_the_same_everywhere() {
    let bits = |v: Vec3| v.to_array().into_iter().flat_map(|x| x.to_bits().to_le_bytes());
    let bytes = Family::TRIANGLES.iter().flat_map(|family| {
        let batches = (0..4).map(|i| family.batch(&family.setting, i));
        batches.flat_map(|batch| {
            let points = batch.triangles.iter().flat_map(|triangle| triangle.corners);
            let rays = (0..batch.rays.len()).map(|i| batch.rays.get(i));
            let rays = rays.flat_map(|ray| [ray.origin, ray.dir]);
            points.chain(rays).flat_map(bits).collect::<Vec<_>>()
        })
    });
    assert_eq!(fnv1a(bytes), 0, "new families: new figures");
}

/// Every way is timed.
#[test]
fn times_are_times() {
    for time in time(&defaults(), 3) {
        let ordered = 0.0 < time.least && time.least <= time.median && time.median <= time.greatest;
        assert!(ordered && time.greatest.is_finite(), "{time:?}");
    }
}
