//! Surfaces of the second order.

use glam::{Mat3, Vec3};

use super::{Cone, Sphere};

/// The points x with (x − center) · M (x − center) = level, M symmetric, cut off between two
/// planes: spheres, ellipsoids, cylinders, cones, and what is bent like a saddle. Rays hit it from
/// both sides. It has no caps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadric {
    /// The centre of symmetry, in world space; of a cone its apex.
    pub center: Vec3,
    /// M: xx, yy, zz, yz, zx, xy.
    pub matrix: [f32; 6],
    /// What the form is equal to on the surface: with a matrix of unit scale the square of a
    /// radius; 0 for a cone.
    pub level: f32,
    /// What points are measured along to cut off the surface; of any length.
    pub axis: Vec3,
    /// The least and the greatest of `axis · (x − center)`, both of which belong to the surface.
    pub range: [f32; 2],
}

/// The whole surface.
const EVERYWHERE: (Vec3, [f32; 2]) = (Vec3::ZERO, [0.0; 2]);

impl Quadric {
    /// An ellipsoid, whose half axes are the lengths of what the unit vectors are multiplied by.
    pub fn ellipsoid(center: Vec3, half_axes: Vec3) -> Quadric {
        let [x, y, z] = half_axes.as_dvec3().to_array().map(|half| (1.0 / (half * half)) as f32);
        let (axis, range) = EVERYWHERE;
        Quadric { center, matrix: [x, y, z, 0.0, 0.0, 0.0], level: 1.0, axis, range }
    }

    /// A cylinder of this radius about an axis through `center`, from −`half` to `half` along it.
    pub fn cylinder(center: Vec3, axis: Vec3, radius: f32, half: f32) -> Quadric {
        let axis = axis.as_dvec3().normalize();
        let matrix = across(axis, 1.0);
        let level = radius * radius;
        Quadric { center, matrix, level, axis: axis.as_vec3(), range: [-half, half] }
    }

    /// A cone with this apex, which is `slope` times as wide as it is far from the apex, from 0 to
    /// `height` along the axis.
    pub fn cone(apex: Vec3, axis: Vec3, slope: f32, height: f32) -> Quadric {
        let axis = axis.as_dvec3().normalize();
        let slope = f64::from(slope);
        let matrix = across(axis, 1.0 + slope * slope);
        Quadric { center: apex, matrix, level: 0.0, axis: axis.as_vec3(), range: [0.0, height] }
    }

    /// M as a matrix.
    pub fn matrix(&self) -> Mat3 {
        let [xx, yy, zz, yz, zx, xy] = self.matrix;
        Mat3::from_cols_array(&[xx, xy, zx, xy, yy, yz, zx, yz, zz])
    }
}

impl From<Sphere> for Quadric {
    /// With the square of the radius rounded.
    fn from(Sphere { center, radius }: Sphere) -> Quadric {
        let (axis, range) = EVERYWHERE;
        Quadric {
            center,
            matrix: [1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
            level: radius * radius,
            axis,
            range,
        }
    }
}

/// The square of the distance from an axis, less some of that along it: 1 − `share` · a aᵀ.
fn across(axis: glam::DVec3, share: f64) -> [f32; 6] {
    let glam::DVec3 { x, y, z } = axis;
    [
        1.0 - share * x * x,
        1.0 - share * y * y,
        1.0 - share * z * z,
        -share * y * z,
        -share * z * x,
        -share * x * y,
    ]
    .map(|number| number as f32)
}

/// A surface that stays curved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curved {
    /// A whole sphere.
    Sphere(Sphere),
    /// Anything of the second order.
    Quadric(Quadric),
    /// The mantle of a truncated cone, or a cylinder.
    Cone(Cone),
}
