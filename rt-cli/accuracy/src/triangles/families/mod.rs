//! Families of hard inputs: each a generator of rays and triangles, with the circumstance that
//! makes them hard.
//!
//! A family makes [`Batch`] after batch, each from its own number and from a [`Setting`], the same
//! on every machine. Batches differ in their rotation, in the order of their corners, in which axis
//! is which and which way it runs, and in the length of the directions.

mod closed;
mod grid;
mod single;

use rt_kernels::Rays;
use rt_kernels::geom::Triangle;

use rt_kernels::reference::random::Random;
use crate::{BATCH, Place, Setting};

/// Some rays, each of which is tested against each of some triangles.
#[derive(Clone, Debug)]
pub struct Batch {
    /// The triangles.
    pub triangles: Vec<Triangle>,
    /// The rays: [`BATCH`] of them.
    pub rays: Rays,
}

/// What is asked of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Neighbours in a closed mesh and rays from inside: one that exactly meets one of them must
    /// meet one.
    Closed,
    /// The same, with directions as chance has them: what happens by nature.
    Natural,
    /// One triangle, and rays that nearly miss it or nearly hit it.
    Single,
    /// Numbers or triangles that are none.
    Broken,
}

/// A generator of hard inputs.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Its name.
    pub name: &'static str,
    /// The circumstance, in a sentence.
    pub about: &'static str,
    /// What is asked of it.
    pub kind: Kind,
    /// Whether `t` is well conditioned, so that its errors tell about the kernel: no ray grazes a
    /// triangle.
    pub fair: bool,
    /// The setting it is commonly used with.
    pub setting: Setting,
    make: fn(&mut Random, &mut Place) -> Batch,
}

impl Family {
    /// All families of rays and triangles.
    pub const TRIANGLES: [Family; 18] = [
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
        closed::INTERIOR,
        closed::RANDOM,
        single::BAND,
        single::EDGE_ON,
        single::SPAWNED,
        single::DEGENERATE,
        single::NOT_FINITE,
    ];

    /// The family of that name.
    pub fn named(name: &str) -> Option<&'static Family> {
        Family::TRIANGLES.iter().find(|family| family.name == name)
    }

    /// Batch number `i` of the family.
    pub fn batch(&self, setting: &Setting, i: usize) -> Batch {
        let mut random = Random::new(setting.seed ^ (i as u64).wrapping_mul(0xd134_2543_de82_ef95));
        let mut place = Place::new(setting, &mut random);
        (self.make)(&mut random, &mut place)
    }
}

/// Near the origin, of size 1.
const UNIT: Setting = Setting { seed: 1, scale: 1.0, offset: 0.0 };
