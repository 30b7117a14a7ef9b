//! What the tests of curved surfaces promise, and what they are known to get wrong.
//!
//! A few thousand rays a family; `cargo test -p rt-tests million -- --ignored` shows each kernel a
//! million.

use std::collections::BTreeSet;

use rt_kernels::geom::Curved;
use rt_kernels::quadric::{QuadricTest, catalogue};
use rt_kernels::tri::{Shape, Way};
use rt_kernels::{Accelerator, Brute, Exec, Hits, Primitives, Rays, Stats};
use rt_render::accuracy::BATCH;
use rt_render::accuracy::quadrics::{
    self as accuracy, CEILINGS, Ceiling, Family, Row, Subject, answers, measure, time,
};
use rt_tests::random::Random;
use rt_tests::{aim, rays, trace};
use simd4::Level;

/// The test that renders, every way it runs.
fn defaults() -> Vec<Subject> {
    let test = catalogue().into_iter().find(|test| test.is_default()).expect("a default");
    Way::all().into_iter().map(|way| Subject { test, way }).collect()
}

/// Every kernel, one way: packets at the best level, or else one ray at a time.
fn each_kernel() -> Vec<Subject> {
    let level = Level::best().expect("a level");
    let ways = [Shape::Rays, Shape::One].map(|shape| Way { level, shape });
    let runs = |test: &&'static dyn QuadricTest| {
        let way = ways.into_iter().find(|&way| test.runs(way) && !test.is_emulated(way));
        way.map(|way| Subject { test: *test, way })
    };
    catalogue().iter().filter_map(runs).collect()
}

fn per_million(count: u64, row: &Row) -> f64 {
    count as f64 * 1e6 / row.tally.rays.max(1) as f64
}

/// Who touches the sphere is in doubt within the band; no one else is.
#[test]
fn the_default_is_right_but_for_the_band() {
    for family in Family::ALL.iter().filter(|family| family.shape == accuracy::Shape::Sphere) {
        for row in measure(&defaults(), family, family.setting, rays(16_384)) {
            let (subject, tally) = (&row.subject, &row.tally);
            let case = format!("{subject:?}, {}: {tally:?}", family.name);
            assert_eq!(tally.nan_hits, 0, "{case}");
            assert!(tally.band <= BAND, "{case}");
            if family.fair {
                assert!(tally.t_ulp.at(0.99) <= 4.0, "{case}");
            }
            if family.name != "grazing" && family.name != "near surface" {
                assert_eq!((tally.false_hits, tally.false_misses), (0, 0), "{case}");
            }
            assert!(tally.unsure * 1_000 < tally.rays, "{case}");
        }
    }
}

/// In units of the oracle's.
const BAND: f64 = 3.0;

/// Every kernel estimates nothing: all have the same bits everywhere.
#[test]
fn all_are_bit_equal_on_all_levels() {
    let ways = Way::all();
    for test in catalogue() {
        for family in &Family::ALL {
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
/// shapes with any.
#[test]
fn the_closest_of_many_is_the_same_in_every_shape() {
    let mut random = Random::new(53);
    for round in 0..rays(16) {
        // Twice each, so that there are ties; not a multiple of any number of lanes.
        let mut spheres: Vec<_> = (0..21 + round % 3)
            .map(|_| rt_kernels::geom::Sphere {
                center: random.in_cube(),
                radius: random.unit() as f32 * 0.5 + 0.01,
            })
            .collect();
        spheres.extend(spheres.clone());
        let surfaces: Vec<_> = spheres.iter().copied().map(Curved::Sphere).collect();
        let batch: Rays =
            (0..BATCH + 3).map(|_| aim::at(random.in_cube() * 3.0, random.in_cube())).collect();
        let mut brute = Hits::new();
        let scene = Primitives { triangles: vec![], spheres };
        let accel = Brute::build(&scene).expect("in range");
        let exec = Exec::best().expect("a level");
        accel.closest(exec, &batch, &mut brute, &mut Stats::default());
        for test in catalogue() {
            let records = test.surfaces(&surfaces).expect("spheres");
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

/// Families that these pass would have lost their teeth.
#[test]
fn the_textbook_fails_far_from_the_sphere() {
    for (kernel, variant, name) in [
        ("textbook", "sphere", "distant"),
        ("textbook", "sphere", "past"),
        ("stable q", "sphere", "distant"),
        ("stable q", "sphere", "past"),
        ("textbook", "world quadric", "far"),
        ("residual", "world quadric", "far"),
    ] {
        let family = Family::named(name).expect("a family");
        let is = |subject: &Subject| {
            subject.test.name() == kernel && subject.test.variant() == variant
        };
        let subjects: Vec<_> = each_kernel().into_iter().filter(is).collect();
        let row = &measure(&subjects, family, family.setting, rays(8_192))[0];
        let wrong = per_million(row.tally.false_hits + row.tally.false_misses, row);
        assert!(wrong > 10_000.0, "{name}: {row:?}");
    }
}

/// The worst of each kernel over the families: false misses, false hits, errors of t, the band.
fn worst(rows: &[Row]) -> [f64; 4] {
    let max = |value: &dyn Fn(&Row) -> f64| rows.iter().map(value).fold(0.0, f64::max);
    [
        max(&|row| per_million(row.tally.false_misses, row)),
        max(&|row| per_million(row.tally.false_hits, row)),
        max(&|row| if row.family.fair { row.tally.t_ulp.at(0.99) } else { 0.0 }),
        max(&|row| row.tally.band),
    ]
}

/// Every kernel in every family: what `check` is shown are its ceiling and its worst.
fn against_ceilings(n: usize, mut check: impl FnMut(&Subject, Ceiling, [f64; 4])) {
    let subjects = each_kernel();
    let mut rows = vec![Vec::new(); subjects.len()];
    for family in &Family::ALL {
        for (all, row) in rows.iter_mut().zip(measure(&subjects, family, family.setting, n)) {
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
    against_ceilings(n, |subject, ceiling, [misses, hits, t_p99, band]| {
        // Of fewer rays the share is less certain: by four standard deviations.
        let most = |ceiling: f64| {
            let expected = ceiling / 1e6 * n as f64;
            (expected + 4.0 * expected.sqrt()) * 1e6 / n as f64
        };
        assert!(misses <= most(ceiling.false_misses), "{subject:?}: {misses}, {ceiling:?}");
        assert!(hits <= most(ceiling.false_hits), "{subject:?}: {hits} false hits, {ceiling:?}");
        assert!(t_p99 <= ceiling.t_p99 * 1.2, "{subject:?}: t {t_p99}, {ceiling:?}");
        assert!(band <= ceiling.band, "{subject:?}: band {band}, {ceiling:?}");
    });
}

/// Ceilings only go down: they are what a kernel does, rounded up.
#[test]
#[ignore = "some minutes"]
fn ceilings_of_quadrics_hold_for_a_million_rays() {
    let mut wrong = String::new();
    against_ceilings(1_000_000, |_, ceiling, now| {
        let Ceiling { kernel, variant, .. } = ceiling;
        let units = [10.0, 10.0, 0.1, 0.1];
        let was = [ceiling.false_misses, ceiling.false_hits, ceiling.t_p99, ceiling.band];
        let now: [f64; 4] = std::array::from_fn(|i| (now[i] / units[i]).ceil() * units[i]);
        if now.iter().zip(was).any(|(now, was)| (now - was).abs() > 1e-6) {
            let [misses, hits, t_p99, band] = now;
            wrong += &format!(
                "\n(\"{kernel}\", \"{variant}\", {misses:.1}, {hits:.1}, {t_p99:.1}, {band:.1}),"
            );
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

/// Every way is timed.
#[test]
fn times_are_times() {
    for time in time(&defaults(), 3) {
        let ordered = 0.0 < time.least && time.least <= time.median && time.median <= time.greatest;
        assert!(ordered && time.greatest.is_finite(), "{time:?}");
    }
}
