//! What went wrong, where, and how it is told.

use std::fmt;
use std::io;
use std::path::PathBuf;

/// A reader gives up after so many errors in one file.
pub(crate) const MAX_DIAGNOSTICS: usize = 10;

/// Anything that keeps this crate from reading or writing a scene. Its text is complete: it needs
/// no source beside it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read.
    #[error("cannot read {}: {}", .path.display(), reason(.source))]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file is not what its name promises: at most ten places, in the order of the file.
    #[error("{}", list(.0))]
    Invalid(Vec<Diagnostic>),
    /// No reader knows files with this extension.
    #[error("cannot tell the format of {}: files that are read end in {known}", .path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// The known extensions.
        known: &'static str,
    },
    /// There is no procedural scene of this name.
    #[error("unknown scene 'spd:{name}': there is {known}")]
    UnknownScene {
        /// The name without `spd:`.
        name: String,
        /// The known scenes.
        known: String,
    },
    /// A procedural scene does not come in this size.
    #[error("spd:{name} has no size '{size}': sizes go from {} to {}", .range.0, .range.1)]
    SceneSize {
        /// The name without `spd:`.
        name: &'static str,
        /// What was asked for.
        size: String,
        /// The least and the greatest size.
        range: (u32, u32),
    },
    /// A tessellation would have too many triangles.
    #[error("{name} has more than {limit} triangles at resolution {resolution}")]
    TooFine {
        /// The scene.
        name: String,
        /// The resolution that was asked for.
        resolution: u32,
        /// The greatest number of triangles.
        limit: u128,
    },
    /// The format that was asked for cannot express the scene.
    #[error("{0}")]
    Inexpressible(String),
    /// A scene could not be written.
    #[error("cannot write the scene: {}", reason(.0))]
    Write(#[source] io::Error),
}

/// One place in a file and what is wrong there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file, as the reader was told to call it.
    pub file: String,
    /// The line, from 1; 0 if this is about the file as a whole.
    pub line: usize,
    /// The column in characters, from 1; 0 if this is about the file as a whole.
    pub column: usize,
    /// What was expected and what was found.
    pub message: String,
    /// The line, or the part of a long line around the place, fit for a terminal: one character a
    /// column, no control characters.
    pub source_line: String,
    /// The character of `source_line` that `column` is about, from 0.
    pub caret: usize,
}

impl Diagnostic {
    /// About a file as a whole.
    pub(crate) fn whole(file: &str, message: impl Into<String>) -> Self {
        Diagnostic {
            file: file.to_owned(),
            line: 0,
            column: 0,
            message: message.into(),
            source_line: String::new(),
            caret: 0,
        }
    }

    /// Place and message on one line, without the source.
    pub fn headline(&self) -> String {
        match self.line {
            0 => format!("{}: {}", self.file, self.message),
            _ => format!("{}:{}:{}: {}", self.file, self.line, self.column, self.message),
        }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.headline())?;
        if self.line > 0 {
            write!(f, "\n  {}\n  {:>2$}", self.source_line, "^", self.caret + 1)?;
        }
        Ok(())
    }
}

fn list(diagnostics: &[Diagnostic]) -> String {
    let mut lines: Vec<String> = diagnostics.iter().map(Diagnostic::to_string).collect();
    if diagnostics.len() >= MAX_DIAGNOSTICS {
        lines.push(format!("stopped after {MAX_DIAGNOSTICS} errors"));
    }
    lines.join("\n")
}

/// The system's words without its error number.
pub(crate) fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    match text.rfind(" (os error ") {
        Some(end) => text[..end].to_owned(),
        None => text,
    }
}

/// `1 triangle`, `2 triangles`.
pub(crate) fn plural(count: u64, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
