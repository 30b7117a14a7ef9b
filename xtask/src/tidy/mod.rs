//! What no compiler checks: which words stay in which rooms, and which crate may use which.

mod arrows;
mod rooms;

pub(crate) use arrows::arrows;
pub(crate) use rooms::rooms;
