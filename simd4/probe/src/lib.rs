//! Every operation of simd4 at every level and width, and sample kernels, for `cargo xtask asm`
//! to compile and read. To add an operation, add a line to a table in [`ops`]; to add a kernel,
//! write it in [`kernels`] and add a line to the table there.
#![allow(missing_docs, clippy::missing_errors_doc, reason = "every function is a sample")]

#[cfg(not(feature = "planted"))]
pub mod kernels;
#[cfg(not(feature = "planted"))]
#[macro_use]
pub mod ops;
#[cfg(feature = "planted")]
pub mod planted;
