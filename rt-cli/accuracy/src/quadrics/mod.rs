//! Curved surfaces: every test, every way to run it, on every family of rays that are hard on them.

mod ceilings;
mod families;
mod measure;
mod time;

pub use ceilings::{CEILINGS, Ceiling};
pub use families::{Batch, Family, Shape};
pub use measure::{Row, Subject, answers, measure, subjects};
pub use time::time;
