//! What is proven where: the table of targets.
//!
//! A target is a build and a machine to run it on. Rows with the same build share it.

use crate::levels;
use std::env::consts::{ARCH, FAMILY, OS};

use Host::{Any, Has, Linux, LinuxX86, Unix};
use Levels::{OfThisCpu, OfThisCpuFrom, These};
use Link::{Gcc, Lld, Own};
use Run::{Directly, Miri, Node, Qemu};
use Tests::{Brief, Conformance, Dispatch, Everything, Workspace};
use Tier::{EveryRun, OnDemand};

/// How many cases proptest tries, and so how many rays the other tests trace, wherever programs
/// run slowly or repeat what has been run in full: a sixteenth.
pub(crate) const FEWER_CASES: &str = "16";

/// The same where all that counts is which instructions run.
pub(crate) const FEWEST_CASES: &str = "4";

/// The table.
#[rustfmt::skip]
pub(crate) static TARGETS: &[Target] = &[
    // Name, build, what runs it, the levels that must be there, what is run at the best of them,
    // what at each of the others; where this can be done, and when it is.

    // The machine itself.
    target("native",        NATIVE,      Directly,                           OfThisCpu,                                   Everything,  Some(Brief),       Any,           EveryRun),
    // Lesser CPUs: an instruction that one lacks kills the program. SandyBridge has AVX, but no
    // FMA: it must fall back to SSE4.1.
    target("qemu64",        NATIVE,      qemu("x86_64", "qemu64"),           These(&["scalar", "sse2"]),                  Dispatch,    None,              LinuxX86,      EveryRun),
    target("nehalem",       NATIVE,      qemu("x86_64", "Nehalem"),          These(&["scalar", "sse2", "sse4.1"]),         Dispatch,    None,              LinuxX86,      EveryRun),
    target("sandybridge",   NATIVE,      qemu("x86_64", "SandyBridge"),      These(&["scalar", "sse2", "sse4.1"]),         Dispatch,    None,              LinuxX86,      EveryRun),
    target("haswell",       NATIVE,      qemu("x86_64", "Haswell"),          These(&["scalar", "sse2", "sse4.1", "avx2"]), Dispatch,    None,              LinuxX86,      EveryRun),
    // What the build guarantees is another level, lesser ones are left out, and the compiler has more
    // instructions to go wrong with.
    target("x86-64-v2",     V2,          Directly,                           OfThisCpuFrom("sse4.1"),                     Brief,       Some(Conformance), Has("sse4.1"), EveryRun),
    target("x86-64-v3",     V3,          Directly,                           OfThisCpuFrom("avx2"),                       Brief,       Some(Conformance), Has("avx2"),   EveryRun),
    target("x86-64-v4",     V4,          Directly,                           OfThisCpuFrom("avx512"),                     Brief,       Some(Conformance), Has("avx512"), EveryRun),
    // Other architectures.
    target("aarch64",       AARCH64,     qemu("aarch64", "max"),             These(&["scalar", "neon"]),                  Brief,       Some(Dispatch),    Linux,         EveryRun),
    target("cortex-a53",    AARCH64,     qemu("aarch64", "cortex-a53"),      These(&["scalar", "neon"]),                  Dispatch,    None,              Linux,         EveryRun),
    target("cortex-a72",    AARCH64,     qemu("aarch64", "cortex-a72"),      These(&["scalar", "neon"]),                  Dispatch,    None,              Linux,         OnDemand),
    target("aarch64-all",   AARCH64,     qemu("aarch64", "max"),             These(&["scalar", "neon"]),                  Workspace,   None,              Linux,         OnDemand),
    target("i686",          I686,        Directly,                           OfThisCpu,                                   Brief,       Some(Dispatch),    LinuxX86,      EveryRun),
    target("wasm32",        WASM32,      Node,                               These(&["scalar"]),                          Brief,       None,              Unix,          EveryRun),
    target("wasm32-simd",   WASM32_SIMD, Node,                               These(&["scalar", "simd128"]),               Brief,       Some(Dispatch),    Unix,          EveryRun),
    // Without a level of their own: the definition holds for either order of bytes and for every
    // way to make vectors of scalar code.
    target("armv7",         ARMV7,       qemu("arm", "max"),                 These(&["scalar"]),                          Brief,       None,              Linux,         OnDemand),
    target("powerpc64le",   POWERPC64LE, qemu("ppc64le", "power9"),          These(&["scalar"]),                          Brief,       None,              Linux,         OnDemand),
    target("riscv64gc",     RISCV64GC,   qemu("riscv64", "rv64"),            These(&["scalar"]),                          Brief,       None,              Linux,         OnDemand),
    target("s390x",         S390X,       qemu("s390x", "max"),               These(&["scalar"]),                          Brief,       None,              Linux,         OnDemand),
    // What no CPU shows: undefined behaviour.
    target("miri",          MIRI_X86_64, Miri,                               These(&["scalar", "sse2"]),                  Conformance, None,              Any,           OnDemand),
    target("miri-avx2",     MIRI_AVX2,   Miri,                               These(&["scalar", "avx2"]),                  Conformance, None,              Any,           OnDemand),
    target("miri-s390x",    MIRI_S390X,  Miri,                               These(&["scalar"]),                          Conformance, None,              Any,           OnDemand),
];

// The builds. Static musl programs need nothing of the target but what rustup brings; where it has
// no musl, Debian's cross compilers bring the C library.
const NATIVE: Build = Build { triple: None, link: Own, rustflags: "" };
const V2: Build = Build { rustflags: "-Ctarget-cpu=x86-64-v2", ..NATIVE };
const V3: Build = Build { rustflags: "-Ctarget-cpu=x86-64-v3", ..NATIVE };
const V4: Build = Build { rustflags: "-Ctarget-cpu=x86-64-v4", ..NATIVE };
const AARCH64: Build = build("aarch64-unknown-linux-musl", Lld);
const I686: Build = build("i686-unknown-linux-musl", Lld);
const WASM32: Build = build("wasm32-wasip1", Own);
const WASM32_SIMD: Build = Build { rustflags: "-Ctarget-feature=+simd128", ..WASM32 };
const ARMV7: Build = build("armv7-unknown-linux-gnueabihf", Gcc("arm-linux-gnueabihf", "armhf"));
const POWERPC64LE: Build =
    build("powerpc64le-unknown-linux-gnu", Gcc("powerpc64le-linux-gnu", "ppc64el"));
const RISCV64GC: Build = build("riscv64gc-unknown-linux-gnu", Gcc("riscv64-linux-gnu", "riscv64"));
const S390X: Build = build("s390x-unknown-linux-gnu", Gcc("s390x-linux-gnu", "s390x"));
const MIRI_X86_64: Build = build("x86_64-unknown-linux-gnu", Own);
const MIRI_AVX2: Build = Build {
    rustflags: "-Ctarget-feature=+avx2,+fma,+bmi1,+bmi2,+lzcnt,+popcnt,+f16c,+movbe",
    ..MIRI_X86_64
};
const MIRI_S390X: Build = build("s390x-unknown-linux-gnu", Own);

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    /// What `--target` of `cross` is given, and reports say.
    pub(crate) name: &'static str,
    /// How its programs are made.
    pub(crate) build: Build,
    /// How they are run.
    pub(crate) run: Run,
    /// The levels that its programs must find: these, no more and no less.
    pub(crate) levels: Levels,
    /// What is run at the best level.
    pub(crate) best: Tests,
    /// What is run at each of the others.
    pub(crate) others: Option<Tests>,
    /// Where this can be done.
    pub(crate) host: Host,
    /// When it is.
    pub(crate) tier: Tier,
}

/// How programs are compiled and linked. By default, as the host's own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Build {
    /// What rustc calls the target; `None` is the host's own.
    pub(crate) triple: Option<&'static str>,
    /// What links.
    pub(crate) link: Link,
    /// More for rustc.
    pub(crate) rustflags: &'static str,
}

/// What links a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Link {
    /// What rustc takes by itself.
    #[default]
    Own,
    /// The linker that rustup ships.
    Lld,
    /// Debian's cross compiler for what GNU calls the first name, and Debian the second.
    Gcc(&'static str, &'static str),
}

/// What runs a program.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Run {
    /// The host.
    Directly,
    /// QEMU's emulator of an architecture, as a certain CPU.
    Qemu {
        /// The architecture.
        arch: &'static str,
        /// What `-cpu` is given.
        cpu: &'static str,
    },
    /// Node's WASI.
    Node,
    /// Miri, which interprets and also builds.
    Miri,
}

/// Which levels must be there.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Levels {
    /// Those whose instructions the host's CPU has.
    OfThisCpu,
    /// Of those the definition and, from this on, what a build that guarantees it does not leave out.
    OfThisCpuFrom(&'static str),
    /// These, weakest first.
    These(&'static [&'static str]),
}

/// Which tests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tests {
    /// All of the workspace, with those in its documentation.
    Everything,
    /// All of the workspace, but for those in its documentation.
    Workspace,
    /// Conformance, kernels and golden pictures: the packages [`CORE`], without [`LONG`].
    Brief,
    /// Conformance, and of the kernels what is in [`DISPATCHED`]: on CPUs and at levels of programs
    /// that another ran more of.
    Dispatch,
    /// Every operation against its definition: the package `simd4`.
    Conformance,
}

/// What every architecture must hold. The few tests within rt-kernels, which know no architecture,
/// would be compiled for a share of what all of it takes.
pub(crate) const CORE: [&str; 2] = ["simd4", "rt-tests"];

/// The tests of [`CORE`] that take an emulator ten seconds to minutes, and that the host runs in full.
pub(crate) const LONG: [&str; 16] = [
    "accelerators::meshes_aimed",
    "build::pathological_scenes",
    "threads_do_not_change",
    "closest_point::of_many_the_same",
    "cone::hits_are_right",
    "large::bundles_at_edges",
    "large::rays_that_go_together",
    "pictures::every_builder",
    "pictures::every_layout",
    "pictures::every_way",
    "precision::pictures_are_within",
    "precision::scenes_differ",
    "watertight::ball_far",
    "watertight::spiky_ball_far",
    "watertight::spiky_ball_of_every_plan",
    "watertight::tiny_ball",
];

/// Of the tests of kernels, those that together take every accelerator, level and packet, and render.
pub(crate) const DISPATCHED: [&str; 6] = [
    "accelerators::closest_and_any",
    "closest_point::nothing_is_closer",
    "pictures::pictures_are_golden",
    "sphere::hit_and_miss",
    "triangle::hit_and_miss",
    "watertight::ball_at",
];

/// Of conformance what the others need not repeat, since no level has a part in it: the definition of
/// elementary functions against the real ones.
pub(crate) const OF_THE_DEFINITION: &str = "elementary::errors";

/// Which machines can try a target. The others leave it to them.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Host {
    /// All.
    Any,
    /// Those on which a file has the same name for a program and for WASI.
    Unix,
    /// QEMU runs single programs on Linux only.
    Linux,
    /// The host's own programs, x86-64 and for Linux.
    LinuxX86,
    /// Those whose CPU has a level.
    Has(&'static str),
}

/// When a target is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tier {
    /// By `ci`.
    EveryRun,
    /// By `ci --all`.
    OnDemand,
}

impl Target {
    /// The row of that name.
    pub(crate) fn named(name: &str) -> Result<&'static Target, String> {
        TARGETS.iter().find(|target| target.name == name).ok_or_else(|| {
            let names: Vec<_> = TARGETS.iter().map(|target| target.name).collect();
            format!("there is no target {name:?}, but {}", names.join(", "))
        })
    }

    /// Why it is left to other machines, if it is.
    pub(crate) fn elsewhere(&self) -> Option<String> {
        let here = match self.host {
            Any => true,
            Unix => FAMILY == "unix",
            Linux => OS == "linux",
            LinuxX86 => OS == "linux" && ARCH == "x86_64",
            Has(level) => levels::of_this_cpu().contains(&level),
        };
        let needed = match self.host {
            Any => "any machine",
            Unix => "Unix",
            Linux => "Linux",
            LinuxX86 => "Linux on x86-64",
            Has(level) => &format!("a CPU with {level}"),
        };
        (!here).then(|| format!("not for this machine: it takes {needed}"))
    }

    /// Whether its build is of the whole workspace, and not of [`CORE`] alone.
    pub(crate) fn of_workspace(&self) -> bool {
        self.build == NATIVE || self.best == Workspace
    }

    /// Whether its programs are those of another.
    pub(crate) fn shares_build(&self, other: &Target) -> bool {
        self.build == other.build && self.of_workspace() == other.of_workspace()
    }

    /// Whether building is one thing and running another.
    pub(crate) fn is_built_apart(&self) -> bool {
        !matches!(self.run, Miri)
    }

    /// The number of cases for proptest, if not its own.
    pub(crate) fn cases(&self, tests: Tests) -> Option<&'static str> {
        match (self.run, tests) {
            (Miri, _) => Some("2"),
            (_, Everything) => None,
            (_, Dispatch) => Some(FEWEST_CASES),
            _ => Some(FEWER_CASES),
        }
    }
}

/// A row, without the names of its fields.
#[expect(clippy::too_many_arguments, reason = "a table is as wide as it is")]
const fn target(
    name: &'static str,
    build: Build,
    run: Run,
    levels: Levels,
    best: Tests,
    others: Option<Tests>,
    host: Host,
    tier: Tier,
) -> Target {
    Target { name, build, run, levels, best, others, host, tier }
}

/// A build for another target, with nothing special.
const fn build(triple: &'static str, link: Link) -> Build {
    Build { triple: Some(triple), link, rustflags: "" }
}

/// QEMU as a certain CPU.
const fn qemu(arch: &'static str, cpu: &'static str) -> Run {
    Qemu { arch, cpu }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_found() {
        for target in TARGETS {
            let found = Target::named(target.name).expect("it is there");
            assert!(std::ptr::eq(found, target), "{} is there twice", target.name);
        }
        let error = Target::named("vax").expect_err("no such row");
        assert!(error.contains("\"vax\"") && error.contains("native, qemu64"), "{error}");
    }

    #[test]
    fn every_list_of_levels_starts_with_the_definition() {
        for target in TARGETS {
            if let These(levels) = target.levels {
                assert_eq!(levels.first(), Some(&"scalar"), "{}", target.name);
            }
        }
    }

    #[test]
    fn rows_of_one_build_are_together_so_that_it_is_done_once() {
        let mut builds: Vec<Build> = TARGETS
            .iter()
            .filter(|target| !matches!(target.run, Miri))
            .map(|target| target.build)
            .collect();
        builds.dedup();
        for (i, build) in builds.iter().enumerate() {
            let again = builds[i + 1..].contains(build);
            assert!(!again, "{build:?} is in two places");
        }
    }
}
