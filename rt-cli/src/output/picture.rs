//! PNG.

use rt_render::Film;
use rt_scene::View;

use crate::error::Error;
use crate::report;

/// A picture as a PNG file. Its text chunks hold only what is the same for every level,
/// accelerator and number of threads.
pub(crate) fn png(film: &Film, scene: &str, view: &View) -> Result<Vec<u8>, Error> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, film.width(), film.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let text = [
        ("Software", concat!("rt ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("Scene", scene.to_owned()),
        ("Size", format!("{}x{}", film.width(), film.height())),
        ("View", report::flags(view)),
    ];
    for (keyword, text) in text {
        encoder.add_itxt_chunk(keyword.to_owned(), text)?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&film.to_srgb8())?;
    writer.finish()?;
    Ok(file)
}
