//! What was measured, as it stands in files.

use std::num::NonZeroU64;

use rt_render::Level;
use serde::{Deserialize, Deserializer, de::Error};

/// A file of rows. Keys that are of no use here may stand in it too.
#[derive(Debug, Deserialize)]
pub(crate) struct Measured {
    /// What it was measured on.
    pub(crate) machine: Text,
    /// What measured it.
    pub(crate) command: Text,
    pub(crate) rows: Vec<Row>,
}

impl Measured {
    /// Reads a file.
    pub(crate) fn parse(file: &[u8]) -> Result<Measured, serde_json::Error> {
        serde_json::from_slice(file)
    }
}

/// What one kernel did with one family of inputs.
#[derive(Debug, Deserialize)]
pub(crate) struct Row {
    pub(crate) suite: SuiteKind,
    pub(crate) kernel: Text,
    pub(crate) variant: Text,
    /// Whether it is the one that renders.
    pub(crate) default: bool,
    /// Whether its bits are the same on every level and machine.
    pub(crate) exact: bool,
    pub(crate) level: LevelIndex,
    pub(crate) shape: Shape,
    pub(crate) width: u32,
    pub(crate) family: Text,
    pub(crate) kind: FamilyKind,
    pub(crate) rays: NonZeroU64,
    pub(crate) leaks: u64,
    pub(crate) false_hits: u64,
    pub(crate) false_misses: u64,
    pub(crate) t_ulp: Ulps,
    /// Whether errors of `t` in this family tell about the kernel.
    pub(crate) fair: bool,
    #[serde(deserialize_with = "bound")]
    pub(crate) band: f64,
    #[serde(deserialize_with = "time")]
    pub(crate) ns: f64,
}

/// Of the errors of `t`, the one that is drawn.
#[derive(Debug, Deserialize)]
pub(crate) struct Ulps {
    #[serde(deserialize_with = "bound")]
    pub(crate) p99: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum SuiteKind {
    Triangle,
    Box,
    Quadric,
}

/// What lies in the lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Shape {
    One,
    Rays,
    Primitives,
}

/// What is asked of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum FamilyKind {
    /// Aimed at the edges and vertices of a closed mesh.
    Closed,
    /// As chance has it.
    Natural,
    /// Aimed at what is hard of one primitive.
    Single,
    /// Numbers or primitives that are none.
    Broken,
}

/// A level, by its place among [`Level::NAMES`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(try_from = "String")]
pub(crate) struct LevelIndex(pub(crate) usize);

impl TryFrom<String> for LevelIndex {
    type Error = String;

    fn try_from(name: String) -> Result<LevelIndex, String> {
        let index = Level::NAMES.iter().position(|known| *known == name);
        let names = || Level::NAMES.join(", ");
        index.map(LevelIndex).ok_or_else(|| format!("{name:?} is no level: expected {}", names()))
    }
}

impl LevelIndex {
    pub(crate) fn name(self) -> &'static str {
        Level::NAMES[self.0]
    }
}

/// Words that can stand in XML, where most control characters may not.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(from = "String")]
pub(crate) struct Text(pub(crate) String);

impl From<String> for Text {
    fn from(text: String) -> Text {
        let forbidden = |c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}');
        Text(text.replace(forbidden, "\u{fffd}"))
    }
}

/// How great an error is at most. JSON has no word for the infinite but null.
fn bound<'de, D: Deserializer<'de>>(json: D) -> Result<f64, D::Error> {
    match Option::<f64>::deserialize(json)?.unwrap_or(f64::INFINITY) {
        bound if bound >= 0.0 => Ok(bound),
        bound => Err(Error::custom(format!("expected null or a number from 0 up, found {bound}"))),
    }
}

fn time<'de, D: Deserializer<'de>>(json: D) -> Result<f64, D::Error> {
    match Option::<f64>::deserialize(json)? {
        Some(ns) if ns > 0.0 => Ok(ns),
        Some(ns) => Err(Error::custom(format!("expected a time above 0, found {ns}"))),
        None => Err(Error::custom("expected a time above 0, found null")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = r#"{"machine": "m", "command": "c", "rows": [
{"suite": "triangle", "kernel": "k", "variant": "", "default": false, "exact": true, "more": 0,
"level": "avx2", "shape": "rays", "width": 8, "family": "edge", "kind": "closed", "rays": 10,
"leaks": 1, "false_hits": 2, "false_misses": 3, "t_ulp": {"p99": 2.5}, "fair": true, "band": 1,
"ns": 0.5}
]}"#;

    #[test]
    fn rows_are_read() {
        let file = Measured::parse(FILE.as_bytes()).unwrap();
        let row = &file.rows[0];
        assert_eq!((row.level.name(), row.rays.get(), row.leaks), ("avx2", 10, 1));
        assert_eq!((row.t_ulp.p99, row.band, row.ns), (2.5, 1.0, 0.5));
        let unbounded = FILE.replace("2.5", "null");
        let file = Measured::parse(unbounded.as_bytes()).unwrap();
        assert_eq!(file.rows[0].t_ulp.p99, f64::INFINITY);
    }

    #[test]
    fn what_is_no_row_is_told_with_its_line() {
        let time = "expected a time above 0, found";
        let levels = Level::NAMES.join(", ");
        for (from, to, line, message) in [
            ("\"ns\": 0.5", "\"ns\": 0", 5, format!("{time} 0")),
            ("\"ns\": 0.5", "\"ns\": -1", 5, format!("{time} -1")),
            ("\"ns\": 0.5", "\"ns\": null", 5, format!("{time} null")),
            ("\"ns\": 0.5", "\"ns\": NaN", 5, "expected value".into()),
            ("\"ns\": 0.5", "\"ns\": 1e999", 5, "number out of range".into()),
            ("\"ns\": 0.5", "\"no\": 0.5", 5, "missing field `ns`".into()),
            ("\"band\": 1", "\"bund\": 1", 5, "missing field `band`".into()),
            ("\"p99\"", "\"p98\"", 4, "missing field `p99`".into()),
            ("2.5", "-2.5", 4, "expected null or a number from 0 up, found -2.5".into()),
            ("\"leaks\": 1", "\"leaks\": -1", 4, "invalid value: integer `-1`".into()),
            ("\"leaks\": 1", "\"leaks\": 0.5", 4, "invalid type: floating point `0.5`".into()),
            ("\"rays\": 10", "\"rays\": 0", 3, "invalid value: integer `0`".into()),
            ("true, \"more", "1, \"more", 2, "invalid type: integer `1`, expected a bool".into()),
            ("avx2", "avx3", 3, format!("\"avx3\" is no level: expected {levels}")),
            ("closed", "open", 3, "unknown variant `open`".into()),
            ("\"machine\": \"m\", ", "", 6, "missing field `machine`".into()),
            ("]}", "]", 6, "EOF while parsing an object".into()),
            ("[", "3, [", 1, "invalid type: integer `3`, expected a sequence".into()),
        ] {
            assert!(FILE.contains(from), "{from}");
            let error = Measured::parse(FILE.replacen(from, to, 1).as_bytes()).unwrap_err();
            assert!(error.to_string().starts_with(&message), "{to}: {error}");
            assert_eq!(error.line(), line, "{to}: {error}");
        }
    }

    #[test]
    fn words_can_stand_in_xml() {
        let text = |text: &str| Text::from(text.to_owned()).0;
        assert_eq!(text("a<b> & ×"), "a<b> & ×");
        assert_eq!(text("a\u{1}\n\u{ffff}b"), "a\u{fffd}\u{fffd}\u{fffd}b");
    }
}
