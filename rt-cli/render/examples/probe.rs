use rt_render::accuracy::*;
fn main() {
    let n: usize = std::env::args().nth(1).map_or(16384, |n| n.parse().unwrap());
    let best = simd4::Level::available().last().unwrap();
    let subjects: Vec<_> = subjects()
        .into_iter()
        .filter(|s| {
            s.way.level == best && s.way.shape == Shape::Rays || s.test.name().ends_with("f64")
        })
        .collect();
    for f in &Family::TRIANGLES {
        let start = std::time::Instant::now();
        let rows = measure(&subjects, f, f.setting, n);
        println!("{} {:?}", f.name, start.elapsed());
        for r in rows {
            let t = &r.tally;
            let m = |x: u64| x as f64 * 1e6 / t.rays as f64;
            println!(
                "  {:<20} {:<45} leak {:>8.0} dbl {:>8.0} fh {:>8.0} fm {:>8.0} nan {:>8.0} t {:>6.2} {:>8.2} {:>12.1} band {:>10.2}",
                r.subject.test.name(),
                r.subject.test.variant(),
                m(t.leaks),
                m(t.double_hits),
                m(t.false_hits),
                m(t.false_misses),
                m(t.nan_hits),
                t.t_ulp.at(0.5),
                t.t_ulp.at(0.99),
                t.t_ulp.max(),
                t.band
            );
        }
    }
    let subjects = rt_render::accuracy::subjects();
    let start = std::time::Instant::now();
    for (s, t) in subjects.iter().zip(time(&subjects, 15)) {
        println!("{s:?} {t:.3?}");
    }
    println!("{:?}", start.elapsed());
}
