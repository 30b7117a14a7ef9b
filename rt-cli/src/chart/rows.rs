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
