//! Families of hard inputs, whatever the sort of kernel that they are hard on.

use rt_kernels::catalogue::{Listed, Shape, Way};
use rt_kernels::reference::random::Random;
use simd4::Level;

use crate::{Ceiling, Row, Tally, Time};

/// Rays to a batch.
pub const BATCH: usize = 64;

/// A generator of inputs that are hard on kernels of one sort.
///
/// It makes batch after batch of [`BATCH`] rays, each from its own number and from a [`Setting`],
/// the same on every machine.
pub trait Family: Sized + Sync + 'static {
    /// What kernels of this sort are listed as.
    type Kernel: Listed + ?Sized + 'static;

    /// What they intersect.
    const SORT: &'static str;

    /// All families for this sort.
    fn all() -> &'static [Self];

    /// All kernels of this sort, with every choice.
    fn kernels() -> Vec<&'static Self::Kernel>;

    /// What each of them was found to get wrong, at most.
    fn ceilings() -> &'static [Ceiling];

    /// Nanoseconds of the calling thread for one test of one ray by each subject, the rays' share
    /// of the setup of packets included. Each runs once a round, in turn, so that a machine that
    /// slows down slows down all of them.
    fn time(subjects: &[Subject<Self::Kernel>], rounds: usize) -> Vec<Time>;

    /// What there is to know of the family.
    fn facts(&self) -> &Facts;

    /// Judges batch number `i`, shows it to every subject and counts in its tally.
    fn count(
        &self,
        setting: &Setting,
        i: usize,
        subjects: &[Subject<Self::Kernel>],
        tallies: &mut [Tally],
    );

    /// The bits of what a subject answers to the rays of batch number `i`. All NaNs are one.
    fn answers(
        &self,
        setting: &Setting,
        i: usize,
        subject: &Subject<Self::Kernel>,
    ) -> Vec<[u32; 4]>;

    /// What the default kernel promises, and breaks in this row: nothing, or what it is.
    fn broken_promise(row: &Row<Self>) -> Option<String>;

    /// The family of that name.
    fn named(name: &str) -> Option<&'static Self> {
        Self::all().iter().find(|family| family.facts().name == name)
    }
}

/// What there is to know of a family.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    /// Its name.
    pub name: &'static str,
    /// The circumstance, in a sentence.
    pub about: &'static str,
    /// What is asked of it.
    pub kind: Kind,
    /// Whether `t` is well conditioned, so that its errors tell about the kernel: no ray grazes
    /// anything, or starts next to it.
    pub fair: bool,
    /// The setting it is commonly used with.
    pub setting: Setting,
}

/// What is asked of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Neighbours in a closed mesh and rays from inside: one that exactly meets one of them must
    /// meet one.
    Closed,
    /// Rays as chance has them: what happens by nature. Of triangles, those of a closed mesh.
    Natural,
    /// One primitive, and rays that nearly miss it or nearly hit it.
    Single,
    /// Numbers or primitives that are none.
    Broken,
}

impl Kind {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Closed => "closed",
            Kind::Natural => "natural",
            Kind::Single => "single",
            Kind::Broken => "broken",
        }
    }
}

/// What a family leaves open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The stream of random numbers.
    pub seed: u64,
    /// The size of meshes and primitives.
    pub scale: f32,
    /// How far from the world's origin they are.
    pub offset: f32,
}

impl Setting {
    /// Near the origin, of size 1.
    pub const UNIT: Setting = Setting { seed: 1, scale: 1.0, offset: 0.0 };

    /// The random numbers of batch number `i`.
    pub(crate) fn stream(&self, i: usize) -> Random {
        Random::new(self.seed ^ (i as u64).wrapping_mul(0xd134_2543_de82_ef95))
    }
}

/// A kernel and a way to run it.
pub struct Subject<K: ?Sized + 'static> {
    /// The kernel.
    pub kernel: &'static K,
    /// A way in which it [runs](Listed::runs).
    pub way: Way,
}

impl<K: ?Sized> Clone for Subject<K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K: ?Sized> Copy for Subject<K> {}

impl<K: Listed + ?Sized> std::fmt::Debug for Subject<K> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (name, variant) = (self.kernel.name(), self.kernel.variant());
        write!(f, "{name} ({variant}), {:?} at {}", self.way.shape, self.way.level)
    }
}

/// Every kernel, every way it runs without emulation.
pub fn subjects<F: Family>() -> Vec<Subject<F::Kernel>> {
    let ways = Way::all();
    let each = |kernel| ways.iter().map(move |&way| Subject { kernel, way });
    F::kernels().into_iter().flat_map(each).filter(is_itself).collect()
}

/// Every kernel once: packets at the best level, or else one ray at a time. One that is not exact,
/// and so not the same in all shapes, both ways.
///
/// # Panics
/// If `SIMD4_LEVEL` names no level of this CPU.
pub fn samples<F: Family>() -> Vec<Subject<F::Kernel>> {
    let level = Level::best().expect("a level");
    let ways = [Shape::Rays, Shape::One].map(|shape| Way { level, shape });
    let each = |kernel: &'static F::Kernel| {
        let all = ways.map(|way| Subject { kernel, way }).into_iter().filter(is_itself);
        all.take(if kernel.is_exact() { 1 } else { 2 })
    };
    F::kernels().into_iter().flat_map(each).collect()
}

/// The kernel that renders, every way it runs.
pub fn defaults<F: Family>() -> Vec<Subject<F::Kernel>> {
    subjects::<F>().into_iter().filter(|subject| subject.kernel.is_default()).collect()
}

fn is_itself<K: Listed + ?Sized>(subject: &Subject<K>) -> bool {
    subject.kernel.runs(subject.way) && !subject.kernel.is_emulated(subject.way)
}
