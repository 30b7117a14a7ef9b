//! What every scene and picture that a reader returns must be, whatever it has read.

use rt_picture::Picture;
use rt_scene::{Error, Scene};

/// Looks for nonsense in what a reader made of random input. An error is as good an answer as any,
/// if it says something.
///
/// # Panics
/// If it finds some.
pub fn check(read: Result<Scene, Error>) {
    let scene = match read {
        Ok(scene) => scene,
        Err(error) => return assert!(!error.to_string().is_empty(), "an error without words"),
    };
    let (mesh, materials) = (&scene.mesh, scene.materials.len());
    let all_in = |indices: &[u32], len| indices.iter().all(|&index| (index as usize) < len);
    for triangle in &mesh.triangles {
        assert!(all_in(&triangle.position, mesh.positions.len()), "no such vertex: {triangle:?}");
        let normals = triangle.normal.unwrap_or_default();
        let no_normals = triangle.normal.is_none();
        assert!(no_normals || all_in(&normals, mesh.normals.len()), "no such normal: {triangle:?}");
        assert!(all_in(&[triangle.material], materials), "no such material: {triangle:?}");
    }
    assert!(mesh.positions.iter().chain(&mesh.normals).all(|v| v.is_finite()), "not finite");
    for sphere in &scene.spheres {
        assert!(all_in(&[sphere.material], materials), "no such material: {sphere:?}");
        let sound = sphere.center.is_finite() && sphere.radius.is_finite() && sphere.radius > 0.0;
        assert!(sound, "no sphere: {sphere:?}");
    }
    for cone in &scene.cones {
        assert!(all_in(&[cone.material], materials), "no such material: {cone:?}");
        let (ends, radii) = ([cone.base, cone.apex], [cone.base_radius, cone.apex_radius]);
        let finite = ends.iter().all(|end| end.is_finite()) && radii.iter().all(|r| r.is_finite());
        let sound = ends[0] != ends[1] && radii.iter().all(|&r| r >= 0.0) && radii != [0.0; 2];
        assert!(finite && sound, "no cone: {cone:?}");
    }
}

/// Looks for nonsense in what a reader made of random input, likewise.
///
/// # Panics
/// If it finds some.
pub fn check_picture(read: Result<Picture, rt_picture::Error>) {
    match read {
        Ok(picture) => {
            let size = picture.width as usize * picture.height as usize;
            assert!(size > 0 && picture.pixels.len() == size, "pixels are missing");
        }
        Err(error) => {
            let words = error.to_string();
            assert!(!words.is_empty() && words.len() < 500, "an error without words, or too many");
        }
    }
}
