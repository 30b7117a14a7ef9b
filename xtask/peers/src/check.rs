//! Whether two ways find the same.

use rt_kernels::Ray;
use serde::{Deserialize, Serialize};

use crate::peers::Hit;

/// Of all distances and coordinates of a ray, how far apart two hits are that differ by rounding.
const ROUNDING: f32 = 1e-5;

/// How many rays one way judges otherwise than another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Differences {
    /// It finds nothing where the other does.
    pub(crate) missed: usize,
    /// It finds something where the other does not.
    pub(crate) extra: usize,
    /// It finds another triangle, and not one at the same distance.
    pub(crate) other: usize,
    /// It finds the same triangle at another distance.
    pub(crate) moved: usize,
}

impl Differences {
    /// Compares what two ways found.
    pub(crate) fn between(rays: &[Ray], found: &[Option<Hit>], other: &[Option<Hit>]) -> Self {
        let mut differences = Differences::default();
        for ((ray, found), other) in rays.iter().zip(found).zip(other) {
            match (found, other) {
                (None, None) => {}
                (None, Some(_)) => differences.missed += 1,
                (Some(_), None) => differences.extra += 1,
                (Some(a), Some(b)) => {
                    let length = ray.dir.length();
                    let scale = a.t.max(b.t) * length + ray.origin.abs().max_element();
                    if (a.t - b.t).abs() * length <= ROUNDING * scale {
                        continue;
                    }
                    let count = if a.prim == b.prim {
                        &mut differences.moved
                    } else {
                        &mut differences.other
                    };
                    *count += 1;
                }
            }
        }
        differences
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn each_difference_is_counted_by_its_kind() {
        let ray = Ray::new(Vec3::X, Vec3::Z);
        let hit = |t, prim| Some(Hit { t, prim });
        let found = [None, None, hit(1.0, 0), hit(1.0, 0), hit(1.0, 0), hit(1.0, 0)];
        let other = [None, hit(1.0, 0), None, hit(2.0, 1), hit(2.0, 0), hit(1.000_001, 1)];
        let differences = Differences::between(&[ray; 6], &found, &other);
        assert_eq!(differences, Differences { missed: 1, extra: 1, other: 1, moved: 1 });
    }
}
