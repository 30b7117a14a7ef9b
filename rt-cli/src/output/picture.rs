//! Pictures.

use rt_picture::Format;
use rt_render::{Film, Job};

use crate::error::Error;
use crate::report;

/// A rendered picture as a file. What a PNG says of it is the same for every level, accelerator and
/// number of threads.
pub(crate) fn picture(
    film: Film,
    format: Format,
    scene: &str,
    job: &Job,
) -> Result<Vec<u8>, Error> {
    let mut text = vec![
        ("Software", concat!("rt ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("Scene", scene.to_owned()),
        ("Size", format!("{}x{}", job.size.0, job.size.1)),
        ("View", report::flags(&job.view)),
    ];
    if let Some(crop) = job.crop {
        text.push(("Crop", report::crop(crop)));
    }
    Ok(rt_picture::write(&film.into_picture(), format, &text)?)
}
