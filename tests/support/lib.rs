//! What the tests share: meshes and scenes, rays, ways to run them, and oracles.
//!
//! An oracle is separate, dumb and short, and shares no code with what it judges.

pub mod figures;
pub mod hash;
pub mod oracle;
pub mod scenes;
pub mod strategies;
pub mod trace;

pub use rt_kernels::reference::{aim, mesh, random};

/// The number of cases of a property: `PROPTEST_CASES`, or 256.
///
/// # Panics
/// If the variable is there and is no number.
pub fn cases() -> u32 {
    let number = |cases: String| cases.parse().expect("PROPTEST_CASES is a number");
    std::env::var("PROPTEST_CASES").map_or(256, number)
}

/// `n`, scaled by [`cases`]: the one setting by which all tests grow and shrink, so that they stay
/// quick under emulation.
pub fn rays(n: usize) -> usize {
    (n as u64 * u64::from(cases())).div_ceil(256) as usize
}

/// The examples of the README, which are to work as they stand.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
