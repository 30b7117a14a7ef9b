//! The NFF writer.

use std::io::{self, Write};

use glam::Vec3;

use super::surface::surface;
use crate::diag::Error;
use crate::model::{Cone, Light, Mesh, Scene, Sphere, Triangle};
use crate::spd::white_light;
use crate::triangulate::Triangulator;

/// The distance of the hither plane: the model has none, and ray tracers need none.
const HITHER: f32 = 0.01;

/// Writes a scene as NFF. Read back, every coordinate has the same bits; two triangles that a
/// quadrilateral would give are written as one.
///
/// The format has one grey strength for highlights and mirror reflections, one for what goes through,
/// and no emission: what a material has beyond that is lost ([`poorer`](super::poorer)).
pub fn write(scene: &Scene, out: &mut impl Write) -> Result<(), Error> {
    Writer { out, triangulator: Triangulator::default() }.scene(scene).map_err(Error::Write)
}

struct Writer<'a, W> {
    out: &'a mut W,
    triangulator: Triangulator,
}

impl<W: Write> Writer<'_, W> {
    fn scene(&mut self, scene: &Scene) -> io::Result<()> {
        write_background(scene, self.out)?;
        write_view(scene, self.out)?;
        self.lights(&scene.lights)?;
        let mut material = None;
        let mut triangles = scene.mesh.triangles.as_slice();
        while let Some(first) = triangles.first() {
            self.change_surface(scene, &mut material, first.material)?;
            let corners = self.quad(&scene.mesh, triangles);
            let corners = corners.map_or(first.position.to_vec(), |corners| corners.to_vec());
            triangles = &triangles[corners.len() - 2..];
            self.polygon(&scene.mesh, &corners, first.normal)?;
        }
        for sphere in &scene.spheres {
            self.change_surface(scene, &mut material, sphere.material)?;
            write_sphere(sphere, self.out)?;
        }
        for cone in &scene.cones {
            self.change_surface(scene, &mut material, cone.material)?;
            write_cone(cone, self.out)?;
        }
        Ok(())
    }

    /// Colours are left out where a reader would put the same.
    fn lights(&mut self, lights: &[Light]) -> io::Result<()> {
        for Light { position: Vec3 { x, y, z }, color } in lights {
            write!(self.out, "l {x} {y} {z}")?;
            if *color != white_light(lights.len()) {
                write!(self.out, " {} {} {}", color.x, color.y, color.z)?;
            }
            writeln!(self.out)?;
        }
        Ok(())
    }

    fn change_surface(
        &mut self,
        scene: &Scene,
        current: &mut Option<u32>,
        wanted: u32,
    ) -> io::Result<()> {
        if *current == Some(wanted) {
            return Ok(());
        }
        *current = Some(wanted);
        write!(self.out, "f")?;
        for number in surface(&scene.materials[wanted as usize]) {
            write!(self.out, " {number}")?;
        }
        writeln!(self.out)
    }

    /// The corners of the quadrilateral whose triangles come next, if they do.
    fn quad(&mut self, mesh: &Mesh, triangles: &[Triangle]) -> Option<[u32; 4]> {
        let [first, second, ..] = triangles else { return None };
        if first.normal.is_some() || second.normal.is_some() || first.material != second.material {
            return None;
        }
        let ([a, b, c], [d, e, f]) = (first.position, second.position);
        let corners = if (d, e) == (a, c) { [a, b, c, f] } else { [a, b, e, c] };
        let points = corners.map(|corner| mesh.positions[corner as usize]);
        let read = self.triangulator.polygon(&points);
        let same = read.iter().map(|triangle| triangle.map(|corner| corners[corner as usize]));
        same.eq([[a, b, c], [d, e, f]]).then_some(corners)
    }

    fn polygon(
        &mut self,
        mesh: &Mesh,
        corners: &[u32],
        normals: Option<[u32; 3]>,
    ) -> io::Result<()> {
        let keyword = if normals.is_some() { "pp" } else { "p" };
        writeln!(self.out, "{keyword} {}", corners.len())?;
        for (nth, &corner) in corners.iter().enumerate() {
            let Vec3 { x, y, z } = mesh.positions[corner as usize];
            write!(self.out, "{x} {y} {z}")?;
            if let Some(normals) = normals {
                let Vec3 { x, y, z } = mesh.normals[normals[nth] as usize];
                write!(self.out, " {x} {y} {z}")?;
            }
            writeln!(self.out)?;
        }
        Ok(())
    }
}

/// The statement of the background, if there is one; AFF has the same.
pub(crate) fn write_background(scene: &Scene, out: &mut impl Write) -> io::Result<()> {
    match scene.background {
        Some(Vec3 { x, y, z }) => writeln!(out, "b {x} {y} {z}"),
        None => Ok(()),
    }
}

/// The statement of the view, if there is one; AFF has the same.
pub(crate) fn write_view(scene: &Scene, out: &mut impl Write) -> io::Result<()> {
    let Some(view) = &scene.view else { return Ok(()) };
    writeln!(out, "v")?;
    for (keyword, Vec3 { x, y, z }) in [("from", view.eye), ("at", view.target), ("up", view.up)] {
        writeln!(out, "{keyword} {x} {y} {z}")?;
    }
    writeln!(out, "angle {}\nhither {HITHER}", view.fov_y)?;
    match view.size {
        Some((width, height)) => writeln!(out, "resolution {width} {height}"),
        None => Ok(()),
    }
}

/// A sphere's statement; AFF has the same.
pub(crate) fn write_sphere(sphere: &Sphere, out: &mut impl Write) -> io::Result<()> {
    let Vec3 { x, y, z } = sphere.center;
    writeln!(out, "s {x} {y} {z} {}", sphere.radius)
}

/// A cone's statement; AFF has the same.
pub(crate) fn write_cone(cone: &Cone, out: &mut impl Write) -> io::Result<()> {
    let (Vec3 { x, y, z }, Vec3 { x: ax, y: ay, z: az }) = (cone.base, cone.apex);
    let (radius, a_radius) = (cone.base_radius, cone.apex_radius);
    writeln!(out, "c {x} {y} {z} {radius} {ax} {ay} {az} {a_radius}")
}
