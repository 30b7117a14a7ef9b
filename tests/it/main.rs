//! Tests that span the crates.

mod accelerators;
mod build;
mod padding;
mod pictures;
mod precision;
mod range;
mod sphere;
mod triangle;
mod watertight;
