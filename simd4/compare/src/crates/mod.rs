//! The sample kernels through other crates, each as its documentation recommends, dispatched at
//! run time where the crate can. A kernel that a crate has no operations for is left out.

mod fearless;
mod glam;
mod pulp;
mod wide;

use crate::io::{Io, N};

/// A kernel's name, and what runs it.
pub(crate) type Kernel = (&'static str, fn(&mut Io));

/// All crates with their kernels.
pub(crate) const CRATES: [(&str, &[Kernel]); 4] = [
    ("wide", wide::KERNELS),
    ("fearless_simd", fearless::KERNELS),
    ("pulp", pulp::KERNELS),
    ("glam", glam::KERNELS),
];

/// As many elements of a row as there are lanes.
#[inline(always)]
fn lanes<const LANES: usize>(row: &[f32; N], at: usize) -> [f32; LANES] {
    match row[at..at + LANES].try_into() {
        Ok(lanes) => lanes,
        Err(_) => unreachable!(),
    }
}
