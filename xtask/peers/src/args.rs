//! The command line.

use std::path::PathBuf;

use clap::Parser;

use crate::mesh;
use crate::peers::Isa;
use crate::rays::Kind;

/// Our kernels beside Embree's and those of other crates: the same scenes, rays, thread and
/// instructions, in interleaved rounds. Times are those of the thread, not of the clock on the wall.
///
/// Embree is loaded from what `pip install embreex` or `apt-get install libembree-dev` installs. It
/// asks the system for large pages; GLIBC_TUNABLES=glibc.malloc.hugetlb=1 in the environment does
/// that for everyone else.
#[derive(Clone, Debug, Parser)]
#[command(name = "cargo xtask peers")]
pub(crate) struct Args {
    /// Scenes: balls, rings, tree, bunny, dragon, conference, an OBJ or NFF file, or
    /// spd:NAME[:SIZE]. All of the named ones, if not given
    #[arg(long, value_delimiter = ',')]
    scenes: Option<Vec<String>>,
    /// Instructions: sse4, avx2, avx512, and native, where other crates take part. All, if not given
    #[arg(long, value_delimiter = ',', value_parser = isa)]
    isa: Option<Vec<Isa>>,
    /// Rays: primary, shadow, diffuse. All, if not given
    #[arg(long, value_delimiter = ',', value_parser = kind)]
    rays: Option<Vec<Kind>>,
    /// Pixels along the side of the picture. 512 and 1024, if not given
    #[arg(long, value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=4096))]
    size: Option<Vec<u32>>,
    /// How often each way runs. 7, or with --quick 3, if not given
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: Option<u32>,
    /// Fewer rounds and scenes, and ways that are far behind in the first run are not timed again
    #[arg(long)]
    pub(crate) quick: bool,
    /// Builds and leaks too, where scenes, instructions, rays or sizes are chosen
    #[arg(long)]
    all: bool,
    /// Hierarchies with spatial splits on both sides, which take longer to build, instead of the
    /// default ones
    #[arg(long)]
    pub(crate) spatial: bool,
    /// Show only the default of ours and the fastest way of each peer
    #[arg(long)]
    pub(crate) brief: bool,
    /// Write what was measured to a file
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Draw it
    #[arg(long, value_name = "FILE.svg")]
    pub(crate) chart: Option<PathBuf>,
    /// Embree's shared library
    #[arg(long, env = "EMBREE", value_name = "FILE")]
    pub(crate) embree: Option<PathBuf>,
    /// This program, compiled for this CPU and with other crates
    #[arg(long, hide = true)]
    pub(crate) native: Option<PathBuf>,
    /// Measure with all instructions of this CPU, and write it to stdout for the program that asks
    #[arg(long, hide = true)]
    pub(crate) for_parent: bool,
}

/// The name of a level, understood.
fn isa(name: &str) -> Result<Isa, String> {
    let names = Isa::ALL.map(Isa::name).join(", ");
    Isa::ALL.into_iter().find(|isa| isa.name() == name).ok_or(format!("one of {names}"))
}

/// The name of a kind of rays, understood.
fn kind(name: &str) -> Result<Kind, String> {
    let names = Kind::ALL.map(Kind::name).join(", ");
    Kind::ALL.into_iter().find(|kind| kind.name() == name).ok_or(format!("one of {names}"))
}

impl Args {
    /// The scenes, and whether there is one that may be left out: it is not asked for by name.
    pub(crate) fn scenes(&self) -> (Vec<String>, bool) {
        match &self.scenes {
            Some(scenes) => (scenes.clone(), false),
            None => {
                let named = if self.quick { &mesh::QUICK[..] } else { &mesh::ALL };
                (named.iter().map(|&name| name.to_owned()).collect(), true)
            }
        }
    }

    pub(crate) fn isa(&self) -> Vec<Isa> {
        match &self.isa {
            _ if self.for_parent => vec![Isa::Native],
            Some(isa) => isa.clone(),
            None => Isa::ALL.to_vec(),
        }
    }

    pub(crate) fn rays(&self) -> Vec<Kind> {
        self.rays.clone().unwrap_or(Kind::ALL.to_vec())
    }

    pub(crate) fn size(&self) -> Vec<u32> {
        self.size.clone().unwrap_or(vec![512, 1024])
    }

    pub(crate) fn rounds(&self) -> usize {
        self.rounds.unwrap_or(if self.quick { 3 } else { 7 }) as usize
    }

    /// Whether builds and leaks are measured too.
    pub(crate) fn everything(&self) -> bool {
        let chosen = self.scenes.is_some()
            || self.isa.is_some()
            || self.rays.is_some()
            || self.size.is_some();
        self.all || !chosen
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(args: &[&str]) -> Args {
        Args::try_parse_from([&["peers"], args].concat()).expect("a command line")
    }

    #[test]
    fn all_is_measured_unless_something_is_chosen() {
        let args = parse(&[]);
        assert_eq!((args.scenes().0.len(), args.isa().len(), args.rounds()), (6, 4, 7));
        assert!(args.everything() && parse(&["--quick"]).everything());
        let args = parse(&["--isa", "sse4,avx2", "--rays", "shadow", "--size", "512"]);
        assert_eq!((args.isa(), args.rays()), (vec![Isa::Sse4, Isa::Avx2], vec![Kind::Shadow]));
        assert!(!args.everything() && parse(&["--isa", "avx2", "--all"]).everything());
    }

    #[test]
    fn quick_is_less() {
        let (args, quick) = (parse(&[]), parse(&["--quick"]));
        assert!(quick.rounds() < args.rounds() && quick.scenes().0.len() < args.scenes().0.len());
    }

    #[test]
    fn the_child_measures_native_alone_whatever_its_parent_was_asked() {
        assert_eq!(parse(&["--isa", "sse4,native", "--for-parent"]).isa(), [Isa::Native]);
    }

    #[test]
    fn what_there_is_not_is_refused() {
        for args in [["--isa", "sse9"], ["--rays", "x"], ["--size", "0"], ["--rounds", "0"]] {
            assert!(Args::try_parse_from(["peers"].iter().chain(&args)).is_err(), "{args:?}");
        }
    }
}
