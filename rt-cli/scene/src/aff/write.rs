//! The AFF writer.

use std::collections::HashMap;
use std::io::{self, Write};

use glam::Vec3;

use super::surface::surface;
use crate::diag::Error;
use crate::model::{Light, Material, Mesh, Scene, Triangle};
use crate::nff::{write_background, write_cone, write_sphere, write_view};

/// Writes a scene as AFF, with a mesh for triangles side by side of one material. Read back, every
/// coordinate has the same bits.
///
/// The format has one colour for highlights and mirror reflections, a grey for what goes through, and
/// no emission, and of it no textures are read: what a material has beyond that is lost
/// ([`poorer`](super::poorer)).
pub fn write(scene: &Scene, out: &mut impl Write) -> Result<(), Error> {
    write_scene(scene, out).map_err(Error::Write)
}

fn write_scene(scene: &Scene, out: &mut impl Write) -> io::Result<()> {
    write_background(scene, out)?;
    write_view(scene, out)?;
    for Light { position: Vec3 { x, y, z }, color } in &scene.lights {
        writeln!(out, "l {x} {y} {z} {} {} {}", color.x, color.y, color.z)?;
    }
    let mut current = None;
    let mut change = |material: u32, out: &mut _| match current.replace(material) {
        Some(same) if same == material => Ok(()),
        _ => write_surface(&scene.materials[material as usize], out),
    };
    let alike = |a: &Triangle, b: &Triangle| {
        a.material == b.material && a.normal.is_some() == b.normal.is_some()
    };
    for triangles in scene.mesh.triangles.chunk_by(alike) {
        change(triangles[0].material, out)?;
        write_mesh(&scene.mesh, triangles, out)?;
    }
    for sphere in &scene.spheres {
        change(sphere.material, out)?;
        write_sphere(sphere, out)?;
    }
    for cone in &scene.cones {
        change(cone.material, out)?;
        write_cone(cone, out)?;
    }
    Ok(())
}

fn write_surface(material: &Material, out: &mut impl Write) -> io::Result<()> {
    write!(out, "fm")?;
    for number in surface(material) {
        write!(out, " {number}")?;
    }
    writeln!(out)
}

/// Writes triangles all of which have normals, or none.
fn write_mesh(mesh: &Mesh, triangles: &[Triangle], out: &mut impl Write) -> io::Result<()> {
    let (mut positions, mut normals) = (Used::default(), Used::default());
    let corners: Vec<_> = triangles
        .iter()
        .map(|triangle| {
            let position = triangle.position.map(|index| positions.number(index));
            (position, triangle.normal.map(|corners| corners.map(|index| normals.number(index))))
        })
        .collect();
    writeln!(out, "m")?;
    positions.write("vertices", &mesh.positions, out)?;
    if !normals.order.is_empty() {
        normals.write("normals", &mesh.normals, out)?;
    }
    writeln!(out, "triangles {}", corners.len())?;
    for ([a, b, c], normal) in corners {
        match normal {
            Some([d, e, f]) => writeln!(out, "{a} {b} {c} {d} {e} {f}")?,
            None => writeln!(out, "{a} {b} {c}")?,
        }
    }
    Ok(())
}

/// Vectors of the scene that a mesh has, numbered in the order of their use.
#[derive(Default)]
struct Used {
    numbers: HashMap<u32, usize>,
    order: Vec<u32>,
}

impl Used {
    fn number(&mut self, index: u32) -> usize {
        *self.numbers.entry(index).or_insert_with(|| {
            self.order.push(index);
            self.order.len() - 1
        })
    }

    fn write(&self, keyword: &str, all: &[Vec3], out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{keyword} {}", self.order.len())?;
        for &index in &self.order {
            let Vec3 { x, y, z } = all[index as usize];
            writeln!(out, "{x} {y} {z}")?;
        }
        Ok(())
    }
}
