//! What the format's `fm` means.

use glam::Vec3;

use crate::model::{Material, Scene};
use crate::nff::grey;

/// The numbers of `fm`: ambient, diffuse and specular colour, shine, transmittance, index of
/// refraction.
pub(super) type Surface = [f32; 12];

pub(super) fn material(surface: Surface) -> Material {
    let [_, _, _, r, g, b, sr, sg, sb, shininess, clear, ior] = surface;
    let specular = Vec3::new(sr, sg, sb);
    Material {
        diffuse: Vec3::new(r, g, b),
        specular,
        shininess,
        mirror: specular.max(Vec3::ZERO),
        transmission: Vec3::splat(clear.max(0.0)),
        ior: if ior > 0.0 { ior } else { 1.0 },
        ..Material::default()
    }
}

/// What stands for a material. Of ambient light it gives back nothing: so it looks the same to
/// programs that draw such light.
pub(super) fn surface(material: &Material) -> Surface {
    let Vec3 { x: r, y: g, z: b } = material.diffuse;
    let Vec3 { x: sr, y: sg, z: sb } = material.reflected();
    let (shine, clear, ior) = (material.shininess, grey(material.transmission), material.ior);
    [0.0, 0.0, 0.0, r, g, b, sr, sg, sb, shine, clear, ior]
}

/// How many materials of a scene are others when they have been written and read back.
pub fn poorer(scene: &Scene) -> usize {
    crate::model::changed(&scene.materials, |old| material(surface(old)))
}
