//! Ray tracing kernels that give one answer and leak nothing.
//!
//! Pure geometry on the lanes of [`simd4`]: no I/O, no clocks, no threads of its own. A caller
//! hands a batch of [`Rays`] to an [`Accelerator`] and says [how](Exec) to run it; the bits that
//! come back are the same for every accelerator, packet size, level and machine.
//!
//! ```
//! use glam::Vec3;
//! use rt_kernels::{Accelerator, Bvh, Exec, Hits, Primitives, Ray, Rays, Sequential, Stats};
//! use rt_kernels::geom::Sphere;
//!
//! let ball = Sphere { center: Vec3::ZERO, radius: 1.0 };
//! let scene = Primitives { spheres: vec![ball], ..Primitives::default() };
//! let bvh = Bvh::build(&scene, &Sequential)?;
//!
//! let mut rays = Rays::new();
//! rays.push(Ray::new(Vec3::new(0.0, 0.0, 5.0), Vec3::NEG_Z));
//! let mut hits = Hits::new();
//! bvh.closest(Exec::best()?, &rays, &mut hits, &mut Stats::default());
//! assert_eq!(hits.get(0).map(|hit| hit.t), Some(4.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Who has one ray asks for its closest hit ([`intersect`](Accelerator::intersect)), for the closest
//! of some primitives ([`intersect_where`](Accelerator::intersect_where)), for whether there is any
//! ([`occluded`](Accelerator::occluded)), or for [`all_hits`](Accelerator::all_hits); who has a point
//! asks for the [`closest_point`](Bvh::closest_point). [`Primitives::mesh`] takes vertices and
//! indices, [`Bvh::refit`] new positions, and a [`Plan`] says what hierarchy to build.
//!
//! # Why the answer is one
//!
//! What a ray hits is defined by each primitive alone, never by the order of visits:
//!
//! 1. Every primitive has its **own box**: its bounds, [padded](geom::Aabb::padded) by more than
//!    the error of its kernel. Nodes are bounded by unions of own boxes.
//! 2. A ray hits a primitive if the kernel says so **and** the ray passes the own box, by the same
//!    [slab expression](slab) that tests nodes. The hit's `t` is the greater of the kernel's and
//!    the entry into the own box.
//! 3. The closest hit is the least `(t, primitive)`; equal `t` go to the lowest primitive.
//!
//! That holds for every triangle test that an accelerator can be built for ([`tri::Method`]): each has
//! one answer, its own. Only that of the default is also exact at edges.
//!
//! Every operation of the slab expression is monotone under rounding, so nested boxes have nested
//! intervals, bit for bit. No node above the winner can then be entered later than the winner's
//! `t`, and pruning on `entry > best` never loses it. Padding alone would not do: the `t` of an
//! unclamped hit can fall before the entry into its own box by any amount, and whether it is found
//! would depend on what was found before.
//!
//! Where an accelerator cuts own boxes, the pieces do not contain them. Why that is enough, and why
//! the pieces may not be made smaller, stands in
//! [`spatial_splits`](bvh::build::spatial_splits#why-pieces-are-enough); why a [kd-tree](kd) may cut
//! triangles by their planes, [there](kd#why-the-answer-is-one).
//!
//! # The range
//!
//! Coordinates up to 2^40 in magnitude, and directions whose greatest component is between 2^-20
//! and 2^20, keep every product of the kernels finite; primitives whose widths, not only lengths, are
//! greater than 2^-40 keep them from vanishing. Of a [cone](quadric::cone) also the width times the
//! direction is to be greater than 2^-50, or its hits lose digits. A scene outside this range is brought in
//! by an exact power of two before it is built.

mod accelerator;
mod brute;
pub mod bvh;
pub mod camera;
pub mod catalogue;
mod collect;
pub mod geom;
pub mod kd;
pub mod mailbox;
pub mod packet;
mod primitives;
pub mod quadric;
#[cfg(feature = "reference")]
pub mod reference;
mod single;
pub mod slab;
mod stats;
mod sweep;
mod trace;
pub mod tri;

pub use accelerator::Accelerator;
pub use brute::Brute;
pub use bvh::{BuildError, Builder, Bvh, ClosestPoint, Join, Layout, Plan, RefitError, Sequential};
pub use geom::{Hit, Ray};
pub use kd::{KdBuilder, KdPlan, KdTree};
pub use mailbox::Mailbox;
pub use packet::{Hits, Rays};
pub use primitives::Primitives;
pub use stats::{Counters, NoStats, Stats};
pub use trace::{Exec, PacketSize};
