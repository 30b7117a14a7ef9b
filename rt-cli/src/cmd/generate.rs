//! `rt gen`.

use std::path::Path;

use crate::args::GenArgs;
use crate::error::Error;
use crate::output::SceneOutput;
use crate::{report, ui};

/// Writes a procedural scene in the format that the file's name asks for.
pub(crate) fn run(args: &GenArgs) -> Result<(), Error> {
    let output = SceneOutput::open(args.output.as_deref().unwrap_or(Path::new("-")))?;
    let scene = args.tessellate.apply(rt_scene::spd::generate(&args.name, args.size)?)?;
    let name = output.name();
    output.write(&scene)?;
    if let Some(name) = name {
        let stated: Vec<_> =
            scene.facts.stated.iter().map(|(&kind, &n)| (kind, n as usize)).collect();
        ui::say(&format!("{name}: {}", report::number_of(&stated)));
    }
    Ok(())
}
