//! What is built of the operations, for any lanes.

mod vec3;

pub use vec3::Vec3;
