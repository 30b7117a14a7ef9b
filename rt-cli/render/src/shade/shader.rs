//! What a surface is like: the trait that is open to anyone, and its built-in implementations.

use glam::{Vec2, Vec3};
use rt_scene::Material;

/// Says what a surface is like, point by point.
///
/// A [`World`](crate::World) has one for each material. [`Material`] is the plain one: the same
/// everywhere. One's own is put in place by [`World::set_shader`](crate::World::set_shader), and no
/// code of this crate need know of it:
///
/// ```
/// use glam::Vec3;
/// use rt_render::{AccelKind, Finish, Point, Shader, World};
///
/// /// Squares of two colours, on whatever it is put.
/// struct Checkers([Vec3; 2]);
///
/// impl Shader for Checkers {
///     fn finish(&self, at: &Point) -> Finish {
///         let square = at.position.floor().element_sum().rem_euclid(2.0) as usize;
///         Finish { diffuse: self.0[square], ..Finish::default() }
///     }
/// }
///
/// /// Light in three steps, as in a comic strip.
/// struct Toon;
///
/// impl Shader for Toon {
///     fn finish(&self, _: &Point) -> Finish {
///         Finish { own_light: true, ..Finish::default() }
///     }
///
///     fn light(&self, _: &Point, finish: &Finish, to_light: Vec3) -> Vec3 {
///         Vec3::splat((finish.normal.dot(to_light) * 3.0).ceil() / 3.0)
///     }
/// }
///
/// let scene = rt_scene::open("spd:tetra:2")?;
/// let mut world = World::build(scene, AccelKind::Bvh, 1)?;
/// world.set_shader(0, Checkers([Vec3::ZERO, Vec3::ONE]));
/// world.set_shader(0, Toon);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// The answer must depend on nothing but the arguments, or pictures differ from run to run; and it
/// must not call functions whose bits differ between machines (`f32::sin` and its like), or they
/// differ between those.
pub trait Shader: Send + Sync {
    /// What the surface is like at a point. Its [`normal`](Finish::normal) may be left zero, for the
    /// point's own.
    fn finish(&self, at: &Point) -> Finish;

    /// The light that the surface sends back to the viewer of a light of intensity 1 in the direction
    /// `to_light`, of unit length, in front of the surface: asked for only where the finish says
    /// [`own_light`](Finish::own_light). Elsewhere it is Phong's model, computed for many points at
    /// once.
    fn light(&self, at: &Point, finish: &Finish, to_light: Vec3) -> Vec3 {
        super::phong(finish, finish.normal, to_light, at.dir)
    }
}

/// A point on a surface that a ray met. All directions have unit length.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Where it is, in the units of the scene.
    pub position: Vec3,
    /// The direction of the ray.
    pub dir: Vec3,
    /// The normal for shading, on the side that the ray came from.
    pub normal: Vec3,
    /// The normal of the true surface, on the side that the ray came from.
    pub true_normal: Vec3,
    /// Texture coordinates, with v upwards; zero where the scene states none.
    pub uv: Vec2,
    /// Whether the ray came from the front: from where a triangle's corners are counterclockwise, or
    /// from outside of a sphere or cone.
    pub front: bool,
    /// Index of the material.
    pub material: u32,
}

/// What a surface is like at a point, in linear colour: Phong's model, and what rays it sends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    /// The normal that light is reflected about, of unit length, on the side that the ray came from; zero for
    /// the [point's own](Point::normal).
    pub normal: Vec3,
    /// Diffuse reflectance.
    pub diffuse: Vec3,
    /// Specular reflectance: the strength of highlights.
    pub specular: Vec3,
    /// The cosine exponent of highlights.
    pub shininess: f32,
    /// What a mirror-reflected ray contributes. Zero: no ray is sent.
    pub mirror: Vec3,
    /// What a ray that goes through contributes. Zero: the surface is opaque.
    pub transmission: Vec3,
    /// The index of refraction: of light behind the front of the surface, by that before it.
    pub ior: f32,
    /// Whether the last but one are shared out by Fresnel's equations.
    pub fresnel: bool,
    /// Light that the surface itself gives off.
    pub emission: Vec3,
    /// Whether [`Shader::light`] is to be asked for the light that is reflected.
    pub own_light: bool,
}

impl Default for Finish {
    /// That of the default [`Material`].
    fn default() -> Finish {
        Finish::from(&Material::default())
    }
}

impl From<&Material> for Finish {
    fn from(material: &Material) -> Finish {
        Finish {
            normal: Vec3::ZERO,
            diffuse: material.diffuse,
            specular: material.specular,
            shininess: material.shininess,
            mirror: material.mirror,
            transmission: material.transmission,
            ior: material.ior,
            fresnel: material.fresnel,
            emission: material.emission,
            own_light: false,
        }
    }
}

/// The same everywhere.
impl Shader for Material {
    fn finish(&self, _: &Point) -> Finish {
        Finish::from(self)
    }
}
