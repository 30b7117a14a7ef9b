//! Embree, 3 or 4, by its shared library.

mod ffi;

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::rc::Rc;

use rt_kernels::Ray;

use super::{Built, Hit, Isa, Mode, Peer, Way};
use crate::mesh::Mesh;
use crate::rays::Work;
use ffi::{Align16, Align32, Align64, Config, RayHits, Rays, Record};

/// How to get it.
const HOW: &str = "get Embree 4 by `pip install embreex`, or Embree 3 by `apt-get install \
                   libembree-dev`, or name a libembree4.so with --embree or in EMBREE";

/// The library, found and loaded.
#[derive(Clone, Copy)]
pub(crate) struct Embree {
    library: &'static ffi::Library,
    spatial: bool,
}

impl Embree {
    /// Loads what `path` names, or what is found in pip's and the system's folders; its hierarchies
    /// are to have spatial splits or not.
    ///
    /// # Errors
    /// One line that says how to get it.
    pub(crate) fn open(path: Option<&Path>, spatial: bool) -> Result<Embree, String> {
        let loaded = match path {
            Some(path) => ffi::Library::open(path)
                .map_err(|error| format!("{}: {error}; {HOW}", path.display())),
            None => Embree::find(),
        };
        loaded.map(|library| Embree { library, spatial })
    }

    fn find() -> Result<&'static ffi::Library, String> {
        let system = ["libembree4.so.4", "libembree4.so", "libembree3.so.3", "libembree3.so"];
        let candidates = in_wheels().into_iter().chain(system.map(PathBuf::from));
        let mut loaded = candidates.filter_map(|path| ffi::Library::open(&path).ok());
        loaded.next().ok_or(format!("there is no Embree: {HOW}"))
    }

    /// `embree3` or `embree4`.
    pub(crate) fn name(self) -> &'static str {
        if self.library.major == 3 { "embree3" } else { "embree4" }
    }

    /// Builds a hierarchy at that level, in medium quality, which is the default, or with spatial
    /// splits in high quality.
    pub(crate) fn build(
        self,
        mesh: &Mesh,
        isa: Isa,
        threads: usize,
        robust: bool,
    ) -> Result<Scene, String> {
        let isa = match isa {
            Isa::Sse4 => Some("sse4.2"),
            Isa::Avx2 => Some("avx2"),
            Isa::Avx512 => Some("avx512"),
            Isa::Native => None,
        };
        let config = Config { isa, threads, robust, quality: if self.spatial { 2 } else { 1 } };
        let scene = ffi::Scene::build(self.library, &config, &mesh.vertices, &mesh.triangles)?;
        Ok(Scene { peer: self.name(), robust, scene })
    }
}

/// The libraries in packages of Python's: `embreex.libs/libembree4-….so.4`.
fn in_wheels() -> Vec<PathBuf> {
    let program =
        "import site; print(*site.getsitepackages(), site.getusersitepackages(), sep='\\n')";
    let ask = |python: &&str| Command::new(python).args(["-c", program]).output().ok();
    let Some(output) = ["python3", "python"].iter().find_map(ask) else { return Vec::new() };
    let is_embree = |path: &PathBuf| {
        path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("libembree"))
    };
    String::from_utf8_lossy(&output.stdout)
        .lines()
        .filter_map(|folder| Path::new(folder).join("embreex.libs").read_dir().ok())
        .flat_map(|files| files.flatten().map(|file| file.path()).filter(is_embree))
        .collect()
}

/// A hierarchy of Embree's.
pub(crate) struct Scene {
    peer: &'static str,
    robust: bool,
    scene: ffi::Scene,
}

impl Peer for Scene {
    fn built(&self) -> Built {
        Built { took: self.scene.build, bytes: self.scene.bytes.max(0) as usize }
    }

    /// One by one, and in packets that are native to the level, each with rays announced as coherent
    /// and not.
    fn ways<'a>(&'a self, work: &'a Work) -> Vec<Box<dyn Way + 'a>> {
        let mut ways = Vec::new();
        if work.kind.closest() {
            self.add::<RayHits<Align16, 1>>(work, &mut ways);
            self.add::<RayHits<Align16, 4>>(work, &mut ways);
            self.add::<RayHits<Align32, 8>>(work, &mut ways);
            self.add::<RayHits<Align64, 16>>(work, &mut ways);
        } else {
            self.add::<Rays<Align16, 1>>(work, &mut ways);
            self.add::<Rays<Align16, 4>>(work, &mut ways);
            self.add::<Rays<Align32, 8>>(work, &mut ways);
            self.add::<Rays<Align64, 16>>(work, &mut ways);
        }
        ways
    }
}

impl Scene {
    fn add<'a, R: Record + 'a>(&'a self, work: &'a Work, ways: &mut Vec<Box<dyn Way + 'a>>) {
        if !self.scene.native[R::LANES.ilog2() as usize] {
            return;
        }
        let records: Vec<_> = work.rays.chunks(R::LANES).map(R::new).collect();
        let records = Rc::new(RefCell::new(records));
        // One ray has nothing to be coherent with.
        let flags = if R::LANES == 1 { &[false][..] } else { &[false, true] };
        for &coherent in flags {
            let coherence = if coherent { " coherent" } else { "" };
            let robust = if self.robust { " robust" } else { "" };
            let mode = Mode::of(self.peer, format!("{}{coherence}{robust}", R::LANES));
            let (scene, records) = (&self.scene, records.clone());
            ways.push(Box::new(Run { mode, scene, rays: &work.rays, records, coherent }));
        }
    }
}

/// One way to trace some rays.
struct Run<'a, R> {
    mode: Mode,
    scene: &'a ffi::Scene,
    rays: &'a [Ray],
    /// Ways with packets of one size share them: there are many.
    records: Rc<RefCell<Vec<R>>>,
    coherent: bool,
}

impl<R: Record> Way for Run<'_, R> {
    fn mode(&self) -> &Mode {
        &self.mode
    }

    fn reset(&mut self) {
        let mut records = self.records.borrow_mut();
        for (record, rays) in records.iter_mut().zip(self.rays.chunks(R::LANES)) {
            record.reset(rays);
        }
    }

    fn run(&mut self) {
        self.scene.trace(&mut self.records.borrow_mut(), self.rays.len(), self.coherent);
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        let records = self.records.borrow();
        let hit = |i: usize| records[i / R::LANES].hit(i % R::LANES);
        (0..self.rays.len()).map(|i| hit(i).map(|(t, prim)| Hit { t, prim })).collect()
    }
}
