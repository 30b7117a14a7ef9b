//! What slab tests promise, and what they are known to get wrong.
//!
//! A few thousand rays a family; `cargo test -p rt-tests million -- --ignored` shows each kernel a
//! million.

use std::collections::BTreeSet;

use rt_kernels::geom::Aabb;
use rt_kernels::slab::{BoxSet, BoxTest, Crossings, catalogue};
use rt_kernels::tri::{Shape, Way};
use rt_kernels::{Ray, Rays};
use rt_render::accuracy::boxes::{
    CEILINGS, Ceiling, Family, Likeness, Row, Subject, answers, measure, time,
};
use rt_render::accuracy::{BATCH, Setting};
use rt_tests::random::Random;
use rt_tests::{aim, rays};
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
    let runs = |test: &&'static dyn BoxTest| {
        let way = ways.into_iter().find(|&way| test.runs(way) && !test.is_emulated(way));
        way.map(|way| Subject { test: *test, way })
    };
    catalogue().iter().filter_map(runs).collect()
}

fn named(kernel: &str, variant: &str) -> Subject {
    let is = |subject: &Subject| subject.test.name() == kernel && subject.test.variant() == variant;
    each_kernel().into_iter().find(is).unwrap_or_else(|| panic!("no {kernel} ({variant})"))
}

fn per_million(count: u64, row: &Row) -> f64 {
    count as f64 * 1e6 / row.tally.rays as f64
}

#[test]
fn the_default_misses_nothing_in_any_family_at_any_level() {
    for family in &Family::ALL {
        for row in measure(&defaults(), family, family.setting, rays(8_192)) {
            let (subject, tally) = (&row.subject, &row.tally);
            let case = format!("{subject:?}, {}: {tally:?}", family.name);
            assert_eq!((tally.false_misses, tally.nan_hits), (0, 0), "{case}");
            if family.fair {
                assert!(tally.t_ulp.at(0.99) <= 4.0, "{case}");
            }
        }
    }
}

/// All settings of all families.
#[test]
fn the_default_misses_nothing_at_any_scale_or_distance() {
    let subject = each_kernel().into_iter().find(|subject| subject.test.is_default());
    for family in &Family::ALL {
        for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            for offset in [0.0, 1e3, 2.2e5, 1e6] {
                let setting = Setting { seed: 2, scale, offset };
                for row in measure(subject.as_slice(), family, setting, rays(1_024)) {
                    assert_eq!(row.tally.false_misses, 0, "{row:?}");
                }
            }
        }
    }
}

/// A family in which nothing is hit would ask nothing.
#[test]
fn families_have_hits() {
    for family in &Family::ALL {
        let row = &measure(&defaults()[..1], family, family.setting, rays(8_192))[0];
        // Who starts inside enters nothing.
        let entries = row.tally.t_ulp.count();
        assert!(entries * 20 > row.tally.rays || family.name == "inside", "{row:?}");
    }
}

#[test]
fn exact_kernels_are_bit_equal_on_all_levels() {
    let ways = Way::all();
    for test in catalogue().into_iter().filter(|test| test.is_exact()) {
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

/// Many boxes at once: the same as one by one.
#[test]
fn many_boxes_are_counted_one_by_one() {
    let mut random = Random::new(52);
    // No multiple of any number of lanes.
    let boxes: Vec<_> = (0..37)
        .map(|_| Aabb::point(random.in_cube()).union(&Aabb::point(random.in_cube())))
        .collect();
    let alike = |random: &mut Random| aim::at(glam::Vec3::splat(9.0), random.in_cube());
    let unlike = |random: &mut Random| aim::at(random.in_cube() * 3.0, random.in_cube());
    for make in [alike, unlike] {
        let batch: Rays = (0..BATCH + 3)
            .map(|i| Ray { tmax: if i % 3 == 0 { 1.0 } else { 1e9 }, ..make(&mut random) })
            .collect();
        for test in catalogue().into_iter().filter(|test| test.is_exact()) {
            let cross = |way, boxes: &[Aabb]| {
                let mut crossings = Crossings::new();
                test.cross(way, &BoxSet::new(boxes), &batch, &mut crossings);
                (0..batch.len()).map(|i| crossings.get(i)).collect::<Vec<_>>()
            };
            let mut want = vec![(0, f32::INFINITY); batch.len()];
            for aabb in &boxes {
                let one = cross(Way::all()[0], std::slice::from_ref(aabb));
                for (want, (count, enter)) in want.iter_mut().zip(one) {
                    *want = (want.0 + count, if count > 0 { want.1.min(enter) } else { want.1 });
                }
            }
            assert!(want.iter().any(|&(count, _)| count > 2), "few boxes are hit");
            for way in Way::all().into_iter().filter(|&way| test.runs(way)) {
                assert_eq!(cross(way, &boxes), want, "{:?}", Subject { test, way });
            }
        }
    }
}

/// Families that these pass would have lost their teeth.
#[test]
fn known_mistakes_are_found() {
    let fails = |kernel, variant, family: &str, least: f64| {
        let family = Family::named(family).expect("a family");
        let subject = named(kernel, variant);
        let rows = measure(&[subject], family, family.setting, rays(8_192));
        let misses = per_million(rows[0].tally.false_misses, &rows[0]);
        assert!(misses >= least, "{}: {misses} of a million: {:?}", family.name, rows[0]);
    };
    // Kay and Kajiya with NaN in the wrong place.
    fails("unordered", "division, interval first", "on plane", 100_000.0);
    fails("unordered", "division, interval last", "on plane", 100_000.0);
    // No widening.
    for kernel in ["edge", "corner", "far"] {
        fails("signed", "division", kernel, 5_000.0);
        fails("unordered", "division, each clipped", kernel, 5_000.0);
    }
    // Flat boxes.
    fails("conservative", "division, as printed", "flat", 100_000.0);
    let level = Level::best().expect("a level");
    if named("signed", "division").test.runs(Way { level, shape: Shape::Rays })
        && each_kernel().iter().any(|subject| subject.test.variant().contains("b·r"))
    {
        fails("signed", "division, b·r − o·r", "far", 100_000.0);
    }
}

/// The worst of each kernel over the families: false misses, false hits, errors of the entry.
fn worst(rows: &[Row]) -> [f64; 3] {
    let max = |value: &dyn Fn(&Row) -> f64| rows.iter().map(value).fold(0.0, f64::max);
    let near = |row: &&Row| row.family.fair && row.setting.offset == 0.0;
    [
        max(&|row| per_million(row.tally.false_misses, row)),
        max(&|row| per_million(row.tally.false_hits, row)),
        rows.iter().filter(near).map(|row| row.tally.t_ulp.at(0.99)).fold(0.0, f64::max),
    ]
}

/// Every kernel in every family: what `check` is shown are its ceiling and its worst.
fn against_ceilings(n: usize, mut check: impl FnMut(&Subject, Ceiling, [f64; 3])) {
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
    against_ceilings(n, |subject, ceiling, [misses, hits, t_p99]| {
        // Of fewer rays the share is less certain: by four standard deviations.
        let most = |ceiling: f64| {
            let expected = ceiling / 1e6 * n as f64;
            (expected + 4.0 * expected.sqrt()) * 1e6 / n as f64
        };
        assert!(misses <= most(ceiling.false_misses), "{subject:?}: {misses}, {ceiling:?}");
        assert!(hits <= most(ceiling.false_hits), "{subject:?}: {hits} false hits, {ceiling:?}");
        assert!(t_p99 <= ceiling.t_p99 * 1.1, "{subject:?}: t {t_p99}, {ceiling:?}");
    });
}

/// Ceilings only go down: of a kernel that is exact, and so gives the same figures everywhere, they
/// are what it does, rounded up.
#[test]
#[ignore = "some minutes"]
fn ceilings_of_boxes_hold_for_a_million_rays() {
    let mut wrong = String::new();
    against_ceilings(1_000_000, |subject, ceiling, [misses, hits, t_p99]| {
        let Ceiling { kernel, variant, .. } = ceiling;
        let round = |value: f64, unit: f64| (value / unit).ceil() * unit;
        let now = [round(misses, 10.0), round(hits, 10.0), round(t_p99, 0.1)];
        let was = [ceiling.false_misses, ceiling.false_hits, ceiling.t_p99];
        let higher = now.iter().zip(was).any(|(now, was)| *now > was + 1e-6);
        let lower = now.iter().zip(was).any(|(now, was)| *now < was - 1e-6);
        if higher || lower && subject.test.is_exact() {
            let [misses, hits, t_p99] = now;
            wrong += &format!("\n(\"{kernel}\", \"{variant}\", {misses:.1}, {hits:.1}, {t_p99:.1}),");
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
    for likeness in [Likeness::Alike, Likeness::Unlike] {
        for time in time(&defaults(), likeness, 3) {
            let ordered =
                0.0 < time.least && time.least <= time.median && time.median <= time.greatest;
            assert!(ordered && time.greatest.is_finite(), "{time:?}");
        }
    }
}
