//! How long it takes to build a hierarchy, on one thread and on two.

use rt_kernels::{Bvh, Join, Plan, Sequential};
use serde::{Deserialize, Serialize};

use crate::clock::{Took, took};
use crate::mesh::Mesh;
use crate::peers::{Embree, Isa, Peer, primitives};
use crate::race::Times;

/// Builds of one scene by one peer.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Build {
    pub(crate) scene: String,
    pub(crate) triangles: usize,
    pub(crate) peer: String,
    pub(crate) threads: usize,
    /// The median of the rounds: of processors on one thread, on the wall on two.
    pub(crate) seconds: f64,
    /// By ours on as many threads.
    pub(crate) to_ours: f64,
}

/// Threads that take turns at what is independent.
struct Pool(rayon::ThreadPool);

impl Join for Pool {
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        rayon::join(a, b)
    }
}

/// Lets our builder and Embree's take turns, at the best level of this CPU.
pub(crate) fn measure(
    mesh: &Mesh,
    embree: Embree,
    plan: Plan,
    rounds: usize,
) -> Result<Vec<Build>, String> {
    const THREADS: [usize; 2] = [1, 2];
    let scene = primitives(mesh)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
    let pool = Pool(pool.map_err(|error| error.to_string())?);
    let ours = |threads: usize| -> Result<Took, String> {
        let (built, took) = match threads {
            1 => took(|| Bvh::build_with(&scene, plan, &Sequential)),
            _ => pool.0.install(|| took(|| Bvh::build_with(&scene, plan, &pool))),
        };
        built.map(|_| took).map_err(|error| error.to_string())
    };
    let theirs =
        |threads| embree.build(mesh, Isa::Native, threads, false).map(|scene| scene.built().took);
    let mut failed = None;
    let times = Times::race(2 * THREADS.len(), rounds, |who| {
        let threads = THREADS[who / 2];
        let took = if who.is_multiple_of(2) { ours(threads) } else { theirs(threads) };
        took.map_err(|error| failed = Some(error)).unwrap_or_default().on(threads)
    });
    if let Some(error) = failed {
        return Err(error);
    }
    let build = |who: usize| Build {
        scene: mesh.name.clone(),
        triangles: mesh.triangles.len(),
        peer: if who.is_multiple_of(2) { "rt".to_owned() } else { embree.name().to_owned() },
        threads: THREADS[who / 2],
        seconds: times.median(who),
        to_ours: times.ratio(who - who % 2, who),
    };
    Ok((0..2 * THREADS.len()).map(build).collect())
}
