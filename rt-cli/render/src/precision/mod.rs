//! What precision a scene needs, and which triangle test is enough for it.
//!
//! Three steps, each of them plain `f64` arithmetic in a fixed order, so that the outcome is the
//! same on every machine:
//!
//! 1. [`Facts`] are what decides, whoever looks at it: coordinates, features, slivers.
//! 2. [`predict`] says how far from an edge a camera's ray may still be misjudged, with each
//!    [`Method`](crate::Method): triangle by triangle, by the [`ERRORS`] of the method, in world units and in pixels
//!    of that camera.
//! 3. [`choose`] takes the first method, in the order of measured cost, of which that is less than
//!    a tolerance, and that pays over a structure in a scene with so many triangles of which a ray
//!    meets so many.
//!
//! # What a tolerance means
//!
//! A picture is **within** `px` pixels if what each ray from the eye finds is right for a scene in
//! which every edge of every triangle, and every surface along its normal, may be moved by less than
//! that. So a ray is judged as by the watertight test unless it passes an edge of a triangle
//! nearer than `px`; a ray that slips between two triangles there sees what is behind them. Of
//! shadows and mirrors it says nothing but that they see the same triangles, moved as little.

mod band;
mod choice;
mod facts;
mod table;

pub use band::{Prediction, predict};
pub use choice::{Choice, choose};
pub use facts::Facts;
pub use table::{ERRORS, Errors, Over, ROUNDOFF, errors};
