//! OBJ and MTL texts.

use std::collections::HashSet;
use std::io::{self, Write};
use std::iter;

use glam::{Vec2, Vec3};

use crate::diag::{Error, plural};
use crate::model::{ColorMap, Material, Scene};

/// Writes a scene's triangles as OBJ. Read back, every coordinate has the same bits. `library` is
/// the name of the file that [`write_library`] writes; without it no materials are stated.
///
/// An OBJ holds neither spheres nor cones, which are an error, nor lights nor a view, which are left out.
pub fn write(scene: &Scene, library: Option<&str>, out: &mut impl Write) -> Result<(), Error> {
    for (count, kind) in [(scene.spheres.len(), "sphere"), (scene.cones.len(), "cone")] {
        if count > 0 {
            let (name, many) = (&scene.name, plural(count as u64, kind));
            let message = format!(
                "an OBJ file cannot hold {name}'s {many}: write an NFF, or make triangles of them \
                 with --tessellate"
            );
            return Err(Error::Inexpressible(message));
        }
    }
    write_mesh(scene, library, out).map_err(Error::Write)
}

/// Writes a scene's materials as MTL. `pictures` are the names of the files in which who calls puts
/// the scene's textures, in their order. What reflects does so as much as its highlights: MTL has one
/// colour for both. What goes through is grey.
///
/// # Panics
/// If a texture of a material has no name.
pub fn write_library(
    scene: &Scene,
    pictures: &[String],
    out: &mut impl Write,
) -> Result<(), Error> {
    write_materials(&scene.materials, pictures, out).map_err(Error::Write)
}

fn write_mesh(scene: &Scene, library: Option<&str>, out: &mut impl Write) -> io::Result<()> {
    let mesh = &scene.mesh;
    if let Some(library) = library {
        writeln!(out, "mtllib {library}")?;
    }
    for Vec3 { x, y, z } in &mesh.positions {
        writeln!(out, "v {x} {y} {z}")?;
    }
    for Vec3 { x, y, z } in &mesh.normals {
        writeln!(out, "vn {x} {y} {z}")?;
    }
    for Vec2 { x, y } in &mesh.uvs {
        writeln!(out, "vt {x} {y}")?;
    }
    let names = unique_names(&scene.materials);
    let mut material = None;
    for triangle in &mesh.triangles {
        if library.is_some() && material != Some(triangle.material) {
            material = Some(triangle.material);
            writeln!(out, "usemtl {}", names[triangle.material as usize])?;
        }
        write!(out, "f")?;
        for corner in 0..3 {
            let number = |indices: [u32; 3]| u64::from(indices[corner]) + 1;
            write!(out, " {}", number(triangle.position))?;
            match (triangle.uv.map(number), triangle.normal.map(number)) {
                (None, None) => {}
                (Some(uv), None) => write!(out, "/{uv}")?,
                (None, Some(normal)) => write!(out, "//{normal}")?,
                (Some(uv), Some(normal)) => write!(out, "/{uv}/{normal}")?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

fn write_materials(
    materials: &[Material],
    pictures: &[String],
    out: &mut impl Write,
) -> io::Result<()> {
    for (material, name) in materials.iter().zip(unique_names(materials)) {
        let reflects = material.mirror != Vec3::ZERO;
        writeln!(out, "newmtl {name}")?;
        let opacity = 1.0 - (material.transmission.element_sum() / 3.0).min(1.0);
        let diffuse = if opacity > 0.0 { material.diffuse / opacity } else { Vec3::ZERO };
        for (keyword, Vec3 { x, y, z }) in
            [("Kd", diffuse), ("Ks", material.reflected()), ("Ke", material.emission)]
        {
            writeln!(out, "{keyword} {x} {y} {z}")?;
        }
        if let Some(ColorMap { texture, scale, offset }) = material.diffuse_map {
            write!(out, "map_Kd")?;
            for (option, value, usual) in [("-s", scale, Vec2::ONE), ("-o", offset, Vec2::ZERO)] {
                if value != usual {
                    write!(out, " {option} {} {}", value.x, value.y)?;
                }
            }
            writeln!(out, " {}", pictures[texture as usize])?;
        }
        if material.transmission != Vec3::ZERO {
            writeln!(out, "d {opacity}")?;
        }
        if material.ior != 1.0 {
            writeln!(out, "Ni {}", material.ior)?;
        }
        writeln!(out, "Ns {}", material.shininess)?;
        let model = match (material.transmission != Vec3::ZERO, reflects, material.fresnel) {
            (true, _, true) => 7,
            (true, true, false) => 6,
            // No model lets light through glass that reflects nothing.
            (true, false, false) => continue,
            (false, true, true) => 5,
            (false, true, false) => 3,
            (false, false, _) => 2,
        };
        writeln!(out, "illum {model}")?;
    }
    Ok(())
}

/// The materials' own names, with a number where that is needed to tell them apart.
fn unique_names(materials: &[Material]) -> Vec<String> {
    let mut taken = HashSet::new();
    let unique = |(index, material): (usize, &Material)| {
        let base = if material.name.is_empty() { "material" } else { &material.name };
        let numbered = (index..).map(|number| format!("{base}_{number}"));
        let mut names = iter::once(base.to_owned()).chain(numbered);
        names.find(|name| taken.insert(name.clone())).unwrap_or_default()
    };
    materials.iter().enumerate().map(unique).collect()
}
