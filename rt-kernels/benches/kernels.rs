//! One test of one ray against one triangle, box or curved surface, by every kernel: a group for
//! each kernel and level, N rays × 1 primitive and 1 ray × N primitives.
//!
//! `cargo bench -p rt-kernels -- triangle/watertight` runs one method. Times are for 64 rays × 64
//! primitives, so that elements per second are tests per second.
#![allow(missing_docs)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use rt_kernels::catalogue::{Listed, Shape, Way};
use rt_kernels::geom::{Aabb, Cone, Curved, Sphere, Triangle};
use rt_kernels::slab::{BoxSet, Crossings};
use rt_kernels::{Hits, Ray, Rays, quadric, slab, tri};

/// The rays and the primitives.
const N: u16 = 64;

/// Numbers from −1 to 1, scattered (Weyl's sequence for each coordinate).
fn scattered(i: u16) -> Vec3 {
    let i = f32::from(i);
    Vec3::new(i * 0.754_877_7, i * 0.569_840_3, i * 0.819_172_5).map(|x| 2.0 * x.fract() - 1.0)
}

/// From one eye, all forward.
fn rays() -> Rays {
    let eye = Vec3::new(3.0, 4.0, 12.0);
    (0..N).map(|i| Ray::new(eye, scattered(i + 500) - eye)).collect()
}

/// Every way to run a kernel: `run` does it, and `answer` says of each ray what was found, which
/// is asserted to be the same in all.
fn each_way<R, A: PartialEq>(
    criterion: &mut Criterion,
    sort: &str,
    kernel: &(impl Listed + ?Sized),
    run: impl Fn(Way, &mut R),
    answer: impl Fn(&R) -> Vec<A>,
) where
    R: Default,
{
    let once = |way| {
        let mut found = R::default();
        run(way, &mut found);
        answer(&found)
    };
    let want = once(Way::all()[0]);
    for way in Way::all() {
        if !kernel.runs(way) || kernel.is_emulated(way) {
            continue;
        }
        let name = kernel.name();
        assert!(!kernel.is_exact() || once(way) == want, "{name} at {way:?}");
        let level = if way.shape == Shape::One { "one lane" } else { way.level.name() };
        let shape = match way.shape {
            Shape::One => "1x1".to_owned(),
            Shape::Rays => format!("{}x1", way.width()),
            Shape::Primitives => format!("1x{}", way.width()),
        };
        let mut group = criterion.benchmark_group(format!("{sort}/{name}/{level}"));
        group.throughput(Throughput::Elements(u64::from(N) * u64::from(N)));
        group.bench_function(BenchmarkId::new(kernel.variant(), shape), |bencher| {
            let mut found = R::default();
            bencher.iter(|| run(way, &mut found));
        });
        group.finish();
    }
}

fn hits(found: &Hits) -> Vec<Option<(u32, u32)>> {
    let hit = |i| found.get(i).map(|hit| (hit.prim, hit.t.to_bits()));
    let all: Vec<_> = (0..found.len()).map(hit).collect();
    assert!(all.iter().flatten().count() > all.len() / 2, "too few hits to tell");
    all
}

fn triangles(criterion: &mut Criterion) {
    let corner = |i, k| scattered(i) + 0.5 * scattered(3 * i + k + 1000);
    let triangle = |i| Triangle { corners: [corner(i, 0), corner(i, 1), corner(i, 2)] };
    let triangles: Vec<_> = (0..N).map(triangle).collect();
    let rays = rays();
    for kernel in tri::catalogue() {
        let records = kernel.triangles(&triangles);
        let run = |way, found: &mut Hits| kernel.closest(way, &records, &rays, found);
        each_way(criterion, "triangle", kernel, run, hits);
    }
}

fn boxes(criterion: &mut Criterion) {
    let aabb = |i| Aabb::point(scattered(i)).union(&Aabb::point(scattered(i + 1000)));
    let boxes = BoxSet::new(&(0..N).map(aabb).collect::<Vec<_>>());
    let rays = rays();
    for kernel in slab::catalogue() {
        let run = |way, found: &mut Crossings| kernel.cross(way, &boxes, &rays, found);
        each_way(criterion, "box", kernel, run, |found| {
            let all: Vec<_> = (0..found.len()).map(|i| found.get(i).0).collect();
            assert!(all.iter().sum::<u32>() > u32::from(N), "too few hits to tell");
            all
        });
    }
}

fn quadrics(criterion: &mut Criterion) {
    let sphere = |i| Curved::Sphere(Sphere { center: scattered(i), radius: 0.25 });
    let spheres: Vec<_> = (0..N).map(sphere).collect();
    let cone = |i| {
        let (base, apex) = (scattered(i), scattered(i) + Vec3::new(0.1, 0.2, 0.3));
        Curved::Cone(Cone { base, base_radius: 0.25, apex, apex_radius: 0.125 })
    };
    let cones: Vec<_> = (0..N).map(cone).collect();
    let rays = rays();
    for kernel in quadric::catalogue() {
        let surfaces = kernel.surfaces(&spheres).or_else(|| kernel.surfaces(&cones));
        let surfaces = surfaces.expect("every kernel takes spheres or cones");
        let run = |way, found: &mut Hits| kernel.closest(way, &surfaces, &rays, found);
        each_way(criterion, "quadric", kernel, run, hits);
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(std::time::Duration::from_millis(50))
        .measurement_time(std::time::Duration::from_millis(200))
        .sample_size(20);
    targets = triangles, boxes, quadrics
}
criterion_main!(benches);
