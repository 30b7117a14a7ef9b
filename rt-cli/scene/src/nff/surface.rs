//! What the format's `f` means.

use std::collections::HashMap;

use glam::Vec3;

use crate::model::{Material, Scene};

/// The numbers of `f`: red, green, blue, Kd, Ks, shine, transmittance, index of refraction.
pub(crate) type Surface = [f32; 8];

/// The materials of surfaces; equal surfaces share one.
#[derive(Default)]
pub(crate) struct Surfaces(HashMap<Option<[u32; 8]>, u32>);

impl Surfaces {
    /// The index of the material of a surface, or of what is stated before any.
    pub(crate) fn index(&mut self, materials: &mut Vec<Material>, surface: Option<Surface>) -> u32 {
        let bits = surface.map(|surface| surface.map(f32::to_bits));
        *self.0.entry(bits).or_insert_with(|| {
            materials.push(surface.map_or_else(Material::default, material));
            materials.len() as u32 - 1
        })
    }
}

/// An index of refraction of zero is what opaque surfaces state.
fn material([r, g, b, kd, ks, shine, transmittance, ior]: Surface) -> Material {
    Material {
        diffuse: Vec3::new(r, g, b) * kd,
        specular: Vec3::splat(ks),
        shininess: shine,
        mirror: Vec3::splat(ks.max(0.0)),
        transmission: Vec3::splat(transmittance.max(0.0)),
        ior: if ior > 0.0 { ior } else { 1.0 },
        ..Material::default()
    }
}

/// What stands for a material.
pub(super) fn surface(material: &Material) -> Surface {
    let (Vec3 { x: r, y: g, z: b }, kd) = split_diffuse(material.diffuse);
    let (ks, transmittance) = (grey(material.reflected()), grey(material.transmission));
    [r, g, b, kd, ks, material.shininess, transmittance, material.ior]
}

/// How many materials of a scene are others when they have been written and read back.
pub fn poorer(scene: &Scene) -> usize {
    crate::model::changed(&scene.materials, |old| material(surface(old)))
}

/// A colour whose greatest component is one, and Kd, if their product has the same bits; the colour
/// in few digits, if that can be.
fn split_diffuse(diffuse: Vec3) -> (Vec3, f32) {
    const DIGITS: f32 = 1e5;
    let kd = diffuse.max_element();
    let color = diffuse / kd;
    let short = (color * DIGITS).round() / DIGITS;
    let good = [short, color].into_iter().find(|&color| color * kd == diffuse);
    good.map_or((diffuse, 1.0), |color| (color, kd))
}

/// The one strength that stands for a colour.
pub(crate) fn grey(color: Vec3) -> f32 {
    if color == Vec3::splat(color.x) { color.x } else { color.element_sum() / 3.0 }
}
