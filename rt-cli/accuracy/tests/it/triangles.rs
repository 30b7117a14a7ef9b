//! What is asked of triangle tests alone.

use glam::Vec3;
use rt_accuracy::triangles::TriangleFamily;
use rt_accuracy::{BATCH, Family, Kind, Subject, Way, samples};
use rt_kernels::geom::Triangle;
use rt_kernels::{Accelerator, Brute, Exec, Hits, KdBuilder, KdPlan, KdTree, PacketSize};
use rt_kernels::{Primitives, Ray, Rays, Sequential, Stats};
use rt_tests::hash::fnv1a;
use rt_tests::random::Random;
use rt_tests::{rays, trace};
use simd4::Level;

use super::{shown, the_default_keeps_its_promises_everywhere};

#[test]
fn the_default_leaks_nothing_at_any_scale_or_distance() {
    the_default_keeps_its_promises_everywhere(|family: &TriangleFamily, setting| {
        // A thousandth of a mesh's size must be more than roundoff: rays from the inside of what
        // is crushed start on its surface.
        let thin = ["pancake", "needle"].contains(&family.facts().name);
        let crushed = thin && 1e-3 * setting.scale < 64.0 * f32::EPSILON * setting.offset;
        family.facts().kind == Kind::Closed && !crushed
    });
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
        let scene = Primitives { triangles: triangles.clone(), ..Primitives::default() };
        let mut brute = Hits::new();
        let exec = Exec::best().expect("a level");
        let accel = Brute::build(&scene).expect("in range");
        accel.closest(exec, &batch, &mut brute, &mut Stats::default());
        for kernel in TriangleFamily::kernels().into_iter().filter(|kernel| kernel.is_exact()) {
            let records = kernel.triangles(&triangles);
            let mut want = Hits::new();
            for (i, way) in Way::all().into_iter().filter(|&way| kernel.runs(way)).enumerate() {
                let mut got = Hits::new();
                kernel.closest(way, &records, &batch, &mut got);
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
        assert!((0..batch.len()).any(|i| brute.get(i).is_some()), "nothing is hit");
    }
}

/// Cells cut triangles, and rays are tested in the order of cells: in every family the hits are the
/// bits of brute force, with none lost, no number that is none and, in closed meshes, no leak.
#[test]
fn kd_trees_of_every_family_equal_brute_force() {
    for family in TriangleFamily::all() {
        let (facts, mut met) = (family.facts(), 0);
        for i in 0..rays(8) {
            let mut batch = family.batch(&facts.setting, i);
            // What is not finite is no scene.
            batch.triangles.retain(|triangle| triangle.corners.iter().all(|p| p.is_finite()));
            let scene = Primitives { triangles: batch.triangles, ..Primitives::default() };
            let brute = Brute::build(&scene).expect("in range");
            let want = trace::closest(&brute, Exec::best().expect("a level"), &batch.rays);
            met += want.iter().flatten().count();
            for builder in KdBuilder::ALL {
                let plan = KdPlan { builder, ..KdPlan::default() };
                let tree = KdTree::build_with(&scene, plan, &Sequential).expect("in range");
                for exec in Level::available().flat_map(packets) {
                    let got = trace::closest(&tree, exec, &batch.rays);
                    for (i, (got, want)) in got.into_iter().zip(&want).enumerate() {
                        let ray = batch.rays.get(i);
                        let name = format!("{}, {builder:?}, {exec:?}: {ray:?}", facts.name);
                        assert_eq!(got.map(trace::bits), want.map(trace::bits), "{name}");
                        assert!(got.is_none_or(|hit| hit.t.is_finite()), "{name}: {got:?}");
                        assert!(got.is_some() || facts.kind != Kind::Closed, "{name}: a leak");
                    }
                }
            }
        }
        assert!(met > 0 || facts.kind != Kind::Closed, "{}: nothing is hit", facts.name);
    }
}

fn packets(level: Level) -> [Exec; 4] {
    [PacketSize::Single, PacketSize::Four, PacketSize::Sixteen, PacketSize::Large]
        .map(|packet| Exec { level, packet })
}

/// A family that the common test passes would have lost its teeth.
#[test]
fn moller_trumbore_fails_the_edge_family() {
    let mut subjects = samples::<TriangleFamily>();
    // An estimate that errs to one side closes cracks, and hits twice instead.
    subjects
        .retain(|Subject { kernel, .. }| kernel.name() == "moller-trumbore" && kernel.is_exact());
    assert!(subjects.len() >= 2, "{subjects:?}");
    for name in ["edge", "vertex", "tiny", "far", "rotated grid"] {
        for row in shown::<TriangleFamily>(&subjects, name, 8_192) {
            assert!(row.per_million(row.tally.leaks) > 5_000.0, "{row:?}");
        }
    }
    for row in shown::<TriangleFamily>(&subjects, "random", 8_192) {
        assert!(row.per_million(row.tally.leaks) < 1_000.0, "by chance too: {row:?}");
    }
}

/// The same inputs on every machine.
#[test]
fn families_are_the_same_everywhere() {
    let bits = |v: Vec3| v.to_array().into_iter().flat_map(|x| x.to_bits().to_le_bytes());
    let bytes = TriangleFamily::all().iter().flat_map(|family| {
        let batches = (0..4).map(|i| family.batch(&family.facts().setting, i));
        batches.flat_map(|batch| {
            let points = batch.triangles.iter().flat_map(|triangle| triangle.corners);
            let rays = (0..batch.rays.len()).map(|i| batch.rays.get(i));
            let rays = rays.flat_map(|ray| [ray.origin, ray.dir]);
            points.chain(rays).flat_map(bits).collect::<Vec<_>>()
        })
    });
    assert_eq!(fnv1a(bytes), 17_794_044_349_630_052_028, "new families: new figures");
}
