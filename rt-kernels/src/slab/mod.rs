//! Ray against box by slabs (Kay and Kajiya 1986): one file a variant.

pub mod robust;
