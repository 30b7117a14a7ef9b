//! Families of rays and triangles: each a generator, with the circumstance that makes it hard.
//!
//! Batches differ in their rotation, in the order of their corners, in which axis is which and
//! which way it runs, and in the length of the directions.

mod closed;
mod grid;
mod single;

use rt_kernels::Rays;
use rt_kernels::geom::Triangle;
use rt_kernels::reference::random::Random;

use crate::place::Place;
use crate::{Facts, Setting};

/// Some rays, each of which is tested against each of some triangles.
#[derive(Clone, Debug)]
pub struct Batch {
    /// The triangles.
    pub triangles: Vec<Triangle>,
    /// The rays.
    pub rays: Rays,
}

/// A generator of rays and triangles.
#[derive(Clone, Copy, Debug)]
pub struct TriangleFamily {
    pub(super) facts: Facts,
    make: fn(&mut Random, &mut Place) -> Batch,
}

impl TriangleFamily {
    pub(super) const ALL: [TriangleFamily; 20] = [
        closed::EDGE,
        closed::VERTEX,
        closed::AXIS,
        closed::FAR,
        closed::VERY_FAR,
        closed::TINY,
        closed::HUGE,
        closed::PANCAKE,
        closed::NEEDLE,
        grid::EXACT,
        grid::ROTATED,
        grid::SPLIT_PLANE,
        closed::INTERIOR,
        closed::RANDOM,
        closed::CAMERA,
        single::BAND,
        single::EDGE_ON,
        single::SPAWNED,
        single::DEGENERATE,
        single::NOT_FINITE,
    ];

    /// Batch number `i`.
    pub fn batch(&self, setting: &Setting, i: usize) -> Batch {
        let mut random = setting.stream(i);
        let mut place = Place::new(setting, &mut random);
        (self.make)(&mut random, &mut place)
    }
}
