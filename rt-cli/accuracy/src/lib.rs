//! Speed against accuracy: every kernel, every way to run it, on every family of hard inputs,
//! judged by exact arithmetic.
//!
//! A [`Family`] makes inputs for kernels of one sort: [`triangles`], [`boxes`] or [`quadrics`].
//! [`measure`] counts what [`Subject`]s get wrong in one, [`Family::time`] what they cost; both run
//! the same compiled loop. Counts are the same on every machine for kernels that are
//! [exact](rt_kernels::catalogue::Listed::is_exact), and nearly so for the others. What kernels
//! promise, and what they are known to get wrong at most, [`complaints`] knows.
#![forbid(unsafe_code)]

pub mod boxes;
mod ceiling;
mod family;
mod measure;
mod place;
pub mod quadrics;
mod tally;
mod time;
pub mod triangles;

pub use ceiling::{Ceiling, Worst, complaints, worst};
pub use family::{BATCH, Facts, Family, Kind, Setting, Subject, defaults, samples, subjects};
pub use measure::{Row, answers, measure};
pub use rt_kernels::catalogue::{Listed, Shape, Way};
pub use tally::{Quantiles, Tally};
pub use time::Time;
