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

impl Hit {
    /// Whether it is before another of the same ray; of equal distances the lower number is.
    #[inline(always)]
    pub(crate) fn wins(&self, other: &Hit) -> bool {
        self.t < other.t || (self.t == other.t && self.prim < other.prim)
    }
}
