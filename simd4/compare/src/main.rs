//! `simd4` beside hand-written intrinsics and beside other crates, in one process: the tables of
//! its README.
//!
//! `cargo run --release` in this folder prints both; `cargo run --release -- round` the single
//! ops and kernels whose name or group has `round` in it. Without `--release` nothing is
//! optimised, here and in the crates: what a debug build costs.

#[path = "../../benches/io.rs"]
mod io;
#[path = "../../benches/kernels.rs"]
mod kernels;
#[path = "../../benches/ops.rs"]
mod ops;
#[path = "../../benches/twin/mod.rs"]
mod twin;

mod crates;
mod race;

use simd4::Level;

use crates::CRATES;
use io::Io;
use ops::Op;
use race::{Ratio, Run, race};
use twin::Twin;

fn main() {
    let mut io = Io::ordinary();
    let all = || ops::OPS.iter().chain(kernels::KERNELS);
    if let Some(wanted) = std::env::args().nth(1) {
        let wanted = |op: &&Op| op.name.contains(&wanted) || op.group.contains(&wanted);
        return single(&mut io, all().filter(wanted));
    }
    others(&mut io);
    println!();
    groups(&mut io, all());
}

/// Levels of this CPU that have twins.
fn levels() -> impl DoubleEndedIterator<Item = Level> {
    Level::available().filter(|level| twin::of(level.name(), "add").is_some())
}

fn ours(op: &Op, level: Level) -> Run<'_> {
    Box::new(move |io| (op.ours)(level, io))
}

fn by_hand(twin: Twin) -> Run<'static> {
    // SAFETY: only twins of levels that the CPU has are asked for.
    Box::new(move |io| unsafe { twin(io) })
}

/// One op on one level against its twin, which it must equal.
fn against_twin(io: &mut Io, op: &Op, level: Level) -> Option<(f64, Ratio)> {
    let twin = twin::of(level.name(), op.name)?;
    op.check(level, twin);
    let (time, ratios) = race(io, &[by_hand(twin), ours(op, level)]);
    Some((time, ratios[1]))
}

/// Every op of a choice, with how far to trust the figures.
fn single<'a>(io: &mut Io, ops: impl Iterator<Item = &'a Op>) {
    println!("| op | level | twin, ns | ours / twin | spread | of the shortest |");
    println!("|---|---|---|---|---|---|");
    for op in ops {
        for level in levels() {
            let Some((time, ratio)) = against_twin(io, op, level) else { continue };
            let Ratio { median, spread, of_minima } = ratio;
            let (group, name) = (op.group, op.name);
            println!(
                "| {group} {name} | {level} | {time:.0} | {median:.2} | {spread:.3} | {of_minima:.2} |"
            );
        }
    }
}

/// The sample kernels at the best level, through every crate.
fn others(io: &mut Io) {
    let Some(level) = levels().next_back() else { return };
    let names: Vec<_> = CRATES.iter().map(|(name, _)| *name).collect();
    println!("Time by that of the {level} twin:\n");
    println!("| kernel | twin, ns | simd4 | {} |", names.join(" | "));
    println!("|---|---|---|{}", "---|".repeat(names.len()));
    for op in kernels::KERNELS {
        let Some(twin) = twin::of(level.name(), op.name) else { continue };
        op.check(level, twin);
        let mut runs = vec![by_hand(twin), ours(op, level)];
        // Where each crate stands in the race, if it has the kernel.
        let places = CRATES.map(|(name, kernels)| {
            let (_, kernel) = kernels.iter().find(|(kernel, _)| *kernel == op.name)?;
            agree(io, op, twin, name, *kernel);
            runs.push(Box::new(*kernel));
            Some(runs.len() - 1)
        });
        let (time, ratios) = race(io, &runs);
        let cell = |place: Option<usize>| match place {
            Some(place) => format!("{:.2}", ratios[place].median),
            None => "–".to_string(),
        };
        let cells: Vec<_> = [Some(1)].into_iter().chain(places).map(cell).collect();
        println!("| {} | {time:.0} | {} |", op.name, cells.join(" | "));
    }
}

/// Stops the program if a crate's result is not the twin's, within rounding.
fn agree(io: &mut Io, op: &Op, twin: Twin, name: &str, kernel: fn(&mut Io)) {
    let ours = io.output(by_hand(twin));
    let theirs = io.output(kernel);
    for (at, (&a, &b)) in ours.iter().zip(&theirs).enumerate() {
        let (x, y) = (f32::from_bits(a), f32::from_bits(b));
        let close = a == b || (x - y).abs() <= 1e-5 * y.abs();
        assert!(close, "{} by {name}, output {at}: {x:e} and {y:e}", op.name);
    }
}

/// Each group on each level: the median of its ops, and the slowest.
fn groups<'a>(io: &mut Io, ops: impl Iterator<Item = &'a Op>) {
    let levels: Vec<_> = levels().collect();
    let names: Vec<_> = levels.iter().map(Level::to_string).collect();
    println!("Time by that of the level's own twin, median of the group and the slowest:\n");
    println!("| group | {} |", names.join(" | "));
    println!("|---|{}", "---|".repeat(names.len()));
    for group in ops.collect::<Vec<_>>().chunk_by(|a, b| a.group == b.group) {
        let cells = levels.iter().map(|&level| {
            let mut ratios: Vec<_> = group
                .iter()
                .filter_map(|op| Some((against_twin(io, op, level)?.1.median, op.name)))
                .collect();
            ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
            match (ratios.get(ratios.len() / 2), ratios.last()) {
                (Some((median, _)), Some((worst, name))) => {
                    format!("{median:.2} ({name} {worst:.2})")
                }
                _ => "–".to_string(),
            }
        });
        println!("| {} | {} |", group[0].group, cells.collect::<Vec<_>>().join(" | "));
    }
}
