//! `rt chart`.

use std::fs;
use std::path::Path;

use crate::args::ChartArgs;
use crate::chart::{Measured, Model, svg};
use crate::error::Error;
use crate::output::{self, Output};
use crate::report::count;
use crate::ui;

/// Draws what is in files.
pub(crate) fn run(args: &ChartArgs) -> Result<(), Error> {
    output::format(&args.output, &["svg"])?;
    let output = Output::open(&args.output)?;
    let files = args.from.iter().map(|path| read(path)).collect::<Result<_, _>>()?;
    let model = Model::new(files).map_err(Error::Chart)?;
    output.write(svg(&model).as_bytes())?;
    if args.output != Path::new("-") {
        let [suites, kernels, variants] = model.counts();
        let shown = [count(variants, "variant"), count(kernels, "kernel"), count(suites, "suite")];
        ui::say(&format!("{}: {}", args.output.display(), shown.join(", ")));
    }
    Ok(())
}

fn read(path: &Path) -> Result<Measured, Error> {
    let file = fs::read(path).map_err(|source| Error::Read { path: path.into(), source })?;
    Measured::parse(&file).map_err(|source| Error::Rows { path: path.into(), source })
}
