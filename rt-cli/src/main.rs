//! `rt`: renders, inspects and measures scenes. Thin: what it does is done by rt-scene,
//! rt-picture, rt-render and rt-accuracy.
#![forbid(unsafe_code)]

mod args;
mod chart;
mod cmd;
mod error;
mod output;
mod report;
mod ui;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    let args = args::Args::parse();
    let done = match &args.command {
        args::Command::Render(args) => cmd::render::run(args),
        args::Command::Gen(args) => cmd::generate::run(args),
        args::Command::Info(args) => cmd::info::run(args),
        args::Command::Bench(args) => cmd::bench::run(args),
        args::Command::Accuracy(args) => cmd::accuracy::run(args),
        args::Command::Chart(args) => cmd::chart::run(args),
        args::Command::Compare(args) => cmd::compare::run(args),
        args::Command::Convert(args) => cmd::convert::run(args),
        args::Command::Completions(args) => cmd::completions::run(args),
        args::Command::Paper(args) => cmd::paper::run(args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            ui::error(&error);
            error.exit_code()
        }
    }
}
