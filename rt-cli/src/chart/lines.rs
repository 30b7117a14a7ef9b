//! Lines over two logarithmic axes.

use plotters::prelude::*;

use super::scale::{Place, Scale, number};
use super::style::{AXIS, BOLD, Canvas, Drawn, GRID, NOTE, PLAIN, color};

const SIZE: (u32, u32) = (900, 520);

/// A chart of measurements.
pub(crate) struct Lines<'a> {
    pub(crate) title: &'a str,
    /// What the axes are, with their units: the one to the right, the one upward.
    pub(crate) axes: [&'a str; 2],
    pub(crate) lines: Vec<Line>,
}

/// Measurements of one thing. All are greater than 0.
pub(crate) struct Line {
    pub(crate) name: String,
    pub(crate) points: Vec<(f64, f64)>,
}

impl Lines<'_> {
    /// The picture.
    pub(crate) fn svg(&self) -> String {
        let mut svg = String::new();
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        self.draw(&root).expect("a string has room");
        drop(root);
        svg
    }

    fn draw(&self, page: &Canvas) -> Drawn {
        page.fill(&WHITE)?;
        BOLD.write(page, (84, 22), self.title)?;
        NOTE.write(page, (84, 42), self.axes[1])?;
        let all = || self.lines.iter().flat_map(|line| &line.points);
        let x = Scale::around(all().map(|point| point.0), 10);
        let y = Scale::around(all().map(|point| point.1), 10);
        let mut builder = ChartBuilder::on(page);
        builder.margin_top(60).margin_right(210).x_label_area_size(46).y_label_area_size(80);
        let mut chart = builder.build_cartesian_2d(x, y)?;
        let label = |place: &Place| match place {
            Place::At(value) => number(*value),
            Place::Strip(_) => String::new(),
        };
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(GRID)
            .axis_style(AXIS)
            .label_style(NOTE.style())
            .x_label_formatter(&label)
            .y_label_formatter(&label)
            .x_desc(self.axes[0])
            .draw()?;
        // Names stand at the ends of their lines, and below each other where those meet.
        let mut ends = Vec::new();
        for (i, line) in self.lines.iter().enumerate() {
            let places = line.points.iter().map(|&(x, y)| (Place::At(x), Place::At(y)));
            let places: Vec<_> = places.collect();
            chart.draw_series([PathElement::new(places.clone(), color(i).stroke_width(2))])?;
            let dots = places.iter().map(|&place| Circle::new(place, 3, color(i).filled()));
            chart.draw_series(dots)?;
            if let Some(last) = places.last() {
                ends.push((chart.backend_coord(last), i));
            }
        }
        ends.sort_by_key(|((_, y), _)| *y);
        let mut free = 0;
        for ((_, y), i) in ends {
            let y = y.max(free);
            free = y + 18;
            let words = super::style::Words { color: color(i), ..PLAIN };
            words.write(page, (SIZE.0 as i32 - 200, y), &self.lines[i].name)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_and_its_name_are_in_the_picture() {
        let line = |name: &str, f: fn(f64) -> f64| Line {
            name: name.to_owned(),
            points: (0..5).map(|i| 10_f64.powi(i)).map(|x| (x, f(x))).collect(),
        };
        let lines =
            vec![line("straight", |x| x), line("flat", |_| 5.0), line("also flat", |_| 5.0)];
        let svg = Lines { title: "Growth", axes: ["triangles", "ms"], lines }.svg();
        for word in ["Growth", "triangles", "ms", "straight", "flat", "also flat"] {
            assert!(svg.contains(word), "{word}");
        }
        assert_eq!(svg.matches("<circle").count(), 15);
        let document = roxmltree::Document::parse(&svg).expect("it is XML");
        assert_eq!(document.root_element().tag_name().name(), "svg");
    }
}
