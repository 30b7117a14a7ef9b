//! Textures that material libraries name.

use std::collections::HashMap;
use std::io;
use std::sync::Arc;

use glam::Vec2;

use super::mtl::Loader;
use crate::diag::{MAX_DIAGNOSTICS, plural, reason};
use crate::model::{ColorMap, Facts};
use crate::text::{Lexer, Source, Word, decode};
use crate::texture::Texture;

/// No more files than this are tried.
const MAX_TEXTURES: usize = 1024;

/// A statement of a texture.
#[derive(Clone, Copy)]
pub(super) struct Map {
    /// Index of the library, and where it names the file.
    pub(super) library: usize,
    pub(super) at: usize,
    /// The name's length in bytes.
    pub(super) len: usize,
    scale: Vec2,
    offset: Vec2,
}

/// Options of a texture, and how many words follow each.
const OPTIONS: [(&str, usize); 10] = [
    ("-blendu", 1),
    ("-blendv", 1),
    ("-cc", 1),
    ("-clamp", 1),
    ("-texres", 1),
    ("-boost", 1),
    ("-bm", 1),
    ("-imfchan", 1),
    ("-type", 1),
    ("-mm", 2),
];

impl Map {
    /// Reads the rest of a statement: options and a name, which may hold blanks. Of the options those
    /// count that scale and move.
    pub(super) fn read(lexer: &mut Lexer<'_>, library: usize) -> Result<Map, (usize, String)> {
        let (mut scale, mut offset) = (Vec2::ONE, Vec2::ZERO);
        loop {
            let before = lexer.clone();
            let Some(word) = lexer.word() else { break };
            match word.text {
                b"-s" => scale = vector(lexer, word)?,
                b"-o" => offset = vector(lexer, word)?,
                b"-t" => drop(vector(lexer, word)?),
                _ => match OPTIONS.iter().find(|(name, _)| name.as_bytes() == word.text) {
                    Some((_, words)) => {
                        for _ in 0..*words {
                            lexer.word();
                        }
                    }
                    None => {
                        *lexer = before;
                        break;
                    }
                },
            }
        }
        let name = lexer.rest();
        if name.text.is_empty() {
            return Err((name.at, "expected the name of a texture".to_owned()));
        }
        Ok(Map { library, at: name.at, len: name.text.len(), scale, offset })
    }
}

/// One to three numbers; the third is not for pictures.
fn vector(lexer: &mut Lexer<'_>, keyword: Word<'_>) -> Result<Vec2, (usize, String)> {
    let mut found = Vec::new();
    while found.len() < 3 {
        let before = lexer.clone();
        match lexer.word().map(|word| word.number()) {
            Some(Ok(number)) => found.push(number),
            _ => {
                *lexer = before;
                break;
            }
        }
    }
    match found[..] {
        [] => Err((lexer.at(), format!("expected a number after {}", keyword.quoted()))),
        [u] => Ok(Vec2::splat(u)),
        [u, v, ..] => Ok(Vec2::new(u, v)),
    }
}

/// The textures that are used, each read once.
#[derive(Default)]
pub(super) struct Textures {
    /// By library's folder and name; none if it cannot be read.
    numbers: HashMap<(String, String), Option<u32>>,
    missing: usize,
    pub(super) textures: Vec<Arc<Texture>>,
}

impl Textures {
    /// The texture of a material, read from `load`; a warning if it cannot be.
    pub(super) fn open(
        &mut self,
        map: &Map,
        library: &Source<'_>,
        load: &mut Loader<'_>,
        facts: &mut Facts,
    ) -> Option<ColorMap> {
        let word = Word { at: map.at, text: &library.text[map.at..map.at + map.len] };
        let name = decode(word.text).replace('\\', "/");
        let folder = library.name.replace('\\', "/");
        let folder = folder.rfind('/').map_or("", |end| &folder[..=end]).to_owned();
        let key = (folder, name);
        let number = match self.numbers.get(&key) {
            Some(&number) => number,
            None if self.numbers.len() >= MAX_TEXTURES => return None,
            None => {
                let number = match read(&key.0, &key.1, load) {
                    Ok(texture) => {
                        self.textures.push(Arc::new(texture));
                        Some(self.textures.len() as u32 - 1)
                    }
                    Err(why) => {
                        let message = format!("cannot read texture {}: {why}", word.quoted());
                        self.miss(|| library.warning(word.at, message), facts);
                        None
                    }
                };
                self.numbers.insert(key, number);
                if self.numbers.len() == MAX_TEXTURES {
                    let rest = format!("more than {MAX_TEXTURES} textures: the rest is not read");
                    facts.warnings.push(rest);
                }
                number
            }
        };
        number.map(|texture| ColorMap { texture, scale: map.scale, offset: map.offset })
    }

    fn miss(&mut self, warning: impl FnOnce() -> String, facts: &mut Facts) {
        self.missing += 1;
        if self.missing <= MAX_DIAGNOSTICS {
            let warning = warning();
            facts.missing.push(warning.clone());
            facts.warnings.push(warning);
        }
    }

    /// Tells how many more cannot be read.
    pub(super) fn finish(&self, name: &str, facts: &mut Facts) {
        if self.missing > MAX_DIAGNOSTICS {
            let more = plural((self.missing - MAX_DIAGNOSTICS) as u64, "more texture");
            facts.warnings.push(format!("{name}: {more} cannot be read"));
        }
    }
}

/// Looks beside the library, beside the scene, and there for the name without its folders, which may be
/// those of another machine.
fn read(folder: &str, name: &str, load: &mut Loader<'_>) -> Result<Texture, String> {
    let base = name.rsplit('/').next().unwrap_or(name);
    let mut tried: Vec<String> = Vec::new();
    let mut first: Option<io::Error> = None;
    for path in [format!("{folder}{name}"), name.to_owned(), format!("{folder}{base}")] {
        if tried.contains(&path) {
            continue;
        }
        match load(&path) {
            Ok(bytes) => return Texture::decode(&bytes),
            Err(error) => drop(first.get_or_insert(error)),
        }
        tried.push(path);
    }
    Err(first.map_or_else(String::new, |error| reason(&error)))
}
