//! Scene descriptions: what is there, not how it is traced.
//!
//! [`Scene`] is plain data: a triangle mesh, quadrics that stay quadrics, materials, lights and a
//! view. It comes from a file ([`obj`], [`nff`]) or from a procedure ([`spd`]); [`open`] takes
//! either by name.
#![forbid(unsafe_code)]

mod model;

pub use model::{Facts, Light, Material, Mesh, Scene, Skipped, Sphere, Triangle, View};
