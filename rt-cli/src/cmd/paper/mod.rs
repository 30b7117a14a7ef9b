//! `rt paper`: what a paper measured, measured again, with its figures beside ours.

mod cachegrind;
mod geimer_mueller;
mod report;
mod shading;
mod wald_2001;

use crate::args::{Paper, PaperArgs};
use crate::error::Error;

pub(crate) fn run(args: &PaperArgs) -> Result<(), Error> {
    match &args.paper {
        Paper::Wald2001(args) => wald_2001::run(args),
        Paper::GeimerMueller(args) => geimer_mueller::run(args),
        Paper::Shading(args) => shading::run(args),
    }
}
