//! Checks an OBJ text statement by statement and hands on what [`tobj`] understands.
//!
//! What comes out is ASCII and holds nothing but good `v`, `vn` and `f` lines. Names, texture
//! coordinates and everything else stay here, so that one mesh comes of it whose vertices the
//! materials share.

use std::collections::HashMap;
use std::io::{self, BufRead, Read};

use crate::diag::{Diagnostic, Error, MAX_DIAGNOSTICS, plural};
use crate::model::Skipped;
use crate::text::{Lexer, Source, Word};

/// Clean text is made in pieces of about this many bytes.
const PIECE: usize = 1 << 16;

/// What a face's index counts in: the order is that of a corner, `position/texture/normal`.
const LISTS: [(&str, &str); 3] =
    [("vertex", "vertices"), ("texture coordinate", "texture coordinates"), ("normal", "normals")];

/// Statements that draw something which is not drawn here.
const NOT_DRAWN: [(&[u8], &str); 8] = [
    (b"l", "lines are not drawn"),
    (b"p", "points are not drawn"),
    (b"curv", "free-form curves are not drawn"),
    (b"curv2", "free-form curves are not drawn"),
    (b"surf", "free-form surfaces are not drawn"),
    (b"bzp", "free-form surfaces are not drawn"),
    (b"bsp", "free-form surfaces are not drawn"),
    (b"call", "other OBJ files are not included"),
];

/// Statements that draw nothing by themselves.
const SILENT: [&[u8]; 39] = [
    b"o", b"g", b"s", b"mg", b"vp", b"deg", b"bmat", b"step", b"cstype", b"parm", b"trim", b"hole",
    b"scrv", b"sp", b"end", b"con", b"bevel", b"c_interp", b"d_interp", b"lod", b"usemap",
    b"maplib", b"shadow_obj", b"trace_obj", b"ctech", b"stech", b"csh", b"cdc", b"cdp", b"res",
    b"vertex", b"x", b"y", b"z", b"u", b"w", b"group", b"off", b"on",
];

/// Faces from `first` on, up to the next run, have this material and do or don't have normals.
#[derive(Clone, Copy)]
pub(super) struct Run {
    pub(super) first: usize,
    /// Index into [`Outline::names`].
    pub(super) material: Option<u32>,
    pub(super) normals: bool,
}

/// What the clean text does not say.
pub(super) struct Outline<'a> {
    /// How many positions, texture coordinates and normals the file states.
    pub(super) counts: [usize; 3],
    pub(super) faces: usize,
    pub(super) runs: Vec<Run>,
    /// What `usemtl` names, in the order of first use.
    pub(super) names: Vec<Word<'a>>,
    /// What `mtllib` names.
    pub(super) libraries: Vec<Word<'a>>,
    pub(super) skipped: Vec<Skipped>,
}

/// The checker; as a reader, it gives the clean text.
pub(super) struct Reader<'a> {
    source: Source<'a>,
    lexer: Lexer<'a>,
    clean: Vec<u8>,
    consumed: usize,
    ended: bool,
    errors: Vec<Diagnostic>,
    outline: Outline<'a>,
    material: Option<u32>,
    materials: HashMap<&'a [u8], u32>,
    not_drawn: [u64; NOT_DRAWN.len()],
    unknown: Option<(Word<'a>, u64)>,
    /// The highest index that faces state, for each list: they may come before what they name.
    highest: [i64; 3],
    /// The lists' lengths, once they are known.
    limits: [i64; 3],
}

impl<'a> Reader<'a> {
    pub(super) fn new(source: Source<'a>) -> Self {
        Reader {
            source,
            lexer: Lexer::new(source.text),
            clean: Vec::with_capacity(PIECE.min(source.text.len())),
            consumed: 0,
            ended: false,
            errors: Vec::new(),
            outline: Outline {
                counts: [0; 3],
                faces: 0,
                runs: Vec::new(),
                names: Vec::new(),
                libraries: Vec::new(),
                skipped: Vec::new(),
            },
            material: None,
            materials: HashMap::new(),
            not_drawn: [0; NOT_DRAWN.len()],
            unknown: None,
            highest: [0; 3],
            limits: [i64::MAX; 3],
        }
    }

    /// To be called when everything has been read.
    pub(super) fn finish(mut self) -> Result<Outline<'a>, Error> {
        if !self.errors.is_empty() {
            return Err(Error::Invalid(self.errors));
        }
        if self.outline.faces == 0 {
            let message = "no faces: an OBJ needs 'f' statements to show anything";
            return Err(Error::Invalid(vec![Diagnostic::whole(self.source.name, message)]));
        }
        for (&(what, why), &count) in NOT_DRAWN.iter().zip(&self.not_drawn) {
            let what = String::from_utf8_lossy(what).into_owned();
            self.outline.skipped.extend((count > 0).then(|| Skipped { what, why: why.to_owned(), count }));
        }
        if let Some((first, count)) = self.unknown {
            let place = self.source.warning(first.at, first.quoted());
            let why = format!("not OBJ that is known here; the first is {place}");
            self.outline.skipped.push(Skipped { what: "other statement".to_owned(), why, count });
        }
        Ok(self.outline)
    }

    /// Fills `clean`; nothing more comes if it stays empty.
    fn refill(&mut self) {
        self.clean.clear();
        self.consumed = 0;
        while !self.ended && (self.clean.len() < PIECE || !self.errors.is_empty()) {
            self.line();
            self.ended |= !self.lexer.next_line() || self.errors.len() == MAX_DIAGNOSTICS;
        }
        let counts = self.outline.counts.map(|count| count as i64);
        let late = self.highest.iter().zip(counts).any(|(&index, count)| index > count);
        if self.ended && late && self.limits != counts {
            // Some index never came true. To say which, read again, knowing how long the lists are.
            let mut again = Reader { limits: counts, ..Reader::new(self.source) };
            while !again.ended {
                again.refill();
            }
            self.errors = again.errors;
        }
        if !self.errors.is_empty() {
            self.clean.clear();
        }
    }

    fn line(&mut self) {
        let Some(keyword) = self.lexer.word() else { return };
        let before = self.clean.len();
        let checked = match keyword.text {
            b"v" => self.numbers(keyword, 3).map(|()| self.outline.counts[0] += 1),
            b"vt" => self.numbers(keyword, 1).map(|()| self.outline.counts[1] += 1),
            b"vn" => self.numbers(keyword, 3).map(|()| self.outline.counts[2] += 1),
            b"f" | b"fo" => self.face(),
            b"usemtl" => {
                self.use_material();
                Ok(())
            }
            b"mtllib" => {
                let names = self.lexer.rest();
                self.outline.libraries.push(names);
                Ok(())
            }
            other => {
                self.pass_over(keyword, other);
                Ok(())
            }
        };
        if let Err(diagnostic) = checked {
            self.clean.truncate(before);
            self.errors.push(diagnostic);
            // A bad element counts all the same, or every index after it would look wrong too.
            match keyword.text {
                b"v" => self.outline.counts[0] += 1,
                b"vt" => self.outline.counts[1] += 1,
                b"vn" => self.outline.counts[2] += 1,
                _ => {}
            }
        }
    }
}
