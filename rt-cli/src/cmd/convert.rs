//! `rt convert`.

use crate::args::ConvertArgs;
use crate::error::Error;
use crate::output::SceneOutput;
use crate::{report, ui};

/// Writes a scene in the format that the file's name asks for.
pub(crate) fn run(args: &ConvertArgs) -> Result<(), Error> {
    let output = SceneOutput::open(&args.output)?;
    let scene = args.opening.open(&args.scene)?;
    let (name, lost) = (output.name(), output.lost(&scene));
    if !args.quiet {
        ui::warnings(&scene);
    }
    output.write(&scene)?;
    if !args.quiet {
        if let Some(lost) = lost {
            ui::say(&format!("warning: {lost}"));
        }
        if let Some(name) = name {
            ui::say(&format!("{name}: {}", report::contents(&scene)));
        }
    }
    Ok(())
}
