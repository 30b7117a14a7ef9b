//! Layouts: flat arrays, converted from the build tree, that own their copy of the primitives.

mod collapse;
mod convert;
mod order;
mod skip_array;
mod wide;

pub(crate) use order::without_gaps;
pub(crate) use skip_array::MAX_SLOTS;
pub use skip_array::{Node, SkipArray};
pub(crate) use wide::Child;
pub use wide::{Wide, WideNode};
