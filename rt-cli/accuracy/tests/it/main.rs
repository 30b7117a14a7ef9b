//! What kernels promise of accuracy, and what they are known to get wrong.
//!
//! A few thousand rays a family; `cargo test --release -p rt-accuracy million -- --ignored` shows
//! each kernel a million.

mod boxes;
mod quadrics;
mod triangles;

use std::collections::BTreeSet;

use rt_accuracy::{
    Family, Listed, Row, Setting, Subject, Way, answers, complaints, defaults, measure, samples,
    worst,
};
use rt_tests::rays;

/// One kernel, the way [`samples`] has it.
fn subject<F: Family>(kernel: &str, variant: &str) -> Subject<F::Kernel> {
    let is = |subject: &Subject<F::Kernel>| {
        subject.kernel.name() == kernel && subject.kernel.variant() == variant
    };
    samples::<F>()
        .into_iter()
        .find(is)
        .unwrap_or_else(|| panic!("there is no {kernel} ({variant})"))
}

/// Subjects in a family as it commonly is.
fn shown<F: Family>(subjects: &[Subject<F::Kernel>], family: &str, n: usize) -> Vec<Row<F>> {
    let family = F::named(family).expect("a family");
    measure(subjects, family, family.facts().setting, rays(n))
}

fn the_default_keeps_its_promises_at_every_level<F: Family>() {
    for family in F::all() {
        for row in measure(&defaults::<F>(), family, family.facts().setting, rays(8_192)) {
            assert_eq!(F::broken_promise(&row), None);
        }
    }
}

/// All settings of all families that are asked for.
fn the_default_keeps_its_promises_everywhere<F: Family>(is_asked: impl Fn(&F, Setting) -> bool) {
    let mut subjects = samples::<F>();
    subjects.retain(|subject| subject.kernel.is_default());
    for family in F::all() {
        for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            for offset in [0.0, 1e3, 2.2e5, 1e6] {
                let setting = Setting { seed: 2, scale, offset };
                if !is_asked(family, setting) {
                    continue;
                }
                for row in measure(&subjects, family, setting, rays(1_024)) {
                    let Row { tally, .. } = &row;
                    let wrong = tally.leaks + tally.nan_hits;
                    assert_eq!(wrong, 0, "{row:?}");
                    assert!(F::SORT != "box" || tally.false_misses == 0, "{row:?}");
                }
            }
        }
    }
}

/// Every answer of every exact kernel has the same bits at all levels and in all shapes.
fn exact_kernels_are_bit_equal_on_all_levels<F: Family>() {
    let ways = Way::all();
    for kernel in F::kernels().into_iter().filter(|kernel| kernel.is_exact()) {
        for family in F::all() {
            let setting = &family.facts().setting;
            let of = |way| answers::<F>(&Subject { kernel, way }, family, setting, rays(256));
            let want = of(ways[0]);
            for &way in ways[1..].iter().filter(|&&way| kernel.runs(way)) {
                let (got, subject) = (of(way), Subject { kernel, way });
                let differ = got.iter().zip(&want).filter(|(got, want)| got != want).count();
                assert_eq!(got.len(), want.len());
                let family = family.facts().name;
                assert_eq!(differ, 0, "{subject:?}, {family}: of {} tests", want.len());
            }
        }
    }
}

/// All kernels one way, in all families.
fn all_rows<F: Family>(n: usize) -> Vec<Row<F>> {
    let subjects = samples::<F>();
    let rows = |family: &'static F| measure(&subjects, family, family.facts().setting, n);
    F::all().iter().flat_map(rows).collect()
}

fn no_kernel_is_worse_than_its_ceiling<F: Family>() {
    let complaints = complaints(&all_rows::<F>(rays(4_096)));
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

/// Ceilings only go down: of a kernel that is exact, and so gives the same figures everywhere, they
/// are what it does, rounded up.
fn ceilings_are_what_a_million_rays_show<F: Family>() {
    let rows = all_rows::<F>(1_000_000);
    let mut differ = String::new();
    for kernel in F::kernels() {
        let (name, variant) = (kernel.name(), kernel.variant());
        let of = |row: &&Row<F>| {
            row.subject.kernel.name() == name && row.subject.kernel.variant() == variant
        };
        let its: Vec<_> = rows.iter().filter(of).collect();
        if its.is_empty() {
            continue;
        }
        let units = [10.0, 10.0, 10.0, 0.1, 0.1];
        let worst = worst(&its).to_array();
        let now: [f64; 5] = std::array::from_fn(|i| (worst[i] / units[i]).ceil() * units[i]);
        let is =
            |ceiling: &&rt_accuracy::Ceiling| ceiling.kernel == name && ceiling.variant == variant;
        let was = F::ceilings().iter().find(is).map(|ceiling| ceiling.worst.to_array());
        let holds = was.is_some_and(|was| {
            now.iter().zip(was).all(|(now, was)| {
                let most = if kernel.is_exact() { was } else { 1.5 * was };
                *now <= most + 1e-6 && (!kernel.is_exact() || *now >= was - 1e-6)
            })
        });
        if !holds {
            let [a, b, c, d, e] = now;
            differ += &format!(
                "\n    ceiling(\"{name}\", \"{variant}\", [{a:.1}, {b:.1}, {c:.1}, {d:.1}, {e:.1}]),"
            );
        }
    }
    let complaints = complaints(&rows).join("\n");
    assert!(differ.is_empty(), "these are the figures now:{differ}\n{complaints}");
    assert!(complaints.is_empty(), "{complaints}");
}

/// What is judged must be able to fail.
fn complaints_are_made<F: Family>() {
    let rows = all_rows::<F>(64);
    assert_eq!(complaints(&rows), <[String; 0]>::default());
    let bad = |change: &dyn Fn(&mut Row<F>)| {
        let mut rows = rows.clone();
        let default = rows.iter_mut().filter(|row| row.subject.kernel.is_default());
        default.filter(|row| row.tally.rays > 0).for_each(change);
        complaints(&rows)
    };
    assert!(!bad(&|row| row.tally.nan_hits = 1).is_empty());
    assert!(!bad(&|row| row.tally.band = 1e9).is_empty());
    if F::SORT == "triangle" {
        assert!(!bad(&|row| row.tally.leaks = 1).is_empty());
    } else {
        assert!(!bad(&|row| row.tally.false_misses = 1).is_empty());
    }
}

fn the_catalogue_is_in_order<F: Family>() {
    let all = F::kernels();
    let names: BTreeSet<_> = all.iter().map(|kernel| (kernel.name(), kernel.variant())).collect();
    assert_eq!(names.len(), all.len(), "two kernels of one name");
    // Of curved surfaces spheres and cones have one each.
    let defaults = if F::SORT == "quadric" { 2 } else { 1 };
    assert_eq!(all.iter().filter(|kernel| kernel.is_default()).count(), defaults);
    let ceilings = F::ceilings().iter();
    let ceilings: BTreeSet<_> =
        ceilings.map(|ceiling| (ceiling.kernel, ceiling.variant.to_owned())).collect();
    assert_eq!(ceilings, names, "ceilings and catalogue");
    let families: BTreeSet<_> = F::all().iter().map(|family| family.facts().name).collect();
    assert_eq!(families.len(), F::all().len(), "two families of one name");
}

/// Every way is timed.
fn times_are_times<F: Family>() {
    for time in F::time(&defaults::<F>(), 3) {
        let ordered = 0.0 < time.least && time.least <= time.median && time.median <= time.greatest;
        assert!(ordered && time.greatest.is_finite(), "{time:?}");
    }
}

/// What holds for kernels of every sort.
macro_rules! stamp {
    ($($module:ident = $Family:ty)*) => {$(
        mod $module {
            use $Family as F;

            #[test]
            fn the_default_keeps_its_promises_at_every_level() {
                super::the_default_keeps_its_promises_at_every_level::<F>();
            }
            #[test]
            fn exact_kernels_are_bit_equal_on_all_levels() {
                super::exact_kernels_are_bit_equal_on_all_levels::<F>();
            }
            #[test]
            fn no_kernel_is_worse_than_its_ceiling() {
                super::no_kernel_is_worse_than_its_ceiling::<F>();
            }
            #[test]
            #[ignore = "some minutes"]
            fn ceilings_are_what_a_million_rays_show() {
                super::ceilings_are_what_a_million_rays_show::<F>();
            }
            #[test]
            fn the_catalogue_is_in_order() {
                super::the_catalogue_is_in_order::<F>();
            }
            #[test]
            fn complaints_are_made() {
                super::complaints_are_made::<F>();
            }
            #[test]
            fn times_are_times() {
                super::times_are_times::<F>();
            }
        }
    )*};
}

stamp! {
    of_triangles = rt_accuracy::triangles::TriangleFamily
    of_boxes = rt_accuracy::boxes::BoxFamily
    of_quadrics = rt_accuracy::quadrics::QuadricFamily
}
