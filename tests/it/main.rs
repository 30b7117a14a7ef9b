//! Tests that span the crates.

mod accelerators;
mod build;
mod builders;
mod closest_point;
mod cone;
mod kd;
mod large;
mod layouts;
mod padding;
mod pictures;
mod precision;
mod range;
mod refit;
mod single;
mod sphere;
mod triangle;
mod watertight;
