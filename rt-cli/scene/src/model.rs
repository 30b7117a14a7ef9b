//! The scene as data.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3};

use crate::texture::Texture;

/// Everything a renderer needs to know of a scene. Coordinates are in world space, right-handed,
/// in the units of the file.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// What the scene was opened as: a file's name without its folders, or `spd:NAME:SIZE`.
    pub name: String,
    /// All triangles, from whatever kind of flat primitive they came.
    pub mesh: Mesh,
    /// Spheres: they stay such until someone [tessellates](crate::tessellate()) them.
    pub spheres: Vec<Sphere>,
    /// Cones and cylinders: likewise.
    pub cones: Vec<Cone>,
    /// The materials that all these index. Never empty in a scene that was opened.
    pub materials: Vec<Material>,
    /// The pictures that materials name.
    pub textures: Vec<Arc<Texture>>,
    /// Point lights. Empty where the file states none.
    pub lights: Vec<Light>,
    /// The colour of rays that hit nothing, linear, if the file states one.
    pub background: Option<Vec3>,
    /// The camera, if the file states one.
    pub view: Option<View>,
    /// What the reader counted, skipped and warns of.
    pub facts: Facts,
}

impl Scene {
    /// The least and the greatest coordinates of all that is there; none if there is nothing.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let points = self.mesh.positions.iter().map(|&point| (point, point));
        let spheres = self.spheres.iter().map(|sphere| {
            let radius = Vec3::splat(sphere.radius);
            (sphere.center - radius, sphere.center + radius)
        });
        let cones = self.cones.iter().map(Cone::bounds);
        points.chain(spheres).chain(cones).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    /// Leaves out all textures: materials are of the colours that they state.
    pub fn remove_textures(&mut self) {
        self.textures.clear();
        self.materials.iter_mut().for_each(|material| material.diffuse_map = None);
    }

    /// What every reader does last: looks the scene over.
    pub(crate) fn finish(&mut self) {
        if self.materials.is_empty() {
            self.materials.push(Material::default());
        }
        let flat = self.mesh.triangles.iter().filter(|triangle| self.mesh.area(triangle) == 0.0);
        let flat = flat.count();
        match flat {
            0 => {}
            1 => self.facts.warnings.push("1 triangle has no area".to_owned()),
            count => {
                let warning = format!("{count} triangles have no area");
                self.facts.warnings.push(warning);
            }
        }
    }
}

/// Triangles with shared vertices.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Vertex positions; every component is finite.
    pub positions: Vec<Vec3>,
    /// Vertex normals, as stated (not necessarily of unit length); every component is finite.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, v upwards; every component is finite.
    pub uvs: Vec<Vec2>,
    /// The triangles. Some may have no area.
    pub triangles: Vec<Triangle>,
}

impl Mesh {
    /// A triangle's area, in double precision: it vanishes only if the corners are on a line.
    fn area(&self, triangle: &Triangle) -> f64 {
        let [a, b, c] = triangle.position.map(|index| self.positions[index as usize].as_dvec3());
        (b - a).cross(c - a).length() / 2.0
    }
}

/// Three corners, counterclockwise seen from the front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Indices into [`Mesh::positions`].
    pub position: [u32; 3],
    /// Indices into [`Mesh::normals`], where the file gives normals.
    pub normal: Option<[u32; 3]>,
    /// Indices into [`Mesh::uvs`], where the file gives texture coordinates.
    pub uv: Option<[u32; 3]>,
    /// Index into [`Scene::materials`].
    pub material: u32,
}

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre; finite.
    pub center: Vec3,
    /// Radius; finite and greater than zero.
    pub radius: f32,
    /// Index into [`Scene::materials`].
    pub material: u32,
}

/// The mantle of a truncated cone, or of a cylinder if the radii are equal; it has no caps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The centre of one end; finite.
    pub base: Vec3,
    /// The radius there; finite and at least zero.
    pub base_radius: f32,
    /// The centre of the other end; finite, and not the base.
    pub apex: Vec3,
    /// The radius there; finite and at least zero, but not both are zero.
    pub apex_radius: f32,
    /// Index into [`Scene::materials`].
    pub material: u32,
}

impl Cone {
    /// The least and the greatest coordinates.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let axis = (self.apex.as_dvec3() - self.base.as_dvec3()).normalize();
        // How far a circle of radius 1 about the axis reaches along each coordinate.
        let reach = (DVec3::ONE - axis * axis).max(DVec3::ZERO).map(f64::sqrt).as_vec3();
        let (base, apex) = (reach * self.base_radius, reach * self.apex_radius);
        ((self.base - base).min(self.apex - apex), (self.base + base).max(self.apex + apex))
    }
}

/// Phong's reflection model, in linear colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name in the file; empty where it has none.
    pub name: String,
    /// Diffuse reflectance.
    pub diffuse: Vec3,
    /// The picture that multiplies it.
    pub diffuse_map: Option<ColorMap>,
    /// Specular reflectance: the strength of highlights.
    pub specular: Vec3,
    /// The cosine exponent of highlights.
    pub shininess: f32,
    /// What a mirror-reflected ray contributes. Zero: no ray is sent.
    pub mirror: Vec3,
    /// What a ray that goes through contributes. Zero: the material is opaque.
    pub transmission: Vec3,
    /// The index of refraction: of light within it, by that outside; 1 bends nothing.
    pub ior: f32,
    /// Whether reflection and transmission depend on the angle, by Fresnel's equations.
    pub fresnel: bool,
    /// Light that the surface itself gives off.
    pub emission: Vec3,
    /// Whether nobody sees its back, by what is opaque: rays that meet it go on. It casts shadows all
    /// the same.
    pub one_sided: bool,
}

impl Material {
    /// What stands for both highlights and mirror reflections, in formats that have one colour for them.
    pub(crate) fn reflected(&self) -> Vec3 {
        if self.mirror == Vec3::ZERO { self.specular } else { self.mirror }
    }
}

impl Default for Material {
    /// Light grey, matt.
    fn default() -> Self {
        Material {
            name: String::new(),
            diffuse: Vec3::splat(0.8),
            diffuse_map: None,
            specular: Vec3::ZERO,
            shininess: 1.0,
            mirror: Vec3::ZERO,
            transmission: Vec3::ZERO,
            ior: 1.0,
            fresnel: false,
            emission: Vec3::ZERO,
            one_sided: false,
        }
    }
}

/// How many materials are no longer the same, but for their names, when a format has held them.
pub(crate) fn changed(materials: &[Material], held: impl Fn(&Material) -> Material) -> usize {
    let same = |old: &&Material| Material { name: old.name.clone(), ..held(old) } == **old;
    materials.len() - materials.iter().filter(same).count()
}

/// How a picture lies on a surface: repeated without end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorMap {
    /// Index into [`Scene::textures`].
    pub texture: u32,
    /// What texture coordinates are multiplied by.
    pub scale: Vec2,
    /// What is added to them then.
    pub offset: Vec2,
}

/// A point light without attenuation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it is.
    pub position: Vec3,
    /// Its colour times its intensity, linear.
    pub color: Vec3,
}

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The centre of projection.
    pub eye: Vec3,
    /// The point in the middle of the picture.
    pub target: Vec3,
    /// The direction that is up in the picture; need not be of unit length, nor perpendicular to
    /// the line of sight.
    pub up: Vec3,
    /// The full vertical angle of view, in degrees.
    pub fov_y: f32,
    /// The picture's width and height in pixels, where the file states them.
    pub size: Option<(u32, u32)>,
}

/// What a reader found, for `rt info` and for warnings.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// How many primitives of each kind the file states (`polygon`, `sphere`, …), before anything
    /// is triangulated.
    pub stated: BTreeMap<&'static str, u64>,
    /// What was left out of the scene.
    pub skipped: Vec<Skipped>,
    /// What a user should know, one sentence each, with the place where it applies.
    pub warnings: Vec<String>,
    /// Those of the warnings that are of a file that the scene names and that cannot be read.
    pub missing: Vec<String>,
}

/// Statements that a reader left out, all for one reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// The kind of statement, for example `l` or `face`.
    pub what: String,
    /// Why it was left out.
    pub why: String,
    /// How many there were.
    pub count: u64,
}
