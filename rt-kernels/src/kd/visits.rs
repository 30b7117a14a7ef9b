//! Which nodes a ray visits: for counting what rays have in common.

use super::{KdTree, WIDER};
use crate::Ray;

impl KdTree {
    /// Calls with the number of every node that [traversal](super::traverse) visits for this ray
    /// alone, if nothing is hit before `tmax`: for a ray that ends at its closest hit, these are those
    /// that are visited to find it.
    pub fn visits(&self, ray: &Ray, visit: &mut impl FnMut(usize)) {
        let (origin, inv) = (ray.origin.to_array(), ray.dir.to_array().map(|d| 1.0 / d));
        let distance = |axis: usize, at: f32| (at - origin[axis]) * inv[axis];
        let (mut near, mut far) = (ray.tmin, ray.tmax.min(f32::MAX));
        for (axis, &sides) in self.bounds.axes.iter().enumerate() {
            let negative = usize::from(inv[axis] < 0.0);
            // `max` and `min` drop NaN.
            near = near.max(distance(axis, sides[negative]) * (1.0 - WIDER));
            far = far.min(distance(axis, sides[1 - negative]) * (1.0 + WIDER));
        }
        let mut waiting = vec![(0, near, far)];
        while let Some((number, near, far)) = waiting.pop() {
            if near > far {
                continue;
            }
            visit(number);
            let node = self.cells.pairs[number / 2].0[number % 2];
            let Some(axis) = node.axis() else { continue };
            let split = distance(axis, node.at());
            let first = usize::from(inv[axis] < 0.0);
            let children = [0, 1].map(|child| 2 * node.pair() + child);
            waiting.push((children[1 - first], near.max(split * (1.0 - WIDER)), far));
            waiting.push((children[first], near, far.min(split * (1.0 + WIDER))));
        }
    }
}
