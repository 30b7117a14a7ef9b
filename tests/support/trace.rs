//! Running the kernels every way there is.

use rt_kernels::tri::Method;
use rt_kernels::{Accelerator, Builder, Exec, Hit, Hits, Join, KdBuilder, KdPlan, Layout, Mailbox};
use rt_kernels::{PacketSize, Plan, Rays, Stats};
use simd4::Level;

/// Every level of this machine with every packet size that all accelerators have.
pub fn ways() -> Vec<Exec> {
    ways_of(&[PacketSize::Single, PacketSize::Native, PacketSize::Four, PacketSize::Eight])
}

/// Every level of this machine with every packet size; what an accelerator does not have comes to
/// another that it has.
pub fn every_way() -> Vec<Exec> {
    [ways(), ways_of(&[PacketSize::Sixteen, PacketSize::Large])].concat()
}

fn ways_of(packets: &[PacketSize]) -> Vec<Exec> {
    Level::available()
        .flat_map(|level| packets.iter().map(move |&packet| Exec { level, packet }))
        .collect()
}

/// Every hierarchy that there is for a triangle test.
pub fn every_plan(method: Method) -> Vec<Plan> {
    let plans = Builder::ALL
        .into_iter()
        .flat_map(|builder| Layout::ALL.map(|layout| Plan { builder, layout, method }));
    plans.filter(|plan| plan.layout() == plan.layout).collect()
}

/// Every kd-tree that there is for a triangle test: every builder, and every mailbox for one.
pub fn every_kd_plan(method: Method) -> Vec<KdPlan> {
    let default = KdPlan { method, ..KdPlan::default() };
    let mailboxes = [Mailbox::None, Mailbox::Stamps, Mailbox::Hashed(1), Mailbox::Inverse];
    let mailboxes = mailboxes.map(|mailbox| KdPlan { mailbox, ..default });
    let builders = KdBuilder::ALL.map(|builder| KdPlan { builder, ..default });
    builders.into_iter().chain(mailboxes).collect()
}

/// What a ray hit, bit by bit: t, primitive, u, v.
pub type Bits = Option<[u32; 4]>;

/// The bits of a hit.
pub fn bits(hit: Hit) -> [u32; 4] {
    [hit.t.to_bits(), hit.prim, hit.u.to_bits(), hit.v.to_bits()]
}

/// The closest hit of each ray.
pub fn closest(accel: &(impl Accelerator + ?Sized), exec: Exec, rays: &Rays) -> Vec<Option<Hit>> {
    let mut hits = Hits::new();
    accel.closest(exec, rays, &mut hits, &mut Stats::default());
    assert_eq!(hits.len(), rays.len(), "one answer a ray");
    (0..rays.len()).map(|i| hits.get(i)).collect()
}

/// The bits of the closest hit of each ray.
pub fn closest_bits(accel: &(impl Accelerator + ?Sized), exec: Exec, rays: &Rays) -> Vec<Bits> {
    closest(accel, exec, rays).into_iter().map(|hit| hit.map(bits)).collect()
}

/// Whether each ray hits anything.
pub fn any(accel: &(impl Accelerator + ?Sized), exec: Exec, rays: &Rays) -> Vec<bool> {
    let mut found = Vec::new();
    accel.any(exec, rays, &mut found, &mut Stats::default());
    found
}

/// A thread for one half, and whichever half ends first.
pub struct Threads;

impl Join for Threads {
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        std::thread::scope(|scope| {
            let b = scope.spawn(b);
            let a = a();
            (a, b.join().expect("no panic"))
        })
    }
}
