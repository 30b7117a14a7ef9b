//! The Standard Procedural Databases: scenes that are computed, in any size.
//!
//! Source: Haines, "A Proposal for Standard Graphics Environments", IEEE Computer Graphics and
//! Applications 7(11), 1987, and the programs published with it. Beside them stand three scenes of
//! our own that need different precision.

mod balls;
mod gears;
mod jacks;
mod lattice;
mod mount;
mod precision;
mod rings;
mod shells;
mod sombrero;
mod stage;
mod teapot;
mod tetra;
mod tree;
mod turn;

use glam::Vec3;

use crate::diag::Error;
use crate::model::Scene;

/// A scene that is computed.
pub struct Procedure {
    /// What it is called after `spd:`.
    pub name: &'static str,
    /// What it shows, in a few words.
    pub about: &'static str,
    /// The size if none is given.
    pub default_size: u32,
    /// The least and the greatest size.
    pub sizes: (u32, u32),
    generate: fn(u32) -> Scene,
}

/// All scenes, by name.
pub const PROCEDURES: &[Procedure] = &[
    balls::PROCEDURE,
    gears::PROCEDURE,
    jacks::PROCEDURE,
    lattice::PROCEDURE,
    mount::PROCEDURE,
    rings::PROCEDURE,
    shells::PROCEDURE,
    sombrero::PROCEDURE,
    teapot::PROCEDURE,
    tetra::PROCEDURE,
    tree::PROCEDURE,
    precision::NEAR,
    precision::FAR,
    precision::SLIVERS,
];

/// Computes the scene of this name.
pub fn generate(name: &str, size: Option<u32>) -> Result<Scene, Error> {
    let procedure = find(name)?;
    let size = size.unwrap_or(procedure.default_size);
    if size < procedure.sizes.0 || size > procedure.sizes.1 {
        return Err(procedure.size_error(&size.to_string()));
    }
    let mut scene = (procedure.generate)(size);
    scene.name = format!("spd:{name}:{size}");
    scene.finish();
    Ok(scene)
}

/// Takes `NAME` or `NAME:SIZE`.
pub(crate) fn open(name: &str) -> Result<Scene, Error> {
    let Some((name, size)) = name.split_once(':') else { return generate(name, None) };
    match size.parse() {
        Ok(size) => generate(name, Some(size)),
        Err(_) => Err(find(name)?.size_error(size)),
    }
}

fn find(name: &str) -> Result<&'static Procedure, Error> {
    PROCEDURES.iter().find(|procedure| procedure.name == name).ok_or_else(|| {
        let known: Vec<String> = PROCEDURES.iter().map(|p| format!("spd:{}", p.name)).collect();
        Error::UnknownScene { name: name.to_owned(), known: known.join(", ") }
    })
}

impl Procedure {
    fn size_error(&self, size: &str) -> Error {
        Error::SceneSize { name: self.name, size: size.to_owned(), range: self.sizes }
    }
}

/// The colour of each of so many lights for which a scene states none: white, and the dimmer the
/// more there are, as the programs of the databases have it for renderers that take an intensity.
pub(crate) fn white_light(count: usize) -> Vec3 {
    Vec3::splat(1.0 / (count as f32).sqrt())
}
