//! `rt gen`.

use std::path::Path;

use crate::args::GenArgs;
use crate::error::Error;
use crate::output::{self, Output};
use crate::{report, ui};

/// Writes a procedural scene in the format that the file's name asks for.
pub(crate) fn run(args: &GenArgs) -> Result<(), Error> {
    let path = args.output.as_deref().unwrap_or(Path::new("-"));
    let format = output::format(path, &["nff", "obj"])?;
    let output = Output::open(path)?;
    let scene = args.tessellate.apply(rt_scene::spd::generate(&args.name, args.size)?)?;
    let mut text = Vec::new();
    match format {
        "obj" => rt_scene::obj::write(&scene, None, &mut text)?,
        _ => rt_scene::nff::write(&scene, &mut text)?,
    }
    output.write(&text)?;
    if path != Path::new("-") {
        let stated: Vec<_> =
            scene.facts.stated.iter().map(|(&kind, &n)| (kind, n as usize)).collect();
        ui::say(&format!("{}: {}", path.display(), report::number_of(&stated)));
    }
    Ok(())
}
