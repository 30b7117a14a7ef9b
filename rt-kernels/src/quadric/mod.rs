//! Ray against curved surfaces, which stay curved: one file a method.

pub mod sphere;
