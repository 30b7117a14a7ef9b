//! Colours, type and small helpers of drawing.

use std::io;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub(super) type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Drawn = Result<(), DrawingAreaErrorKind<io::Error>>;

/// A place in the picture, in pixels.
pub(super) type Pixel = (i32, i32);

pub(super) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
pub(super) const FAINT: RGBColor = RGBColor(0x66, 0x66, 0x66);
pub(super) const AXIS: RGBColor = RGBColor(0x99, 0x99, 0x99);
pub(super) const GRID: RGBColor = RGBColor(0xe4, 0xe4, 0xe4);
/// Where others are faster and more accurate.
pub(super) const BEATEN: RGBColor = RGBColor(0xf3, 0xf3, 0xf3);
/// Where nothing went wrong.
pub(super) const CLEAN: RGBColor = RGBColor(0xe3, 0xf1, 0xe6);

/// Colours that the colour-blind tell apart too (Okabe and Ito 2008), without the yellow, which
/// is too pale for lines on white.
const KERNELS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x55, 0x55, 0x55),
];

/// The colour of a suite's kernel. The default one, which comes first, has the same in all suites.
pub(super) fn color(kernel: usize) -> RGBColor {
    KERNELS[kernel % KERNELS.len()]
}

/// How words look.
#[derive(Clone, Copy)]
pub(super) struct Words {
    pub(super) size: i32,
    pub(super) color: RGBColor,
    pub(super) bold: bool,
    pub(super) align: HPos,
}

/// Running text.
pub(super) const PLAIN: Words = Words { size: 13, color: INK, bold: false, align: HPos::Left };
pub(super) const BOLD: Words = Words { bold: true, ..PLAIN };
pub(super) const NOTE: Words = Words { size: 12, color: FAINT, ..PLAIN };

impl Words {
    /// For what takes a style: plotters divides sizes by 1.24 on the way to SVG.
    pub(super) fn style(self) -> TextStyle<'static> {
        let style = if self.bold { FontStyle::Bold } else { FontStyle::Normal };
        let font: FontDesc = ("sans-serif", f64::from(self.size) * 1.24, style).into_font();
        let color = self.color.to_backend_color();
        TextStyle { font, color, pos: Pos::new(self.align, VPos::Center) }
    }

    /// Writes at a place, which is that of the text's middle height.
    pub(super) fn write(self, canvas: &Canvas, at: Pixel, text: &str) -> Drawn {
        canvas.draw(&Text::new(text.to_owned(), at, self.style()))
    }

    /// About how wide a text will be, whatever the font: rather too much.
    pub(super) fn width(self, text: &str) -> i32 {
        let share = if self.bold { 0.6 } else { 0.54 };
        (text.chars().count() as f64 * f64::from(self.size) * share).ceil() as i32
    }

    /// As much of a text as has room.
    pub(super) fn fit(self, text: &str, width: i32) -> String {
        if self.width(text) <= width {
            return text.to_owned();
        }
        let room = width / (self.width("0").max(1)) - 1;
        let kept: String = text.chars().take(usize::try_from(room).unwrap_or(0)).collect();
        format!("{}…", kept.trim_end_matches([' ', ',']))
    }

    /// Lines of words with no more width than that.
    pub(super) fn wrap(self, text: &str, width: i32) -> Vec<String> {
        let mut lines: Vec<String> = vec![String::new()];
        for word in text.split_whitespace() {
            let word = self.fit(word, width);
            let last = lines.len() - 1;
            let longer = format!("{} {word}", lines[last]);
            if lines[last].is_empty() {
                lines[last] = word;
            } else if self.width(&longer) <= width {
                lines[last] = longer;
            } else {
                lines.push(word);
            }
        }
        lines
    }
}

/// A line through some places.
pub(super) fn path(
    canvas: &Canvas,
    places: Vec<Pixel>,
    color: impl Into<RGBAColor>,
    width: u32,
) -> Drawn {
    let color: RGBAColor = color.into();
    canvas.draw(&PathElement::new(places, color.stroke_width(width)))
}

/// A filled rectangle.
pub(super) fn fill(canvas: &Canvas, corners: [Pixel; 2], color: RGBColor) -> Drawn {
    canvas.draw(&Rectangle::new(corners, color.filled()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_have_room_or_are_cut() {
        assert_eq!(PLAIN.fit("short", 200), "short");
        let long = "x".repeat(500);
        for width in [0, 10, 50, 300] {
            let cut = PLAIN.fit(&long, width);
            assert!(cut.ends_with('…') && PLAIN.width(&cut) <= width.max(10), "{width}: {cut}");
        }
        let lines = PLAIN.wrap(&format!("one two {long} three"), 100);
        assert!(lines.iter().all(|line| PLAIN.width(line) <= 100), "{lines:?}");
        assert_eq!((&*lines[0], &*lines[lines.len() - 1]), ("one two", "three"));
    }
}
