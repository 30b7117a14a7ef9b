//! Throw-away.
use rt_render::accuracy::*;
fn main() {
    let n: usize = std::env::args().nth(1).map_or(16384, |n| n.parse().unwrap());
    let best = simd4::Level::available().last().unwrap();
    let subjects: Vec<_> = boxes::subjects()
        .into_iter()
        .filter(|s| s.way.level == best && s.way.shape == Shape::Rays)
        .collect();
    let mut worst = vec![(0f64, "", 0f64, "", 0f64, 0u64, 0f64); subjects.len()];
    for f in &boxes::Family::ALL {
        let start = std::time::Instant::now();
        let rows = boxes::measure(&subjects, f, f.setting, n);
        println!("{} {:?}", f.name, start.elapsed());
        for (r, w) in rows.iter().zip(&mut worst) {
            let t = &r.tally;
            let m = |x: u64| x as f64 * 1e6 / t.rays as f64;
            if m(t.false_misses) > w.0 {
                w.0 = m(t.false_misses);
                w.1 = f.name;
            }
            if m(t.false_hits) > w.2 {
                w.2 = m(t.false_hits);
                w.3 = f.name;
            }
            if f.fair {
                w.4 = w.4.max(t.t_ulp.at(0.99));
            }
            w.5 += t.nan_hits;
            w.6 = w.6.max(t.band);
            println!(
                "  {:<14} {:<40} fm {:>8.0} fh {:>8.0} nan {:>8.0} t {:>6.2} {:>8.2} {:>12.1} band {:>10.2}",
                r.subject.test.name(),
                r.subject.test.variant(),
                m(t.false_misses),
                m(t.false_hits),
                m(t.nan_hits),
                t.t_ulp.at(0.5),
                t.t_ulp.at(0.99),
                t.t_ulp.max(),
                t.band
            );
        }
    }
    let a = boxes::time(&subjects, boxes::Likeness::Alike, 15);
    let b = boxes::time(&subjects, boxes::Likeness::Unlike, 15);
    for (i, s) in subjects.iter().enumerate() {
        println!(
            "WORST {:<14} {:<40} fm {:>8.0} {:<9} fh {:>8.0} {:<9} t99 {:>10.2} nan {:>6} band {:>10.1} ns {:.3} {:.3}",
            s.test.name(),
            s.test.variant(),
            worst[i].0,
            worst[i].1,
            worst[i].2,
            worst[i].3,
            worst[i].4,
            worst[i].5,
            worst[i].6,
            a[i].median,
            b[i].median
        );
    }
    let subjects: Vec<_> = quadrics::subjects()
        .into_iter()
        .filter(|s| s.way.level == best && s.way.shape == Shape::Rays)
        .collect();
    for f in &quadrics::Family::ALL {
        let start = std::time::Instant::now();
        let rows = quadrics::measure(&subjects, f, f.setting, n);
        println!("{} {:?}", f.name, start.elapsed());
        for r in rows {
            let t = &r.tally;
            if t.rays == 0 {
                continue;
            }
            let m = |x: u64| x as f64 * 1e6 / t.rays as f64;
            println!(
                "  {:<10} {:<24} fm {:>8.0} fh {:>8.0} unsure {:>5} nan {:>4.0} t {:>6.2} {:>8.2} {:>12.1} band {:>10.2}",
                r.subject.test.name(),
                r.subject.test.variant(),
                m(t.false_misses),
                m(t.false_hits),
                t.unsure,
                m(t.nan_hits),
                t.t_ulp.at(0.5),
                t.t_ulp.at(0.99),
                t.t_ulp.max(),
                t.band
            );
        }
    }
    for (s, t) in subjects.iter().zip(quadrics::time(&subjects, 15)) {
        println!("{s:?} {t:.3?}");
    }
}
