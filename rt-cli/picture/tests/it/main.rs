//! Picture files, judged by other readers and writers.

mod bad;
mod compare;
mod exr;
mod formats;
mod part;
mod srgb;
mod support;
