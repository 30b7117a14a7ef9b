//! Phong's reflection model.

use glam::Vec3;
use rt_scene::Material;

/// The light that a surface sends back to where a ray came from, of a light of intensity 1: per
/// colour, for unit vectors `normal`, `to_light` and the ray's direction `dir`.
///
/// Source: Phong 1975.
pub(crate) fn phong(material: &Material, normal: Vec3, to_light: Vec3, dir: Vec3) -> Vec3 {
    let cosine = normal.dot(to_light);
    if cosine <= 0.0 {
        return Vec3::ZERO;
    }
    let diffuse = material.diffuse * cosine;
    if material.specular == Vec3::ZERO {
        return diffuse;
    }
    let reflected = normal * (2.0 * cosine) - to_light;
    let highlight = (-dir).dot(reflected).max(0.0);
    diffuse + material.specular * libm::powf(highlight, material.shininess)
}
