//! Text files as they come: any line ending, any eight-bit encoding, words with their places.
//!
//! A word is a slice of the file, and its place is a byte offset. Lines and columns are counted
//! only when somebody has to be told.

use std::borrow::Cow;
use std::fs;
use std::io;
use std::path::Path;

use crate::diag::{Diagnostic, Error};

/// Of a long line this many characters are shown on either side of the place.
const CONTEXT: usize = 60;
/// Of a long word this many characters are quoted.
const QUOTE: usize = 40;

/// The bytes of a regular file. (A pipe or a device might never end.)
pub(crate) fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    let kind = fs::metadata(path)?.file_type();
    if kind.is_dir() {
        return Err(io::Error::other("it is a directory"));
    }
    if !kind.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    fs::read(path)
}

/// A text file in memory.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// What messages call it.
    pub(crate) name: &'a str,
    /// Its bytes, without a byte order mark. No byte is zero.
    pub(crate) text: &'a [u8],
}

impl<'a> Source<'a> {
    /// Takes text only; `format` (`OBJ`, …) is for the message if it is anything else.
    pub(crate) fn new(name: &'a str, bytes: &'a [u8], format: &str) -> Result<Self, Error> {
        let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        let problem = if text.starts_with(b"\xFF\xFE") || text.starts_with(b"\xFE\xFF") {
            format!("this is UTF-16 text: save it as UTF-8 to have it read as {format}")
        } else if let Some(at) = text.iter().position(|&byte| byte == 0) {
            format!("this is not {format} text: byte {} is zero", at + bytes.len() - text.len() + 1)
        } else {
            return Ok(Source { name, text });
        };
        Err(Error::Invalid(vec![Diagnostic::whole(name, problem)]))
    }

    /// What is wrong at a byte offset.
    pub(crate) fn diagnostic(&self, at: usize, message: impl Into<String>) -> Diagnostic {
        let (before, after) = self.text.split_at(at);
        let start = before.iter().rposition(|&byte| is_line_end(byte)).map_or(0, |end| end + 1);
        let lines = line_ends(&self.text[..start]);
        let before = &before[start..];
        let after = &after[..after.iter().position(|&b| is_line_end(b)).unwrap_or(after.len())];
        let column = std::str::from_utf8(before).map_or(before.len(), |text| text.chars().count());

        // A character has at most four bytes: cut before decoding, the line may be the whole file.
        let (head, head_cut) = last(before, 4 * CONTEXT);
        let head = printable(head);
        let shown = head.chars().count();
        let skipped = shown.saturating_sub(CONTEXT);
        let mut source_line: String = head.chars().skip(skipped).collect();
        let mut caret = shown - skipped;
        if head_cut || skipped > 0 {
            source_line.insert(0, '…');
            caret += 1;
        }
        let (tail, tail_cut) = first(after, 4 * CONTEXT);
        let tail = printable(tail);
        source_line.extend(tail.chars().take(CONTEXT));
        if tail_cut || tail.chars().count() > CONTEXT {
            source_line.push('…');
        }
        Diagnostic {
            file: self.name.to_owned(),
            line: lines + 1,
            column: column + 1,
            message: message.into(),
            source_line,
            caret,
        }
    }

    /// A warning with its place, on one line.
    pub(crate) fn warning(&self, at: usize, message: impl Into<String>) -> String {
        self.diagnostic(at, message).headline()
    }
}

/// A word and its byte offset.
#[derive(Clone, Copy)]
pub(crate) struct Word<'a> {
    pub(crate) at: usize,
    pub(crate) text: &'a [u8],
}

impl Word<'_> {
    /// For messages: fit for a terminal, not too long.
    pub(crate) fn shown(&self) -> String {
        let (text, cut) = first(self.text, 4 * QUOTE);
        let text = printable(text);
        let more = if cut || text.chars().count() > QUOTE { "…" } else { "" };
        text.chars().take(QUOTE).collect::<String>() + more
    }

    /// The same in quotes.
    pub(crate) fn quoted(&self) -> String {
        format!("'{}'", self.shown())
    }

    /// The finite number that this word is, or a message.
    pub(crate) fn number(&self) -> Result<f32, String> {
        match self.parse::<f32>() {
            Some(value) if value.is_finite() => Ok(value),
            Some(_) if self.text.iter().any(u8::is_ascii_digit) => {
                Err(format!("{} is beyond the range of single precision", self.quoted()))
            }
            Some(_) => Err(format!("expected a finite number, found {}", self.quoted())),
            None => Err(format!("expected a number, found {}", self.quoted())),
        }
    }

    pub(crate) fn parse<T: std::str::FromStr>(&self) -> Option<T> {
        std::str::from_utf8(self.text).ok()?.parse().ok()
    }
}

/// Cuts a text into words and lines.
///
/// Lines end in LF, CR LF or CR; a backslash before that, or before the end of the text, continues
/// the line. `#` begins a comment.
#[derive(Clone)]
pub(crate) struct Lexer<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Lexer<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        Lexer { text, at: 0 }
    }

    /// Just after the last word.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// The next word of this line.
    #[inline]
    pub(crate) fn word(&mut self) -> Option<Word<'a>> {
        let mut start = self.at;
        while let length @ 1.. = self.blank(start) {
            start += length;
        }
        let mut end = start;
        while end < self.text.len() && !self.ends_word(end) {
            end += 1;
        }
        if end == start {
            return None;
        }
        self.at = end;
        Some(Word { at: start, text: &self.text[start..end] })
    }

    /// The rest of this line without blanks around it and without comment: a name may hold blanks.
    pub(crate) fn rest(&mut self) -> Word<'a> {
        let line = &self.text[self.at..];
        let line = &line[..line.iter().position(|&b| is_line_end(b)).unwrap_or(line.len())];
        let at = self.at + line.iter().take_while(|b| b.is_ascii_whitespace()).count();
        self.at += line.len();
        let name = line.trim_ascii();
        let comment =
            name.windows(2).position(|two| two[0].is_ascii_whitespace() && two[1] == b'#');
        Word { at, text: name[..comment.unwrap_or(name.len())].trim_ascii_end() }
    }

    /// Goes to the next line, over what is left of this one; false if there is none.
    #[inline]
    pub(crate) fn next_line(&mut self) -> bool {
        while self.word().is_some() {}
        while let length @ 1.. = self.blank(self.at) {
            self.at += length;
        }
        // A comment may end in a backslash (a Windows path): it does not go on.
        while self.text.get(self.at).is_some_and(|&byte| !is_line_end(byte)) {
            self.at += 1;
        }
        self.at += line_end(&self.text[self.at..]);
        self.at < self.text.len()
    }

    /// How many bytes of blank, of one kind, are here.
    #[inline]
    fn blank(&self, at: usize) -> usize {
        match self.text.get(at) {
            Some(b' ' | b'\t' | b'\x0B' | b'\x0C') => 1,
            Some(b'\\') => match line_end(&self.text[at + 1..]) {
                0 if at + 1 < self.text.len() => 0,
                length => 1 + length,
            },
            _ => 0,
        }
    }

    #[inline]
    fn ends_word(&self, at: usize) -> bool {
        match self.text[at] {
            b' ' | b'\t'..=b'\r' => true,
            // Not after a point: `1.#INF` is how some C libraries write infinity.
            b'#' => at == 0 || self.text[at - 1] != b'.',
            b'\\' => self.blank(at) > 0,
            _ => false,
        }
    }
}

/// UTF-8 if it is that, else Latin-1.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect()),
    }
}

fn is_line_end(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}

/// The length of the line end that the text begins with.
fn line_end(text: &[u8]) -> usize {
    match text {
        [b'\r', b'\n', ..] => 2,
        [b'\r' | b'\n', ..] => 1,
        _ => 0,
    }
}

fn line_ends(text: &[u8]) -> usize {
    let (mut count, mut previous) = (0, 0);
    for &byte in text {
        count += usize::from(is_line_end(byte) && !(byte == b'\n' && previous == b'\r'));
        previous = byte;
    }
    count
}

/// Decoded, with a blank for a tab and a dot for anything else that does not print.
fn printable(bytes: &[u8]) -> String {
    let show = |c: char| match c {
        '\t' => ' ',
        // Marks that turn the direction of writing would garble the rest of the message.
        '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2060}'..='\u{206F}' => '.',
        _ if c.is_control() => '.',
        _ => c,
    };
    decode(bytes).chars().map(show).collect()
}

/// At most so many bytes from the front, not ending inside a character; and whether any are left.
fn first(bytes: &[u8], limit: usize) -> (&[u8], bool) {
    if bytes.len() <= limit {
        return (bytes, false);
    }
    let end = (limit - 3..=limit).rev().find(|&end| !is_continuation(bytes[end]));
    (&bytes[..end.unwrap_or(limit)], true)
}

/// The same from the back.
fn last(bytes: &[u8], limit: usize) -> (&[u8], bool) {
    let Some(cut) = bytes.len().checked_sub(limit).filter(|&cut| cut > 0) else {
        return (bytes, false);
    };
    let start = (cut..cut + 3).find(|&start| !is_continuation(bytes[start]));
    (&bytes[start.unwrap_or(cut)..], true)
}

fn is_continuation(byte: u8) -> bool {
    byte & 0xC0 == 0x80
}
