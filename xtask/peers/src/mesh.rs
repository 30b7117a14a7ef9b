//! The scenes: triangles, a camera and a light.

use std::path::{Path, PathBuf};

use glam::Vec3;
use rt_kernels::reference::mesh::Mesh as Ball;
use rt_render::fitted_view;
use rt_scene::{SPD_RESOLUTION, View, tessellate};

/// What is measured without `--scenes`.
pub(crate) const ALL: [&str; 6] = ["balls", "rings", "tree", "bunny", "dragon", "conference"];

/// What is measured if time is short.
pub(crate) const QUICK: [&str; 4] = ["balls", "tree", "bunny", "conference"];

/// Those of them that are computed.
const COMPUTED: [&str; 3] = ["balls", "rings", "tree"];

/// Where the files are, from the root of the repository.
pub(crate) const FOLDER: &str = "../shared/scenes/obj";

/// Views of scenes whose files have none, and which are not to be seen from the front.
const VIEWS: [(&str, View, Vec3); 1] = [(
    "conference",
    View {
        eye: Vec3::new(900.0, 300.0, 400.0),
        target: Vec3::new(-200.0, 150.0, -400.0),
        up: Vec3::Y,
        fov_y: 60.0,
        size: None,
    },
    Vec3::new(300.0, 600.0, -200.0),
)];

/// Triangles, and what is seen of them.
pub(crate) struct Mesh {
    pub(crate) name: String,
    pub(crate) vertices: Vec<[f32; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) view: View,
    pub(crate) light: Vec3,
}

impl Mesh {
    /// Opens a scene by its name in [`ALL`], as a file, or as `spd:NAME`. What is
    /// curved is tessellated.
    pub(crate) fn open(name: &str) -> Result<Mesh, String> {
        let path = match name {
            _ if COMPUTED.contains(&name) => PathBuf::from(format!("spd:{name}")),
            _ if ALL.contains(&name) => file(name),
            _ => PathBuf::from(name),
        };
        let scene = rt_scene::open(&path).and_then(|scene| tessellate(scene, SPD_RESOLUTION));
        let mut scene = scene.map_err(|error| error.to_string())?;
        let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
        let name = stem.trim_start_matches("spd:").to_owned();
        let bounds = rt_render::bounds(&scene);
        let known = VIEWS.iter().find(|(known, ..)| *known == name);
        let view = scene.view.take().or(known.map(|(_, view, _)| *view));
        let view = view.unwrap_or_else(|| fitted_view(&bounds, (512, 512), Vec3::Y, 45.0));
        let stated = scene.lights.first().map(|light| light.position);
        let light = stated.or(known.map(|(.., light)| *light)).unwrap_or_else(|| beside(&view));
        let triangles: Vec<_> = scene.mesh.triangles.iter().map(|t| t.position).collect();
        if triangles.is_empty() {
            return Err(format!("{name} has no triangles"));
        }
        let vertices = scene.mesh.positions.iter().map(|point| point.to_array()).collect();
        Ok(Mesh { name, vertices, triangles, view, light })
    }

    /// A ball about the origin, seen from a distance and lit from above.
    pub(crate) fn of(ball: &Ball) -> Mesh {
        let (eye, target, up) = (Vec3::Z * 3.0, Vec3::ZERO, Vec3::Y);
        Mesh {
            name: "ball".to_owned(),
            vertices: ball.vertices.iter().map(Vec3::to_array).collect(),
            triangles: ball.faces.clone(),
            view: View { eye, target, up, fov_y: 45.0, size: None },
            light: Vec3::Y * 5.0,
        }
    }

    /// The corners of a triangle.
    pub(crate) fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|i| self.vertices[i as usize].into())
    }
}

/// Where a scene of [`ALL`] is that is a file.
fn file(name: &str) -> PathBuf {
    Path::new(FOLDER).join(name).with_extension("obj")
}

/// Whether a scene of [`ALL`] is a file that is not there.
pub(crate) fn is_missing(name: &str) -> bool {
    ALL.contains(&name) && !COMPUTED.contains(&name) && !file(name).exists()
}

/// A light for scenes without one: over the right shoulder.
fn beside(view: &View) -> Vec3 {
    let back = view.eye - view.target;
    let right = view.up.cross(back).normalize_or(Vec3::X);
    let up = back.cross(right).normalize_or(Vec3::Y);
    view.eye + (right + up) * back.length() * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_curved_comes_as_triangles() {
        let mesh = Mesh::open("spd:balls:1").expect("a scene");
        // Ten spheres and the floor.
        assert_eq!((&*mesh.name, mesh.triangles.len()), ("balls:1", 10 * 192 + 2));
        assert!(mesh.triangles.as_flattened().iter().all(|&i| (i as usize) < mesh.vertices.len()));
    }

    #[test]
    fn a_scene_without_a_light_is_lit_over_the_right_shoulder() {
        let (eye, target, up) = (Vec3::Z * 4.0, Vec3::ZERO, Vec3::Y);
        let light = beside(&View { eye, target, up, fov_y: 45.0, size: None });
        assert!((light - Vec3::new(2.0, 2.0, 4.0)).length() < 1e-6, "{light}");
    }

    #[test]
    fn only_named_files_may_be_missing() {
        assert!(!is_missing("balls") && !is_missing("nowhere.obj"));
        assert_eq!(is_missing("bunny"), !Path::new(FOLDER).join("bunny.obj").exists());
    }
}
