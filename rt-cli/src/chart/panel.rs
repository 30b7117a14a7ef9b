//! Time against one kind of error.

use plotters::coord::CoordTranslate;
use plotters::coord::cartesian::Cartesian2d;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::marker::{Marker, ring};
use super::model::{Error, Point, Suite};
use super::scale::{Place, Scale, number};
use super::style::{
    AXIS, BEATEN, BOLD, CLEAN, Canvas, Drawn, GRID, NOTE, Pixel, Words, color, fill, path,
};

/// The height of the two lines above a panel.
const HEAD: i32 = 44;

/// What a panel shows.
pub(super) struct Panel<'a> {
    pub(super) title: &'a str,
    /// What its upward axis is, with its unit.
    pub(super) unit: &'a str,
    pub(super) suite: &'a Suite,
    pub(super) points: &'a [&'a Point],
    pub(super) error: Error,
    pub(super) time: &'a Scale,
    pub(super) scale: &'a Scale,
    /// What zero is called on the axis, and what it means.
    pub(super) zero: [&'a str; 2],
    /// Whether its upward axis has numbers.
    pub(super) labels: bool,
    /// Whether the points of the front have numbers.
    pub(super) numbered: bool,
}

/// Where the panel's places are in the picture.
struct Map<'a> {
    panel: &'a Panel<'a>,
    area: Cartesian2d<Scale, Scale>,
}

impl Map<'_> {
    fn pixel(&self, x: Place, y: Place) -> Pixel {
        self.area.translate(&(x, y))
    }

    /// The place of a point; kernels have lanes of their own in the strip.
    fn point(&self, point: &Point) -> Option<Pixel> {
        // The lowest is for words.
        let lanes = self.panel.suite.kernels.len() as f64 + 1.0;
        let y = match (self.panel.error)(point)? {
            value if value > 0.0 => Place::At(value),
            _ => Place::Strip(1.0 - (point.kernel as f64 + 0.5) / lanes),
        };
        Some(self.pixel(Place::At(point.ns), y))
    }

    fn x(&self, ns: f64) -> i32 {
        self.pixel(Place::At(ns), self.panel.scale.ends().1).0
    }
}

impl Panel<'_> {
    /// Draws it in a part of the page.
    pub(super) fn draw(&self, page: &Canvas, (x, y): Pixel, (width, height): Pixel) -> Drawn {
        let left = if self.labels { 74 } else { 20 };
        BOLD.write(page, (x + left, y + 8), self.title)?;
        NOTE.write(page, (x + left, y + 27), self.unit)?;
        let area = page.clone().shrink((x, y), (width, height));
        let mut builder = ChartBuilder::on(&area);
        builder.margin_top(HEAD).margin_right(14).x_label_area_size(42).y_label_area_size(left);
        let mut chart = builder.build_cartesian_2d(self.time.clone(), self.scale.clone())?;
        let map = Map { panel: self, area: chart.as_coord_spec().clone() };
        let front = Suite::front(self.points, self.error);
        self.ground(page, &map, &front)?;
        let label = |place: &Place| match place {
            _ if !self.labels => String::new(),
            Place::Strip(_) => self.zero[0].to_owned(),
            Place::At(value) => number(*value),
        };
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(AXIS)
            .label_style(NOTE.style())
            .y_label_formatter(&label)
            .x_desc("ns per test")
            .draw()?;
        if front.is_empty() {
            let words = Words { align: HPos::Center, ..NOTE };
            return words.write(page, (x + (left + width) / 2, y + height / 2), "not measured");
        }
        self.lines(page, &map)?;
        self.marks(page, &map, &front)
    }

    /// The strip, and what is beaten by the front.
    fn ground(&self, page: &Canvas, map: &Map, front: &[&Point]) -> Drawn {
        let (low, high) = self.time.ends();
        let (bottom, top) = self.scale.ends();
        if self.scale.has_strip() {
            let corners = [map.pixel(low, bottom), map.pixel(high, Place::Strip(0.0))];
            fill(page, corners, CLEAN)?;
        }
        let floor = map.pixel(low, bottom).1;
        let (right, top) = map.pixel(high, top);
        let mut edge = Vec::new();
        for (i, point) in front.iter().enumerate() {
            let Some((x, y)) = map.point(point) else { continue };
            let y = y.min(floor);
            let end = front.get(i + 1).map_or(right, |next| map.x(next.ns));
            fill(page, [(x, top), (end, y)], BEATEN)?;
            edge.extend([(x, y), (end, y)]);
        }
        if let Some((x, _)) = edge.first() {
            edge.insert(0, (*x, top));
        }
        path(page, edge, AXIS, 1)
    }

    /// The front of each kernel by itself.
    fn lines(&self, page: &Canvas, map: &Map) -> Drawn {
        for kernel in 0..self.suite.kernels.len() {
            let places = self.own_front(kernel).into_iter().filter_map(|point| map.point(point));
            path(page, places.collect(), color(kernel), 2)?;
        }
        Ok(())
    }

    fn marks(&self, page: &Canvas, map: &Map, front: &[&Point]) -> Drawn {
        let among =
            |points: &[&Point], point: &Point| points.iter().any(|p| std::ptr::eq(*p, point));
        let own: Vec<_> = (0..self.suite.kernels.len()).flat_map(|k| self.own_front(k)).collect();
        // What matters last, so that it lies on top.
        for faded in [true, false] {
            for &point in self.points {
                let Some(at) = map.point(point) else { continue };
                if point.default && !faded {
                    ring(page, at)?;
                }
                if faded != (among(&own, point) || point.default) {
                    let (level, color, filled) = (point.level, color(point.kernel), point.exact);
                    Marker { level, color, filled, faded }.draw(page, at)?;
                }
            }
        }
        if self.numbered {
            self.numbers(page, map, front)?;
        }
        if self.scale.has_strip() {
            let (x, y) = map.pixel(self.time.ends().0, Place::Strip(0.0));
            Words { size: 11, ..NOTE }.write(page, (x + 5, y - 9), self.zero[1])?;
        }
        Ok(())
    }

    /// Numbers the front as far as there is room beside the points.
    fn numbers(&self, page: &Canvas, map: &Map, front: &[&Point]) -> Drawn {
        // To the lower left of the front there is nothing else.
        const OFFSETS: [Pixel; 5] = [(-10, 10), (-13, 0), (-2, 15), (-16, 14), (12, -11)];
        let (left, _) = map.pixel(self.time.ends().0, self.scale.ends().0);
        let near = |a: Pixel, b: Pixel| (a.0 - b.0).abs() < 11 && (a.1 - b.1).abs() < 11;
        let mut taken: Vec<_> = self.points.iter().filter_map(|point| map.point(point)).collect();
        for (i, point) in front.iter().enumerate() {
            let Some((x, y)) = map.point(point) else { continue };
            let mut places = OFFSETS.iter().map(|(dx, dy)| (x + dx, y + dy));
            let free = |at: &Pixel| at.0 > left + 6 && !taken.iter().any(|other| near(*at, *other));
            if let Some(at) = places.find(free) {
                let words = Words { align: HPos::Center, ..BOLD };
                words.write(page, at, &(i + 1).to_string())?;
                taken.push(at);
            }
        }
        Ok(())
    }

    fn own_front(&self, kernel: usize) -> Vec<&Point> {
        let own: Vec<_> = self.points.iter().copied().filter(|p| p.kernel == kernel).collect();
        Suite::front(&own, self.error)
    }
}
