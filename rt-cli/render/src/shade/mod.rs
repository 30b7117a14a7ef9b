//! From hits to surfaces, and from surfaces to light.

mod phong;
mod surface;

pub(crate) use phong::phong;
pub(crate) use surface::Surface;
