//! What kernels promise, and what they were found to get wrong at most.

use rt_kernels::catalogue::Listed;

use crate::{BATCH, Family, Row, Tally};

/// The worst that a kernel did in any family.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// Leaks of a million rays. (Of triangles alone.)
    pub leaks: f64,
    /// False misses of a million rays.
    pub false_misses: f64,
    /// False hits of a million rays.
    pub false_hits: f64,
    /// The 99th percentile of the error of `t`, in units in the last place, in families that are
    /// fair and near the origin.
    pub t_p99: f64,
    /// The band in which rays are misjudged, in families near the origin.
    pub band: f64,
}

impl Worst {
    /// As an array, for loops: in the order of the fields.
    pub fn to_array(self) -> [f64; 5] {
        [self.leaks, self.false_misses, self.false_hits, self.t_p99, self.band]
    }
}

/// No measurement of a kernel may exceed its ceiling, and ceilings only go down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ceiling {
    /// The method.
    pub kernel: &'static str,
    /// Its choices.
    pub variant: &'static str,
    /// What it gets wrong, at most.
    pub worst: Worst,
}

/// A line of a table of ceilings, in the order of [`Worst::to_array`].
pub(crate) const fn ceiling(
    kernel: &'static str,
    variant: &'static str,
    [leaks, false_misses, false_hits, t_p99, band]: [f64; 5],
) -> Ceiling {
    Ceiling { kernel, variant, worst: Worst { leaks, false_misses, false_hits, t_p99, band } }
}

/// The worst of one kernel over its rows.
pub fn worst<F: Family>(rows: &[&Row<F>]) -> Worst {
    worst_by(Tally::t_p99, rows)
}

fn worst_by<F: Family>(t_p99: fn(&Tally) -> f64, rows: &[&Row<F>]) -> Worst {
    let mut worst = Worst::default();
    for row in rows {
        let tally = &row.tally;
        worst.leaks = worst.leaks.max(row.per_million(tally.leaks));
        worst.false_misses = worst.false_misses.max(row.per_million(tally.false_misses));
        worst.false_hits = worst.false_hits.max(row.per_million(tally.false_hits));
        if row.setting.offset == 0.0 {
            worst.band = worst.band.max(tally.band);
            if row.family.facts().fair {
                worst.t_p99 = worst.t_p99.max(t_p99(tally));
            }
        }
    }
    worst
}

/// What is not as it should be: a promise of the default kernel that a row breaks, a kernel that
/// is worse than its ceiling in all rows together, or has none.
pub fn complaints<F: Family>(rows: &[Row<F>]) -> Vec<String> {
    let default = rows.iter().filter(|row| row.subject.kernel.is_default());
    let mut complaints: Vec<String> = default.filter_map(F::broken_promise).collect();
    for kernel in F::kernels() {
        let (name, variant) = (kernel.name(), kernel.variant());
        let its = |row: &&Row<F>| {
            row.subject.kernel.name() == name && row.subject.kernel.variant() == variant
        };
        let rows: Vec<_> = rows.iter().filter(its).collect();
        let Some(rays) = rows.iter().map(|row| row.tally.rays).filter(|&rays| rays > 0).min()
        else {
            continue;
        };
        let is = |ceiling: &&Ceiling| ceiling.kernel == name && ceiling.variant == variant;
        let Some(ceiling) = F::ceilings().iter().find(is) else {
            complaints.push(format!("{name} ({variant}) has no ceiling"));
            continue;
        };
        // Estimates differ between machines.
        let slack = if kernel.is_exact() { 1.0 } else { 1.5 };
        // The greatest of other rays than those of the table may be greater by chance.
        let known = |row: &&Row<F>| row.setting.seed == row.family.facts().setting.seed;
        let tail = if rays <= 1_000_000 && rows.iter().all(known) { 1.0 } else { 2.0 };
        let worst = worst_by(Tally::t_p99_at_least, &rows);
        let pairs = worst.to_array().into_iter().zip(ceiling.worst.to_array());
        let what = ["leaks", "false misses", "false hits", "99 % of t", "band"];
        for (i, (now, most)) in pairs.enumerate() {
            let most = match i {
                0..=2 => with_luck(most * slack, rays),
                3 => most * slack,
                _ => most * slack * tail,
            };
            if now > most {
                let what = what[i];
                complaints.push(format!("{name} ({variant}): {what} {now:.2}, not {most:.2}"));
            }
        }
    }
    complaints
}

/// A share of a million rays, as far as fewer of them may exceed it: by four standard deviations,
/// if the rays of a batch stand and fall together.
fn with_luck(per_million: f64, rays: u64) -> f64 {
    let share = per_million / 1e6;
    let deviation = (share * (1.0 - share) * BATCH as f64 / rays as f64).sqrt();
    (share + 4.0 * deviation) * 1e6
}
