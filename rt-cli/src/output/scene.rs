//! Scenes.

use std::path::{Path, PathBuf};

use rt_scene::Scene;

use super::{Output, format};
use crate::error::Error;

/// A place for a scene: a file and, beside an OBJ, its materials and their pictures.
pub(crate) struct SceneOutput {
    path: PathBuf,
    output: Output,
    format: Format,
}

enum Format {
    Nff,
    Aff,
    /// With the name of the library, and its place.
    Obj(String, Output),
}

impl SceneOutput {
    /// Makes sure that it can be written. The extension tells the format; without one it is NFF.
    pub(crate) fn open(path: &Path) -> Result<SceneOutput, Error> {
        let format = format(path, &["nff", "obj", "aff"])?;
        let output = Output::open(path)?;
        let format = match format {
            "obj" => {
                let beside = path.with_extension("mtl");
                let name = beside.file_name().and_then(|name| name.to_str()).ok_or_else(|| {
                    Error::Usage(format!("{}: an OBJ needs a name in UTF-8", path.display()))
                })?;
                Format::Obj(name.to_owned(), Output::open(&beside)?)
            }
            "aff" => Format::Aff,
            _ => Format::Nff,
        };
        Ok(SceneOutput { path: path.to_owned(), output, format })
    }

    /// Writes all of it.
    pub(crate) fn write(self, scene: &Scene) -> Result<(), Error> {
        let mut text = Vec::new();
        match self.format {
            Format::Nff => rt_scene::nff::write(scene, &mut text)?,
            Format::Aff => rt_scene::aff::write(scene, &mut text)?,
            Format::Obj(name, library) => {
                rt_scene::obj::write(scene, Some(&name), &mut text)?;
                let (mut pictures, mut names) = (Vec::new(), Vec::new());
                for (number, texture) in scene.textures.iter().enumerate() {
                    let beside = self.path.with_extension(format!("{number}.png"));
                    let name = beside.file_name().map(|name| name.to_string_lossy().into_owned());
                    names.extend(name);
                    pictures.push((Output::open(&beside)?, texture));
                }
                let mut materials = Vec::new();
                rt_scene::obj::write_library(scene, &names, &mut materials)?;
                for (output, texture) in pictures {
                    output.write(&texture.to_png())?;
                }
                library.write(&materials)?;
            }
        }
        self.output.write(&text)
    }

    /// What to call it, unless it is standard output.
    pub(crate) fn name(&self) -> Option<String> {
        (self.path != Path::new("-")).then(|| self.path.display().to_string())
    }

    /// What a scene has and the format has no place for.
    pub(crate) fn lost(&self, scene: &Scene) -> Option<String> {
        match self.format {
            Format::Nff => lost_materials("NFF", rt_scene::nff::poorer(scene)),
            Format::Aff => lost_materials("AFF", rt_scene::aff::poorer(scene)),
            Format::Obj(..) => lost_in_obj(scene),
        }
    }
}

fn lost_in_obj(scene: &Scene) -> Option<String> {
    let mut lost = Vec::new();
    if !scene.lights.is_empty() {
        lost.push(crate::report::count(scene.lights.len(), "light"));
    }
    if let Some(view) = &scene.view {
        lost.push(format!("the view ({})", crate::report::flags(view)));
    }
    if scene.background.is_some() {
        lost.push("the background".to_owned());
    }
    (!lost.is_empty()).then(|| format!("an OBJ has no place for {}", lost.join(" and ")))
}

fn lost_materials(format: &str, poorer: usize) -> Option<String> {
    let many = crate::report::count(poorer, "material");
    (poorer > 0).then(|| format!("an {format} says less of materials: {many} will look different"))
}
