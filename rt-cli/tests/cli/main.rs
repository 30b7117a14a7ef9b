//! The program `rt` as its users meet it: files, flags, messages, exit codes.
//!
//! `RT_RUNNER=qemu-aarch64 cargo test -p rt-cli --target …` runs it under an emulator.

mod accuracy;
mod bad_formats;
mod bad_input;
mod bad_nff;
mod bench;
mod chart;
mod compare;
mod convert;
mod flags;
mod formats;
mod generate;
mod info;
mod machine;
#[cfg(unix)]
mod output;
mod paper;
mod picture;
mod precision;
#[cfg(unix)]
mod resume;
mod stats;
mod support;
mod talk;
#[cfg(unix)]
mod unusual_files;
