//! Pictures and counts of rays, through the public API alone.

mod published;
mod samples;
mod shader;
mod spawned;
mod support;
