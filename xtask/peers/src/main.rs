//! The kernels beside Embree and other BVH crates: the same scenes, rays, thread and instructions,
//! in one process, in interleaved rounds. `cargo xtask peers --help` says what there is to choose.

mod args;
mod builds;
mod cells;
mod chart;
mod check;
mod clock;
mod leaks;
mod mesh;
mod native;
mod peers;
mod race;
mod rays;
mod report;

use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use rt_kernels::{Exec, Sequential};

use args::Args;
use cells::Cell;
use mesh::Mesh;
use peers::{Embree, Isa, Ours};
use rays::Picture;
use report::Report;

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> Result<(), String> {
    let embree = Embree::open(args.embree.as_deref(), args.spatial)?;
    // Levels that this CPU lacks are left out; native is for the other program, if there is one.
    let (isa, lacking): (Vec<_>, Vec<_>) =
        args.isa().into_iter().partition(|&isa| peers::level(isa).is_ok());
    for isa in lacking {
        eprintln!("{isa} is left out: this CPU lacks it");
    }
    let other = args.native.as_deref().filter(|_| !args.for_parent);
    let (elsewhere, here): (Vec<_>, Vec<_>) =
        isa.into_iter().partition(|&isa| isa == Isa::Native && other.is_some());

    let show = |text: &str| {
        if !args.for_parent {
            print!("{text}");
        }
    };
    show(&report::head());
    let mut report = measure(args, embree, &here, &show)?;
    if let (Some(path), [_, ..]) = (other, &*elsewhere) {
        let native = native::run(path)?;
        native.cells.iter().for_each(|cell| show(&report::table(cell, args.brief)));
        report.cells.extend(native.cells);
        report.leaks.extend(native.leaks);
    }
    if args.for_parent {
        print!("{}", serde_json::to_string(&report).map_err(|error| error.to_string())?);
        return Ok(());
    }
    show(&report.closing());
    if let Some(path) = &args.json {
        write(path, &format!("{:#}\n", report.json(args.spatial)))?;
    }
    if let Some(path) = &args.chart {
        write(path, &chart::svg(&report))?;
    }
    Ok(())
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}

/// Measures at these levels, and shows each cell as soon as there is one.
fn measure(
    args: &Args,
    embree: Embree,
    isa: &[Isa],
    show: &impl Fn(&str),
) -> Result<Report, String> {
    let (mut report, plan) = (Report::default(), peers::plan(args.spatial));
    let (scenes, may_be_missing) = args.scenes();
    for name in scenes {
        if may_be_missing && mesh::is_missing(&name) {
            eprintln!("{name} is left out: it is not in {}", mesh::FOLDER);
            continue;
        }
        let mesh = Mesh::open(&name)?;
        let ours = Ours::build(&peers::primitives(&mesh)?, plan, &Sequential)?;
        let exec = Exec::best().map_err(|error| error.to_string())?;
        let picture = |size| Ok((size, Picture::new(&mesh, ours.default(), exec, size)?));
        let pictures = args.size().into_iter().map(picture).collect::<Result<Vec<_>, String>>()?;
        for &isa in isa {
            let peers = peers::all(&ours, embree, &mesh, isa)?;
            for (size, picture) in &pictures {
                for kind in args.rays() {
                    let (works, rounds) = (picture.works(kind), args.rounds());
                    let rows = cells::measure(&peers, &works, rounds, args.quick)?;
                    let (scene, triangles) = (mesh.name.clone(), mesh.triangles.len());
                    let cell = Cell { scene, triangles, size: *size, kind, isa, rows };
                    show(&report::table(&cell, args.brief));
                    report.cells.push(cell);
                }
            }
        }
        if args.everything() && !args.for_parent {
            report.builds.extend(builds::measure(&mesh, embree, plan, args.rounds())?);
        }
    }
    if let (true, Some(&isa)) = (args.everything(), isa.last()) {
        let rays = if args.quick { 100_000 } else { 1_000_000 };
        report.leaks = leaks::measure(embree, plan, isa, rays)?;
    }
    Ok(report)
}
