//! New positions for an old tree.

use crate::bvh::{BuildError, Sequential};
use crate::geom::Aabb;
use crate::primitives::{KINDS, Primitives};

/// Why a hierarchy does not take new positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RefitError {
    /// A hierarchy could not be built of them either.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// There are more primitives of a kind than when it was built, or fewer.
    #[error(
        "the hierarchy was built for {} triangles, {} spheres and {} cones, not {}, {} and {}",
        built[0], built[1], built[2], given[0], given[1], given[2]
    )]
    Counts {
        /// How many triangles, spheres and cones there were.
        built: [usize; KINDS],
        /// How many there are.
        given: [usize; KINDS],
    },
}

/// A layout that can.
pub(super) trait Refit {
    /// How many triangles, spheres and cones it was made for.
    fn counts(&self) -> [usize; KINDS];

    /// Takes new positions of the same primitives, whose own boxes these are, and keeps the tree.
    fn replace(&mut self, primitives: &Primitives, own_boxes: &[Aabb]);
}

/// Takes new positions and keeps the tree: leaves are bounded again by own boxes, nodes by their
/// children.
///
/// Where own boxes were cut, the pieces are not: each leaf has the whole, as if it had been put
/// there so. That is right as it would be for any tree.
pub(super) fn refit(array: &mut impl Refit, primitives: &Primitives) -> Result<(), RefitError> {
    primitives.check(&Sequential)?;
    let (built, given) = (array.counts(), primitives.counts());
    if built != given {
        return Err(RefitError::Counts { built, given });
    }
    let own_boxes: Vec<_> = primitives.own_boxes().collect();
    array.replace(primitives, &own_boxes);
    Ok(())
}
