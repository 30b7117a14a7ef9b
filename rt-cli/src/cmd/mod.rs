//! The subcommands, one file each.

pub(crate) mod accuracy;
pub(crate) mod bench;
pub(crate) mod chart;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod generate;
pub(crate) mod info;
pub(crate) mod paper;
pub(crate) mod render;
