//! What is compared: something that traces rays, in each of its ways.

#[cfg(feature = "crates")]
mod bvh;
mod embree;
#[cfg(feature = "crates")]
mod obvhs;
mod ours;
#[cfg(feature = "crates")]
mod parry;
#[cfg(feature = "crates")]
mod single;

use std::fmt;

use serde::{Deserialize, Serialize};

pub(crate) use embree::Embree;
pub(crate) use ours::{Ours, level, plan, primitives};

use crate::clock::Took;
use crate::mesh::Mesh;
use crate::rays::Work;

/// The instructions that all are limited to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Isa {
    /// SSE4.1 for us, 4.2 for Embree, which has nothing between it and SSE2.
    Sse4,
    Avx2,
    Avx512,
    /// What the CPU has, and the compiler was told to use.
    Native,
}

impl Isa {
    pub(crate) const ALL: [Isa; 4] = [Isa::Sse4, Isa::Avx2, Isa::Avx512, Isa::Native];

    /// As on the command line and in JSON.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Isa::Sse4 => "sse4",
            Isa::Avx2 => "avx2",
            Isa::Avx512 => "avx512",
            Isa::Native => "native",
        }
    }
}

impl fmt::Display for Isa {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Who traces, and how.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Mode {
    /// `rt`, `embree4`, …
    pub(crate) peer: String,
    /// What the way is called.
    pub(crate) name: String,
    /// Whether it is what one gets from us without asking.
    pub(crate) default: bool,
}

impl Mode {
    /// Not our default.
    fn of(peer: &str, name: impl Into<String>) -> Mode {
        Mode { peer: peer.to_owned(), name: name.into(), default: false }
    }

    /// Whether it is ours.
    pub(crate) fn is_ours(&self) -> bool {
        self.peer == "rt"
    }

    /// Whether it is Embree's.
    pub(crate) fn is_embree(&self) -> bool {
        self.peer.starts_with("embree")
    }
}

/// What it took to have a hierarchy.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Built {
    pub(crate) took: Took,
    /// With the hierarchy's copy of the triangles, or the buffers that it needs to be kept.
    pub(crate) bytes: usize,
}

/// The closest hit of a ray, or that there is one: then both are 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    pub(crate) t: f32,
    pub(crate) prim: u32,
}

impl Hit {
    /// That there is one.
    const SOME: Hit = Hit { t: 0.0, prim: 0 };
}

/// A hierarchy over a mesh.
pub(crate) trait Peer {
    fn built(&self) -> Built;

    /// All ways to trace those rays over it; the default is the first.
    fn ways<'a>(&'a self, work: &'a Work) -> Vec<Box<dyn Way + 'a>>;
}

/// A way to trace certain rays, which lie ready in the layout that it likes best.
pub(crate) trait Way {
    fn mode(&self) -> &Mode;

    /// Restores what a run overwrites. It is not timed.
    fn reset(&mut self) {}

    /// Traces all rays.
    fn run(&mut self);

    /// What the last run found, in the order of the rays.
    fn hits(&self) -> Vec<Option<Hit>>;
}

/// Everyone at that level, our default first; other crates where the level is what they are compiled
/// for.
pub(crate) fn all<'a>(
    ours: &'a Ours,
    embree: Embree,
    mesh: &'a Mesh,
    isa: Isa,
) -> Result<Vec<Box<dyn Peer + 'a>>, String> {
    let mut peers = ours.at(level(isa)?);
    for robust in [false, true] {
        peers.push(Box::new(embree.build(mesh, isa, 1, robust)?));
    }
    #[cfg(feature = "crates")]
    if isa == Isa::Native {
        peers.push(obvhs::build(mesh));
        peers.push(bvh::build(mesh));
        peers.push(parry::build(mesh)?);
    }
    Ok(peers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Differences;
    use crate::rays::Kind;
    use rt_kernels::reference::mesh::Mesh as Ball;
    use rt_kernels::reference::random::Random;
    use rt_kernels::{Ray, Sequential};

    /// Rays about a ball, of which some hit; not as many as fill packets.
    fn work(kind: Kind) -> Work {
        let mut random = Random::new(5);
        let mut ray = || {
            let origin = random.direction() * 3.0;
            Ray { tmax: 2.5, ..Ray::new(origin, random.in_cube() - origin * 0.5) }
        };
        Work { kind, order: "", rays: (0..1003).map(|_| ray()).collect() }
    }

    #[test]
    fn all_find_the_same() {
        let embree = match Embree::open(None, false) {
            Ok(embree) => embree,
            Err(reason) => return eprintln!("skipped: {reason}"),
        };
        let mesh = Mesh::of(&Ball::icosphere(3));
        let primitives = primitives(&mesh).expect("a mesh");
        let ours = Ours::build(&primitives, plan(false), &Sequential).expect("in range");
        let levels = Isa::ALL.into_iter().filter(|&isa| level(isa).is_ok());
        for (isa, kind) in levels.flat_map(|isa| [(isa, Kind::Primary), (isa, Kind::Shadow)]) {
            let peers = all(&ours, embree, &mesh, isa).expect("built");
            let work = work(kind);
            let mut first = None;
            for mut way in peers.iter().flat_map(|peer| peer.ways(&work)) {
                way.reset();
                way.run();
                let hits = way.hits();
                let expected = first.get_or_insert_with(|| hits.clone());
                let differences = Differences::between(&work.rays, &hits, expected);
                assert_eq!(differences, Differences::default(), "{isa} {:?}", way.mode());
            }
            let hits = first.expect("ours").iter().flatten().count();
            assert!((200..800).contains(&hits), "{hits}");
        }
    }

    #[test]
    fn a_library_that_is_not_there_is_missed_in_one_line() {
        let path = std::path::Path::new("/nowhere/libembree4.so");
        let wrong = Embree::open(Some(path), false).err().expect("it is nowhere");
        assert!(wrong.contains("pip install embreex") && !wrong.contains('\n'), "{wrong}");
    }
}
