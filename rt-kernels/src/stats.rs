//! What a traversal did.

use std::ops::AddAssign;

/// Whom a traversal tells of its work: [`Stats`], or [nobody](NoStats).
pub trait Counters: Copy + Default + AddAssign {
    /// Adds some work.
    fn count(&mut self, work: impl FnOnce(&mut Stats));
}

/// No counts, which compile to nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoStats;

impl Counters for NoStats {
    #[inline(always)]
    fn count(&mut self, _: impl FnOnce(&mut Stats)) {}
}

impl AddAssign for NoStats {
    #[inline(always)]
    fn add_assign(&mut self, _: NoStats) {}
}

impl Counters for Stats {
    #[inline(always)]
    fn count(&mut self, work: impl FnOnce(&mut Stats)) {
        work(self);
    }
}

/// Counts of work. A packet counts once a node and once a lane for each test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Nodes that a packet, or a single ray, was tested against.
    pub node_visits: u64,
    /// Rays that went on into those, summed: by node visits, how full packets are. Over a skip array
    /// a packet visits nodes that no ray goes on into; the kd-tree does not count it.
    pub active_rays: u64,
    /// Rays that went on by themselves from somewhere, because too few went with them; all if no rays
    /// go together. Packets of a register's size never part.
    pub rays_alone: u64,
    /// Tests of one ray against one node's box.
    pub box_tests: u64,
    /// Tests of one ray against one triangle.
    pub triangle_tests: u64,
    /// Tests of one ray against one sphere.
    pub sphere_tests: u64,
    /// Tests of one ray against one cone or cylinder.
    pub cone_tests: u64,
    /// Tests of one ray against one primitive that a [mailbox](crate::mailbox) spared.
    pub mailed: u64,
}

impl Stats {
    /// Tests of one ray against one primitive of any kind.
    pub fn primitive_tests(&self) -> u64 {
        self.triangle_tests + self.sphere_tests + self.cone_tests
    }
}

impl AddAssign for Stats {
    fn add_assign(&mut self, other: Stats) {
        self.node_visits += other.node_visits;
        self.active_rays += other.active_rays;
        self.rays_alone += other.rays_alone;
        self.box_tests += other.box_tests;
        self.triangle_tests += other.triangle_tests;
        self.sphere_tests += other.sphere_tests;
        self.cone_tests += other.cone_tests;
        self.mailed += other.mailed;
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use simd4::{Scalar, Simd};

    use super::*;
    use crate::bvh::layout::Wide;
    use crate::bvh::traverse::large::{self, Batch, Scratch};
    use crate::bvh::{Builder, Sequential, build::Block};
    use crate::geom::{Ray, Sphere};
    use crate::packet::{Hits, Rays};
    use crate::primitives::Primitives;

    /// What a traversal finds does not depend on whom it tells, and who is nobody takes no room.
    #[test]
    fn counting_changes_nothing() {
        let ball = |i: u8| Sphere { center: Vec3::X * f32::from(i), radius: 0.4 };
        let scene = Primitives { spheres: (0..50).map(ball).collect(), ..Primitives::default() };
        let tree = Builder::default().build(&scene, Block::ONE, &Sequential);
        let wide = Wide::<4>::new(&scene, tree, &Sequential);
        let rays: Rays =
            (0..500).map(|i| Ray::new(Vec3::new(i as f32 * 0.1, 0.1, 9.0), Vec3::NEG_Z)).collect();
        fn found<C: Counters>(wide: &Wide<4>, rays: &Rays, counters: &mut C) -> Vec<Option<u32>> {
            let mut hits = Hits::new();
            hits.resize(rays.len());
            let batch = Batch { rays, most: 64, any: false, hits: &mut hits };
            let s = Scalar::new();
            let scratch = &mut Scratch::new(wide);
            large::trace::<_, <Scalar as Simd>::f32x4, C, 4>(s, wide, batch, scratch, counters);
            (0..rays.len()).map(|i| hits.get(i).map(|hit| hit.t.to_bits())).collect()
        }
        let mut stats = Stats::default();
        let counted = found(&wide, &rays, &mut stats);
        assert!(stats.node_visits > 50 && stats.sphere_tests > 300, "{stats:?}");
        assert!((stats.node_visits..=stats.node_visits * 64).contains(&stats.active_rays));
        assert_eq!(found(&wide, &rays, &mut NoStats), counted);
        assert!(counted.iter().flatten().count() > 300);
        assert_eq!(size_of::<NoStats>(), 0);
    }
}
