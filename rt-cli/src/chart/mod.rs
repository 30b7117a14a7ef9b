//! Speed against accuracy as a picture.
//!
//! [`rows`] is what `rt accuracy --json` writes, [`Model`] what of it is worth showing, [`svg`] the
//! picture. The picture is a function of the model alone.

mod front;
mod legend;
mod levels;
mod lines;
mod marker;
mod model;
mod page;
mod panel;
mod rows;
mod scale;
mod style;

pub(crate) use lines::{Line, Lines};
pub(crate) use model::Model;
pub(crate) use page::svg;
pub(crate) use rows::Measured;
