//! Material libraries: the part of MTL that [`Material`] has room for.

use std::collections::{HashMap, HashSet};
use std::io;

use glam::Vec3;

use super::map::Map;
use crate::diag::{MAX_DIAGNOSTICS, plural, reason};
use crate::model::Material;
use crate::text::{Lexer, Source, Word, decode};

/// No more names than this are tried for one file.
const MAX_LIBRARIES: usize = 64;

/// Gives the bytes of a material library by the name that the OBJ file states, or of a texture by the
/// name that a library states.
pub type Loader<'a> = dyn FnMut(&str) -> io::Result<Vec<u8>> + 'a;

/// All materials that a file's libraries define, and what was wrong with them.
#[derive(Default)]
pub(super) struct Libraries {
    materials: HashMap<String, (Material, Option<Map>)>,
    tried: HashSet<String>,
    /// Name and bytes of each file.
    files: Vec<(String, Vec<u8>)>,
    pub(super) warnings: Vec<String>,
    /// Those of them that are of a file that cannot be read.
    pub(super) missing: Vec<String>,
}

impl Libraries {
    /// A material, and what texture is stated of it.
    pub(super) fn get(&self, name: &str) -> Option<&(Material, Option<Map>)> {
        self.materials.get(name)
    }

    /// The library that states a texture.
    pub(super) fn source(&self, map: &Map) -> Option<Source<'_>> {
        let (name, bytes) = &self.files[map.library];
        Source::new(name, bytes, "MTL").ok()
    }

    /// Opens what one `mtllib` statement names: one file, or else several.
    pub(super) fn open(&mut self, source: &Source<'_>, names: Word<'_>, load: &mut Loader<'_>) {
        let line = decode(names.text);
        let Err(error) = self.open_one(&line, load) else { return };
        let several = split_names(&line);
        if several.len() < 2 {
            self.miss(cannot_read(source, names, &line, &error));
            return;
        }
        for name in several {
            if let Err(error) = self.open_one(&name, load) {
                self.miss(cannot_read(source, names, &name, &error));
            }
        }
    }

    fn miss(&mut self, warning: String) {
        self.missing.push(warning.clone());
        self.warnings.push(warning);
    }

    fn open_one(&mut self, name: &str, load: &mut Loader<'_>) -> io::Result<()> {
        if !self.tried.insert(name.to_owned()) || self.tried.len() > MAX_LIBRARIES + 1 {
            return Ok(());
        }
        if self.tried.len() > MAX_LIBRARIES {
            let rest =
                format!("more than {MAX_LIBRARIES} material libraries: the rest is not read");
            self.warnings.push(rest);
            return Ok(());
        }
        let bytes = load(name)?;
        match Source::new(name, &bytes, "MTL") {
            Ok(source) => self.read(&source),
            Err(error) => self.warnings.push(error.to_string()),
        }
        self.files.push((name.to_owned(), bytes));
        Ok(())
    }

    fn read(&mut self, source: &Source<'_>) {
        let mut cleaner = Cleaner::new(*source, self.files.len());
        cleaner.run();
        let Cleaner { clean, stated, mut warnings, .. } = cleaner;
        match tobj::load_mtl_buf(&mut clean.as_slice()) {
            Ok((materials, _)) => {
                for (stated, material) in stated.iter().zip(materials) {
                    let name = decode(stated.name.text).into_owned();
                    let material = convert(name.clone(), stated, &material);
                    self.materials.insert(name, (material, stated.map));
                }
            }
            Err(error) => warnings.push(format!("{}: {error}", source.name)),
        }
        self.warnings.append(&mut warnings);
    }
}

fn cannot_read(source: &Source<'_>, at: Word<'_>, name: &str, error: &io::Error) -> String {
    let name = Word { at: 0, text: name.as_bytes() }.quoted();
    source.warning(at.at, format!("cannot read material library {name}: {}", reason(error)))
}

/// Cuts at blanks after `.mtl`, or at every blank where there is no such name.
fn split_names(line: &str) -> Vec<String> {
    let is_end = |word: &str| word.to_ascii_lowercase().ends_with(".mtl");
    let any = line.split_ascii_whitespace().any(is_end);
    let mut names = vec![String::new()];
    for word in line.split_ascii_whitespace() {
        let name = names.last_mut().expect("never empty");
        if !name.is_empty() {
            name.push(' ');
        }
        name.push_str(word);
        if !any || is_end(word) {
            names.push(String::new());
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

/// What is stated of a material is what its illumination model asks for. Light goes through it as
/// far as it is dissolved (`d`); where the model is refraction, 6 or 7, and nothing is dissolved, as
/// far as highlights leave of it. It is filtered by `Tf`, and bent by `Ni` but in the models that
/// know no glass.
fn convert(name: String, stated: &Stated<'_>, material: &tobj::Material) -> Material {
    let default = Material::default();
    let color = |value: Option<[f32; 3]>, otherwise| value.map_or(otherwise, Vec3::from);
    let specular = color(material.specular, default.specular);
    // A texture is a colour by itself.
    let diffuse = if stated.map.is_some() { Vec3::ONE } else { default.diffuse };
    let model = material.illumination_model;
    let reflects = matches!(model, Some(3..=9));
    let refracts = matches!(model, Some(6 | 7));
    let opacity = material.dissolve.unwrap_or(1.0).min(1.0);
    let through = match refracts && opacity == 1.0 {
        true => (Vec3::ONE - specular).max(Vec3::ZERO),
        false => Vec3::splat(1.0 - opacity),
    };
    let bends = matches!(model, None | Some(4..=9));
    let ior = material.optical_density.filter(|&ior| bends && ior > 0.0);
    Material {
        name,
        diffuse: color(material.diffuse, diffuse) * opacity,
        diffuse_map: None,
        specular,
        shininess: material.shininess.unwrap_or(default.shininess),
        mirror: if reflects { specular } else { default.mirror },
        transmission: through * stated.filter.unwrap_or(Vec3::ONE),
        ior: ior.unwrap_or(default.ior),
        fresnel: matches!(model, Some(5 | 7)),
        emission: color(material.emissive, default.emission),
        one_sided: false,
    }
}

/// What of a material does not go through tobj.
struct Stated<'a> {
    name: Word<'a>,
    has_dissolve: bool,
    /// `Tf`.
    filter: Option<Vec3>,
    /// `map_Kd`.
    map: Option<Map>,
}

/// Checks an MTL text and writes what is good of it, materials named by their number.
struct Cleaner<'a> {
    source: Source<'a>,
    lexer: Lexer<'a>,
    clean: Vec<u8>,
    stated: Vec<Stated<'a>>,
    library: usize,
    /// The first statement of a texture that is not drawn, and all that it and others name.
    texture: Option<Word<'a>>,
    textures: HashSet<&'a [u8]>,
    warnings: Vec<String>,
}

impl<'a> Cleaner<'a> {
    /// `library` is the number of the file.
    fn new(source: Source<'a>, library: usize) -> Self {
        Cleaner {
            library,
            source,
            lexer: Lexer::new(source.text),
            clean: Vec::new(),
            stated: Vec::new(),
            texture: None,
            textures: HashSet::new(),
            warnings: Vec::new(),
        }
    }

    fn run(&mut self) {
        let mut wrong = 0;
        loop {
            if let Some(keyword) = self.lexer.word()
                && let Err((at, message)) = self.statement(keyword)
            {
                wrong += 1;
                if wrong <= MAX_DIAGNOSTICS {
                    self.warnings.push(self.source.warning(at, message));
                }
            }
            if !self.lexer.next_line() {
                break;
            }
        }
        if wrong > MAX_DIAGNOSTICS {
            let more = plural((wrong - MAX_DIAGNOSTICS) as u64, "more line");
            self.warnings.push(format!("{}: {more} left out", self.source.name));
        }
        if let Some(first) = self.texture {
            let others = match self.textures.len() - 1 {
                0 => String::new(),
                count => format!(" and {}", plural(count as u64, "other")),
            };
            let texture = first.shown();
            let message = format!("{texture}{others}: no textures but map_Kd are drawn");
            self.warnings.push(self.source.warning(first.at, message));
        }
    }

    fn statement(&mut self, keyword: Word<'a>) -> Result<(), (usize, String)> {
        match keyword.text {
            b"newmtl" => {
                let name = self.lexer.rest();
                if name.text.is_empty() {
                    return Err((name.at, "expected a name after 'newmtl'".to_owned()));
                }
                self.clean.extend(format!("newmtl {}\n", self.stated.len()).bytes());
                self.stated.push(Stated { name, has_dissolve: false, filter: None, map: None });
                Ok(())
            }
            _ if self.stated.is_empty() => Ok(()),
            b"Kd" | b"Ks" | b"Ke" => self.values(keyword, 3),
            b"Ns" | b"Ni" => self.values(keyword, 1),
            b"Tf" => self.filter(),
            b"d" => self.dissolve(keyword),
            b"Tr" => self.transparency(),
            b"illum" => self.illumination(),
            b"map_Kd" | b"map_kd" => self.color_map(),
            map if map.starts_with(b"map_") || [&b"bump"[..], b"disp", b"refl"].contains(&map) => {
                self.texture(keyword);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// What glass does to light. In other forms of the statement there are no numbers to be had.
    fn filter(&mut self) -> Result<(), (usize, String)> {
        let before = self.lexer.clone();
        if self.lexer.word().is_some_and(|word| matches!(word.text, b"spectral" | b"xyz")) {
            return Ok(());
        }
        self.lexer = before;
        let words = self.numbers("'Tf'", 3)?;
        let mut filter = Vec3::ZERO;
        for (channel, word) in words.iter().enumerate() {
            filter[channel] = word.number().map_err(|message| (word.at, message))?;
        }
        if let Some(material) = self.stated.last_mut() {
            material.filter = Some(filter);
        }
        Ok(())
    }

    /// One number may stand for a grey.
    fn values(&mut self, keyword: Word<'a>, wanted: usize) -> Result<(), (usize, String)> {
        let words = self.numbers(&keyword.quoted(), wanted)?;
        self.clean.extend_from_slice(keyword.text);
        for word in words {
            self.clean.push(b' ');
            self.clean.extend_from_slice(word.text);
        }
        self.clean.push(b'\n');
        Ok(())
    }

    fn numbers(&mut self, keyword: &str, wanted: usize) -> Result<Vec<Word<'a>>, (usize, String)> {
        let mut words = Vec::new();
        while let Some(word) = self.lexer.word().filter(|_| words.len() < wanted) {
            let value = word.number().map_err(|message| (word.at, message))?;
            if value < 0.0 {
                let message = format!("expected a number of at least 0, found {}", word.quoted());
                return Err((word.at, message));
            }
            words.push(word);
        }
        if words.len() == 1 {
            words.resize(wanted, words[0]);
        } else if words.len() < wanted {
            let s = if wanted == 1 { "" } else { "s" };
            let message =
                format!("expected {wanted} number{s} after {keyword}, found {}", words.len());
            return Err((self.lexer.at(), message));
        }
        Ok(words)
    }

    /// Perhaps only at the rim, which is no different here.
    fn dissolve(&mut self, keyword: Word<'a>) -> Result<(), (usize, String)> {
        let before = self.lexer.clone();
        if self.lexer.word().is_none_or(|word| word.text != b"-halo") {
            self.lexer = before;
        }
        if let Some(material) = self.stated.last_mut() {
            material.has_dissolve = true;
        }
        self.values(keyword, 1)
    }

    /// The opposite of `d`, which counts if both are stated: some programs confuse the two.
    fn transparency(&mut self) -> Result<(), (usize, String)> {
        let Some(word) = self.lexer.word() else {
            let message = "expected 1 number after 'Tr', found 0".to_owned();
            return Err((self.lexer.at(), message));
        };
        let value = word.number().map_err(|message| (word.at, message))?;
        if !self.stated.last().is_some_and(|material| material.has_dissolve) {
            self.clean.extend(format!("d {}\n", (1.0 - value).clamp(0.0, 1.0)).bytes());
        }
        Ok(())
    }

    fn illumination(&mut self) -> Result<(), (usize, String)> {
        let word = self.lexer.word().unwrap_or(Word { at: self.lexer.at(), text: b"" });
        let Some(model) = word.parse::<u8>() else {
            let message =
                format!("expected an illumination model of 0 to 10, found {}", word.quoted());
            return Err((word.at, message));
        };
        self.clean.extend(format!("illum {model}\n").bytes());
        Ok(())
    }

    fn color_map(&mut self) -> Result<(), (usize, String)> {
        let map = Map::read(&mut self.lexer, self.library)?;
        if let Some(material) = self.stated.last_mut() {
            material.map = Some(map);
        }
        Ok(())
    }

    fn texture(&mut self, keyword: Word<'a>) {
        let name = self.lexer.rest();
        self.textures.insert(name.text);
        let whole = &self.source.text[keyword.at..name.at + name.text.len()];
        self.texture.get_or_insert(Word { at: keyword.at, text: whole });
    }
}
