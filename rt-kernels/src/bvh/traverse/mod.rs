//! Traversals: one file a layout and order of visits.

pub mod skip;
pub mod wide;
