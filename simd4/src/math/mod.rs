//! What is built of the operations, for any lanes.

pub(crate) mod elementary;
mod transpose;
mod vec3;

pub use transpose::transpose;
pub use vec3::Vec3;
