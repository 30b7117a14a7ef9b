//! The kernels beside Embree and other BVH crates: the same scenes, rays, thread and instructions,
//! in one process, in interleaved rounds. `cargo xtask peers --help` says what there is to choose.

mod check;
mod embree;
mod mesh;
mod ours;
mod peer;
mod race;
mod rays;
mod report;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use rt_kernels::{Exec, Sequential};

use check::Differences;
use embree::Embree;
use mesh::Mesh;
use ours::Ours;
use peer::{Built, Isa, Way};
use race::Times;
use rays::{Kind, Picture, Work};
use report::{Cell, Row};

/// Our kernels beside Embree's and others', on the same rays.
#[derive(Parser)]
#[command(name = "cargo xtask peers")]
struct Args {
    /// Scenes: balls, rings, tree, bunny, dragon, conference, an OBJ or NFF file, or spd:NAME:SIZE.
    #[arg(long, value_delimiter = ',', default_values_t = mesh::ALL.map(String::from))]
    scenes: Vec<String>,
    /// Instructions: sse4, avx2, avx512, native.
    #[arg(long, value_delimiter = ',', value_parser = isa, default_value = "sse4,avx2,avx512")]
    isa: Vec<Isa>,
    /// Rays: primary, shadow, diffuse.
    #[arg(long, value_delimiter = ',', value_parser = kind, default_value = "primary,shadow,diffuse")]
    rays: Vec<Kind>,
    /// Pixels along the side of the picture.
    #[arg(long, value_delimiter = ',', default_value = "512,1024")]
    size: Vec<u32>,
    /// How often each way runs.
    #[arg(long, default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Embree's shared library.
    #[arg(long, env = "EMBREE")]
    embree: Option<PathBuf>,
    /// Only the default of ours and the fastest of each peer.
    #[arg(long)]
    brief: bool,
}

fn isa(name: &str) -> Result<Isa, String> {
    Isa::ALL.into_iter().find(|isa| isa.name() == name).ok_or(format!("no {name:?}"))
}

fn kind(name: &str) -> Result<Kind, String> {
    Kind::ALL.into_iter().find(|kind| kind.name() == name).ok_or(format!("no {name:?}"))
}

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
    let embree = Embree::open(args.embree.as_deref())?;
    let mut cells = Vec::new();
    print!("{}", report::head());
    for name in &args.scenes {
        let mesh = Mesh::open(name)?;
        let ours = Ours::build(&ours::primitives(&mesh)?, &Sequential)?;
        let exec = Exec::best().map_err(|error| error.to_string())?;
        let pictures: Vec<_> = args
            .size
            .iter()
            .map(|&size| Ok((size, Picture::new(&mesh, ours.default(), exec, size)?)))
            .collect::<Result<_, String>>()?;
        for &isa in &args.isa {
            let scenes = [false, true].map(|robust| embree.build(&mesh, isa, 1, robust));
            let scenes = scenes.into_iter().collect::<Result<Vec<_>, _>>()?;
            for ((size, picture), &kind) in pictures
                .iter()
                .flat_map(|picture| args.rays.iter().map(move |kind| (picture, kind)))
            {
                let works = picture.works(kind);
                let level = ours::level(isa)?;
                let mut ways: Vec<(Box<dyn Way + '_>, Built, &Work)> = Vec::new();
                for work in &works {
                    ways.extend(
                        ours.ways(work, level).into_iter().map(|(way, built)| (way, built, work)),
                    );
                    for scene in &scenes {
                        let built = scene.built();
                        ways.extend(scene.ways(work).into_iter().map(|way| (way, built, work)));
                    }
                }
                let rows = measure(ways, args.rounds as usize);
                let (scene, size) = (mesh.name.clone(), *size);
                let cell = Cell { scene, triangles: mesh.triangles.len(), size, kind, isa, rows };
                print!("{}", cell.table(args.brief));
                cells.push(cell);
            }
        }
    }
    print!("{}", report::summary(&cells));
    Ok(())
}

/// Checks what all ways find, then lets them race.
fn measure(ways: Vec<(Box<dyn Way + '_>, Built, &Work)>, rounds: usize) -> Vec<Row> {
    let mut rows = Vec::new();
    let (mut racers, mut reference) = (Vec::new(), (None, Vec::new()));
    for (mut way, built, work) in ways {
        way.reset();
        way.run();
        let hits = way.hits();
        // The first way of each work is ours.
        if reference.0 != Some(work.order) {
            reference = (Some(work.order), hits.clone());
        }
        let differences = Differences::between(&work.rays, &hits, &reference.1);
        let mode = way.mode().clone();
        rows.push(Row {
            mode,
            built,
            rays: work.rays.len(),
            differences,
            seconds: 0.0,
            to_default: 0.0,
        });
        racers.push(way);
    }
    let times = Times::race(&mut racers, rounds);
    for (i, row) in rows.iter_mut().enumerate() {
        row.seconds = times.median(i);
    }
    // Rays may start from either end: the default takes the better.
    let default = report::fastest(&rows, |row| row.mode.default);
    if let Some(default) = default {
        for (i, row) in rows.iter_mut().enumerate() {
            row.to_default = times.ratio(i, default);
        }
    }
    rows
}
