//! `rt accuracy`.

use std::fmt::Write as _;
use std::path::Path;

use rt_accuracy::boxes::BoxFamily;
use rt_accuracy::quadrics::QuadricFamily;
use rt_accuracy::triangles::TriangleFamily;
use rt_accuracy::{Family, Kind, Listed, Row, Shape, Time, complaints, measure, subjects, worst};
use rt_render::Level;
use rt_render::precision::{ERRORS, Errors};
use serde_json::{Value, json};

use crate::args::{AccuracyArgs, MeasureArgs, best_level};
use crate::error::Error;
use crate::{output, ui};

/// Measures, and complains of what is worse than it should be.
pub(crate) fn run(args: &AccuracyArgs) -> Result<(), Error> {
    let json = args.json.as_deref().map(output::open_json).transpose()?;
    let measured = Measured::new(&args.measure)?;
    if args.json.as_deref() != Some(Path::new("-")) {
        output::to_stdout(measured.table.as_bytes())?;
    }
    if let Some(json) = json {
        json.write(output::json(&measured.json).as_bytes())?;
    }
    if measured.complaints.is_empty() {
        Ok(())
    } else {
        Err(Error::Inaccurate(measured.complaints))
    }
}

/// What came of it.
pub(crate) struct Measured {
    /// All rows, as `--json` has them.
    pub(crate) json: Value,
    table: String,
    complaints: Vec<String>,
}

impl Measured {
    /// Every kernel, every way, in every family.
    pub(crate) fn new(args: &MeasureArgs) -> Result<Measured, Error> {
        let command: Vec<_> = std::env::args().skip(1).collect();
        let json = json!({
            "command": format!("rt {}", command.join(" ")),
            "arch": std::env::consts::ARCH,
            "machine": machine(),
            "rows": [],
        });
        let mut measured = Measured { json, table: String::new(), complaints: Vec::new() };
        let level = best_level()?;
        let triangles = measured.add::<TriangleFamily>(args, level);
        measured.complaints.extend(beyond(&ERRORS, &triangles));
        measured.add::<BoxFamily>(args, level);
        measured.add::<QuadricFamily>(args, level);
        if !args.is_common() {
            measured.complaints.clear();
        }
        Ok(measured)
    }

    fn add<F: Family>(&mut self, args: &MeasureArgs, level: Level) -> Vec<Row<F>> {
        let subjects = subjects::<F>();
        let mut rows = Vec::new();
        for (i, family) in (1..).zip(F::all()) {
            let facts = family.facts();
            if !args.quiet {
                let (sort, of) = (F::SORT, F::all().len());
                ui::say(&format!("{sort} {i}/{of}: {}: {}", facts.name, facts.about));
            }
            rows.extend(measure(&subjects, family, args.setting(facts.setting), args.rays()));
        }
        if !args.quiet {
            ui::say(&format!("{}: times", F::SORT));
        }
        let times = F::time(&subjects, args.rounds());
        let timed = rows.iter().zip(times.iter().cycle());
        // Not of a kernel that is not made for the family.
        let timed: Vec<_> = timed.filter(|(row, _)| row.tally.rays > 0).collect();
        if let Some(all) = self.json["rows"].as_array_mut() {
            all.extend(timed.iter().map(|(row, time)| row_json(row, time)));
        }
        self.table += &table(&timed, level);
        self.complaints.extend(complaints(&rows));
        rows
    }
}

/// Where a triangle test that renders misjudges more than the table says that tolerances go by: in
/// meshes of triangles that are not slim.
fn beyond(table: &[Errors], rows: &[Row<TriangleFamily>]) -> Vec<String> {
    let mut beyond = Vec::new();
    for row in rows {
        let (facts, kernel) = (row.family.facts(), row.subject.kernel);
        let slim = ["pancake", "needle"].contains(&facts.name);
        let plain = kernel.is_exact() && !kernel.variant().contains("fused");
        let of = |errors: &&Errors| errors.method.name() == kernel.name();
        let Some(errors) = table.iter().find(of).filter(|_| plain && !slim) else { continue };
        // No two points are farther from each other than the diagonal of a cube about the origin.
        let most = errors.reach * 2.0 * 3f64.sqrt() + errors.coordinate;
        if facts.kind == Kind::Closed && row.tally.band > most {
            let (name, band) = (facts.name, row.tally.band);
            let which = format!("{} ({})", kernel.name(), kernel.variant());
            beyond.push(format!("{which}: band {band:.2} in {name}; the table says {most:.2}"));
        }
    }
    beyond
}

/// What the machine calls itself, as far as it says.
fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    name.map_or(std::env::consts::ARCH, |(_, name)| name.trim()).to_owned()
}

/// The name of the level, width and shape. One ray at a time there is no level.
fn way<F: Family>(row: &Row<F>) -> (&'static str, usize, &'static str) {
    let way = row.subject.way;
    let level = way.level.name();
    match way.shape {
        Shape::One => ("scalar", 1, "one"),
        Shape::Rays => (level, way.width(), "rays"),
        Shape::Primitives => (level, way.width(), "primitives"),
    }
}

fn row_json<F: Family>(row: &Row<F>, time: &Time) -> Value {
    let (Row { subject, setting, tally, .. }, facts) = (row, row.family.facts());
    let (level, width, shape) = way(row);
    json!({
        "suite": F::SORT,
        "kernel": subject.kernel.name(),
        "variant": subject.kernel.variant(),
        "default": subject.kernel.is_default(),
        "exact": subject.kernel.is_exact(),
        "level": level,
        "shape": shape,
        "width": width,
        "family": facts.name,
        "kind": facts.kind.name(),
        // Whether there are errors of t that tell of the kernel.
        "fair": facts.fair && tally.t_ulp.count() > 0,
        "seed": setting.seed,
        "scale": setting.scale,
        "offset": setting.offset,
        "rays": tally.rays,
        "leaks": tally.leaks,
        "double_hits": tally.double_hits,
        "false_hits": tally.false_hits,
        "false_misses": tally.false_misses,
        "nan_hits": tally.nan_hits,
        "unsure": tally.unsure,
        "t_ulp": {
            "p50": tally.t_ulp.at(0.5),
            "p99": tally.t_ulp.at(0.99),
            "max": tally.t_ulp.max(),
        },
        "band": tally.band,
        "band_of_reach": tally.band_of_reach,
        "ns": time.median,
        "ns_least": time.least,
    })
}

/// The worst of each kernel over all families: rays in lanes at one level, or one at a time where
/// there is no more.
fn table<F: Family>(rows: &[(&Row<F>, &Time)], level: Level) -> String {
    let mut text = format!(
        "{} at {level}, worst of {} families of {} rays\n",
        F::SORT,
        F::all().len(),
        rows.first().map_or(0, |(row, _)| row.tally.rays)
    );
    let _ = writeln!(
        text,
        "{:<50}{:>8}{:>10}{:>12}{:>12}{:>10}{:>12}",
        "", "ns/test", "leaks/M", "misses/M", "false/M", "t p99", "band"
    );
    for kernel in F::kernels() {
        let its: Vec<_> = rows
            .iter()
            .filter(|(row, _)| {
                let subject = row.subject;
                (subject.kernel.name(), subject.kernel.variant())
                    == (kernel.name(), kernel.variant())
            })
            .collect();
        let at = |shape| {
            let is = move |row: &Row<F>| {
                let way = row.subject.way;
                way.shape == shape && (shape == Shape::One || way.level == level)
            };
            its.iter().filter(|(row, _)| is(row)).copied().collect::<Vec<_>>()
        };
        let shown = [Shape::Rays, Shape::One].map(at).into_iter().find(|rows| !rows.is_empty());
        let Some(shown) = shown else { continue };
        let only: Vec<_> = shown.iter().map(|(row, _)| *row).collect();
        let worst = worst(&only);
        let mark = if kernel.is_default() { " *" } else { "" };
        let name = format!("{} ({}){mark}", kernel.name(), kernel.variant());
        let _ = writeln!(
            text,
            "{name:<50}{:>8.2}{:>10.0}{:>12.0}{:>12.0}{:>10.3}{:>12.1}",
            shown[0].1.median,
            worst.leaks,
            worst.false_misses,
            worst.false_hits,
            worst.t_p99,
            worst.band
        );
    }
    text + "* what renders\n\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_that_says_too_little_is_found() {
        let edge = TriangleFamily::named("edge").unwrap();
        let subjects = subjects::<TriangleFamily>();
        let rows = measure(&subjects, edge, edge.facts().setting, 1_024);
        assert_eq!(beyond(&ERRORS, &rows), <[String; 0]>::default());
        let too_little = ERRORS.map(|errors| Errors { reach: 0.1, coordinate: 0.0, ..errors });
        let found = beyond(&too_little, &rows);
        for errors in &ERRORS {
            let name = errors.method.name();
            assert!(found.iter().any(|text| text.starts_with(name)), "{name}: {found:?}");
        }
    }
}
