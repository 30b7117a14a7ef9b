//! `cargo bench -p simd4`: every group of operations and every sample kernel at each level, ours
//! beside a hand-written twin. Before anything is timed, the two are compared bit for bit.

mod io;
mod kernels;
mod ops;
mod twin;

use std::time::Duration;

use criterion::Criterion;
use simd4::Level;

use io::Io;

fn levels(c: &mut Criterion) {
    let mut ordinary = Io::ordinary();
    for level in Level::available() {
        let ops = || ops::OPS.iter().chain(kernels::KERNELS);
        for of_group in ops().collect::<Vec<_>>().chunk_by(|a, b| a.group == b.group) {
            let mut group = c.benchmark_group(format!("{}/{level}", of_group[0].group));
            for op in of_group {
                let Some(twin) = twin::of(level.name(), op.name) else { continue };
                op.check(level, twin);
                group.bench_function(format!("{}/ours", op.name), |b| {
                    b.iter(|| (op.ours)(level, &mut ordinary));
                });
                group.bench_function(format!("{}/twin", op.name), |b| {
                    // SAFETY: the CPU has the level.
                    b.iter(|| unsafe { twin(&mut ordinary) });
                });
            }
            group.finish();
        }
    }
}

/// A minute or two for all; for one group at one level, `cargo bench -p simd4 -- round/sse2`.
fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(50))
        .measurement_time(Duration::from_millis(200))
        .sample_size(20)
        .without_plots()
        .configure_from_args();
    levels(&mut criterion);
    criterion.final_summary();
}
