//! `rt gen`.

use std::path::Path;

use crate::args::GenArgs;
use crate::error::Error;
use crate::output::Output;
use crate::ui;

pub(crate) fn run(args: &GenArgs) -> Result<(), Error> {
    let path = args.output.as_deref().unwrap_or(Path::new("-"));
    let output = Output::open(path)?;
    let scene = rt_scene::spd::generate(&args.name, args.size)?;
    let mut text = Vec::new();
    let extension = path.extension().and_then(|extension| extension.to_str());
    match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("obj") => rt_scene::obj::write(&scene, None, &mut text)?,
        Some("nff") => rt_scene::nff::write(&scene, &mut text)?,
        None if path == Path::new("-") => rt_scene::nff::write(&scene, &mut text)?,
        _ => return Err(Error::OutputFormat { path: path.into(), known: ".nff, .obj" }),
    }
    output.write(&text)?;
    if args.output.is_some() {
        let count = |(kind, n): (&&str, &u64)| format!("{n} {kind}s");
        let stated: Vec<_> = scene.facts.stated.iter().map(count).collect();
        ui::say(&format!("{}: {}", path.display(), stated.join(", ")));
    }
    Ok(())
}
