//! What of the rows is worth showing.
//!
//! Of each variant of a kernel at each level there is one point: the fastest of its shapes, with
//! what that same code got wrong.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use super::front::front;
use super::rows::{FamilyKind, LevelIndex, Measured, Row, Shape, SuiteKind, Text};

/// All that is drawn.
#[derive(Debug)]
pub(crate) struct Model {
    pub(super) machine: String,
    pub(super) commands: Vec<String>,
    pub(super) suites: Vec<Suite>,
}

/// The kernels for one kind of primitive.
#[derive(Debug)]
pub(super) struct Suite {
    pub(super) kind: SuiteKind,
    /// The default one first, the others by name.
    pub(super) kernels: Vec<String>,
    /// By kernel, variant and level.
    pub(super) points: Vec<Point>,
}

/// One variant of a kernel at one level.
#[derive(Clone, Debug)]
pub(super) struct Point {
    /// Its place among the suite's kernels.
    pub(super) kernel: usize,
    pub(super) variant: String,
    pub(super) level: LevelIndex,
    pub(super) default: bool,
    pub(super) exact: bool,
    /// Time of a test.
    pub(super) ns: f64,
    /// What it got wrong in the worst of the hard families.
    pub(super) hard: Option<Rate>,
    /// The same where rays are as chance has them.
    pub(super) natural: Option<Rate>,
    /// Error of `t` that 99 % of the hits keep, in the worst fair family.
    pub(super) t: Option<f64>,
    /// How far from an edge a ray was misjudged.
    pub(super) band: Option<f64>,
}

/// How often something went wrong in the worst of some families, and in which.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rate {
    pub(super) per_million: f64,
    pub(super) family: String,
    /// The least number of rays in any of the families.
    pub(super) rays: u64,
}

/// One of the errors of a point.
pub(super) type Error = fn(&Point) -> Option<f64>;

impl Point {
    pub(super) fn hard(&self) -> Option<f64> {
        self.hard.as_ref().map(|rate| rate.per_million)
    }

    pub(super) fn natural(&self) -> Option<f64> {
        self.natural.as_ref().map(|rate| rate.per_million)
    }
}

impl Model {
    /// What files have together. They are to be of one machine: times of two say nothing about
    /// kernels.
    pub(crate) fn new(files: Vec<Measured>) -> Result<Model, String> {
        let Some(first) = files.first() else { return Err("there are no files".into()) };
        let machine = first.machine.0.clone();
        let mut commands: Vec<String> = Vec::new();
        let mut suites = BTreeMap::<SuiteKind, Vec<Row>>::new();
        for file in files {
            if file.machine.0 != machine {
                let other = file.machine.0;
                return Err(format!("two machines in one chart: {machine:?} and {other:?}"));
            }
            if !commands.contains(&file.command.0) {
                commands.push(file.command.0);
            }
            for row in file.rows {
                suites.entry(row.suite).or_default().push(row);
            }
        }
        if suites.is_empty() {
            return Err("there are no rows".into());
        }
        let suites = suites.into_iter().map(|(kind, rows)| Suite::new(kind, rows));
        Ok(Model { machine, commands, suites: suites.collect::<Result<_, _>>()? })
    }

    /// How many suites, kernels and variants there are.
    pub(crate) fn counts(&self) -> [usize; 3] {
        let kernels = self.suites.iter().map(|suite| suite.kernels.len()).sum();
        let variants = self.suites.iter().map(|suite| suite.best().count()).sum();
        [self.suites.len(), kernels, variants]
    }
}

/// The same compiled code: what has one time.
type Key = (Text, Text, LevelIndex, Shape, u32);

impl Suite {
    fn new(kind: SuiteKind, rows: Vec<Row>) -> Result<Suite, String> {
        let mut kernels: Vec<_> = rows.iter().map(|row| (!row.default, &row.kernel.0)).collect();
        kernels.sort();
        let mut names: Vec<String> = Vec::new();
        for (_, name) in kernels {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }

        let mut codes = BTreeMap::<Key, Point>::new();
        for row in rows {
            let key = (row.kernel.clone(), row.variant.clone(), row.level, row.shape, row.width);
            let point = match codes.entry(key) {
                Entry::Occupied(entry) => entry.into_mut(),
                Entry::Vacant(entry) => {
                    let kernel = names.iter().position(|name| *name == row.kernel.0);
                    entry.insert(Point::new(kernel.unwrap_or_default(), &row))
                }
            };
            point.add(kind, &row).map_err(|why| format!("{}: {why}", about(&row)))?;
        }

        let mut points = BTreeMap::<_, Point>::new();
        for point in codes.into_values() {
            match points.entry((point.kernel, point.variant.clone(), point.level)) {
                Entry::Vacant(entry) => {
                    entry.insert(point);
                }
                Entry::Occupied(mut entry) if point.ns < entry.get().ns => {
                    entry.insert(point);
                }
                Entry::Occupied(_) => {}
            }
        }
        Ok(Suite { kind, kernels: names, points: points.into_values().collect() })
    }

    /// Each variant at the best level that it has.
    pub(super) fn best(&self) -> impl Iterator<Item = &Point> {
        let same = |a: &Point, b: &Point| a.kernel == b.kernel && a.variant == b.variant;
        // Levels are sorted: of each group the last is the best.
        self.points.chunk_by(same).filter_map(|levels| levels.last())
    }

    /// What stands for each kernel, at all of its levels: its default variants, or else of those at
    /// the most levels the one that errs least.
    pub(super) fn at_levels(&self) -> Vec<&[Point]> {
        let same = |a: &Point, b: &Point| a.kernel == b.kernel && a.variant == b.variant;
        let worth = |levels: &&[Point]| {
            let last = &levels[levels.len() - 1];
            (last.hard().unwrap_or(f64::INFINITY), last.ns)
        };
        let rank = |levels: &&[Point]| (usize::MAX - levels.len(), !levels[levels.len() - 1].exact);
        let choose = |kernel: usize| {
            let variants = self.points.chunk_by(same).filter(|levels| levels[0].kernel == kernel);
            let (default, rest): (Vec<_>, Vec<_>) = variants.partition(|levels| levels[0].default);
            if !default.is_empty() {
                return default;
            }
            let least = rest.into_iter().min_by(|a, b| {
                let ((a0, a1), (b0, b1)) = (worth(a), worth(b));
                rank(a).cmp(&rank(b)).then(a0.total_cmp(&b0)).then(a1.total_cmp(&b1))
            });
            Vec::from_iter(least)
        };
        (0..self.kernels.len()).flat_map(choose).collect()
    }

    /// Those of some points that are on the front of time and an error.
    pub(super) fn front<'a>(points: &[&'a Point], error: Error) -> Vec<&'a Point> {
        let known: Vec<_> =
            points.iter().filter_map(|&point| Some((point, (point.ns, error(point)?)))).collect();
        let coordinates: Vec<_> = known.iter().map(|(_, at)| *at).collect();
        front(&coordinates).into_iter().map(|i| known[i].0).collect()
    }
}

impl Point {
    fn new(kernel: usize, row: &Row) -> Point {
        Point {
            kernel,
            variant: row.variant.0.clone(),
            level: row.level,
            default: row.default,
            exact: row.exact,
            ns: row.ns,
            hard: None,
            natural: None,
            t: None,
            band: None,
        }
    }

    fn add(&mut self, suite: SuiteKind, row: &Row) -> Result<(), String> {
        if self.ns != row.ns {
            return Err(format!("two times for the same code, {} and {} ns", self.ns, row.ns));
        }
        if (self.default, self.exact) != (row.default, row.exact) {
            return Err("rows differ in \"default\" or \"exact\"".into());
        }
        let rays = row.rays.get();
        let counts = [row.leaks, row.false_hits, row.false_misses];
        if let Some(count) = counts.into_iter().find(|count| *count > rays) {
            return Err(format!("{count} of {rays} rays went wrong"));
        }
        if row.kind == FamilyKind::Broken {
            return Ok(());
        }
        let hard =
            if suite == SuiteKind::Triangle { FamilyKind::Closed } else { FamilyKind::Single };
        if row.kind == hard {
            worst(&mut self.hard, suite, row);
        } else if row.kind == FamilyKind::Natural {
            worst(&mut self.natural, suite, row);
        }
        if row.fair {
            self.t = Some(self.t.unwrap_or(0.0).max(row.t_ulp.p99));
        }
        self.band = Some(self.band.unwrap_or(0.0).max(row.band));
        Ok(())
    }
}

/// Keeps the worst family.
fn worst(rate: &mut Option<Rate>, suite: SuiteKind, row: &Row) {
    let wrong = match suite {
        SuiteKind::Triangle => row.leaks,
        SuiteKind::Box => row.false_misses,
        SuiteKind::Quadric => row.false_hits + row.false_misses,
    };
    let rays = row.rays.get();
    let per_million = wrong as f64 * 1e6 / rays as f64;
    let family = &row.family.0;
    let rate = rate.get_or_insert_with(|| Rate { per_million, family: family.clone(), rays });
    rate.rays = rate.rays.min(rays);
    if per_million > rate.per_million {
        (rate.per_million, rate.family) = (per_million, family.clone());
    }
}

/// Names a row.
fn about(row: &Row) -> String {
    let (kernel, variant, level) = (&row.kernel.0, &row.variant.0, row.level.name());
    format!("{kernel} ({variant}) at {level}, family {}", row.family.0)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    /// A row, but for what is given.
    fn row(given: Value) -> Value {
        let mut row = json!({
            "suite": "triangle", "kernel": "k", "variant": "v", "default": false, "exact": true,
            "level": "scalar", "shape": "one", "width": 1, "family": "edge", "kind": "closed",
            "seed": 1, "scale": 1.0, "offset": 0.0, "rays": 1000, "leaks": 0, "double_hits": 0,
            "false_hits": 0, "false_misses": 0, "nan_hits": 0,
            "t_ulp": { "p50": 0.5, "p99": 2.0, "max": 3.0 }, "fair": true, "band": 1.0, "ns": 1.0,
        });
        for (key, value) in given.as_object().expect("an object") {
            row[key] = value.clone();
        }
        row
    }

    fn file(rows: &[Value]) -> Measured {
        let json = json!({ "machine": "m", "command": "c", "rows": rows });
        serde_json::from_value(json).expect("rows")
    }

    fn model(rows: &[Value]) -> Result<Model, String> {
        Model::new(vec![file(rows)])
    }

    fn points(rows: &[Value]) -> Vec<Point> {
        model(rows).expect("a model").suites.remove(0).points
    }

    #[test]
    fn the_worst_family_counts_and_is_named() {
        let points = points(&[
            row(json!({ "family": "edge", "leaks": 20 })),
            // A higher rate with fewer leaks.
            row(json!({ "family": "vertex", "leaks": 10, "rays": 100 })),
            row(json!({ "family": "far", "leaks": 0 })),
            row(json!({ "family": "random", "kind": "natural", "leaks": 1 })),
            // Others do not count: they are not of closed meshes.
            row(json!({ "family": "band", "kind": "single", "leaks": 1000 })),
            row(json!({ "family": "nan", "kind": "broken", "leaks": 1000 })),
        ]);
        let rate = |per_million, family: &str, rays| {
            Some(Rate { per_million, family: family.into(), rays })
        };
        assert_eq!(points.len(), 1);
        assert_eq!(points[0].hard, rate(100_000.0, "vertex", 100));
        assert_eq!(points[0].natural, rate(1000.0, "random", 1000));
    }

    #[test]
    fn boxes_must_not_miss_and_quadrics_must_be_right() {
        let wrong = |suite: &str| {
            let counts = json!({ "suite": suite, "kind": "single", "leaks": 5, "false_hits": 30,
                "false_misses": 200 });
            points(&[row(counts)])[0].hard().expect("a rate")
        };
        assert_eq!(wrong("box"), 200_000.0);
        assert_eq!(wrong("quadric"), 230_000.0);
    }

    #[test]
    fn errors_of_t_count_where_they_are_fair_and_bands_where_numbers_are() {
        let p99 = |p99: f64| json!({ "p50": 0.0, "p99": p99, "max": null });
        let points = points(&[
            row(json!({ "t_ulp": p99(3.0), "band": 4.0 })),
            row(json!({ "t_ulp": p99(9.0), "band": 7.0, "fair": false, "kind": "single" })),
            row(json!({ "t_ulp": p99(99.0), "band": 99.0, "kind": "broken" })),
        ]);
        assert_eq!((points[0].t, points[0].band), (Some(3.0), Some(7.0)));
        let unfair = row(json!({ "fair": false, "band": null }));
        let points = self::points(&[unfair]);
        assert_eq!((points[0].t, points[0].band), (None, Some(f64::INFINITY)));
    }

    #[test]
    fn the_fastest_shape_stands_for_a_variant_with_its_own_errors() {
        let points = points(&[
            row(json!({ "level": "sse2", "width": 4, "shape": "one", "ns": 3.0, "leaks": 1 })),
            row(json!({ "level": "sse2", "width": 4, "shape": "rays", "ns": 1.0, "leaks": 2 })),
            row(
                json!({ "level": "sse2", "width": 4, "shape": "primitives", "ns": 2.0, "leaks": 3 }),
            ),
            row(json!({ "level": "scalar", "ns": 9.0, "leaks": 4 })),
        ]);
        let found: Vec<_> =
            points.iter().map(|point| (point.level.name(), point.ns, point.hard())).collect();
        assert_eq!(found, [("scalar", 9.0, Some(4000.0)), ("sse2", 1.0, Some(2000.0))]);
    }

    #[test]
    fn each_variant_is_shown_at_the_best_level_that_it_has() {
        let mut model = model(&[
            row(json!({ "variant": "a", "level": "avx2", "width": 8 })),
            row(json!({ "variant": "a", "level": "sse4.1", "width": 4 })),
            row(json!({ "variant": "b", "level": "scalar" })),
        ])
        .expect("a model");
        let suite = model.suites.remove(0);
        let best: Vec<_> =
            suite.best().map(|point| (&*point.variant, point.level.name())).collect();
        assert_eq!(best, [("a", "avx2"), ("b", "scalar")]);
        // The variant at the most levels stands for the kernel.
        let levels = suite.at_levels();
        assert_eq!((levels.len(), &*levels[0][0].variant, levels[0].len()), (1, "a", 2));
    }

    #[test]
    fn defaults_come_first_and_stand_for_their_kernel() {
        let mut model = model(&[
            row(json!({ "kernel": "a", "variant": "leaky", "leaks": 9, "ns": 0.1 })),
            row(json!({ "kernel": "a", "variant": "tight", "ns": 0.2 })),
            row(json!({ "kernel": "z", "variant": "tight" })),
            row(json!({ "kernel": "z", "variant": "own", "default": true, "leaks": 1 })),
            row(json!({ "kernel": "z", "variant": "too", "default": true, "leaks": 2 })),
        ])
        .expect("a model");
        let suite = model.suites.remove(0);
        assert_eq!(suite.kernels, ["z", "a"]);
        let shown: Vec<_> = suite.at_levels().iter().map(|row| row[0].variant.clone()).collect();
        assert_eq!(shown, ["own", "too", "tight"]);
    }

    #[test]
    fn only_what_was_judged_can_be_on_the_front() {
        let points = points(&[
            row(json!({ "variant": "a", "kind": "single", "ns": 0.1 })),
            row(json!({ "variant": "b", "ns": 0.5, "leaks": 7 })),
            row(json!({ "variant": "c", "ns": 0.6, "leaks": 7 })),
            row(json!({ "variant": "d", "ns": 0.7 })),
        ]);
        let points: Vec<_> = points.iter().collect();
        let front = Suite::front(&points, Point::hard);
        let names: Vec<_> = front.iter().map(|point| &*point.variant).collect();
        assert_eq!(names, ["b", "d"]);
    }

    #[test]
    fn contradictions_are_told() {
        let twice = |given: Value| model(&[row(json!({})), row(given)]).expect_err("an error");
        let lead = "k (v) at scalar, family edge: ";
        let times = "two times for the same code, 1 and 2 ns";
        assert_eq!(twice(json!({ "ns": 2.0 })), format!("{lead}{times}"));
        let differ = "rows differ in \"default\" or \"exact\"";
        assert_eq!(twice(json!({ "exact": false })), format!("{lead}{differ}"));
        assert_eq!(twice(json!({ "default": true })), format!("{lead}{differ}"));
        for count in ["leaks", "false_hits", "false_misses"] {
            let wrong = "1001 of 1000 rays went wrong";
            assert_eq!(twice(json!({ count: 1001 })), format!("{lead}{wrong}"));
        }
        assert_eq!(model(&[]).expect_err("an error"), "there are no rows");
    }

    #[test]
    fn files_are_drawn_together_if_they_are_of_one_machine() {
        let boxes = [row(json!({ "suite": "box" }))];
        let together = Model::new(vec![file(&[row(json!({}))]), file(&boxes)]).expect("a model");
        assert_eq!((together.counts(), together.commands.len()), ([2, 2, 2], 1));
        let mut other = file(&boxes);
        other.machine = Text::from("n".to_owned());
        let error = Model::new(vec![file(&boxes), other]).expect_err("an error");
        assert_eq!(error, "two machines in one chart: \"m\" and \"n\"");
    }
}
