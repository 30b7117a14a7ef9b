//! What the format's `f` means.

use std::collections::HashMap;

use glam::Vec3;

use crate::model::Material;

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
