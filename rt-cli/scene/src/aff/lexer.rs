//! Words of AFF: between blanks, or a brace; `#` and `%` begin a comment.

use crate::text::Word;

/// Cuts a text into words.
pub(super) struct Lexer<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Lexer { text, at: 0 }
    }

    /// Just after the last word.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// The next word, on whatever line.
    pub(super) fn word(&mut self) -> Option<Word<'a>> {
        let word = self.peek()?;
        self.at = word.at + word.text.len();
        Some(word)
    }

    /// The next word, which stays the next.
    pub(super) fn peek(&self) -> Option<Word<'a>> {
        let mut at = self.at;
        loop {
            match self.text.get(at)? {
                b'#' | b'%' => {
                    at += self.text[at..].iter().take_while(|b| !is_line_end(**b)).count()
                }
                byte if is_blank(*byte) => at += 1,
                _ => break,
            }
        }
        let rest = &self.text[at..];
        let ends = |byte: &u8| is_blank(*byte) || matches!(byte, b'{' | b'}' | b'#' | b'%');
        let len = rest.iter().position(ends).unwrap_or(rest.len()).max(1);
        Some(Word { at, text: &rest[..len] })
    }
}

fn is_blank(byte: u8) -> bool {
    byte.is_ascii_whitespace() || byte == b'\x0B'
}

fn is_line_end(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}
