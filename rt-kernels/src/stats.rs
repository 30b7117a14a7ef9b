//! What a traversal did.

use std::ops::AddAssign;

/// Counts of work. A packet counts once a node and once a lane for each test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Nodes that a packet, or a single ray, was tested against.
    pub node_visits: u64,
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
        self.box_tests += other.box_tests;
        self.triangle_tests += other.triangle_tests;
        self.sphere_tests += other.sphere_tests;
        self.cone_tests += other.cone_tests;
        self.mailed += other.mailed;
    }
}
