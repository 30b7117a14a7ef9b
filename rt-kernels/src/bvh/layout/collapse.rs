//! Which nodes of a build tree become the children of one wide node.
//!
//! Whoever meets a wide node's box tests all its children, so the sum of the surfaces of all wide nodes
//! is to be least: leaves are what they are. Of each node it is known what its subtree costs at least
//! as one child of a wide node, as up to two, and so on: as one it is a wide node of its own, whose
//! children are those of the build tree as up to N; as more it gives way to its children, among which
//! the number is shared out.
//!
//! Source: Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
//! BVHs", 2017, Section 3.1. Deviation: subtrees do not become leaves here.

use crate::bvh::build;
use crate::geom::Aabb;

/// A subtree of the build tree.
pub(super) enum Subtree<const N: usize> {
    /// A leaf, also of a wide node.
    Leaf(build::Node),
    /// Two to N subtrees.
    Inner(Inner<N>),
}

/// Two to N subtrees.
pub(super) struct Inner<const N: usize> {
    aabb: Aabb,
    children: Vec<Subtree<N>>,
    /// The least cost as up to one child of a wide node, up to two, and so on.
    costs: [f32; N],
}

impl<const N: usize> Subtree<N> {
    /// A node with those children, of which there are two to N.
    pub(super) fn inner(aabb: Aabb, children: Vec<Subtree<N>>) -> Self {
        let shared = together(&children);
        // That there are fewer nodes counts where none has a surface.
        let mut least = aabb.half_area().max(f32::MIN_POSITIVE) + shared[N - 1];
        let costs = shared.map(|cost| {
            least = least.min(cost);
            least
        });
        Subtree::Inner(Inner { aabb, children, costs })
    }

    /// The box around all of it.
    pub(super) fn aabb(&self) -> &Aabb {
        match self {
            Subtree::Leaf(node) => &node.aabb,
            Subtree::Inner(inner) => &inner.aabb,
        }
    }

    /// The least cost as up to `more` children of a wide node and one.
    fn cost(&self, more: usize) -> f32 {
        match self {
            Subtree::Leaf(_) => 0.0,
            Subtree::Inner(inner) => inner.costs[more],
        }
    }

    /// Adds itself, or what it is parted into as up to `more` children of a wide node and one.
    fn open(self, more: usize, opened: &mut Vec<Subtree<N>>) {
        match self {
            Subtree::Inner(inner) if inner.costs[more] < inner.costs[0] => inner.part(more, opened),
            whole => opened.push(whole),
        }
    }
}

impl<const N: usize> Inner<N> {
    /// What this is parted into if it is a wide node.
    pub(super) fn open(self) -> Vec<Subtree<N>> {
        let mut opened = Vec::with_capacity(N);
        self.part(N - 1, &mut opened);
        opened
    }

    /// The same, but what has the largest surface is parted as long as there is room: what is met first.
    pub(super) fn open_largest(self) -> Vec<Subtree<N>> {
        let mut opened = self.children;
        loop {
            let fits = |subtree: &Subtree<N>| match subtree {
                Subtree::Inner(inner) if opened.len() - 1 + inner.children.len() <= N => {
                    Some(inner.aabb.half_area())
                }
                _ => None,
            };
            let areas = opened.iter().enumerate().filter_map(|(i, one)| Some((i, fits(one)?)));
            let largest = areas.max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((largest, _)) = largest else { return opened };
            if let Subtree::Inner(inner) = opened.swap_remove(largest) {
                opened.extend(inner.children);
            }
        }
    }

    /// Shares `more` children and one out among its own.
    fn part(mut self, mut more: usize, opened: &mut Vec<Subtree<N>>) {
        while let Some(child) = self.children.pop() {
            if self.children.is_empty() {
                return child.open(more, opened);
            }
            let (own, _) = shared_out(&together(&self.children), &child, more);
            child.open(own, opened);
            more -= own + 1;
        }
    }
}

/// What some subtrees, one or more, cost at least together as one child of a wide node, as up to two,
/// and so on. Infinite for fewer than they are.
fn together<const N: usize>(subtrees: &[Subtree<N>]) -> [f32; N] {
    let (first, others) = subtrees.split_first().expect("one or more");
    others.iter().fold(std::array::from_fn(|more| first.cost(more)), |before, child| {
        std::array::from_fn(|more| shared_out(&before, child, more).1)
    })
}

/// Of `more` children and one, how many more than one this is to have, if those `before` cost so much
/// for each number; and what all cost then. Infinite if there are too few.
fn shared_out<const N: usize>(before: &[f32; N], child: &Subtree<N>, more: usize) -> (usize, f32) {
    let ways = (0..more).map(|own| (own, before[more - 1 - own] + child.cost(own)));
    ways.fold((0, f32::INFINITY), |best, way| if way.1 < best.1 { way } else { best })
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::bvh::build::Content;

    /// Children by number, before their node; none of a leaf. And a size of each.
    type Tree = Vec<(Option<[usize; 2]>, f32)>;

    /// Up to eight leaves, put together at random.
    fn tree(seed: u32) -> Tree {
        let mut state = seed.wrapping_mul(2_654_435_769) | 1;
        let mut below = |n: usize| {
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            state as usize % n
        };
        let mut tree: Tree = (0..2 + below(7)).map(|_| (None, 1.0)).collect();
        let mut roots: Vec<usize> = (0..tree.len()).collect();
        while roots.len() > 1 {
            let pair = [0; 2].map(|_| roots.swap_remove(below(roots.len())));
            roots.push(tree.len());
            tree.push((Some(pair), 1.0 + below(100) as f32));
        }
        tree
    }

    fn subtree<const N: usize>(tree: &Tree, i: usize) -> Subtree<N> {
        let (children, size) = tree[i];
        let aabb = Aabb::new(Vec3::ZERO, Vec3::splat(size));
        match children {
            Some(two) => Subtree::inner(aabb, two.map(|child| subtree(tree, child)).into()),
            None => Subtree::Leaf(build::Node { aabb, content: Content::Leaf(0..1) }),
        }
    }

    /// The surfaces of a wide node and all below.
    fn surfaces<const N: usize>(inner: Inner<N>) -> f32 {
        let own = inner.aabb.half_area();
        let opened = inner.open();
        assert!((1..=N).contains(&opened.len()), "{} children", opened.len());
        let below = opened.into_iter().map(|child| match child {
            Subtree::Inner(inner) => surfaces(inner),
            Subtree::Leaf(_) => 0.0,
        });
        own + below.sum::<f32>()
    }

    /// How many children a node has if just those of `wide` are nodes.
    fn children(tree: &Tree, wide: u32, i: usize) -> usize {
        let two = tree[i].0.unwrap_or_default();
        let of = |child: usize| match tree[child].0 {
            Some(_) if wide >> child & 1 == 0 => children(tree, wide, child),
            _ => 1,
        };
        two.map(of).iter().sum()
    }

    /// Of all ways to leave nodes out, none has less surface.
    #[test]
    fn no_choice_has_less_surface() {
        const N: usize = 4;
        for seed in 1..300 {
            let tree = tree(seed);
            let root = tree.len() - 1;
            let inner: Vec<usize> = (0..=root).filter(|&i| tree[i].0.is_some()).collect();
            let least = (0..1_u32 << tree.len())
                .filter(|wide| wide >> root & 1 == 1)
                .filter(|wide| (0..=root).all(|i| wide >> i & 1 == 0 || tree[i].0.is_some()))
                .filter(|&wide| {
                    let mut nodes = inner.iter().filter(|&&i| wide >> i & 1 == 1);
                    nodes.all(|&i| children(&tree, wide, i) <= N)
                })
                .map(|wide| {
                    let nodes = inner.iter().filter(|&&i| wide >> i & 1 == 1);
                    nodes.map(|&i| 3.0 * tree[i].1 * tree[i].1).sum::<f32>()
                })
                .fold(f32::INFINITY, f32::min);
            let Subtree::Inner(whole) = subtree::<N>(&tree, root) else { panic!("two leaves") };
            let got = surfaces(whole);
            assert!((got - least).abs() <= 1e-5 * least, "seed {seed}: {got}, not {least}");
        }
    }
}
