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
    /// The least number of rays in any family.
    pub(super) rays: u64,
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

/// How often something went wrong, and in which family.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rate {
    pub(super) per_million: f64,
    pub(super) family: String,
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
        let rays = rows.iter().map(|row| row.rays.get()).min().unwrap_or(1);
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
        Ok(Suite { kind, kernels: names, points: points.into_values().collect(), rays })
    }

    /// Each variant at the best level that it has.
    pub(super) fn best(&self) -> impl Iterator<Item = &Point> {
        let same = |a: &Point, b: &Point| a.kernel == b.kernel && a.variant == b.variant;
        // Levels are sorted: of each group the last is the best.
        self.points.chunk_by(same).filter_map(|levels| levels.last())
    }

    /// One variant of each kernel, at all of its levels: the default one, or of those at the most
    /// levels the one that errs least.
    pub(super) fn at_levels(&self) -> Vec<&[Point]> {
        let same = |a: &Point, b: &Point| a.kernel == b.kernel && a.variant == b.variant;
        let rank = |levels: &&[Point]| {
            let last = &levels[levels.len() - 1];
            (!last.default, usize::MAX - levels.len(), !last.exact)
        };
        let worth = |levels: &&[Point]| {
            let last = &levels[levels.len() - 1];
            (last.hard().unwrap_or(f64::INFINITY), last.ns)
        };
        let choose = |kernel: usize| {
            let variants = self.points.chunk_by(same).filter(|levels| levels[0].kernel == kernel);
            variants.min_by(|a, b| {
                let ((a0, a1), (b0, b1)) = (worth(a), worth(b));
                rank(a).cmp(&rank(b)).then(a0.total_cmp(&b0)).then(a1.total_cmp(&b1))
            })
        };
        (0..self.kernels.len()).filter_map(choose).collect()
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
    let per_million = wrong as f64 * 1e6 / row.rays.get() as f64;
    if rate.as_ref().is_none_or(|rate| per_million > rate.per_million) {
        *rate = Some(Rate { per_million, family: row.family.0.clone() });
    }
}

/// Names a row.
fn about(row: &Row) -> String {
    let (kernel, variant, level) = (&row.kernel.0, &row.variant.0, row.level.name());
    format!("{kernel} ({variant}) at {level}, family {}", row.family.0)
}
