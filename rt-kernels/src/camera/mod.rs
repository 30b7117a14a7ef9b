//! From pixels to rays.

mod pinhole;

pub use pinhole::Pinhole;
