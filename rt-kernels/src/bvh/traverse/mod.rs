//! Traversals: one file a layout and order of visits.

mod compared;
pub mod heap;
pub(crate) mod large;
pub mod skip;
pub(crate) mod turns;
mod way;
pub mod wide;

pub use compared::{Compared, catalogue};
