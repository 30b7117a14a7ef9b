//! NEON, the baseline of AArch64. (32-bit ARM has no level: its NEON flushes subnormals.)

mod neon;

pub use neon::Neon;
