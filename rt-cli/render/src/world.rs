//! A scene made ready to trace.

use std::fmt::{self, Write};
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::Vec3;
use rt_kernels::geom::{Aabb, Cone, Sphere, Triangle};
use rt_kernels::tri::Method;
use rt_kernels::{Accelerator, Brute, BuildError, Bvh, Exec, KdBuilder, KdPlan, KdTree};
use rt_kernels::{Mailbox, Plan, Primitives};
use rt_scene::{Scene, Texture};

use crate::exec::{RayonJoin, on_threads};
use crate::job::RenderError;
use crate::shade::{Finish, Point, Shader, Textured};

/// What finds the hits. The picture does not depend on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AccelKind {
    /// A bounding volume hierarchy.
    #[default]
    Bvh,
    /// A kd-tree.
    Kd {
        /// How it is built.
        builder: KdBuilder,
        /// What keeps rays from being tested twice.
        mailbox: Mailbox,
    },
    /// Every ray against every primitive: for small scenes, as the yardstick.
    Brute,
}

impl AccelKind {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            AccelKind::Bvh => "bvh",
            AccelKind::Kd { .. } => "kd",
            AccelKind::Brute => "brute",
        }
    }
}

/// A scene and its acceleration structure.
pub struct World {
    /// The scene, with all coordinates multiplied by `scale`.
    pub(crate) scene: Scene,
    /// One for each material.
    shaders: Vec<Box<dyn Shader>>,
    pub(crate) accel: Box<dyn Accelerator>,
    /// The power of two that brings the coordinates into the range of the kernels.
    pub(crate) scale: f32,
    kind: AccelKind,
    plan: Plan,
    bounds: Aabb,
    has_one_sided: bool,
    build_time: Duration,
}

impl World {
    /// Builds the acceleration structure, on that many threads.
    ///
    /// # Errors
    /// If the scene is empty, or the kernels refuse it.
    ///
    /// # Panics
    /// If a material names a texture that is not there.
    pub fn build(scene: Scene, kind: AccelKind, threads: usize) -> Result<World, RenderError> {
        World::build_with(scene, kind, Plan::default(), threads)
    }

    /// Builds the acceleration structure by that plan, as far as there is a choice, on that many
    /// threads. Only for the default triangle test is the picture what the scene says to the last
    /// edge.
    ///
    /// # Errors
    /// As [`build`](World::build).
    pub fn build_with(
        mut scene: Scene,
        kind: AccelKind,
        plan: Plan,
        threads: usize,
    ) -> Result<World, RenderError> {
        if scene.mesh.triangles.is_empty() && scene.spheres.is_empty() && scene.cones.is_empty() {
            return Err(RenderError::Empty(scene.name));
        }
        let bounds = bounds(&scene);
        let scale = range_scale(&bounds);
        for position in &mut scene.mesh.positions {
            *position *= scale;
        }
        for sphere in &mut scene.spheres {
            sphere.center *= scale;
            sphere.radius *= scale;
        }
        for cone in &mut scene.cones {
            cone.base *= scale;
            cone.base_radius *= scale;
            cone.apex *= scale;
            cone.apex_radius *= scale;
        }

        let start = Instant::now();
        let primitives = primitives(&scene);
        let accel = on_threads(threads, || -> Result<Box<dyn Accelerator>, BuildError> {
            Ok(match kind {
                AccelKind::Bvh => Box::new(Bvh::build_with(&primitives, plan, &RayonJoin)?),
                AccelKind::Kd { builder, mailbox } => {
                    let plan = KdPlan { builder, mailbox, method: plan.method };
                    Box::new(KdTree::build_with(&primitives, plan, &RayonJoin)?)
                }
                AccelKind::Brute => Box::new(Brute::build_with(&primitives, plan.method)?),
            })
        })??;
        let build_time = start.elapsed();
        let has_one_sided = scene.materials.iter().any(is_one_sided);
        let textures = &scene.textures;
        let shaders = scene.materials.iter().map(|material| shader(material, textures)).collect();
        Ok(World { scene, shaders, accel, scale, kind, plan, bounds, has_one_sided, build_time })
    }

    /// What the scene is called.
    pub fn name(&self) -> &str {
        &self.scene.name
    }

    /// Puts another shader in place of a material's.
    ///
    /// # Panics
    /// If there is no material of that number.
    pub fn set_shader(&mut self, material: usize, shader: impl Shader + 'static) {
        self.shaders[material] = Box::new(shader);
    }

    /// What a surface is like at a point.
    pub(crate) fn finish(&self, point: &Point) -> Finish {
        let finish = self.shader(point).finish(point);
        let own = finish.normal == Vec3::ZERO;
        Finish { normal: if own { point.normal } else { finish.normal }, ..finish }
    }

    /// The shader of the material at a point.
    pub(crate) fn shader(&self, point: &Point) -> &dyn Shader {
        &*self.shaders[point.material as usize]
    }

    /// Whether there are surfaces whose backs nobody sees.
    pub(crate) fn has_one_sided(&self) -> bool {
        self.has_one_sided
    }

    /// Whether nobody sees the backs of a material.
    pub(crate) fn is_one_sided(&self, material: u32) -> bool {
        is_one_sided(&self.scene.materials[material as usize])
    }

    /// What finds the hits.
    pub fn accel_kind(&self) -> AccelKind {
        self.kind
    }

    /// The name of what built it; `None` where nothing is built.
    pub fn builder(&self) -> Option<&'static str> {
        match self.kind {
            AccelKind::Bvh => Some(self.plan.builder.name()),
            AccelKind::Kd { builder, .. } => Some(builder.name()),
            AccelKind::Brute => None,
        }
    }

    /// By what plan a hierarchy of its scene is built.
    pub fn plan(&self) -> Plan {
        self.plan
    }

    /// How the acceleration structure lies in memory.
    pub fn layout(&self) -> &'static str {
        match self.kind {
            AccelKind::Bvh => self.plan.layout().name(),
            AccelKind::Kd { .. } => "pairs",
            AccelKind::Brute => "list",
        }
    }

    /// The triangle test.
    pub fn method(&self) -> Method {
        self.plan.method
    }

    /// What a choice of level and packets comes to in it.
    pub fn exec(&self, asked: Exec) -> Exec {
        self.accel.exec(asked)
    }

    /// The box around all primitives, in the units of the scene.
    pub fn bounds(&self) -> &Aabb {
        &self.bounds
    }

    /// The number of triangles.
    pub fn triangles(&self) -> usize {
        self.scene.mesh.triangles.len()
    }

    /// The number of spheres.
    pub fn spheres(&self) -> usize {
        self.scene.spheres.len()
    }

    /// The number of cones and cylinders.
    pub fn cones(&self) -> usize {
        self.scene.cones.len()
    }

    /// The time that it took to build the acceleration structure.
    pub fn build_time(&self) -> Duration {
        self.build_time
    }

    /// The memory of the scene: geometry, materials, textures and lights.
    pub fn scene_bytes(&self) -> usize {
        let (scene, mesh) = (&self.scene, &self.scene.mesh);
        size_of_val(&*mesh.positions)
            + size_of_val(&*mesh.normals)
            + size_of_val(&*mesh.uvs)
            + size_of_val(&*mesh.triangles)
            + size_of_val(&*scene.spheres)
            + size_of_val(&*scene.cones)
            + size_of_val(&*scene.materials)
            + size_of_val(&*scene.lights)
            + scene.textures.iter().map(|texture| size_of_val(texture.pixels())).sum::<usize>()
    }

    /// The memory of the acceleration structure and its copy of the primitives.
    pub fn accel_bytes(&self) -> usize {
        self.accel.bytes()
    }

    /// A number that differs, but for chance, if anything of the scene differs that a picture may
    /// depend on: its geometry and materials, as stated.
    pub fn fingerprint(&self) -> u64 {
        let Scene {
            mesh,
            spheres,
            cones,
            materials,
            textures,
            name: _,
            // These are the job's.
            lights: _,
            background: _,
            view: _,
            facts: _,
        } = &self.scene;
        let mut hash = Fnv(0xCBF2_9CE4_8422_2325);
        let what = (mesh, spheres, cones, materials, self.scale);
        write!(hash, "{what:?}").expect("a number takes any text");
        textures.iter().for_each(|texture| hash.take(texture.pixels().as_flattened()));
        hash.0
    }

    /// The corners of a triangle.
    pub(crate) fn corners(&self, triangle: &rt_scene::Triangle) -> [Vec3; 3] {
        corners(&self.scene, triangle)
    }
}

/// FNV-1a of a text, or of any bytes.
struct Fnv(u64);

impl Fnv {
    fn take(&mut self, bytes: &[u8]) {
        self.0 = bytes
            .iter()
            .fold(self.0, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3));
    }
}

impl Write for Fnv {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.take(text.as_bytes());
        Ok(())
    }
}

/// What is transparent has two sides: light leaves it by the other.
fn is_one_sided(material: &rt_scene::Material) -> bool {
    material.one_sided && material.transmission == Vec3::ZERO
}

/// The built-in shader of a material.
fn shader(material: &rt_scene::Material, textures: &[Arc<Texture>]) -> Box<dyn Shader> {
    match material.diffuse_map {
        Some(map) => Box::new(Textured::new(material, map, textures[map.texture as usize].clone())),
        None => Box::new(material.clone()),
    }
}

/// The corners of a triangle.
pub(crate) fn corners(scene: &Scene, triangle: &rt_scene::Triangle) -> [Vec3; 3] {
    triangle.position.map(|i| scene.mesh.positions[i as usize])
}

/// What the kernels trace of a scene.
pub(crate) fn primitives(scene: &Scene) -> Primitives {
    let flat = |triangle| Triangle { corners: corners(scene, triangle) };
    let cone = |cone: &rt_scene::Cone| Cone {
        base: cone.base,
        base_radius: cone.base_radius,
        apex: cone.apex,
        apex_radius: cone.apex_radius,
    };
    let sphere =
        |sphere: &rt_scene::Sphere| Sphere { center: sphere.center, radius: sphere.radius };
    Primitives {
        triangles: scene.mesh.triangles.iter().map(flat).collect(),
        spheres: scene.spheres.iter().map(sphere).collect(),
        cones: scene.cones.iter().map(cone).collect(),
    }
}

/// The box around all that can be seen: that of nothing if there is nothing.
pub fn bounds(scene: &Scene) -> Aabb {
    let mesh = &scene.mesh;
    let corners = mesh.triangles.iter().flat_map(|triangle| triangle.position);
    let points = corners.map(|i| mesh.positions[i as usize]);
    let flat = points.fold(Aabb::EMPTY, |all, point| all.union(&Aabb::point(point)));
    let round = scene.spheres.iter().fold(flat, |all, sphere| {
        let r = Vec3::splat(sphere.radius);
        all.union(&Aabb::new(sphere.center - r, sphere.center + r))
    });
    scene
        .cones
        .iter()
        .map(rt_scene::Cone::bounds)
        .fold(round, |all, (low, high)| all.union(&Aabb::new(low, high)))
}

/// The power of two that brings the greatest coordinate near 1, if it is not within 2^±20 already:
/// then no product of the kernels overflows or vanishes. It changes no bit of any mantissa.
fn range_scale(bounds: &Aabb) -> f32 {
    let greatest = bounds.axes.as_flattened().iter().fold(0.0, |max: f32, x| max.max(x.abs()));
    if greatest == 0.0 || (1.0 / (1 << 20) as f32..=(1 << 20) as f32).contains(&greatest) {
        return 1.0;
    }
    // Subnormal coordinates would need a factor beyond the largest: they are brought as near as
    // one factor can.
    let exponent = (greatest.to_bits() >> 23) as i32 - 127;
    f32::from_bits(((127 - exponent).clamp(1, 254) as u32) << 23)
}
