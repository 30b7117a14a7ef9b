//! What tests of curved surfaces were found to get wrong, at most.

use crate::Ceiling;

/// All kernels of the catalogue.
pub(super) const CEILINGS: [Ceiling; 0] = [];
