//! From the unit world in which families are thought up to the one in which they are tested.

use glam::{DQuat, DVec3, Vec3};
use rt_kernels::Ray;
use rt_kernels::geom::Triangle;
use rt_kernels::reference::aim;
use rt_kernels::reference::random::Random;

use crate::Setting;

/// Where a batch is, how large, how turned, and how its corners and axes are ordered.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    rotation: DQuat,
    /// For each axis of the world, which axis it is of the unit world, and its sign.
    axes: [(usize, f64); 3],
    scale: f64,
    offset: DVec3,
    /// What directions are multiplied by: 1 leaves them as they were aimed, to the last bit.
    pace: f32,
    random: Random,
}

impl Place {
    pub(crate) fn new(setting: &Setting, random: &mut Random) -> Place {
        let first = random.below(3);
        let second = (first + 1 + random.below(2)) % 3;
        let order = [first, second, 3 - first - second];
        Place {
            rotation: random.rotation(),
            axes: order.map(|axis| (axis, random.pick(&[1.0, -1.0]))),
            scale: setting.scale.into(),
            offset: random.direction().as_dvec3() * f64::from(setting.offset),
            pace: random.pick(&[1.0, 1e-3, 1e3]),
            random: Random::new(random.bits()),
        }
    }

    /// The same without a rotation: what is exact in the unit world stays so, if the scale is a
    /// power of two.
    #[must_use]
    pub(crate) fn upright(mut self) -> Place {
        self.rotation = DQuat::IDENTITY;
        self.offset = (self.offset / self.scale).round() * self.scale;
        self.pace = 1.0;
        self
    }

    /// A point of the unit world, rounded once.
    pub(crate) fn point(&self, unit: DVec3) -> Vec3 {
        let turned = self.rotation * unit;
        let point = DVec3::from_array(self.axes.map(|(axis, sign)| turned[axis] * sign));
        (point * self.scale + self.offset).as_vec3()
    }

    /// A triangle of placed corners, in an order of its own.
    pub(crate) fn triangle(&mut self, [a, b, c]: [Vec3; 3]) -> Triangle {
        let orders = [[a, b, c], [b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]];
        Triangle { corners: self.random.pick(&orders) }
    }

    /// The ray from one placed point through another, at this batch's pace.
    pub(crate) fn ray(&self, origin: Vec3, target: Vec3) -> Ray {
        self.paced(aim::at(origin, target))
    }

    /// A ray at this batch's pace.
    pub(crate) fn paced(&self, ray: Ray) -> Ray {
        Ray { dir: ray.dir * self.pace, ..ray }
    }
}
