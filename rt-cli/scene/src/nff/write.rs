//! The NFF writer.

use std::io::{self, Write};

use glam::Vec3;

use crate::diag::Error;
use crate::model::{Light, Material, Mesh, Scene, Triangle, View};
use crate::spd::white_light;
use crate::triangulate::Triangulator;

/// The distance of the hither plane: the model has none, and ray tracers need none.
const HITHER: f32 = 0.01;

/// Writes a scene as NFF. Read back, every coordinate has the same bits; two triangles that a
/// quadrilateral would give are written as one.
///
/// The format has one grey strength for highlights and mirror reflections, one for what goes through,
/// and no emission: what a material has beyond that is lost.
pub fn write(scene: &Scene, out: &mut impl Write) -> Result<(), Error> {
    Writer { out, triangulator: Triangulator::default() }.scene(scene).map_err(Error::Write)
}

/// How many materials of a scene [`write()`] makes poorer: those whose highlights, reflections or
/// transmission are coloured or differ in strength, and those that give off light.
pub fn poorer(scene: &Scene) -> usize {
    let is_grey = |color: Vec3| color == Vec3::splat(color.x);
    let holds = |material: &&Material| {
        material.emission == Vec3::ZERO
            && is_grey(material.specular)
            && is_grey(material.transmission)
            && material.mirror == material.specular
    };
    scene.materials.len() - scene.materials.iter().filter(holds).count()
}

/// What stands for both highlights and reflections.
fn reflected(material: &Material) -> Vec3 {
    if material.mirror == Vec3::ZERO { material.specular } else { material.mirror }
}

struct Writer<'a, W> {
    out: &'a mut W,
    triangulator: Triangulator,
}

impl<W: Write> Writer<'_, W> {
    fn scene(&mut self, scene: &Scene) -> io::Result<()> {
        if let Some(Vec3 { x, y, z }) = scene.background {
            writeln!(self.out, "b {x} {y} {z}")?;
        }
        if let Some(view) = &scene.view {
            self.view(view)?;
        }
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
            let Vec3 { x, y, z } = sphere.center;
            writeln!(self.out, "s {x} {y} {z} {}", sphere.radius)?;
        }
        for cone in &scene.cones {
            self.change_surface(scene, &mut material, cone.material)?;
            let (Vec3 { x, y, z }, Vec3 { x: ax, y: ay, z: az }) = (cone.base, cone.apex);
            let (radius, a_radius) = (cone.base_radius, cone.apex_radius);
            writeln!(self.out, "c {x} {y} {z} {radius} {ax} {ay} {az} {a_radius}")?;
        }
        Ok(())
    }

    fn view(&mut self, view: &View) -> io::Result<()> {
        writeln!(self.out, "v")?;
        for (keyword, Vec3 { x, y, z }) in
            [("from", view.eye), ("at", view.target), ("up", view.up)]
        {
            writeln!(self.out, "{keyword} {x} {y} {z}")?;
        }
        writeln!(self.out, "angle {}\nhither {HITHER}", view.fov_y)?;
        match view.size {
            Some((width, height)) => writeln!(self.out, "resolution {width} {height}"),
            None => Ok(()),
        }
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
        let material = &scene.materials[wanted as usize];
        let (Vec3 { x: r, y: g, z: b }, kd) = split_diffuse(material.diffuse);
        let (ks, transmittance) = (grey(reflected(material)), grey(material.transmission));
        let (shine, ior) = (material.shininess, material.ior);
        writeln!(self.out, "f {r} {g} {b} {kd} {ks} {shine} {transmittance} {ior}")
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
fn grey(color: Vec3) -> f32 {
    if color == Vec3::splat(color.x) { color.x } else { color.element_sum() / 3.0 }
}
