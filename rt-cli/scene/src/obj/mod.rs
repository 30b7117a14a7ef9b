//! Wavefront OBJ: polygons, with materials from MTL libraries.
//!
//! The crate `tobj` parses the numbers and numbers the vertices afresh, in the order of their use;
//! before it, a reader of our own checks every statement and says where it is wrong. Polygons are
//! triangulated whatever their shape. Faces of a smoothing group that state no normals get some. Lines,
//! points, free-form surfaces and textures but those of diffuse colour are counted and left out. A vertex's weight or colour is ignored.

mod map;
mod mtl;
mod reader;
mod smooth;
mod write;

use std::collections::HashMap;
use std::path::Path;

use glam::{Vec2, Vec3};
use tobj::{LoadError, LoadOptions};

use crate::diag::{Diagnostic, Error, MAX_DIAGNOSTICS};
use crate::model::{Material, Mesh, Scene, Skipped, Triangle};
use crate::text::{Source, decode, read_file};
use crate::triangulate::Triangulator;
use map::Textures;
use mtl::Libraries;
use reader::{Outline, Reader};
use smooth::Smoothing;

pub use mtl::Loader;
pub use write::{write, write_library};

/// Reads an OBJ file, and its material libraries and textures from the same folder.
pub fn read(path: &Path) -> Result<Scene, Error> {
    let bytes = read_file(path).map_err(|source| Error::Io { path: path.to_owned(), source })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    // Libraries are often named the way of another system.
    let mut library = |name: &str| read_file(&folder.join(name.replace('\\', "/")));
    parse(&bytes, &path.to_string_lossy(), &mut library)
}

/// Reads an OBJ text. `name` is what messages call it, `library` gives material libraries by the
/// names that the text states, and textures by those that libraries state; one that cannot be read
/// costs no more than a warning.
///
/// Vertices that no face uses are left out of the scene.
pub fn parse(bytes: &[u8], name: &str, library: &mut Loader<'_>) -> Result<Scene, Error> {
    let source = Source::new(name, bytes, "OBJ")?;
    let mut reader = Reader::new(source);
    let no_library = |_: &Path| Err(LoadError::GenericFailure);
    let loaded = tobj::load_obj_buf(&mut reader, &LoadOptions::default(), no_library);
    let outline = reader.finish()?;
    let (mut models, _) =
        loaded.map_err(|error| Error::Invalid(vec![Diagnostic::whole(name, error.to_string())]))?;
    let mut scene = Scene { name: crate::base_name(name), ..Scene::default() };
    let materials = use_materials(&mut scene, &source, &outline, library);
    scene.facts.stated.insert("polygon", outline.faces as u64);
    if let Some(model) = models.pop() {
        build_mesh(&mut scene, &model.mesh, &outline, &materials);
    }
    let unused = outline.counts[0].saturating_sub(scene.mesh.positions.len()) as u64;
    if unused > 0 {
        let (what, why) = ("v".to_owned(), "no face uses it".to_owned());
        scene.facts.skipped.push(Skipped { what, why, count: unused });
    }
    scene.facts.skipped.extend(outline.skipped);
    scene.finish();
    Ok(scene)
}

/// Puts the materials that faces use into the scene. Returns the material of each run.
fn use_materials(
    scene: &mut Scene,
    source: &Source<'_>,
    outline: &Outline<'_>,
    library: &mut Loader<'_>,
) -> Vec<u32> {
    let mut libraries = Libraries::default();
    for &names in &outline.libraries {
        libraries.open(source, names, library);
    }
    scene.facts.warnings.append(&mut libraries.warnings);
    scene.facts.missing.append(&mut libraries.missing);

    let mut textures = Textures::default();
    let mut indices: HashMap<Option<u32>, u32> = HashMap::new();
    let mut default = None;
    let mut unknown = 0;
    let mut index_of = |stated: Option<u32>| {
        let name = stated.map(|index| outline.names[index as usize]);
        if let Some((material, map)) = name.and_then(|name| libraries.get(&decode(name.text))) {
            let texture = map.as_ref().and_then(|map| {
                textures.open(map, &libraries.source(map)?, library, &mut scene.facts)
            });
            let material = Material { diffuse_map: texture, ..material.clone() };
            return push(&mut scene.materials, material);
        }
        if let Some(name) = name {
            unknown += 1;
            if unknown <= MAX_DIAGNOSTICS {
                let message = format!("no material {}: the default is used", name.quoted());
                scene.facts.warnings.push(source.warning(name.at, message));
            }
        }
        *default.get_or_insert_with(|| push(&mut scene.materials, Material::default()))
    };
    let runs = outline.runs.iter().map(|run| run.material);
    let indices =
        runs.map(|stated| *indices.entry(stated).or_insert_with(|| index_of(stated))).collect();
    textures.finish(source.name, &mut scene.facts);
    scene.textures = textures.textures;
    if unknown > MAX_DIAGNOSTICS {
        let more = unknown - MAX_DIAGNOSTICS;
        scene.facts.warnings.push(format!("{}: {more} more unknown materials", source.name));
    }
    indices
}

fn push(materials: &mut Vec<Material>, material: Material) -> u32 {
    materials.push(material);
    materials.len() as u32 - 1
}

/// Triangulates the one mesh that tobj makes of the clean text.
fn build_mesh(scene: &mut Scene, mesh: &tobj::Mesh, outline: &Outline<'_>, materials: &[u32]) {
    let vectors = |flat: &[f32]| flat.as_chunks().0.iter().map(|&v| Vec3::from_array(v)).collect();
    scene.mesh = Mesh { positions: vectors(&mesh.positions), ..Mesh::default() };
    if outline.runs.iter().any(|run| run.normals) {
        scene.mesh.normals = vectors(&mesh.normals);
    }
    if outline.runs.iter().any(|run| run.uvs) {
        let uvs = mesh.texcoords.as_chunks().0.iter();
        scene.mesh.uvs = uvs.map(|&uv| Vec2::from_array(uv)).collect();
    }
    let mut smoothing = Smoothing::default();
    let (positions, stated_normals) = (&scene.mesh.positions, scene.mesh.normals.len());
    let triangles = &mut scene.mesh.triangles;
    triangles.reserve(mesh.indices.len().saturating_sub(2 * outline.faces));

    let mut triangulator = Triangulator::default();
    let mut corners = Vec::new();
    let mut first = 0;
    let mut runs = outline.runs.iter().zip(materials).peekable();
    let mut current = None;
    for face in 0..outline.faces {
        current = runs.next_if(|(run, _)| run.first <= face).or(current);
        let Some((run, &material)) = current else { break };
        // Where every face is a triangle, tobj states no arities.
        let arity = mesh.face_arities.get(face).map_or(3, |&arity| arity as usize);
        let range = first..first + arity;
        first += arity;
        let normals = run.normals.then(|| &mesh.normal_indices[range.clone()]);
        let uvs = run.uvs.then(|| &mesh.texcoord_indices[range.clone()]);
        let indices = &mesh.indices[range];
        corners.clear();
        corners.extend(indices.iter().map(|&index| positions[index as usize]));
        let pick = |from: &[u32], triangle: [u32; 3]| triangle.map(|corner| from[corner as usize]);
        let before = triangles.len();
        triangles.extend(triangulator.polygon(&corners).iter().map(|&triangle| Triangle {
            position: pick(indices, triangle),
            normal: normals.map(|normals| pick(normals, triangle)),
            uv: uvs.map(|uvs| pick(uvs, triangle)),
            material,
        }));
        if let Some(group) = run.smoothing.filter(|_| normals.is_none()) {
            smoothing.add(group, positions, stated_normals, &mut triangles[before..]);
        }
    }
    smoothing.finish(&mut scene.mesh);
    scene.facts.warnings.extend(triangulator.warning());
}
