//! One file of a scene while it is read: words, numbers, and what is wrong with them.

use glam::Vec3;

use super::lexer::Lexer;
use crate::diag::{Diagnostic, Error};
use crate::text::{Source, Word};

/// A statement that is wrong.
pub(super) type Checked<T = ()> = Result<T, Diagnostic>;

pub(super) struct File<'a> {
    source: Source<'a>,
    lexer: Lexer<'a>,
}

impl<'a> File<'a> {
    pub(super) fn new(name: &'a str, bytes: &'a [u8]) -> Result<Self, Error> {
        let source = Source::new(name, bytes, "AFF")?;
        Ok(File { source, lexer: Lexer::new(source.text) })
    }

    pub(super) fn word(&mut self) -> Option<Word<'a>> {
        self.lexer.word()
    }

    /// The next word, if it is a certain one.
    pub(super) fn take(&mut self, wanted: &[u8]) -> bool {
        let is_next = self.lexer.peek().is_some_and(|word| word.text == wanted);
        if is_next {
            self.lexer.word();
        }
        is_next
    }

    /// Takes a certain word, which has to be next.
    pub(super) fn expect(&mut self, wanted: &str) -> Checked {
        match self.take(wanted.as_bytes()) {
            true => Ok(()),
            false => Err(self.expected(&format!("'{wanted}'"))),
        }
    }

    /// A name: any word but a brace.
    pub(super) fn name(&mut self, what: &str) -> Checked<Word<'a>> {
        match self.lexer.peek() {
            Some(word) if !matches!(word.text, b"{" | b"}") => {
                self.lexer.word();
                Ok(word)
            }
            _ => Err(self.expected(what)),
        }
    }

    /// Whether a number is next.
    pub(super) fn has_number(&self) -> bool {
        self.lexer.peek().is_some_and(|word| word.number().is_ok())
    }

    /// So many numbers, of the statement that `keyword` begins.
    pub(super) fn numbers<const N: usize>(&mut self, keyword: &str) -> Checked<[f32; N]> {
        let mut numbers = [0.0; N];
        for (found, number) in numbers.iter_mut().enumerate() {
            let word = self.lexer.peek();
            let s = if N == 1 { "" } else { "s" };
            let short = || format!("expected {N} number{s} after '{keyword}', found {found}");
            let (at, message) = match word {
                Some(word) => match word.number() {
                    Ok(value) => {
                        *number = value;
                        self.lexer.word();
                        continue;
                    }
                    // A word here is the next statement, or a broken number.
                    Err(_) if !word.text.iter().any(u8::is_ascii_digit) => (word.at, short()),
                    Err(message) => (word.at, message),
                },
                None => (self.lexer.at(), short()),
            };
            return Err(self.error(at, message));
        }
        Ok(numbers)
    }

    pub(super) fn vector(&mut self, keyword: &str) -> Checked<Vec3> {
        self.numbers(keyword).map(Vec3::from_array)
    }

    /// A number of things, of which there are at least so many. It is only what the file claims.
    pub(super) fn count(&mut self, least: u64, what: &str) -> Checked<u64> {
        self.integer(least..=u64::MAX, &format!("{least} or more {what}"))
    }

    /// A whole number within a range.
    pub(super) fn integer(
        &mut self,
        range: std::ops::RangeInclusive<u64>,
        expected: &str,
    ) -> Checked<u64> {
        let number = self.lexer.peek().and_then(|word| word.parse::<u64>());
        match number.filter(|number| range.contains(number)) {
            Some(number) => {
                self.lexer.word();
                Ok(number)
            }
            None => Err(self.expected(expected)),
        }
    }

    /// What was expected instead of the next word.
    pub(super) fn expected(&self, expected: &str) -> Diagnostic {
        match self.lexer.peek() {
            Some(word) => {
                self.error(word.at, format!("expected {expected}, found {}", word.quoted()))
            }
            None => {
                let message = format!("expected {expected}, found the end of the file");
                self.error(self.lexer.at(), message)
            }
        }
    }

    pub(super) fn error(&self, at: usize, message: impl Into<String>) -> Diagnostic {
        self.source.diagnostic(at, message)
    }
}
