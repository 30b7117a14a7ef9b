//! How far each triangle test may be off.

use crate::{AccelKind, Layout, Method, Plan};

/// The unit roundoff of `f32`: 2^-24.
pub const ROUNDOFF: f64 = 1.0 / (1 << 24) as f64;

/// What a triangle test misjudges: bounds, all in units of [`ROUNDOFF`].
///
/// The **band** of an edge is how far from it, at right angles to itself, a ray may pass and still
/// be judged as if it passed on the other side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// The test.
    pub method: Method,
    /// The band, for each unit of the distance from the ray's origin to the farthest corner.
    pub reach: f64,
    /// The band, for each unit of the greatest coordinate of ray and triangle: what precomputed
    /// numbers about the world's origin cost. 0 for a test that is relative to the ray.
    pub coordinate: f64,
    /// Whether one edge is judged by what the other two leave of 1: in a needle its band is as
    /// many times greater as they are longer.
    pub remainder: bool,
    /// Whether the band of an edge grows with the cosecant of the angle at which it is seen.
    pub end_on: bool,
    /// How far `t` is off, as a shift of the triangle's plane, in the same units as `reach`.
    pub depth: f64,
    /// Whether that grows with the slimness of the triangle, because `t` is made of its edges and
    /// not of its plane.
    pub slim: bool,
    /// The greatest number of triangles for which the test is worth its memory over a skip array.
    pub most_triangles: usize,
    /// The greatest number of [boxes met](super::Facts::boxes_met) for which it is worth its misses.
    pub most_boxes: f64,
}

impl Errors {
    /// Whether the test is the default or faster than that over a structure, in a scene of so many
    /// triangles, of whose boxes a line meets so many.
    pub fn pays(&self, over: Over, triangles: usize, boxes_met: f64) -> bool {
        let gains = triangles <= self.most_triangles && boxes_met <= self.most_boxes;
        self.method == Method::default() || over == Over::SkipArray && gains
    }
}

/// What a triangle test is run over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// Nodes of four or eight children, which have the default test alone.
    WideNodes,
    /// A BVH as a list with skip pointers.
    SkipArray,
    /// A kd-tree, where no test gains a twentieth on the default but in a room seen from outside, or no
    /// structure, which is there to be compared with.
    Other,
}

impl Over {
    /// What a plan comes to with the default test.
    pub fn of(kind: AccelKind, plan: &Plan) -> Over {
        match (kind, plan.layout) {
            (AccelKind::Bvh, Layout::Skip) => Over::SkipArray,
            (AccelKind::Bvh, _) => Over::WideNodes,
            (AccelKind::Kd { .. } | AccelKind::Brute, _) => Over::Other,
        }
    }
}

/// The bounds of all methods, cheapest first; the last is the default.
///
/// `reach`, `coordinate` and `depth` are the worst that was seen of ten million rays aimed at the
/// edges of random triangles (near the origin, far from it, needles, edges seen end on;
/// `PROPTEST_CASES=6000 cargo test -p rt-tests precision` aims them again), at least doubled; `rt
/// accuracy` holds its closed meshes against them. That `end_on` and `remainder` are all that makes
/// them grow follows from the roundings: Möller and Trumbore's edge functions are triple products, each off by
/// roundings of its factors' lengths, whatever the angle; Wald's are off by the size of the
/// coordinates. The watertight test's band is proven ([`Watertight`](rt_kernels::tri::Watertight),
/// "Precision": 6 roundoffs along each of two axes).
///
/// **The order and the limits** are measured: `rt bench spd:near spd:far spd:slivers --kernels`, in
/// more sizes of each. A test that is not the default has less to do for a hit and more for a miss,
/// so that it pays where few boxes are met. Wald's saves up to a quarter of the time of rays that
/// see little else, and a hundredth among 10,000 triangles; but its own boxes are 24 bytes more a
/// triangle, which above that costs more than the test saves. Möller and Trumbore's saves a tenth
/// at best, and nothing at some levels. Plücker's saves nothing anywhere.
pub const ERRORS: [Errors; 4] = [
    Errors {
        method: Method::Wald,
        reach: 4.0,
        coordinate: 6.0,
        remainder: true,
        end_on: false,
        depth: 5.0,
        slim: false,
        most_triangles: 1 << 14,
        most_boxes: 16.0,
    },
    Errors {
        method: Method::MollerTrumbore,
        reach: 4.0,
        coordinate: 0.0,
        remainder: true,
        end_on: true,
        depth: 10.0,
        slim: true,
        most_triangles: usize::MAX,
        most_boxes: 6.0,
    },
    Errors {
        method: Method::Plucker,
        reach: 8.0,
        coordinate: 0.0,
        remainder: false,
        end_on: true,
        depth: 10.0,
        slim: true,
        most_triangles: 0,
        most_boxes: 0.0,
    },
    Errors {
        method: Method::Watertight,
        reach: 9.0,
        coordinate: 0.0,
        remainder: false,
        end_on: false,
        depth: 8.0,
        slim: true,
        most_triangles: usize::MAX,
        most_boxes: f64::INFINITY,
    },
];

/// The bounds of one method.
pub fn errors(method: Method) -> &'static Errors {
    let found = ERRORS.iter().find(|errors| errors.method == method);
    found.expect("the table has a line for every method")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_has_a_line_and_the_default_is_the_last_resort() {
        for method in Method::ALL {
            assert_eq!(errors(method).method, method);
        }
        assert_eq!(ERRORS.len(), Method::ALL.len());
        let last = ERRORS[ERRORS.len() - 1];
        assert_eq!(last.method, Method::default());
        for over in [Over::WideNodes, Over::SkipArray, Over::Other] {
            assert!(last.pays(over, usize::MAX, f64::INFINITY), "{over:?}");
        }
    }
}
