//! What the marks mean, and which points the front is made of.

use plotters::prelude::*;

use super::marker::{Marker, ring};
use super::model::{Model, Point, Rate, Suite};
use super::rows::LevelIndex;
use super::scale::number;
use super::style::{
    AXIS, BEATEN, BOLD, Canvas, Drawn, FAINT, NOTE, PLAIN, Pixel, color, fill, path,
};

/// The marks, in one line or more from a place on. Returns where the next line may be.
pub(super) fn marks(model: &Model, page: &Canvas, (x, y): Pixel) -> Result<i32, Failed> {
    let mut levels: Vec<LevelIndex> =
        model.suites.iter().flat_map(|suite| &suite.points).map(|point| point.level).collect();
    levels.sort();
    levels.dedup();
    let grey = |level, filled| Marker { level, color: FAINT, filled, faded: false };
    let mut at = x;
    BOLD.write(page, (at, y), "Shape: the level")?;
    at += BOLD.width("Shape: the level") + 14;
    for level in &levels {
        grey(*level, true).draw(page, (at, y))?;
        PLAIN.write(page, (at + 12, y), level.name())?;
        at += 30 + PLAIN.width(level.name());
    }
    at += 30;
    let best = levels.last().copied().unwrap_or(LevelIndex(0));
    grey(best, true).draw(page, (at, y))?;
    at = say(page, (at + 12, y), "filled: the same bits on every machine")?;
    grey(best, false).draw(page, (at, y))?;
    at = say(page, (at + 12, y), "hollow: bits differ")?;
    let _ = at;

    let y = y + 26;
    let mut at = x + 6;
    ring(page, (at, y))?;
    grey(best, true).draw(page, (at, y))?;
    at = say(page, (at + 16, y), "what rt renders with")?;
    path(page, vec![(at, y), (at + 22, y)], FAINT, 2)?;
    at = say(page, (at + 30, y), "the best of one kernel; its other variants are pale")?;
    fill(page, [(at, y - 8), (at + 22, y + 8)], BEATEN)?;
    path(page, vec![(at, y - 8), (at, y + 8), (at + 22, y + 8)], AXIS, 1)?;
    say(page, (at + 30, y), "grey: another is faster and errs less (the Pareto front)")?;
    Ok(y + 26)
}

type Failed = DrawingAreaErrorKind<std::io::Error>;

/// Writes, and returns where the next may begin.
fn say(page: &Canvas, at: Pixel, text: &str) -> Result<i32, Failed> {
    PLAIN.write(page, at, text)?;
    Ok(at.0 + PLAIN.width(text) + 24)
}

/// The kernels of a suite and their colours, in a line: as many as it holds.
pub(super) fn kernels(suite: &Suite, page: &Canvas, (mut x, y): Pixel, width: i32) -> Drawn {
    let end = x + width - 100;
    let room = width / i32::try_from(suite.kernels.len().max(1)).unwrap_or(i32::MAX) - 40;
    for (kernel, name) in suite.kernels.iter().enumerate() {
        let name = BOLD.fit(name, room.max(60));
        if x + BOLD.width(&name) > end && kernel + 1 < suite.kernels.len() {
            let rest = suite.kernels.len() - kernel;
            return NOTE.write(page, (x, y), &format!("and {rest} more"));
        }
        fill(page, [(x, y - 6), (x + 12, y + 6)], color(kernel))?;
        BOLD.write(page, (x + 18, y), &name)?;
        x += 40 + BOLD.width(&name);
    }
    Ok(())
}

/// The points of the front with their figures, in a part of the page.
pub(super) fn front(
    suite: &Suite,
    points: &[&Point],
    page: &Canvas,
    (x, y): Pixel,
    (width, height): Pixel,
) -> Drawn {
    let front = Suite::front(points, Point::hard);
    BOLD.write(page, (x, y + 8), "The front, fastest first")?;
    NOTE.write(page, (x, y + 27), "ns per test, wrong per million (worst family)")?;
    let room = usize::try_from((height - 44) / 36).unwrap_or(0);
    let is_on_front = |a: &Point| front.iter().any(|b| std::ptr::eq(a, *b));
    let apart: Vec<&Point> =
        points.iter().copied().filter(|point| point.default && !is_on_front(point)).collect();
    let shown = front.len().min(room.saturating_sub(apart.len()));
    let mut top = y + 54;
    let entries = front.iter().enumerate().take(shown).map(|(i, p)| ((i + 1).to_string(), *p));
    for (number, point) in entries.chain(apart.into_iter().map(|point| (String::new(), point))) {
        let level = point.level;
        BOLD.write(page, (x, top + 8), &number)?;
        let at = (x + 28, top + 8);
        if point.default {
            ring(page, at)?;
        }
        Marker { level, color: color(point.kernel), filled: point.exact, faded: false }
            .draw(page, at)?;
        let (left, kernel) = (x + 48, &suite.kernels[point.kernel]);
        let figures = format!("{kernel}: {}", figures(point));
        PLAIN.write(page, (left, top), &PLAIN.fit(&figures, width - 48))?;
        NOTE.write(page, (left, top + 16), &NOTE.fit(&point.variant, width - 48))?;
        top += 36;
    }
    Ok(())
}

fn figures(point: &Point) -> String {
    let errors = match &point.hard {
        None => "not judged".to_owned(),
        Some(Rate { per_million, .. }) if *per_million == 0.0 => "none seen".to_owned(),
        Some(Rate { per_million, family, .. }) => format!("{} ({family})", number(*per_million)),
    };
    format!("{} ns, {errors}", number(point.ns))
}
