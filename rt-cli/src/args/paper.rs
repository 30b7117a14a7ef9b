//! `rt paper`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args as Group, Subcommand, ValueEnum};
use rt_render::PacketSize;
use rt_render::measure::Extent;

/// Measure again what a paper measured, with its figures beside ours.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt paper wald-2001 --quick\n  \
    rt paper geimer-mueller --quick --cachegrind")]
pub(crate) struct PaperArgs {
    /// Which paper.
    #[command(subcommand)]
    pub(crate) paper: Paper,
}

/// The papers whose measurements there are.
#[derive(Subcommand)]
pub(crate) enum Paper {
    #[command(name = "wald-2001")]
    Wald2001(Wald2001Args),
    GeimerMueller(GeimerMuellerArgs),
    Shading(ShadingPaperArgs),
}

/// What shading costs, beside what Wald, Slusallek, Benthin and Wagner found in 2001.
///
/// Phong's model in lanes against one point at a time, textures, a mirror that fills the picture
/// (Sections 5 and 6.2, Figures 3 and 4), and frames a second of the procedural scenes and of any that
/// are named. Interleaved rounds; the fastest of each.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt paper shading --quick\n  \
    rt paper shading conference.obj --json shading.json")]
pub(crate) struct ShadingPaperArgs {
    #[arg(value_name = "SCENE", help = super::SCENE)]
    pub(crate) scenes: Vec<OsString>,
    /// Smaller scenes: some seconds.
    #[arg(long)]
    pub(crate) quick: bool,
    /// Width and height in pixels.
    #[arg(short, long, value_name = "WxH", value_parser = super::size, default_value = "512x512")]
    pub(crate) size: (u32, u32),
    /// How often everything is timed.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) rounds: u16,
    /// Write the rows to a .json file too; - for standard output, where no table is then.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
}

/// Wald, Slusallek, Benthin and Wagner, "Interactive Rendering with Coherent Ray Tracing".
///
/// Triangle tests (Table 1), what packets have in common (Table 2), rays through kd-trees and BVHs of
/// terrains and of any scenes that are named (Table 3), mailboxes, and growth beside a rasteriser's.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt paper wald-2001 --quick\n  \
    rt paper wald-2001 bunny.obj conference.obj --charts .\n  \
    rt paper wald-2001 --part structures --triangles 8000000 --json rows.json")]
pub(crate) struct Wald2001Args {
    #[arg(value_name = "SCENE", help = super::SCENE)]
    pub(crate) scenes: Vec<OsString>,
    /// Fewer triangles.
    #[arg(long)]
    pub(crate) quick: bool,
    /// The most triangles of a scene that is computed.
    #[arg(long, value_name = "N", default_value_t = 1_100_000)]
    pub(crate) triangles: u32,
    /// How often everything is timed.
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) rounds: u16,
    /// What to measure; can be given several times [default: all but traffic, for which valgrind has
    /// to be there].
    #[arg(long = "part", value_enum, value_name = "PART")]
    pub(crate) parts: Vec<Wald2001Part>,
    /// Write charts to .svg files in that folder.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) charts: Option<PathBuf>,
    /// Write the rows to a .json file too; - for standard output, where no table is then.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// What runs in valgrind: the rays of a scene in packets of that size, or none, and nothing else.
    #[arg(long, value_name = "SCENE,PACKET", value_parser = trace, hide = true)]
    pub(crate) trace: Option<(String, Option<PacketSize>)>,
}

/// What of that paper is measured.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Wald2001Part {
    /// Table 1: triangle tests.
    Tests,
    /// Table 2: visits of nodes in packets.
    Overhead,
    /// Table 3: rays through kd-trees and BVHs.
    Structures,
    /// Mailboxes of all kinds and sizes.
    Mailboxes,
    /// Figure 5: a terrain in more and more triangles.
    Growth,
    /// Accesses to memory, in valgrind: with SIMD4_LEVEL=avx2, since it knows no AVX-512.
    Traffic,
}

impl Wald2001Part {
    /// Those that are measured unless others are named.
    pub(crate) const USUAL: [Wald2001Part; 5] = [
        Wald2001Part::Tests,
        Wald2001Part::Overhead,
        Wald2001Part::Structures,
        Wald2001Part::Mailboxes,
        Wald2001Part::Growth,
    ];
}

fn trace(text: &str) -> Result<(String, Option<PacketSize>), String> {
    let (scene, packet) = text.rsplit_once(',').ok_or("expected a scene and a packet size")?;
    let packet = match packet {
        "none" => None,
        "1" => Some(PacketSize::Single),
        "4" => Some(PacketSize::Four),
        "16" => Some(PacketSize::Sixteen),
        "64" => Some(PacketSize::Large),
        _ => return Err("expected none, 1, 4, 16 or 64".into()),
    };
    Ok((scene.to_owned(), packet))
}

/// Geimer and Müller, "A Cross-Platform Framework for Interactive Ray Tracing", 2003.
///
/// Frames and their ray casting at every level (Figure 2); children sorted or not, heap order, box
/// tests, shared origins, and a frame in three stages (Section 3). One thread; interleaved rounds; the
/// least time of each. All ways to make a frame must give the same picture, and all traversals the
/// same hits.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt paper geimer-mueller\n  \
    rt paper geimer-mueller --quick --cachegrind")]
pub(crate) struct GeimerMuellerArgs {
    /// Smaller scenes: some seconds.
    #[arg(long)]
    pub(crate) quick: bool,
    /// Width and height in pixels.
    #[arg(short, long, value_name = "WxH", value_parser = super::size, default_value = "512x512")]
    pub(crate) size: (u32, u32),
    /// How often everything is timed.
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) rounds: u16,
    /// Count cache misses too, in valgrind, which has to be there.
    #[arg(long)]
    pub(crate) cachegrind: bool,
    /// Write the rows to a .json file too; - for standard output, where no table is then.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// What --cachegrind runs: a frame of NAME:SIZE, or none, and nothing else.
    #[arg(long, value_name = "SCENE,EXTENT", value_parser = frame, hide = true)]
    pub(crate) frame: Option<(String, Option<Extent>)>,
}

fn frame(text: &str) -> Result<(String, Option<Extent>), String> {
    let (scene, extent) = text.split_once(',').ok_or("expected a scene and an extent")?;
    let extent = match extent {
        "none" => None,
        "tile" => Some(Extent::Tile),
        "picture" => Some(Extent::Picture),
        _ => return Err("expected none, tile or picture".into()),
    };
    Ok((scene.to_owned(), extent))
}
