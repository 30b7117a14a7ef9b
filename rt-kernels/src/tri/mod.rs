//! Ray against triangle: one file a method.

pub mod watertight;
