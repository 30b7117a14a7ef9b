//! Logarithmic axes with room for zero.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// A place on an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// A number above 0.
    At(f64),
    /// A share of the strip for zeros, from 0 at its outer end.
    Strip(f64),
}

/// A logarithmic axis. Zeros have a strip of their own before its lower end; what is beyond an end
/// stands there.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scale {
    low: f64,
    high: f64,
    /// The strip's share of the axis.
    strip: f64,
    ticks: Vec<f64>,
}

impl Scale {
    /// An axis for these numbers, a little longer than they need.
    pub(super) fn around(values: impl Iterator<Item = f64>, max_ticks: usize) -> Scale {
        // No test takes less or more: so far, round numbers are exact enough.
        let values = values.map(|value| value.clamp(1e-6, 1e12));
        let (low, high) = extent(values).unwrap_or((1.0, 1.0));
        // A factor of 1.5 at the least, so that small differences look small.
        let margin = (high / low).powf(0.08).max(1.1).max((1.5 / (high / low)).sqrt());
        Scale::new(low / margin, high * margin, 0.0, max_ticks)
    }

    /// An axis of whole powers of ten for these numbers, no further than `limit`, with a strip.
    pub(super) fn decades(values: impl Iterator<Item = f64>, limit: f64, strip: f64) -> Scale {
        let finite = values.filter(|value| *value > 0.0).map(|value| value.clamp(1e-12, limit));
        let (low, high) = extent(finite).unwrap_or((1.0, 1.0));
        let (low, high) = (low.log10().floor(), high.log10().ceil());
        let high = high.max(low + 1.0);
        Scale::new(10_f64.powf(low), 10_f64.powf(high), strip, 8)
    }

    fn new(low: f64, high: f64, strip: f64, max_ticks: usize) -> Scale {
        Scale { low, high, strip, ticks: ticks(low, high, max_ticks) }
    }

    /// Whether it has a strip.
    pub(super) fn has_strip(&self) -> bool {
        self.strip > 0.0
    }

    /// The ends of its logarithmic part.
    pub(super) fn ends(&self) -> (Place, Place) {
        (Place::At(self.low), Place::At(self.high))
    }
}

/// The least and the greatest.
fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.map(|value| (value, value)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
}

/// Round numbers from low to high: as many as there is room for.
fn ticks(low: f64, high: f64, max: usize) -> Vec<f64> {
    const STEPS: [&[f64]; 4] = [
        &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0],
        &[1.0, 1.5, 2.0, 3.0, 5.0, 7.0],
        &[1.0, 2.0, 5.0],
        &[1.0],
    ];
    let exponents = low.log10().floor() as i32..=high.log10().ceil() as i32;
    let inside = |steps: &[f64]| -> Vec<f64> {
        let all = exponents.clone().flat_map(|e| steps.iter().map(move |step| decimal(*step, e)));
        all.filter(|tick| (low * 0.999..=high * 1.001).contains(tick)).collect()
    };
    let whole_decades = (high / low).log10() > 2.5;
    let steps = if whole_decades { &STEPS[3..] } else { &STEPS[..] };
    let fits = steps.iter().map(|steps| inside(steps)).find(|ticks| ticks.len() <= max);
    fits.unwrap_or_else(|| {
        let decades = inside(STEPS[3]);
        let step = decades.len().div_ceil(max.max(1));
        decades.into_iter().step_by(step).collect()
    })
}

/// The number as it would be read, so that it is also written that way.
fn decimal(step: f64, exponent: i32) -> f64 {
    format!("{step}e{exponent}").parse().unwrap_or(step)
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = Place;

    fn map(&self, place: &Place, (from, to): (i32, i32)) -> i32 {
        let share = match *place {
            Place::Strip(share) => share * self.strip,
            Place::At(value) => {
                let value = value.clamp(self.low, self.high);
                let share = (value / self.low).ln() / (self.high / self.low).ln();
                self.strip + share * (1.0 - self.strip)
            }
        };
        from + (f64::from(to - from) * share).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<Place> {
        let strip = self.has_strip().then_some(Place::Strip(0.5));
        strip.into_iter().chain(self.ticks.iter().map(|tick| Place::At(*tick))).collect()
    }

    fn range(&self) -> Range<Place> {
        let low = if self.has_strip() { Place::Strip(0.0) } else { Place::At(self.low) };
        low..Place::At(self.high)
    }
}

impl ValueFormatter<Place> for Scale {
    fn format(place: &Place) -> String {
        match *place {
            Place::Strip(_) => "none".to_owned(),
            Place::At(value) => number(value),
        }
    }
}

/// A number as people write it: `0.5`, `1,000`, `1e7`.
pub(super) fn number(value: f64) -> String {
    match value {
        1e-3..1.0 => format!("{}", round(value, 3)),
        1.0..10.0 => format!("{}", round(value, 2)),
        10.0..100.0 => format!("{}", round(value, 1)),
        100.0..=1e6 => {
            let digits = format!("{value:.0}");
            match digits.len().checked_sub(3) {
                Some(0) | None => digits,
                Some(7..) => digits,
                Some(at) if at <= 3 => format!("{},{}", &digits[..at], &digits[at..]),
                Some(at) => {
                    format!("{},{},{}", &digits[..at - 3], &digits[at - 3..at], &digits[at..])
                }
            }
        }
        _ => format!("{value:.0e}"),
    }
}

/// To so many places.
fn round(value: f64, places: i32) -> f64 {
    let unit = 10_f64.powi(places);
    (value * unit).round() / unit
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIXELS: (i32, i32) = (100, 0);

    #[test]
    fn zeros_and_numbers_do_not_meet() {
        let scale = Scale::decades([0.0, 4.0, 300_000.0].into_iter(), 1e6, 0.25);
        assert_eq!(scale.ends(), (Place::At(1.0), Place::At(1e6)));
        assert_eq!(scale.map(&Place::At(1.0), PIXELS), 75);
        assert_eq!(scale.map(&Place::At(1e3), PIXELS), 37);
        assert_eq!(scale.map(&Place::At(1e6), PIXELS), 0);
        assert_eq!(scale.map(&Place::Strip(0.0), PIXELS), 100);
        assert_eq!(scale.map(&Place::Strip(1.0), PIXELS), 75);
    }

    #[test]
    fn what_is_beyond_an_end_stands_there() {
        let scale = Scale::decades([1.0, f64::INFINITY].into_iter(), 1e7, 0.0);
        for value in [1e7, 1e300, f64::INFINITY] {
            assert_eq!(scale.map(&Place::At(value), PIXELS), 0);
        }
        assert_eq!(scale.map(&Place::At(1e-300), PIXELS), 100);
    }

    #[test]
    fn axes_of_next_to_nothing_are_axes() {
        for scale in [
            Scale::around([].into_iter(), 6),
            Scale::around([0.6].into_iter(), 6),
            Scale::around([1e-300, 1e300].into_iter(), 6),
            Scale::decades([].into_iter(), 1e6, 0.2),
            Scale::decades([0.0].into_iter(), 1e6, 0.2),
            Scale::decades([1e-320, f64::INFINITY].into_iter(), 1e7, 0.2),
        ] {
            assert!(scale.low > 0.0 && scale.high / scale.low >= 1.4, "{scale:?}");
            assert!((1..=8).contains(&scale.ticks.len()), "{scale:?}");
        }
    }

    #[test]
    fn ticks_are_round_and_as_many_as_fit() {
        assert_eq!(ticks(0.45, 1.4, 6), [0.5, 0.6, 0.8, 1.0, 1.2]);
        assert_eq!(ticks(0.45, 1.4, 4), [0.5, 0.7, 1.0]);
        assert_eq!(ticks(0.3, 30.0, 6), [0.5, 1.0, 2.0, 5.0, 10.0, 20.0]);
        assert_eq!(ticks(1.0, 1e6, 8), [1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6]);
        assert_eq!(ticks(1.0, 1e6, 4), [1.0, 100.0, 1e4, 1e6]);
    }

    #[test]
    fn numbers_are_readable() {
        let cases = [
            (0.5, "0.5"),
            (0.4721, "0.472"),
            (1.238, "1.24"),
            (12.0, "12"),
            (1e3, "1,000"),
            (226_288.4, "226,288"),
            (1e6, "1,000,000"),
            (1e7, "1e7"),
            (1e-9, "1e-9"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value), text);
        }
    }
}
