//! Speed against accuracy: every kernel, every way to run it, on every family of hard inputs,
//! judged by exact arithmetic.
//!
//! [`measure`] counts what a kernel gets wrong in a [`Family`], [`time`] what it costs; both run
//! the same compiled loop. [`boxes`] and [`quadrics`] do the same for theirs. Counts are the same on every machine for kernels that are
//! [exact](rt_kernels::tri::TriangleTest::is_exact), and nearly so for the others.

pub mod aim;
pub mod boxes;
mod ceilings;
mod families;
mod fold;
mod measure;
pub mod mesh;
pub mod quadrics;
pub mod random;
mod tally;
mod time;

pub use ceilings::{CEILINGS, Ceiling};
pub use families::{BATCH, Batch, Family, Kind, Place, Setting};
pub use measure::{Row, Subject, answers, measure, subjects};
pub use rt_kernels::tri::{Shape, Way};
pub use tally::{Quantiles, Tally};
pub use time::{Time, time};
