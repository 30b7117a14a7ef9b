//! The page: a legend, a block for each suite, a caption.

use plotters::prelude::*;

use super::model::{Error, Model, Point, Rate, Suite};
use super::panel::Panel;
use super::rows::SuiteKind;
use super::scale::{Scale, number};
use super::style::{BOLD, Canvas, Drawn, NOTE, Words};
use super::{legend, levels};

const WIDTH: i32 = 1200;
const MARGIN: i32 = 30;
/// The height of what is above the suites.
const HEAD: i32 = 130;
/// The heights of the two rows of a suite.
const ROWS: [i32; 2] = [370, 300];
/// The height of a suite, with its title and what separates it from the next.
const SUITE: i32 = TITLE + ROWS[0] + GAP + ROWS[1] + 2 * GAP;
/// The height of a suite's title.
const TITLE: i32 = 44;
const GAP: i32 = 16;
const LINE: i32 = 18;

/// Beyond 2^24 units in the last place nothing of a number is right: more says no more.
const LIMIT: f64 = 1e7;

/// What is called wrong in a suite.
struct Terms {
    title: &'static str,
    wrong: &'static str,
    edges: &'static str,
    t: &'static str,
}

impl Terms {
    fn of(kind: SuiteKind) -> Terms {
        match kind {
            SuiteKind::Triangle => Terms {
                title: "Ray/triangle",
                wrong: "leaks",
                edges: "rays aimed at edges and vertices",
                t: "ulps of t",
            },
            SuiteKind::Box => Terms {
                title: "Ray/box",
                wrong: "false misses",
                edges: "rays aimed at edges and sides",
                t: "ulps of the t of entry",
            },
            SuiteKind::Quadric => Terms {
                title: "Ray/quadric",
                wrong: "false hits and misses",
                edges: "rays that graze, from near and far",
                t: "ulps of t",
            },
        }
    }
}

/// Draws all of it.
pub(crate) fn svg(model: &Model) -> String {
    let mut text = String::new();
    let caption = caption(model);
    let lines = i32::try_from(caption.len()).unwrap_or(i32::MAX / 100);
    let suites = i32::try_from(model.suites.len()).unwrap_or(3);
    let height = HEAD + suites * SUITE + lines * LINE + MARGIN;
    {
        let size = (WIDTH.unsigned_abs(), height.unsigned_abs());
        let page = SVGBackend::with_string(&mut text, size).into_drawing_area();
        draw(model, &caption, &page).expect("strings can be written to");
    }
    text
}

fn draw(model: &Model, caption: &[String], page: &Canvas) -> Drawn {
    page.fill(&WHITE)?;
    let title = Words { size: 22, ..BOLD };
    title.write(page, (MARGIN, 34), "Speed against accuracy: lower left is better")?;
    legend::marks(model, page, (MARGIN, 72))?;
    let mut y = HEAD;
    for suite in &model.suites {
        block(suite, page, y)?;
        y += SUITE;
    }
    for line in caption {
        NOTE.write(page, (MARGIN, y), line)?;
        y += LINE;
    }
    page.present()
}

fn block(suite: &Suite, page: &Canvas, y: i32) -> Drawn {
    let terms = Terms::of(suite.kind);
    let title = Words { size: 18, ..BOLD };
    title.write(page, (MARGIN, y + 12), terms.title)?;
    legend::kernels(suite, page, (MARGIN + 150, y + 13), WIDTH - 2 * MARGIN - 150)?;

    let points: Vec<_> = suite.best().collect();
    let time = Scale::around(points.iter().map(|point| point.ns), 7);
    let rates = points.iter().flat_map(|point| [point.hard(), point.natural()]).flatten();
    let lanes = suite.kernels.len() as f64;
    let strip = ((lanes + 1.0) * 15.0).min(140.0) / f64::from(ROWS[0] - 86);
    let scale = Scale::decades(rates.chain([1e6]), 1e6, strip);
    let none_hard = none(points.iter().filter_map(|point| point.hard.as_ref()));
    let none_natural = none(points.iter().filter_map(|point| point.natural.as_ref()));
    let top = y + TITLE;
    let wrong = format!("{} per million in the worst family", terms.wrong);
    let hard = Panel {
        title: &format!("Hard: {}", terms.edges),
        unit: &wrong,
        suite,
        points: &points,
        error: Point::hard,
        time: &time,
        scale: &scale,
        zero: ["none seen", &none_hard],
        labels: true,
        numbered: true,
    };
    hard.draw(page, (6, top), (530, ROWS[0]))?;
    let natural = Panel {
        title: "Natural: random and camera rays",
        unit: "the same, on the same scale",
        error: Point::natural,
        zero: ["none seen", &none_natural],
        labels: false,
        numbered: false,
        ..hard
    };
    natural.draw(page, (536, top), (300, ROWS[0]))?;
    legend::front(suite, &points, page, (860, top), (WIDTH - MARGIN - 860, ROWS[0]))?;

    let top = top + ROWS[0] + GAP;
    let ulps = format!("{}: 99 % of the hits err by less", terms.t);
    let rest: [(&str, &str, Error, i32); 2] = [
        ("Error of t", &ulps, |point| point.t, 6),
        (
            "Band: the worst misjudged ray",
            "from an edge, in 2⁻²⁴ of the coordinates",
            |point| point.band,
            361,
        ),
    ];
    for (title, unit, error, x) in rest {
        let values: Vec<_> = points.iter().filter_map(|point| error(point)).collect();
        let strip = if values.contains(&0.0) { 0.2 } else { 0.0 };
        let scale = Scale::decades(values.into_iter(), LIMIT, strip);
        let panel = Panel {
            title,
            unit,
            error,
            scale: &scale,
            zero: ["0", ""],
            labels: true,
            numbered: false,
            ..hard
        };
        panel.draw(page, (x, top), (355, ROWS[1]))?;
    }
    levels::draw(suite, page, (736, top), (WIDTH - MARGIN - 736 + 14, ROWS[1]))
}

/// What it means that nothing was seen.
fn none<'a>(rates: impl Iterator<Item = &'a Rate>) -> String {
    let rays = rates.map(|rate| rate.rays).min();
    rays.map_or(String::new(), |n| {
        format!("fewer than 3/N = {} per million", number(3e6 / n as f64))
    })
}

/// What it was measured with, in lines.
fn caption(model: &Model) -> Vec<String> {
    let machine = format!("Machine: {}", model.machine);
    let commands = model.commands.iter().map(|command| format!("Command: {command}"));
    let about = "Each point is one variant of a kernel in the fastest of its shapes (one ray, rays in \
        lanes, primitives in lanes) at the best level that it has; time and errors are of the same \
        compiled code in one run. N is the number of rays in each family; of what was not seen in N \
        rays, the rate is below 3/N with 95 % confidence; there every kernel has a line of its own. \
        An ulp is a unit in the last place of the exact t. The band is how far beside an edge a ray \
        was still misjudged, in units of 2⁻²⁴ of the greatest coordinate.";
    let paragraphs = [about.to_owned(), machine].into_iter().chain(commands);
    paragraphs.flat_map(|paragraph| NOTE.wrap(&paragraph, WIDTH - 2 * MARGIN)).collect()
}
