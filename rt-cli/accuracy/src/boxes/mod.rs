//! Boxes: every slab test, every way to run it, on every family of rays that are hard on boxes.
//!
//! A slab test that misses a box which is hit (a false miss) costs the picture; one that hits what is
//! missed (a false hit) costs time.

mod ceilings;
mod families;
mod measure;
mod time;

pub use ceilings::{CEILINGS, Ceiling};
pub use families::{Batch, Family};
pub use measure::{Row, Subject, answers, measure, subjects};
pub use time::{Likeness, time};
