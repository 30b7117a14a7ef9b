//! Pictures and counts of rays, through the public API alone.

mod published;
mod shader;
mod spawned;
mod support;
