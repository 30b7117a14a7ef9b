//! Where a ray meets a primitive.

/// The closest hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The distance along the ray, in units of the direction's length: at least the entry into the
    /// primitive's own box.
    pub t: f32,
    /// The primitive: triangles are numbered first, then spheres.
    pub prim: u32,
    /// On a triangle, the weight of its second corner; 0 on a sphere.
    pub u: f32,
    /// On a triangle, the weight of its third corner; 0 on a sphere.
    pub v: f32,
}
