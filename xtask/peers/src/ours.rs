//! The kernels of this repository.

use std::rc::Rc;
use std::time::Instant;

use rt_kernels::{
    Accelerator, Bvh, Exec, Hits, Join, Layout, PacketSize, Plan, Primitives, Rays, Stats,
};
use simd4::Level;

use crate::mesh::Mesh;
use crate::peer::{Built, Hit, Isa, Mode, Way};
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

/// The triangles as the kernels take them.
pub(crate) fn primitives(mesh: &Mesh) -> Result<Primitives, String> {
    let vertices: Vec<_> = mesh.vertices.iter().map(|&vertex| vertex.into()).collect();
    Primitives::mesh(&vertices, &mesh.triangles).map_err(|error| error.to_string())
}

/// A hierarchy for each layout, the default first.
pub(crate) struct Ours(Vec<(Bvh, Built)>);

impl Ours {
    /// Builds them.
    pub(crate) fn build(primitives: &Primitives, join: &impl Join) -> Result<Ours, String> {
        let build = |layout| {
            let plan = Plan { layout, ..Plan::default() };
            let start = Instant::now();
            let bvh = Bvh::build_with(primitives, plan, join).map_err(|error| error.to_string())?;
            let built = Built { time: start.elapsed(), bytes: bvh.bytes() };
            Ok((bvh, built))
        };
        Layout::ALL.into_iter().map(build).collect::<Result<_, _>>().map(Ours)
    }

    /// The hierarchy of the default plan.
    pub(crate) fn default(&self) -> &Bvh {
        &self.0[0].0
    }

    /// All ways to trace those rays, the default first.
    pub(crate) fn ways<'a>(&'a self, work: &Work, level: Level) -> Vec<(Box<dyn Way + 'a>, Built)> {
        let batches: Vec<Rays> =
            work.rays.chunks(BATCH).map(|rays| rays.iter().copied().collect()).collect();
        let batches = Rc::new(batches);
        let mut ways: Vec<(Box<dyn Way + 'a>, Built)> = Vec::new();
        for (i, (bvh, built)) in self.0.iter().enumerate() {
            for packet in PACKETS {
                let exec = Exec { level, packet };
                // What comes to another way has its own row.
                if bvh.exec(exec).packet != packet {
                    continue;
                }
                let default = i == 0 && packet == PacketSize::default();
                let name = format!("{} × {}", bvh.plan().layout.name(), exec.lanes());
                let name = if default { format!("default ({name})") } else { name };
                let mode = Mode { peer: "rt", name, order: work.order, default };
                let results = if work.kind.closest() {
                    Results::Closest(vec![Hits::new(); batches.len()])
                } else {
                    Results::Any(vec![Vec::new(); batches.len()])
                };
                ways.push((
                    Box::new(Run { mode, bvh, exec, batches: batches.clone(), results }),
                    *built,
                ));
            }
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
        let stats = &mut Stats::default();
        match &mut self.results {
            Results::Closest(hits) => {
                for (rays, hits) in self.batches.iter().zip(hits) {
                    self.bvh.closest(self.exec, rays, hits, stats);
                }
            }
            Results::Any(found) => {
                for (rays, found) in self.batches.iter().zip(found) {
                    self.bvh.any(self.exec, rays, found, stats);
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
                let one = Hit { t: 0.0, prim: 0 };
                found.iter().flatten().map(|&found| found.then_some(one)).collect()
            }
        }
    }
}
