//! From hits to surfaces, and from surfaces to light.

mod bounce;
mod phong;
mod points;
mod shader;
mod surface;
mod textured;

pub(crate) use bounce::bounce;
pub(crate) use phong::{light, phong};
pub(crate) use points::{Lit, Points};
pub use shader::{Finish, Point, Shader};
pub(crate) use surface::Surface;
pub(crate) use textured::Textured;
