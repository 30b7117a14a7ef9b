//! The times of what stands for each kernel at all of its levels.

use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::style::text_anchor::HPos;

use super::marker::{Marker, ring};
use super::model::Suite;
use super::scale::{Place, Scale};
use super::style::{AXIS, BOLD, Canvas, Drawn, GRID, NOTE, PLAIN, Pixel, Words, color, path};

/// The height of the two lines above.
const HEAD: i32 = 44;
/// The height of the axis.
const FOOT: i32 = 42;
/// The width of the names.
const NAMES: i32 = 215;

/// Draws them in a part of the page.
pub(super) fn draw(suite: &Suite, page: &Canvas, (x, y): Pixel, (width, height): Pixel) -> Drawn {
    let rows = suite.at_levels();
    let times = rows.iter().flat_map(|row| row.iter()).map(|point| point.ns);
    let scale = Scale::around(times, 7);
    let (left, right) = (x + NAMES, x + width - 14);
    let (top, bottom) = (y + HEAD, y + height - FOOT);
    let at = |ns: f64| scale.map(&Place::At(ns), (left, right));

    BOLD.write(page, (x + 4, y + 8), "Levels")?;
    NOTE.write(page, (x + 4, y + 27), "what renders, or one variant of a kernel, at its levels")?;
    let middle = Words { align: HPos::Center, ..NOTE };
    for tick in scale.key_points(10) {
        let x = scale.map(&tick, (left, right));
        path(page, vec![(x, top), (x, bottom)], GRID, 1)?;
        middle.write(page, (x, bottom + 13), &Scale::format(&tick))?;
    }
    path(page, vec![(left, bottom), (right, bottom)], AXIS, 1)?;
    middle.write(page, ((left + right) / 2, bottom + 31), "ns per test")?;

    let pitch = (bottom - top) / i32::try_from(rows.len().max(1)).unwrap_or(i32::MAX);
    for (i, row) in rows.iter().enumerate() {
        let share = (i as f64 + 0.5) / rows.len() as f64;
        let y = top + (f64::from(bottom - top) * share).round() as i32;
        let kernel = row[0].kernel;
        let name = PLAIN.fit(&suite.kernels[kernel], NAMES - 16);
        let variant = NOTE.fit(&row[0].variant, NAMES - 16);
        // With little room only the name, with less nothing.
        let name_at = if pitch < 30 { y } else { y - 7 };
        if pitch >= 13 {
            Words { color: color(kernel), ..BOLD }.write(page, (x + 4, name_at), &name)?;
        }
        if pitch >= 30 {
            NOTE.write(page, (x + 4, y + 8), &variant)?;
        }
        let places: Vec<_> = row.iter().map(|point| (at(point.ns), y)).collect();
        path(page, places.clone(), color(kernel), 2)?;
        if let (true, Some(best)) = (row[0].default, places.last()) {
            ring(page, *best)?;
        }
        for (point, at) in row.iter().zip(places) {
            let (level, color, filled) = (point.level, color(kernel), point.exact);
            Marker { level, color, filled, faded: false }.draw(page, at)?;
        }
    }
    Ok(())
}
