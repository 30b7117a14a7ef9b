//! Points: the shape is the level, filled are those whose bits are the same on all levels.

use plotters::prelude::*;
use rt_render::Level;

use super::rows::LevelIndex;
use super::style::{Canvas, Drawn, INK, Pixel};

/// Corners for a radius of 1, with y down; none for a circle. They are about equal in area.
type Corners = &'static [(f64, f64)];

/// One shape for each of [`Level::NAMES`].
const SHAPES: [Corners; Level::NAMES.len()] = [
    &[],
    &[(0.0, -1.3), (1.2, 0.8), (-1.2, 0.8)],
    &[(0.0, -1.35), (1.35, 0.0), (0.0, 1.35), (-1.35, 0.0)],
    &[(-0.95, -0.95), (0.95, -0.95), (0.95, 0.95), (-0.95, 0.95)],
    &[(0.0, -1.2), (1.14, -0.37), (0.7, 0.97), (-0.7, 0.97), (-1.14, -0.37)],
    &[(0.0, 1.3), (1.2, -0.8), (-1.2, -0.8)],
    &[(-1.2, 0.0), (-0.6, -1.04), (0.6, -1.04), (1.2, 0.0), (0.6, 1.04), (-0.6, 1.04)],
];

/// How a point is shown.
#[derive(Clone, Copy)]
pub(super) struct Marker {
    pub(super) level: LevelIndex,
    pub(super) color: RGBColor,
    /// Whether it has the same bits on all levels.
    pub(super) filled: bool,
    /// Whether it is one of many others.
    pub(super) faded: bool,
}

impl Marker {
    pub(super) fn draw(self, canvas: &Canvas, at: Pixel) -> Drawn {
        let radius = if self.faded { 4 } else { 5 };
        // Mixed with white instead of transparent: what lies over each other stays as it is.
        let color = if self.faded { pale(self.color) } else { self.color };
        let inside = if self.filled { color } else { WHITE };
        let corners = SHAPES[self.level.0];
        if corners.is_empty() {
            canvas.draw(&Circle::new(at, radius, inside.filled()))?;
            return canvas.draw(&Circle::new(at, radius, color.stroke_width(2)));
        }
        let place = |&(x, y): &(f64, f64)| {
            let offset = |share: f64| (share * f64::from(radius)).round() as i32;
            (at.0 + offset(x), at.1 + offset(y))
        };
        let mut outline: Vec<_> = corners.iter().map(place).collect();
        canvas.draw(&Polygon::new(outline.clone(), inside))?;
        outline.extend(outline.first().copied());
        outline.extend(outline.get(1).copied());
        canvas.draw(&PathElement::new(outline, color.stroke_width(2)))
    }
}

/// What is round the default.
pub(super) fn ring(canvas: &Canvas, at: Pixel) -> Drawn {
    canvas.draw(&Circle::new(at, 10, INK.stroke_width(2)))
}

fn pale(color: RGBColor) -> RGBColor {
    let mix = |part: u8| ((u16::from(part) * 9 + 255 * 11) / 20) as u8;
    RGBColor(mix(color.0), mix(color.1), mix(color.2))
}
