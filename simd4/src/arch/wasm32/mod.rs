//! WebAssembly, where it is built with SIMD: a module with instructions that the machine lacks
//! does not load at all, so there is nothing to detect at run time.

mod simd128;

pub use simd128::Simd128;
