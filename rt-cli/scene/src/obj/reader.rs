//! Checks an OBJ text statement by statement and hands on what [`tobj`] understands.
//!
//! What comes out is ASCII and holds nothing but good `v`, `vt`, `vn` and `f` lines. Names and
//! everything else stay here: so one mesh comes of it, whose vertices the materials share.

use std::collections::HashMap;
use std::io::{self, BufRead, Read};

use crate::diag::{Diagnostic, Error, MAX_DIAGNOSTICS};
use crate::model::Skipped;
use crate::text::{Lexer, Source, Word};

/// Clean text is made in pieces of about this many bytes.
const PIECE: usize = 1 << 16;

/// What a corner's indices count, in the order of `position/texture/normal`: the statement, the
/// numbers it needs, and what messages call one and many.
const LISTS: [(&str, usize, &str, &str); 3] = [
    ("v", 3, "vertex", "vertices"),
    ("vt", 1, "texture coordinate", "texture coordinates"),
    ("vn", 3, "normal", "normals"),
];

const POSITION: usize = 0;
const TEXTURE: usize = 1;
const NORMAL: usize = 2;

/// Statements that draw what is not drawn here.
const NOT_DRAWN: [(&str, &str); 10] = [
    ("l", "lines are not drawn"),
    ("p", "points are not drawn"),
    ("curv", "free-form curves are not drawn"),
    ("curv2", "free-form curves are not drawn"),
    ("surf", "free-form surfaces are not drawn"),
    ("cdc", "free-form curves are not drawn"),
    ("cdp", "free-form surfaces are not drawn"),
    ("bzp", "free-form surfaces are not drawn"),
    ("bsp", "free-form surfaces are not drawn"),
    ("call", "other OBJ files are not included"),
];

/// Statements that draw nothing by themselves.
const SILENT: [&str; 26] = [
    "o",
    "g",
    "mg",
    "vp",
    "deg",
    "bmat",
    "step",
    "cstype",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "usemap",
    "maplib",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "csh",
];

/// Faces from `first` up to the next run have this material, are in this smoothing group, and do or
/// don't have normals and texture coordinates.
#[derive(Clone, Copy)]
pub(super) struct Run {
    pub(super) first: usize,
    /// Index into [`Outline::names`].
    pub(super) material: Option<u32>,
    pub(super) smoothing: Option<u32>,
    pub(super) normals: bool,
    pub(super) uvs: bool,
}

/// What the clean text does not say.
#[derive(Default)]
pub(super) struct Outline<'a> {
    /// How many positions, texture coordinates and normals the file states.
    pub(super) counts: [usize; 3],
    pub(super) faces: usize,
    pub(super) runs: Vec<Run>,
    /// What `usemtl` names, each name once.
    pub(super) names: Vec<Word<'a>>,
    /// What `mtllib` names, line by line.
    pub(super) libraries: Vec<Word<'a>>,
    pub(super) skipped: Vec<Skipped>,
}

/// The checker; read from, it gives the clean text.
pub(super) struct Reader<'a> {
    source: Source<'a>,
    lexer: Lexer<'a>,
    clean: Vec<u8>,
    consumed: usize,
    ended: bool,
    errors: Vec<Diagnostic>,
    outline: Outline<'a>,
    material: Option<u32>,
    smoothing: Option<u32>,
    materials: HashMap<&'a [u8], u32>,
    not_drawn: [u64; NOT_DRAWN.len()],
    /// The first unknown statement, and how many there are.
    unknown: Option<(Word<'a>, u64)>,
    /// The highest index stated, for each list: a face may come before what it names.
    highest: [i64; 3],
    /// The lengths of the lists, once they are known.
    limits: [i64; 3],
}

impl<'a> Reader<'a> {
    pub(super) fn new(source: Source<'a>) -> Self {
        Reader {
            source,
            lexer: Lexer::new(source.text),
            clean: Vec::new(),
            consumed: 0,
            ended: source.text.is_empty(),
            errors: Vec::new(),
            outline: Outline::default(),
            material: None,
            smoothing: None,
            materials: HashMap::new(),
            not_drawn: [0; NOT_DRAWN.len()],
            unknown: None,
            highest: [0; 3],
            limits: [i64::MAX; 3],
        }
    }

    /// What is known when all of the file has been read.
    pub(super) fn finish(mut self) -> Result<Outline<'a>, Error> {
        self.check_rest();
        if !self.errors.is_empty() {
            return Err(Error::Invalid(self.errors));
        }
        if self.outline.faces == 0 {
            let message = "no faces: nothing to draw without 'f' statements";
            return Err(Error::Invalid(vec![Diagnostic::whole(self.source.name, message)]));
        }
        let mut skip = |what: &str, why: String, count| {
            self.outline.skipped.push(Skipped { what: what.to_owned(), why, count });
        };
        for ((what, why), count) in NOT_DRAWN.into_iter().zip(self.not_drawn) {
            if count > 0 {
                skip(what, why.to_owned(), count);
            }
        }
        if let Some((first, count)) = self.unknown {
            let first = self.source.warning(first.at, first.quoted());
            skip("other statement", format!("not known; the first is {first}"), count);
        }
        Ok(self.outline)
    }

    /// Goes through the rest of the file for its errors only.
    fn check_rest(&mut self) {
        while !self.ended {
            self.refill();
        }
    }

    /// Fills `clean`. If it stays empty, the file has ended or is in error.
    fn refill(&mut self) {
        self.clean.clear();
        self.consumed = 0;
        while !self.ended && self.clean.len() < PIECE {
            self.statement();
            if !self.errors.is_empty() {
                self.clean.clear();
            }
            self.ended = self.errors.len() == MAX_DIAGNOSTICS || !self.lexer.next_line();
        }
        if self.ended && self.errors.len() < MAX_DIAGNOSTICS {
            self.check_highest();
        }
    }

    /// If an index never came true, reads again, knowing how long the lists are, to say where.
    fn check_highest(&mut self) {
        let counts = self.outline.counts.map(|count| count as i64);
        let late = self.highest.iter().zip(counts).any(|(&index, count)| index > count);
        if late && self.limits != counts {
            let mut again = Reader { limits: counts, ..Reader::new(self.source) };
            again.check_rest();
            self.errors = again.errors;
        }
    }

    fn statement(&mut self) {
        let Some(keyword) = self.lexer.word() else { return };
        let checked = match keyword.text {
            b"v" => self.element(POSITION),
            b"vt" => self.element(TEXTURE),
            b"vn" => self.element(NORMAL),
            // `fo` is what old files call a face.
            b"f" | b"fo" => self.face(),
            _ => {
                self.other(keyword);
                Ok(())
            }
        };
        self.errors.extend(checked.err());
    }

    fn element(&mut self, list: usize) -> Result<(), Diagnostic> {
        let (keyword, wanted, _, many) = LISTS[list];
        // Even a bad element counts, or every index after it would look wrong too.
        self.outline.counts[list] += 1;
        if self.outline.counts[list] > u32::MAX as usize {
            return Err(self.error(self.lexer.at(), format!("more than {} {many}", u32::MAX)));
        }
        self.clean.extend_from_slice(keyword.as_bytes());
        for found in 0..wanted {
            let Some(word) = self.lexer.word() else {
                let s = if wanted == 1 { "" } else { "s" };
                let message =
                    format!("expected {wanted} number{s} after '{keyword}', found {found}");
                return Err(self.error(self.lexer.at(), message));
            };
            word.number().map_err(|message| self.error(word.at, message))?;
            self.hand_on(word);
        }
        if list == TEXTURE {
            match self.lexer.word() {
                Some(word) => {
                    word.number().map_err(|message| self.error(word.at, message))?;
                    self.hand_on(word);
                }
                // The picture is a line.
                None => self.clean.extend_from_slice(b" 0"),
            }
        }
        self.clean.push(b'\n');
        Ok(())
    }

    fn face(&mut self) -> Result<(), Diagnostic> {
        self.clean.push(b'f');
        let (mut corners, mut normals, mut uvs) = (0, true, true);
        while let Some(word) = self.lexer.word() {
            let stated = self.corner(word)?;
            normals &= stated[NORMAL].is_some();
            uvs &= stated[TEXTURE].is_some();
            self.hand_on(word);
            corners += 1;
        }
        if corners < 3 {
            let message = format!("expected 3 or more corners after 'f', found {corners}");
            return Err(self.error(self.lexer.at(), message));
        }
        self.clean.push(b'\n');
        let (material, smoothing) = (self.material, self.smoothing);
        let run = Run { first: self.outline.faces, material, smoothing, normals, uvs };
        let differs = |last: &Run| {
            let same = last.material == material && last.smoothing == smoothing;
            !(same && last.normals == normals && last.uvs == uvs)
        };
        if self.outline.runs.last().is_none_or(differs) {
            self.outline.runs.push(run);
        }
        self.outline.faces += 1;
        Ok(())
    }

    /// Checks `v`, `v/t`, `v//n` or `v/t/n`; says what is stated.
    fn corner(&mut self, word: Word<'a>) -> Result<[Option<i64>; 3], Diagnostic> {
        let malformed = || {
            let example = "a corner such as 1, 1/2, 1//3 or 1/2/3";
            self.error(word.at, format!("expected {example}, found {}", word.quoted()))
        };
        let mut stated = [None; 3];
        for (list, part) in word.text.split(|&byte| byte == b'/').enumerate() {
            let slot = stated.get_mut(list).ok_or_else(malformed)?;
            if !part.is_empty() {
                let part = Word { at: word.at, text: part };
                let digits = part.text.strip_prefix(b"-").unwrap_or(part.text);
                let index = match part.parse::<i64>() {
                    None if !digits.is_empty() && digits.iter().all(u8::is_ascii_digit) => {
                        let message = format!("index {} is out of range", part.quoted());
                        return Err(self.error(word.at, message));
                    }
                    index => index.ok_or_else(malformed)?,
                };
                *slot = Some(index);
            }
        }
        if stated[POSITION].is_none() {
            return Err(malformed());
        }
        for (list, index) in stated.into_iter().enumerate() {
            if let Some(index) = index {
                self.check_index(list, index).map_err(|message| self.error(word.at, message))?;
            }
        }
        Ok(stated)
    }

    fn check_index(&mut self, list: usize, index: i64) -> Result<(), String> {
        let (_, _, one, many) = LISTS[list];
        let total = |count: i64| format!("{count} {}", if count == 1 { one } else { many });
        let (so_far, limit) = (self.outline.counts[list] as i64, self.limits[list]);
        self.highest[list] = self.highest[list].max(index);
        if index == 0 {
            Err(format!("{one} index 0 is out of range: indices start at 1"))
        } else if index < -so_far {
            Err(format!("{one} index {index} is out of range: only {} so far", total(so_far)))
        } else if index > limit {
            Err(format!("{one} index {index} is out of range: the file has {}", total(limit)))
        } else {
            Ok(())
        }
    }

    fn other(&mut self, keyword: Word<'a>) {
        let is = |name: &str| name.as_bytes() == keyword.text;
        match keyword.text {
            // Off is 0, and whatever else is no number.
            b"s" => {
                let group = self.lexer.word().and_then(|word| word.parse::<u32>());
                self.smoothing = group.filter(|&group| group > 0);
            }
            b"mtllib" => self.outline.libraries.push(self.lexer.rest()),
            b"usemtl" => {
                let name = self.lexer.rest();
                let names = &mut self.outline.names;
                self.material = (!name.text.is_empty()).then(|| {
                    *self.materials.entry(name.text).or_insert_with(|| {
                        names.push(name);
                        names.len() as u32 - 1
                    })
                });
            }
            _ => {
                if let Some(kind) = NOT_DRAWN.iter().position(|(name, _)| is(name)) {
                    self.not_drawn[kind] += 1;
                } else if !SILENT.iter().any(|name| is(name)) {
                    self.unknown.get_or_insert((keyword, 0)).1 += 1;
                }
            }
        }
    }

    fn hand_on(&mut self, word: Word<'_>) {
        self.clean.push(b' ');
        self.clean.extend_from_slice(word.text);
    }

    fn error(&self, at: usize, message: String) -> Diagnostic {
        self.source.diagnostic(at, message)
    }
}

impl Read for Reader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.fill_buf()?.read(buffer)?;
        self.consume(length);
        Ok(length)
    }
}

impl BufRead for Reader<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.consumed == self.clean.len() {
            self.refill();
        }
        // The errors are told by `finish`: this only keeps anyone from using the half of a file.
        if self.errors.is_empty() {
            Ok(&self.clean[self.consumed..])
        } else {
            Err(io::Error::other("not a valid OBJ"))
        }
    }

    fn consume(&mut self, length: usize) {
        self.consumed += length;
    }
}
