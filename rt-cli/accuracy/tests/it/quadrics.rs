//! What is asked of tests of curved surfaces alone.

use rt_accuracy::quadrics::QuadricFamily;
use rt_accuracy::{BATCH, Family, Subject, Way};
use rt_kernels::geom::{Cone, Curved, Sphere};
use rt_kernels::{Accelerator, Brute, Exec, Hits, Primitives, Rays, Stats};
use rt_tests::random::Random;
use rt_tests::{aim, rays, trace};

use super::{shown, subject};

/// The closest of many: the same as brute force with the kernel that renders, and the same in all
/// shapes with any.
#[test]
fn the_closest_of_many_is_the_same_in_every_shape() {
    let mut random = Random::new(53);
    for round in 0..rays(16) {
        // Twice each, so that there are ties; not a multiple of any number of lanes.
        let mut spheres: Vec<_> = (0..21 + round % 3)
            .map(|_| Sphere { center: random.in_cube(), radius: random.unit() as f32 * 0.5 + 0.01 })
            .collect();
        spheres.extend(spheres.clone());
        let mut cones: Vec<_> = (0..21 + round % 3)
            .map(|_| {
                let [base, apex] = [(); 2].map(|()| random.in_cube());
                let [base_radius, apex_radius] = [(); 2].map(|()| random.unit() as f32 * 0.5);
                Cone { base, base_radius, apex, apex_radius }
            })
            .collect();
        cones.extend(cones.clone());
        let batch: Rays =
            (0..BATCH + 3).map(|_| aim::at(random.in_cube() * 3.0, random.in_cube())).collect();
        let of_spheres = spheres.iter().copied().map(Curved::Sphere).collect();
        let of_cones = cones.iter().copied().map(Curved::Cone).collect();
        is_one_answer(of_spheres, &Primitives { spheres, ..Primitives::default() }, &batch);
        is_one_answer(of_cones, &Primitives { cones, ..Primitives::default() }, &batch);
    }
}

#[track_caller]
fn is_one_answer(surfaces: Vec<Curved>, scene: &Primitives, batch: &Rays) {
    let mut brute = Hits::new();
    let accel = Brute::build(scene).expect("in range");
    let exec = Exec::best().expect("a level");
    accel.closest(exec, batch, &mut brute, &mut Stats::default());
    let mut kernels = 0;
    for kernel in QuadricFamily::kernels() {
        let Some(records) = kernel.surfaces(&surfaces) else { continue };
        kernels += usize::from(kernel.is_default());
        let mut want = Hits::new();
        for (i, way) in Way::all().into_iter().filter(|&way| kernel.runs(way)).enumerate() {
            let mut got = Hits::new();
            kernel.closest(way, &records, batch, &mut got);
            if i == 0 {
                want = if kernel.is_default() { brute.clone() } else { got.clone() };
            }
            for i in 0..batch.len() {
                let bits = |hits: &Hits| hits.get(i).map(trace::bits);
                let subject = Subject { kernel, way };
                assert_eq!(bits(&got), bits(&want), "{subject:?}: {:?}", batch.get(i));
            }
        }
    }
    assert_eq!(kernels, 1, "one renders");
    assert!((0..batch.len()).any(|i| brute.get(i).is_some()), "nothing is hit");
}

/// Families that these pass would have lost their teeth.
#[test]
fn the_textbook_fails_far_from_the_sphere() {
    for (kernel, variant, family) in [
        ("textbook", "sphere", "distant"),
        ("textbook", "sphere", "past"),
        ("stable q", "sphere", "distant"),
        ("stable q", "sphere", "past"),
        ("textbook", "world quadric", "far"),
        ("residual", "world quadric", "far"),
    ] {
        let subject = subject::<QuadricFamily>(kernel, variant);
        let row = &shown::<QuadricFamily>(&[subject], family, 8_192)[0];
        let wrong = row.per_million(row.tally.false_hits + row.tally.false_misses);
        assert!(wrong > 10_000.0, "{row:?}");
    }
}
