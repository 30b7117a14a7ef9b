//! The kernels of this repository.

use std::rc::Rc;

use rt_kernels::{
    Accelerator, Builder, Bvh, Exec, Hits, Join, Layout, PacketSize, Plan, Primitives, Rays,
};
use simd4::Level;

use super::{Built, Hit, Isa, Mode, Peer, Way};
use crate::clock::took;
use crate::mesh::Mesh;
use crate::rays::Work;

/// Rays in a batch: a tile of 32 by 32 pixels, as the renderer has them.
const BATCH: usize = 1024;

/// The packets that are shown beside the default.
const PACKETS: [PacketSize; 2] = [PacketSize::Native, PacketSize::Single];

/// The level that this comes to, if this CPU has it.
pub(crate) fn level(isa: Isa) -> Result<Level, String> {
    match isa {
        Isa::Sse4 => Level::named("sse4.1"),
        Isa::Avx2 => Level::named("avx2"),
        Isa::Avx512 => Level::named("avx512"),
        Isa::Native => Level::best(),
    }
    .map_err(|error| error.to_string())
}

/// The default, or the same with spatial splits.
pub(crate) fn plan(spatial: bool) -> Plan {
    let default = Plan::default();
    if spatial { Plan { builder: Builder::Spatial, ..default } } else { default }
}

/// The triangles as the kernels take them.
pub(crate) fn primitives(mesh: &Mesh) -> Result<Primitives, String> {
    let vertices: Vec<_> = mesh.vertices.iter().map(|&vertex| vertex.into()).collect();
    Primitives::mesh(&vertices, &mesh.triangles).map_err(|error| error.to_string())
}

/// A hierarchy for each layout, the plan's first.
pub(crate) struct Ours(Vec<(Bvh, Built)>);

impl Ours {
    /// Builds them.
    pub(crate) fn build(
        primitives: &Primitives,
        plan: Plan,
        join: &impl Join,
    ) -> Result<Ours, String> {
        let mut layouts = Layout::ALL;
        layouts.sort_by_key(|&layout| layout != plan.layout);
        let build = |layout| {
            let plan = Plan { layout, ..plan };
            let (bvh, took) = took(|| Bvh::build_with(primitives, plan, join));
            let bvh = bvh.map_err(|error| error.to_string())?;
            let built = Built { took, bytes: bvh.bytes() };
            Ok((bvh, built))
        };
        layouts.into_iter().map(build).collect::<Result<_, _>>().map(Ours)
    }

    /// The hierarchy of the default plan.
    pub(crate) fn default(&self) -> &Bvh {
        &self.0[0].0
    }

    /// All of them, at one level.
    pub(crate) fn at<'a>(&'a self, level: Level) -> Vec<Box<dyn Peer + 'a>> {
        let one = |(i, (bvh, built)): (usize, &'a (Bvh, Built))| -> Box<dyn Peer + 'a> {
            Box::new(At { bvh, built: *built, level, default: i == 0 })
        };
        self.0.iter().enumerate().map(one).collect()
    }
}

/// A hierarchy, to be traced at one level.
struct At<'a> {
    bvh: &'a Bvh,
    built: Built,
    level: Level,
    default: bool,
}

impl Peer for At<'_> {
    fn built(&self) -> Built {
        self.built
    }

    fn ways<'a>(&'a self, work: &'a Work) -> Vec<Box<dyn Way + 'a>> {
        let batches = work.rays.chunks(BATCH).map(|rays| rays.iter().copied().collect());
        let batches: Rc<Vec<Rays>> = Rc::new(batches.collect());
        let usual = Exec::at(self.level);
        let mut seen = Vec::new();
        let mut ways: Vec<Box<dyn Way + 'a>> = Vec::new();
        for packet in [usual.packet].into_iter().chain(PACKETS) {
            let exec = Exec { packet, ..usual };
            // There is not code for every packet.
            let comes_to = self.bvh.exec(exec);
            if seen.contains(&comes_to.packet) {
                continue;
            }
            let default = self.default && seen.is_empty();
            seen.push(comes_to.packet);
            let name = format!("{} × {}", self.bvh.plan().layout.name(), comes_to.lanes());
            let name = if default { format!("default ({name})") } else { name };
            let results = if work.kind.closest() {
                Results::Closest(vec![Hits::new(); batches.len()])
            } else {
                Results::Any(vec![Vec::new(); batches.len()])
            };
            let mode = Mode { default, ..Mode::of("rt", name) };
            let (bvh, batches) = (self.bvh, batches.clone());
            ways.push(Box::new(Run { mode, bvh, exec, batches, results }));
        }
        ways
    }
}

/// What is found, batch by batch.
enum Results {
    Closest(Vec<Hits>),
    Any(Vec<Vec<bool>>),
}

/// One way to trace some rays.
struct Run<'a> {
    mode: Mode,
    bvh: &'a Bvh,
    exec: Exec,
    batches: Rc<Vec<Rays>>,
    results: Results,
}

impl Way for Run<'_> {
    fn mode(&self) -> &Mode {
        &self.mode
    }

    fn run(&mut self) {
        match &mut self.results {
            Results::Closest(hits) => {
                for (rays, hits) in self.batches.iter().zip(hits) {
                    self.bvh.closest_uncounted(self.exec, rays, hits);
                }
            }
            Results::Any(found) => {
                for (rays, found) in self.batches.iter().zip(found) {
                    self.bvh.any_uncounted(self.exec, rays, found);
                }
            }
        }
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        match &self.results {
            Results::Closest(hits) => hits
                .iter()
                .flat_map(|hits| (0..hits.len()).map(|i| hits.get(i)))
                .map(|hit| hit.map(|hit| Hit { t: hit.t, prim: hit.prim }))
                .collect(),
            Results::Any(found) => {
                found.iter().flatten().map(|&found| found.then_some(Hit::SOME)).collect()
            }
        }
    }
}
