//! `rt chart`.

use std::fs;
use std::path::Path;

use super::accuracy;
use crate::args::{ChartArgs, MeasureArgs};
use crate::chart::{Measured, Model, svg};
use crate::error::Error;
use crate::output::{self, Output};
use crate::report::count;
use crate::ui;

/// Draws what is measured, or what is in files.
pub(crate) fn run(args: &ChartArgs) -> Result<(), Error> {
    output::format(&args.output, &["svg"])?;
    let output = Output::open(&args.output)?;
    let files = if args.from.is_empty() {
        vec![measure(&args.measure)?]
    } else {
        args.from.iter().map(|path| read(path)).collect::<Result<_, _>>()?
    };
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

fn measure(args: &MeasureArgs) -> Result<Measured, Error> {
    let json = accuracy::Measured::new(args)?.json.to_string();
    Ok(Measured::parse(json.as_bytes()).expect("what rt accuracy writes can be read"))
}
