//! What is asked of slab tests alone.

use rt_accuracy::boxes::{BoxFamily, Likeness, time};
use rt_accuracy::{BATCH, Family, Subject, Way, defaults, samples};
use rt_kernels::geom::Aabb;
use rt_kernels::slab::{BoxSet, Crossings};
use rt_kernels::{Ray, Rays};
use rt_tests::aim;
use rt_tests::random::Random;

use super::{shown, subject, the_default_keeps_its_promises_everywhere};

#[test]
fn the_default_misses_nothing_at_any_scale_or_distance() {
    the_default_keeps_its_promises_everywhere(|_: &BoxFamily, _| true);
}

/// A family in which nothing is hit would ask nothing.
#[test]
fn families_have_hits() {
    for family in BoxFamily::all() {
        let name = family.facts().name;
        let row = &shown::<BoxFamily>(&defaults::<BoxFamily>()[..1], name, 16_384)[0];
        // Who starts inside enters nothing.
        let entries = row.tally.t_ulp.count();
        assert!(entries * 20 > row.tally.rays || name == "inside", "{row:?}");
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
        for kernel in BoxFamily::kernels().into_iter().filter(|kernel| kernel.is_exact()) {
            let cross = |way, boxes: &[Aabb]| {
                let mut crossings = Crossings::new();
                kernel.cross(way, &BoxSet::new(boxes), &batch, &mut crossings);
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
            for way in Way::all().into_iter().filter(|&way| kernel.runs(way)) {
                assert_eq!(cross(way, &boxes), want, "{:?}", Subject { kernel, way });
            }
        }
    }
}

/// Families that these pass would have lost their teeth.
#[test]
fn known_mistakes_are_found() {
    let fails = |kernel, variant, family: &str, least: f64| {
        let row = &shown::<BoxFamily>(&[subject::<BoxFamily>(kernel, variant)], family, 8_192)[0];
        assert!(row.per_million(row.tally.false_misses) >= least, "{row:?}");
    };
    // Kay and Kajiya with NaN in the wrong place.
    fails("unordered", "division, interval first", "on plane", 100_000.0);
    fails("unordered", "division, interval last", "on plane", 100_000.0);
    // No widening.
    for family in ["edge", "corner", "far"] {
        fails("signed", "division", family, 5_000.0);
        fails("unordered", "division, each clipped", family, 5_000.0);
    }
    // Flat boxes.
    fails("conservative", "division, as printed", "flat", 100_000.0);
    // A fused product less a rounded one: where there is such an instruction.
    let fused = "division, b·r − o·r";
    if samples::<BoxFamily>().iter().any(|subject| subject.kernel.variant() == fused) {
        fails("signed", fused, "far", 100_000.0);
    }
}

/// Rays that are nothing like each other take longer, or as long; they are timed too.
#[test]
fn rays_that_differ_are_timed() {
    for time in time(&defaults::<BoxFamily>(), Likeness::Unlike, 3) {
        assert!(0.0 < time.least && time.greatest.is_finite(), "{time:?}");
    }
}
