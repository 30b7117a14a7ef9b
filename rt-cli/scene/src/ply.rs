//! PLY, the Stanford triangle format: vertices and faces, as text or binary.
//!
//! The crate `ply-rs-bw` reads the elements. Of vertices there are positions and, if stated, normals;
//! faces are triangulated whatever their shape. Colours, texture coordinates and other elements are
//! counted and left out.

use std::path::Path;

use glam::Vec3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Encoding, Property, PropertyAccess, PropertyAccessResult as Access};

use crate::diag::{Diagnostic, Error};
use crate::model::{Mesh, Scene, Skipped, Triangle};
use crate::text::{Source, read_file};
use crate::triangulate::Triangulator;

/// Reads a PLY file.
pub fn read(path: &Path) -> Result<Scene, Error> {
    let bytes = read_file(path).map_err(|source| Error::Io { path: path.to_owned(), source })?;
    parse(&bytes, &path.to_string_lossy())
}

/// Reads a PLY file's bytes. `name` is what messages call it.
///
/// Vertices that no face uses are left out of the scene.
///
/// # Errors
/// The first thing that is wrong, with its line where the file is text; or that there are no faces.
pub fn parse(bytes: &[u8], name: &str) -> Result<Scene, Error> {
    let wrong = |message: String| Error::Invalid(vec![Diagnostic::whole(name, message)]);
    let source = Source { name, text: bytes };
    let mut reader = Reader::new(bytes);
    let parser = Parser::<Other>::new();
    let header = parser.read_header(&mut reader).map_err(|error| told(source, true, &error))?;
    let is_text = header.encoding == Encoding::Ascii;
    let told = |error| told(source, is_text, &error);
    let (mut vertices, mut faces) = (None, None);
    let mut skipped = Vec::new();
    for element in header.elements.values() {
        // Such elements would have no end.
        if element.properties.is_empty() && !is_text && element.count > 0 {
            return Err(wrong(format!("the element '{}' has no properties", element.name)));
        }
        match &*element.name {
            "vertex" => {
                let parser = Parser::<Vertex>::new();
                let all = parser.read_payload_for_element(&mut reader, element, &header);
                vertices = Some((element, all.map_err(told)?));
            }
            "face" => {
                let parser = Parser::<Face>::new();
                let all = parser.read_payload_for_element(&mut reader, element, &header);
                faces = Some(all.map_err(told)?);
            }
            _ => {
                let all = parser.read_payload_for_element(&mut reader, element, &header);
                all.map_err(told)?;
                let why = "of a PLY vertices and faces are read";
                skipped.push(skip(&element.name, why, element.count as u64));
            }
        }
    }
    let Some((element, vertices)) = vertices else {
        return Err(wrong("there is no element 'vertex'".to_owned()));
    };
    let faces = faces.filter(|faces| !faces.is_empty());
    let faces = faces.ok_or_else(|| wrong("no faces: nothing to draw".to_owned()))?;
    let has = |names: [&str; 3]| names.iter().all(|&name| element.properties.contains_key(name));
    if !has(["x", "y", "z"]) {
        return Err(wrong("the element 'vertex' has no x, y and z".to_owned()));
    }
    let with_normals = has(["nx", "ny", "nz"]);
    let known = if with_normals { 6 } else { 3 };
    let more = element.properties.len() - known;
    if more > 0 {
        let why = "of a vertex position and normal are read";
        skipped.push(skip("property", why, more as u64));
    }

    let mut triangulator = Triangulator::default();
    let mesh = mesh(&vertices, &faces, with_normals, &mut triangulator).map_err(wrong)?;
    let mut scene = Scene { name: crate::base_name(name), mesh, ..Scene::default() };
    let flat = faces.iter().filter(|face| face.is_flat()).count() as u64;
    scene.facts.stated.insert("polygon", faces.len() as u64);
    let unused = (vertices.len() - scene.mesh.positions.len()) as u64;
    for (what, why, count) in
        [("vertex", "no face uses it", unused), ("face", "it has less than three corners", flat)]
    {
        if count > 0 {
            scene.facts.skipped.push(skip(what, why, count));
        }
    }
    scene.facts.skipped.extend(skipped);
    scene.facts.warnings.extend(triangulator.warning());
    scene.finish();
    Ok(scene)
}

/// The triangles of all faces, with the vertices that they use; or what is wrong with those.
fn mesh(
    vertices: &[Vertex],
    faces: &[Face],
    with_normals: bool,
    triangulator: &mut Triangulator,
) -> Result<Mesh, String> {
    let mut mesh = Mesh::default();
    // Where the vertices that are used are in the mesh.
    let mut places = vec![u32::MAX; vertices.len()];
    let (mut corners, mut points) = (Vec::new(), Vec::new());
    for (number, face) in faces.iter().enumerate().filter(|(_, face)| !face.is_flat()) {
        corners.clear();
        points.clear();
        for &index in &face.0 {
            let count = vertices.len();
            let vertex = vertices.get(index as usize).ok_or_else(|| {
                format!("face {number} has the vertex {index}, but there are {count}")
            })?;
            let place = &mut places[index as usize];
            if *place == u32::MAX {
                if !vertex.position.is_finite() || !vertex.normal.is_finite() {
                    return Err(format!("vertex {index} is not finite in single precision"));
                }
                *place = mesh.positions.len() as u32;
                mesh.positions.push(vertex.position);
                mesh.normals.extend(with_normals.then_some(vertex.normal));
            }
            corners.push(*place);
            points.push(vertex.position);
        }
        mesh.triangles.extend(triangulator.polygon(&points).iter().map(|triangle| {
            let position = triangle.map(|corner| corners[corner as usize]);
            Triangle { position, normal: with_normals.then_some(position), uv: None, material: 0 }
        }));
    }
    Ok(mesh)
}

/// What is not read.
struct Other;

impl PropertyAccess for Other {
    fn new() -> Self {
        Other
    }
}

#[derive(Default)]
struct Vertex {
    position: Vec3,
    normal: Vec3,
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Vertex::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> Access {
        let place = match name {
            "x" => &mut self.position.x,
            "y" => &mut self.position.y,
            "z" => &mut self.position.z,
            "nx" => &mut self.normal.x,
            "ny" => &mut self.normal.y,
            "nz" => &mut self.normal.z,
            _ => return Access::Ignored,
        };
        let Some(value) = property.to_f32_lossy() else { return Access::UnsupportedType };
        *place = value;
        Access::Set
    }
}

/// The vertices at the corners.
#[derive(Default)]
struct Face(Vec<u32>);

impl Face {
    /// Whether it has too few corners.
    fn is_flat(&self) -> bool {
        self.0.len() < 3
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Face::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> Access {
        if !["vertex_indices", "vertex_index"].contains(&name) {
            return Access::Ignored;
        }
        let Some(indices) = property.to_u32_list() else { return Access::UnsupportedType };
        self.0 = indices;
        Access::Set
    }
}

fn skip(what: &str, why: &str, count: u64) -> Skipped {
    Skipped { what: what.to_owned(), why: why.to_owned(), count }
}

/// What the parser says: its innermost reason and, where the file is text, the place.
fn told(source: Source<'_>, is_text: bool, error: &ParseError) -> Error {
    let said = error.to_string();
    let reason = said.rsplit("Error: ").next().unwrap_or_default();
    let reason = reason.lines().next().unwrap_or_default();
    let reason = reason.split_once(": ").map_or(reason, |(start, rest)| match start {
        _ if start.starts_with("Line ") => rest,
        _ => reason,
    });
    // A line that the grammar does not know.
    let grammar = ["error at 1:", "ParseError { location: LineCol { line: 1, column: "];
    let column = grammar.iter().find_map(|before| {
        let digits = reason.strip_prefix(before)?;
        digits.split(|c: char| !c.is_ascii_digit()).next()?.parse::<usize>().ok()
    });
    let message = match column {
        _ if reason.contains("unsupported by the destination element") => {
            "expected coordinates to be numbers, and vertices of faces to be whole ones from 0 on"
        }
        Some(_) if reason.starts_with("error") => "expected a number",
        Some(_) => "expected a line of a PLY header",
        None => reason,
    };
    let message: String = message.chars().filter(|c| !c.is_control()).take(200).collect();
    let diagnostic = match error.line() {
        Some(line @ 1..) if is_text => {
            let before = source.text.split_inclusive(|&byte| byte == b'\n').take(line - 1);
            let start: usize = before.map(<[u8]>::len).sum();
            let length = source.text[start..].iter().position(|&byte| byte == b'\n');
            let length = length.unwrap_or(source.text.len() - start);
            let column = column.unwrap_or(1).saturating_sub(1);
            source.diagnostic(start + column.min(length), message)
        }
        _ => Diagnostic::whole(source.name, message),
    };
    Error::Invalid(vec![diagnostic])
}
