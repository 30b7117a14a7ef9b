//! Tests that span the crates.

mod accelerators;
mod accuracy;
mod boxes;
mod build;
mod padding;
mod pictures;
mod quadrics;
mod range;
mod sphere;
mod triangle;
mod watertight;
