//! From a scene to pixels and numbers.
//!
//! A [`World`] is a scene made ready to trace; a [`Job`] says what picture of it is wanted;
//! [`render`] makes the [`Film`] and reports what it took. The pixels are the same for every
//! [`AccelKind`], [`Plan`] but for its triangle test, level, packet size and number of threads.
#![forbid(unsafe_code)]

mod exec;
mod film;
mod fit;
mod integrate;
mod job;
#[cfg(feature = "measure")]
pub mod measure;
pub mod precision;
mod shade;
mod world;

pub use exec::{KindReport, Made, Progress, Report, Silent, Tiles, render, render_rest};
pub use film::Film;
pub use fit::fitted_view;
pub use integrate::{Integrator, RayKind};
pub use job::{Crop, Job, RenderError, check_crop, check_size};
pub use rt_kernels::geom::Aabb;
pub use rt_kernels::tri::Method;
pub use rt_kernels::{Builder, Exec, KdBuilder, KdTree, Layout, Mailbox, PacketSize, Plan};
pub use shade::{Finish, Point, Shader};
pub use simd4::{Level, LevelError};
pub use world::{AccelKind, World, bounds};
