//! What the procedures put their primitives on.

use glam::{DVec3, Vec3};

use super::white_light;
use crate::model::{Cone, Light, Mesh, Scene, Sphere, Triangle, View};
use crate::nff::{Surface, Surfaces};
use crate::triangulate::Triangulator;

/// What is behind nearly all the databases' scenes.
const SKY: Vec3 = Vec3::new(0.078, 0.361, 0.753);

/// A scene in the making. What is added comes out as if it had been read from the database's file.
pub(super) struct Stage {
    scene: Scene,
    surface: Option<Surface>,
    surfaces: Surfaces,
    triangulator: Triangulator,
}

/// From here to there with z up, 45 degrees wide, 512 pixels square.
pub(super) fn view(eye: [f32; 3], target: [f32; 3]) -> View {
    let (eye, target) = (Vec3::from_array(eye), Vec3::from_array(target));
    View { eye, target, up: Vec3::Z, fov_y: 45.0, size: Some((512, 512)) }
}

impl Stage {
    /// With lights of which only the places are stated.
    pub(super) fn new(view: View, lights: &[[f32; 3]]) -> Stage {
        let color = white_light(lights.len());
        let light = |&position: &[f32; 3]| Light { position: position.into(), color };
        let scene = Scene {
            lights: lights.iter().map(light).collect(),
            background: Some(SKY),
            view: Some(view),
            ..Scene::default()
        };
        Stage {
            scene,
            surface: None,
            surfaces: Surfaces::default(),
            triangulator: Triangulator::default(),
        }
    }

    /// What is seen where there is nothing, if it is not the sky.
    pub(super) fn background(&mut self, color: [f32; 3]) {
        self.scene.background = Some(color.into());
    }

    /// What follows has this surface.
    pub(super) fn surface(&mut self, surface: Surface) {
        self.surface = Some(surface);
    }

    pub(super) fn sphere(&mut self, center: DVec3, radius: f64) {
        let material = self.material("sphere");
        let (center, radius) = (center.as_vec3(), radius as f32);
        self.scene.spheres.push(Sphere { center, radius, material });
    }

    pub(super) fn cone(&mut self, base: DVec3, base_radius: f64, apex: DVec3, apex_radius: f64) {
        let material = self.material(if base_radius == apex_radius { "cylinder" } else { "cone" });
        self.scene.cones.push(Cone {
            base: base.as_vec3(),
            base_radius: base_radius as f32,
            apex: apex.as_vec3(),
            apex_radius: apex_radius as f32,
            material,
        });
    }

    pub(super) fn polygon(&mut self, corners: &[DVec3]) {
        let material = self.material("polygon");
        let Mesh { positions, triangles, .. } = &mut self.scene.mesh;
        let first = positions.len();
        positions.extend(corners.iter().map(|corner| corner.as_vec3()));
        let cut = self.triangulator.polygon(&positions[first..]);
        triangles.extend(cut.iter().map(|corners| Triangle {
            position: corners.map(|corner| first as u32 + corner),
            normal: None,
            uv: None,
            material,
        }));
    }

    /// A triangle whose corners have normals.
    pub(super) fn patch(&mut self, corners: [(DVec3, DVec3); 3]) {
        let material = self.material("patch");
        let Mesh { positions, normals, triangles, .. } = &mut self.scene.mesh;
        let [position, normal] =
            [positions.len(), normals.len()].map(|first| [0, 1, 2].map(|nth| first as u32 + nth));
        positions.extend(corners.map(|(position, _)| position.as_vec3()));
        normals.extend(corners.map(|(_, normal)| normal.as_vec3()));
        triangles.push(Triangle { position, normal: Some(normal), uv: None, material });
    }

    /// A horizontal square about the z axis.
    pub(super) fn ground(&mut self, half: f64, z: f64) {
        let corner = |[x, y]: [f64; 2]| DVec3::new(x * half, y * half, z);
        self.polygon(&[[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(corner));
    }

    /// The material of what is added now.
    fn material(&mut self, kind: &'static str) -> u32 {
        *self.scene.facts.stated.entry(kind).or_default() += 1;
        self.surfaces.index(&mut self.scene.materials, self.surface)
    }

    pub(super) fn finish(self) -> Scene {
        self.scene
    }
}
