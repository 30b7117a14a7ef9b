//! One test of one ray against one triangle, by every kernel: a group for each kernel and level, N
//! rays × 1 triangle and 1 ray × N triangles.
//!
//! `cargo bench -p rt-kernels -- watertight` runs one method. Times are for 64 rays × 64 triangles,
//! so that elements per second are tests per second.
#![allow(missing_docs)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use rt_kernels::geom::Triangle;
use rt_kernels::tri::{Shape, Way, catalogue};
use rt_kernels::{Hits, Ray, Rays};

/// The rays and the triangles.
const N: u16 = 64;

/// Numbers from −1 to 1, scattered (Weyl's sequence for each coordinate).
fn scattered(i: u16) -> Vec3 {
    let i = f32::from(i);
    Vec3::new(i * 0.754_877_7, i * 0.569_840_3, i * 0.819_172_5).map(|x| 2.0 * x.fract() - 1.0)
}

fn triangles(criterion: &mut Criterion) {
    let triangles: Vec<Triangle> = (0..N)
        .map(|i| {
            let corner = |k| scattered(i) + 0.5 * scattered(3 * i + k + 1000);
            Triangle { corners: [corner(0), corner(1), corner(2)] }
        })
        .collect();
    let eye = Vec3::new(3.0, 4.0, 12.0);
    let rays: Rays = (0..N).map(|i| Ray::new(eye, scattered(i + 500) - eye)).collect();

    for test in catalogue() {
        let records = test.triangles(&triangles);
        let hits = |way| {
            let mut hits = Hits::new();
            test.closest(way, &records, &rays, &mut hits);
            hits
        };
        let want = hits(Way::all()[0]);
        let found = (0..rays.len()).filter(|&i| want.get(i).is_some()).count();
        assert!(found > rays.len() / 2, "{} hits {found} times", test.name());
        for way in Way::all() {
            if !test.runs(way) || test.is_emulated(way) {
                continue;
            }
            let got = hits(way);
            let same = (0..rays.len())
                .all(|i| got.get(i).map(|hit| hit.prim) == want.get(i).map(|hit| hit.prim));
            assert!(same && (!test.is_exact() || got == want), "{} at {way:?}", test.name());

            let level = if way.shape == Shape::One { "one lane" } else { way.level.name() };
            let mut group = criterion.benchmark_group(format!("{}/{level}", test.name()));
            group.throughput(Throughput::Elements(u64::from(N) * u64::from(N)));
            let shape = match way.shape {
                Shape::One => "1x1".to_owned(),
                Shape::Rays => format!("{}x1", way.width()),
                Shape::Triangles => format!("1x{}", way.width()),
            };
            group.bench_function(BenchmarkId::new(test.variant(), shape), |bencher| {
                let mut hits = Hits::new();
                bencher.iter(|| test.closest(way, &records, &rays, &mut hits));
            });
            group.finish();
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_millis(500))
        .sample_size(20);
    targets = triangles
}
criterion_main!(benches);
