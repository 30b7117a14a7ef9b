//! How the work is done: flags that change no picture.

use std::iter;

use clap::builder::PossibleValuesParser;
use clap::{Args as Group, ValueEnum};
use rt_render::Plan;
use rt_render::{AccelKind, Builder, Exec, KdBuilder, Layout, Level, Mailbox, Method, PacketSize};

use crate::error::Error;

/// How the work is done. The picture does not depend on it.
#[derive(Group)]
#[command(next_help_heading = "Machine (the picture is the same for all of these)")]
pub(crate) struct MachineArgs {
    /// The instructions to use: auto is the best level of this CPU (rt info lists those it has), or
    /// what the environment variable SIMD4_LEVEL says.
    #[arg(long, value_name = "LEVEL", default_value = "auto",
          value_parser = level_names())]
    isa: String,
    /// Rays that go together: native is up to 64 over wide nodes, and elsewhere as many as a register
    /// has lanes.
    #[arg(long, value_name = "SIZE", default_value = "native",
          value_parser = ["native", "1", "4", "8", "16", "64"])]
    packet: String,
    /// Threads to use [default: one a core].
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    build: BuildArgs,
}

/// How the acceleration structure is built.
#[derive(Group)]
pub(crate) struct BuildArgs {
    /// What finds the hits.
    #[arg(long, value_enum, value_name = "KIND", default_value_t)]
    accel: AccelArg,
    /// How the kd-tree is built.
    #[arg(long, value_enum, value_name = "NAME", default_value_t)]
    kd_builder: KdBuilderArg,
    /// How the BVH is built.
    #[arg(long, value_enum, value_name = "NAME", default_value_t)]
    builder: BuilderArg,
    /// How the BVH lies in memory. Wide nodes are for packets of all sizes, and for the watertight
    /// triangle test alone: others keep skip.
    #[arg(long, value_enum, value_name = "NAME", default_value_t)]
    layout: LayoutArg,
}

impl BuildArgs {
    /// The kind of acceleration structure.
    pub(crate) fn accel(&self) -> AccelKind {
        match self.accel {
            AccelArg::Bvh => AccelKind::Bvh,
            AccelArg::Kd => {
                let builder = match self.kd_builder {
                    KdBuilderArg::Sweep => KdBuilder::Sweep,
                    KdBuilderArg::Binned => KdBuilder::Binned,
                    KdBuilderArg::Median => KdBuilder::Median,
                };
                AccelKind::Kd { builder, mailbox: Mailbox::default() }
            }
            AccelArg::Brute => AccelKind::Brute,
        }
    }

    /// Builder and layout, for the default triangle test.
    pub(crate) fn plan(&self) -> Plan {
        let builder = match self.builder {
            BuilderArg::BinnedSah => Builder::BinnedSah,
            BuilderArg::SweepSah => Builder::SweepSah,
            BuilderArg::Insertion => Builder::Insertion,
            BuilderArg::Spatial => Builder::Spatial,
        };
        let layout = match self.layout {
            LayoutArg::Skip => Layout::Skip,
            LayoutArg::Bvh4 => Layout::Bvh4,
            LayoutArg::Bvh8 => Layout::Bvh8,
        };
        Plan { builder, layout, method: Method::default() }
    }
}

impl MachineArgs {
    /// The level and packet size.
    pub(crate) fn exec(&self) -> Result<Exec, Error> {
        let level = match &*self.isa {
            "auto" => best_level()?,
            name => named_level(name, format!("--isa {name}"))?,
        };
        let packet = match &*self.packet {
            "1" => PacketSize::Single,
            "4" => PacketSize::Four,
            "8" => PacketSize::Eight,
            "16" => PacketSize::Sixteen,
            "64" => PacketSize::Large,
            _ => PacketSize::Native,
        };
        Ok(Exec { level, packet })
    }

    /// The number of threads.
    pub(crate) fn threads(&self) -> usize {
        match self.threads {
            Some(threads) => threads.into(),
            None => std::thread::available_parallelism().map_or(1, usize::from),
        }
    }

    /// The kind of acceleration structure.
    pub(crate) fn accel(&self) -> AccelKind {
        self.build.accel()
    }

    /// How it is built, if it is a BVH, for the default triangle test.
    pub(crate) fn plan(&self) -> Plan {
        self.build.plan()
    }
}

/// The best level of this CPU, or what the environment says.
pub(crate) fn best_level() -> Result<Level, Error> {
    match std::env::var_os("SIMD4_LEVEL") {
        Some(name) => {
            let name = name.to_string_lossy();
            named_level(&name, format!("SIMD4_LEVEL={name}"))
        }
        None => Level::best().map_err(|source| Error::Level { asked: "auto".into(), source }),
    }
}

fn named_level(name: &str, asked: String) -> Result<Level, Error> {
    Level::named(name).map_err(|source| Error::Level { asked, source })
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum AccelArg {
    /// A bounding volume hierarchy.
    #[default]
    Bvh,
    /// A kd-tree.
    Kd,
    /// Every ray against every primitive.
    Brute,
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum KdBuilderArg {
    /// The surface area heuristic wherever a primitive begins or ends.
    Sweep,
    /// The surface area heuristic at the borders of bins.
    #[default]
    Binned,
    /// In the middle of the longest axis.
    Median,
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum BuilderArg {
    /// The surface area heuristic at the borders of bins.
    #[default]
    BinnedSah,
    /// The surface area heuristic between all neighbours.
    SweepSah,
    /// One primitive after the other, of Goldsmith and Salmon.
    Insertion,
    /// With boxes cut in two where that pays.
    Spatial,
}

#[derive(Clone, Copy, Default, ValueEnum)]
enum LayoutArg {
    /// Eight children a node: for all rays.
    #[default]
    Bvh8,
    /// Four children a node.
    Bvh4,
    /// Depth first with skip pointers: for packets of 4 and 8.
    Skip,
}

/// What `--isa` may be: a name that is no level at all is a mistake in the command line.
fn level_names() -> PossibleValuesParser {
    iter::once("auto").chain(Level::NAMES).into()
}
